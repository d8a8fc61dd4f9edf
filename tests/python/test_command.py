"""The command `bevel-differential`: its output, its files, and its messages about errors."""

import os
import re
import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest

from command_line import command
from command_list import line

from bevel_differential import Differential, Scene
from bevel_differential.command import FINDING
from bevel_differential.designs.sweep import SweepResult, sweep
from refusals import refused

SWEEP = ("sweep --scene study_turning --vary 'left.load_torque=700 N.m..900 N.m' --vary contact.law=line,line_weber --want left.speed:mean "
         "--condition 'efficiency >= 0.9' --from '0.14 s' --workers 0")

pytestmark = pytest.mark.usefixtures("folder")


def test_run_writes_the_record_of_the_scene():
    printed = command("run study_turning --set 'left.load_torque=700 N.m' --stop '50 ms' --output left.speed --output planet[1].left_pairs "
                      "--csv turn.csv --plot turn.png").out
    with Scene.load("study_turning") as scene:
        record = scene.set({"left.load_torque": 700.0}).run(["left.speed", "planet[1].left_pairs"], stop=0.05)
    assert "left.speed" in printed and f"{np.degrees(record['left.speed'][-1]):.6g}" in printed
    columns = np.loadtxt("turn.csv", delimiter=",", skiprows=1, unpack=True)
    assert all(np.array_equal(column, record[name]) for name, column in zip(record.dtype.names, columns, strict=True))
    assert Path("turn.csv").read_text().splitlines()[0] == "time,left.speed,planet[1].left_pairs"
    assert Path("turn.png").read_bytes().startswith(b"\x89PNG")


def test_a_picture_has_a_panel_for_each_unit_with_the_usual_one(fmu_file):
    with Differential(fmu=fmu_file) as straight:
        record = straight.run(outputs=["left.speed", "carrier.speed", "left.shaft_torque", "planet[1].left_pairs"], stop=0.01)
        figure = straight.plot(record)
    assert [axes.get_ylabel() for axes in figure.axes] == ["speed, deg/s", "shaft torque, N·m", "pairs"]
    # without margins, and in the unit that suits 10 ms
    assert figure.axes[-1].get_xlabel() == "time, ms" and figure.axes[-1].get_xlim() == (0.0, 1e3 * record["time"][-1])
    speed = figure.axes[0].lines[0].get_ydata()
    assert np.allclose(speed, np.degrees(record["left.speed"]), rtol=1e-15)
    assert [text.get_text() for text in figure.axes[0].get_legend().texts] == ["left.speed", "carrier.speed"]


@pytest.mark.parametrize("record", [np.zeros(3), [1.0, 2.0], np.zeros(3, [("time", float)]), np.zeros(3, [("left.speed", float)])])
def test_a_record_without_time_or_outputs_is_not_drawn(fmu_file, record):
    with Differential(fmu=fmu_file) as straight, refused("structured array with the time and named outputs"):
        straight.plot(record)


def test_a_frame_is_the_record_by_time(fmu_file):
    with Differential(fmu=fmu_file) as straight:
        record, frame = (straight.run(stop=0.01, frame=as_frame) for as_frame in (False, True))
    assert frame.index.name == "time" and np.array_equal(frame.index, record["time"])
    assert all(np.array_equal(frame[name], record[name]) for name in record.dtype.names[1:])


def test_sweep_prints_its_results_which_are_those_of_the_package():
    printed = command(f"{SWEEP} --plan sobol --runs 5 --seed 1 --set right.load_torque=800 --out found.parquet").out
    with Scene.load("study_turning") as scene:
        scene.set({"right.load_torque": 800.0})
        expected = sweep(scene, {"left.load_torque": "700 N.m..900 N.m", "contact.law": "line, line_weber"}, "sobol", 5, 1,
                         ["left.speed:mean"], ["efficiency >= 0.9"], "0.14 s", workers=0)
    assert SweepResult.load("found.parquet").digest() == expected.digest()
    assert all(text in printed for text in ("8 (5 requested", "feasible  8", "left.speed:mean", "found.parquet"))


def test_few_designs_are_printed_and_a_table_keeps_the_rows():
    grid = f"{SWEEP} --plan grid --stop '0.2 s'".replace("900 N.m'", "900 N.m:2'")
    lines = command(grid).out.splitlines()
    assert any(line.split()[:2] == ["quantity", "unit"] for line in lines) and "--out or --csv" in lines[-1]
    head = next(place for place, line in enumerate(lines) if line.startswith("run  "))
    assert lines[head].split() == ["run", "left.load_torque", "contact.law", "left.speed:mean", "efficiency:final"]
    assert [line.split()[:3] for line in lines[head + 1:head + 5]] == [
        ["0", "700", "line"], ["1", "700", "line_weber"], ["2", "900", "line"], ["3", "900", "line_weber"]]
    printed = command(f"{grid} --csv rows.csv").out
    assert "not kept" not in printed and "written: rows.csv" in printed
    many = command("sweep --scene study_turning --stop 1ms --vary left.load_torque=700..720:21 --plan grid --want left.speed --workers 0").out
    assert "\nrun  " not in many


def test_accuracy_separates_the_work_of_its_runs_from_the_time_of_the_search():
    assert re.search(r"\d+ runs, as much work as [\d.]+ reference runs of [\d.e-]+ s\. The search took [\d.e-]+ s, with the start of each "
                     r"run\.", command(line("accuracy")).out)


def test_a_plan_file_says_the_same_as_options_and_options_come_first():
    Path("plan.toml").write_text('scene = "study_turning"\nplan = "lhs"\nruns = 3\nseed = 1\nwant = ["left.speed:mean"]\n'
                                 'condition = ["efficiency >= 0.9"]\nfrom = "0.14 s"\n[vary]\nleft.load_torque = "700 N.m..900 N.m"\n'
                                 '"contact.law" = "line, line_weber"\n')
    command("sweep --plan-file plan.toml --runs 4 --workers 0 --out a.parquet")
    command(f"{SWEEP} --plan lhs --runs 4 --seed 1 --out b.parquet")
    assert SweepResult.load("a.parquet").digest() == SweepResult.load("b.parquet").digest()


def test_failures_are_listed_by_message_the_most_frequent_first():
    lines = command("sweep --scene study_turning --vary 'geometry.module=-1 mm, -2 mm, 4.5 mm' --vary left.load_torque=1,2 --plan grid "
                    "--want left.speed --workers 0", FINDING).out.splitlines()
    assert lines[:2] == ["runs      6", "failed    4"]
    assert [line.split()[0] for line in lines[2:4]] == ["2", "2"] and all("geometry.module" in line for line in lines[2:4])


@pytest.mark.parametrize("name", ["run", "plan"])
def test_without_a_scene_the_scenes_are_listed(name):
    assert {line.split()[0] for line in command(name).out.splitlines()} >= {"clunk", "study_turning"}


def test_the_verdict_of_geometry_is_its_last_line():
    last = command(line("geometry", "finding"), FINDING).out.splitlines()[-1]
    assert "INTERFERENCE" in last and "2 above" in last and Path("geometry/dimensions.txt").is_file()
    assert command("geometry").out.splitlines()[-1] == "verdict: no interference, the gears turn freely"


def test_a_run_and_loads_end_at_the_given_stop_and_a_plan_states_it():
    command("run study_turning --stop '3 ms' --csv run.csv")
    command("loads study_turning --stop '3 ms' --out loads.csv")
    for file in ("run.csv", "loads.csv"):
        assert float(Path(file).read_text(encoding="utf-8").splitlines()[-1].split(",")[0]) == pytest.approx(3e-3, rel=1e-9)
    assert "0.003 s, communication step 0.001 s" in command("plan study_turning --stop '3 ms'").out


def test_help_of_run_and_sweep_imports_no_engine():
    script = ("import sys; from bevel_differential.command import main; main(['--help']); main(['sweep', '--help']);"
              "print([name for name in ('dask', 'pyarrow', 'pandas', 'matplotlib', 'scipy') if name in sys.modules])")
    source = Path(__file__).resolve().parents[2] / "python" / "src"
    done = subprocess.run([sys.executable, "-c", script], env={**os.environ, "PYTHONPATH": str(source)}, capture_output=True,
                          text=True, timeout=120)
    assert done.stdout.splitlines()[-1] == "[]" and "Monte Carlo" in done.stdout, done
