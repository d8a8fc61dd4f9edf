"""The command `bevel-differential`: its output, its files, and its messages about errors."""

import os
import re
import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest

from warned_lines import without_warnings

from bevel_differential import Differential, Scene, extras
from bevel_differential.command import COMMANDS, main
from bevel_differential.designs.sweep import SweepResult, sweep
from refusals import refused

SWEEP = ["sweep", "--scene", "study_turning", "--vary", "left.load_torque=700 N.m..900 N.m", "--vary",
         "contact.law=line, line_weber", "--want", "left.speed:mean", "--condition", "efficiency >= 0.9", "--from", "0.14 s",
         "--workers", "0"]


@pytest.fixture(autouse=True)
def with_fmu(fmu_file, monkeypatch):
    monkeypatch.setenv("BEVEL_DIFFERENTIAL_FMU", fmu_file)


def test_run_writes_the_record_of_the_scene(tmp_path, capsys):
    csv, picture = (tmp_path / f"turn.{kind}" for kind in ("csv", "png"))
    assert main(["run", "study_turning", "--set", "left.load_torque=700 N.m", "--stop", "50 ms", "--output", "left.speed",
                 "--output", "planet[1].left_pairs", "--csv", str(csv), "--plot", str(picture)]) == 0
    printed = capsys.readouterr().out
    with Scene.load("study_turning") as scene:
        record = scene.set({"left.load_torque": 700.0}).run(["left.speed", "planet[1].left_pairs"], stop=0.05)
    assert "left.speed" in printed and f"{np.degrees(record['left.speed'][-1]):.6g}" in printed
    columns = np.loadtxt(csv, delimiter=",", skiprows=1, unpack=True)
    assert all(np.array_equal(column, record[name]) for name, column in zip(record.dtype.names, columns, strict=True))
    assert csv.read_text().splitlines()[0] == "time,left.speed,planet[1].left_pairs"
    assert picture.read_bytes().startswith(b"\x89PNG")


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


def test_a_missing_package_is_reported_with_its_extra(fmu_file, monkeypatch):
    def missing(name):
        raise ModuleNotFoundError(f"No module named {name!r}", name=name)

    monkeypatch.setattr(extras.importlib, "import_module", missing)
    with Differential(fmu=fmu_file) as straight:
        with refused("pandas … extra sweep"):
            straight.run(stop=0.01, frame=True)
        with refused("matplotlib … extra plot"):
            straight.plot(straight.run(stop=0.01))


def test_sweep_prints_its_results_which_are_those_of_the_package(tmp_path, capsys):
    out = tmp_path / "found.parquet"
    assert main([*SWEEP, "--plan", "sobol", "--runs", "5", "--seed", "1", "--set", "right.load_torque=800",
                 "--out", str(out)]) == 0
    printed = capsys.readouterr().out
    with Scene.load("study_turning") as scene:
        scene.set({"right.load_torque": 800.0})
        expected = sweep(scene, {"left.load_torque": "700 N.m..900 N.m", "contact.law": "line, line_weber"}, "sobol", 5, 1,
                         ["left.speed:mean"], ["efficiency >= 0.9"], "0.14 s", workers=0)
    assert SweepResult.load(out).digest() == expected.digest()
    assert "8 (5 requested" in printed and "feasible  8" in printed and "left.speed:mean" in printed and str(out) in printed


def test_few_designs_are_printed_and_a_table_keeps_the_rows(tmp_path, capsys):
    grid = [*SWEEP, "--plan", "grid", "--stop", "0.2 s"]
    grid[grid.index("left.load_torque=700 N.m..900 N.m")] = "left.load_torque=700 N.m..900 N.m:2"
    assert main(grid) == 0
    lines = capsys.readouterr().out.splitlines()
    assert any(line.split()[:2] == ["quantity", "unit"] for line in lines) and "--out or --csv" in lines[-1]
    head = next(place for place, line in enumerate(lines) if line.startswith("run  "))
    assert lines[head].split() == ["run", "left.load_torque", "contact.law", "left.speed:mean", "efficiency:final"]
    assert [line.split()[:3] for line in lines[head + 1:head + 5]] == [
        ["0", "700", "line"], ["1", "700", "line_weber"], ["2", "900", "line"], ["3", "900", "line_weber"]]
    assert main([*grid, "--csv", str(tmp_path / "rows.csv")]) == 0
    printed = capsys.readouterr().out
    assert "not kept" not in printed and f"written: {tmp_path / 'rows.csv'}" in printed
    assert main(["sweep", "--scene", "study_turning", "--stop", "1 ms", "--vary", "left.load_torque=700..720:21", "--plan", "grid",
                 "--want", "left.speed", "--workers", "0"]) == 0
    assert "\nrun  " not in capsys.readouterr().out


@pytest.mark.parametrize("options", [[], ["-u"]], ids=["buffered", "unbuffered"])
@pytest.mark.parametrize("words, file", [
    (["accuracy", "study_turning", "--stop", "5ms", "--want", "left.speed:mean", "--within", "30%", "--csv", "{}"], "a.csv"),
    (["run", "study_turning", "--stop", "1ms", "--csv", "{}"], "a.csv"), (["plan", "study_turning", "--python", "{}"], "a.py"),
    ([*SWEEP, "--plan", "lhs", "--runs", "2", "--csv", "{}"], "a.csv")])
def test_a_command_writes_its_files_although_the_reader_of_its_output_has_ended(words, file, options, tmp_path):
    reading, writing = os.pipe()
    os.close(reading)
    file = tmp_path / file
    with os.fdopen(writing, "w") as closed:
        done = subprocess.run([sys.executable, *options, "-m", "bevel_differential", *(word.format(file) for word in words)], stdout=closed,
                              stderr=subprocess.PIPE, text=True, check=False)
    assert file.is_file() and done.returncode == 1
    assert not without_warnings(done.stderr), done.stderr


def test_accuracy_separates_the_work_of_its_runs_from_the_time_of_the_search(capsys):
    assert main(["accuracy", "study_turning", "--stop", "5ms", "--want", "left.speed:mean", "--within", "30%"]) == 0
    assert re.search(r"\d+ runs, as much work as [\d.]+ reference runs of [\d.e-]+ s\. The search took [\d.e-]+ s, with the start of each "
                     r"run\.", capsys.readouterr().out)


def test_a_plan_file_says_the_same_as_options_and_options_come_first(tmp_path):
    file, out, again = tmp_path / "plan.toml", tmp_path / "a.parquet", tmp_path / "b.parquet"
    file.write_text('scene = "study_turning"\nplan = "lhs"\nruns = 3\nseed = 1\nwant = ["left.speed:mean"]\n'
                    'condition = ["efficiency >= 0.9"]\nfrom = "0.14 s"\n[vary]\nleft.load_torque = "700 N.m..900 N.m"\n'
                    '"contact.law" = "line, line_weber"\n')
    assert main(["sweep", "--plan-file", str(file), "--runs", "4", "--workers", "0", "--out", str(out)]) == 0
    assert main([*SWEEP, "--plan", "lhs", "--runs", "4", "--seed", "1", "--out", str(again)]) == 0
    assert SweepResult.load(out).digest() == SweepResult.load(again).digest()
    file.write_text("scen = 1\n")
    assert main(["sweep", "--plan-file", str(file)]) == 2


def test_failures_are_listed_by_message_the_most_frequent_first(capsys):
    assert main(["sweep", "--scene", "study_turning", "--vary", "geometry.module=-1 mm, -2 mm, 4.5 mm", "--vary",
                 "left.load_torque=1, 2", "--plan", "grid", "--want", "left.speed", "--workers", "0"]) == 3
    lines = capsys.readouterr().out.splitlines()
    assert lines[:2] == ["runs      6", "failed    4"]
    assert [line.split()[0] for line in lines[2:4]] == ["2", "2"] and all("geometry.module" in line for line in lines[2:4])


@pytest.mark.parametrize("command", ["run", "plan"])
def test_without_a_scene_the_scenes_are_listed(command, capsys):
    assert main([command]) == 0
    assert {line.split()[0] for line in capsys.readouterr().out.splitlines()} >= {"clunk", "study_turning"}


@pytest.mark.parametrize("arguments, parts", [
    (["swep"], ["swep", "did you mean sweep"]),
    (["loads"], ["scene", "loads --help"]),
    (["run", "--set", "geometry.module=4 mm"], ["--set", "name a scene"]),
    ([*SWEEP, "--runs", "2", "--out", "a.csv"], ["a.csv", "a.parquet"]),
    (["run", "study_turning", "--set", "left.load_torque"], ["--set", "NAME=VALUE"]),
    (["sweep", "--plan", "all"], ["--plan", "all"]),
    (["run", "study_turnin"], ["study_turnin", "did you mean study_turning"]),
    (["run", "study_turning", "--set", "geometry.module=4 ft"], ["geometry.module", "ft"]),
    (["run", "study_turning", "--stop", "soon"], ["stop", "soon"]),
    (["run", "study_turning", "--stop", "1 ms", "--plot", "/nowhere/a.png"], ["/nowhere/a.png"]),
    (["run", "study_turning", "--stop", "1 ms", "--csv", "/nowhere/a.csv"], ["/nowhere/a.csv"]),
    (["run", "study_turning", "--fmu", "/nowhere.fmu"], ["/nowhere.fmu", "no such FMU"]),
    (["sweep", "--vary", "left.load_torque=1..2"], ["--scene"]),
    (["sweep", "--scene", "study_turning", "--want", "left.speed", "--runs", "2"], ["nothing varies"]),
    (["sweep", "--scene", "study_turning", "--vary", "left.load_torque=1..2", "--runs", "2"], ["nothing is wanted"]),
    ([*SWEEP, "--runs", "2", "--from", "0.7 s"], ["from", "0.7"]),
    ([*SWEEP, "--runs", "2", "--workers", "-1"], ["workers", "-1"]),
    ([*SWEEP, "--runs", "2", "--out", "/nowhere/a.parquet"], ["/nowhere"]),
    (["sweep", "--plan-file", "/nowhere.toml"], ["/nowhere.toml"]),
])
def test_wrong_use_is_one_line_and_a_status(capsys, arguments, parts):
    assert main(arguments) == 2
    said = capsys.readouterr().err
    assert said.count("\n") == 1 and said.startswith("bevel-differential") and all(part in said for part in parts), said


def test_help_lists_all_commands(capsys):
    assert main(["--help"]) == 0
    printed = capsys.readouterr().out
    assert all(f"\n  {name} " in printed for name in COMMANDS)


def test_help_of_run_and_sweep_imports_no_engine():
    script = ("import sys; from bevel_differential.command import main; main(['--help']); main(['sweep', '--help']);"
              "print([name for name in ('dask', 'pyarrow', 'pandas', 'matplotlib', 'scipy') if name in sys.modules])")
    source = Path(__file__).resolve().parents[2] / "python" / "src"
    done = subprocess.run([sys.executable, "-c", script], env={**os.environ, "PYTHONPATH": str(source)}, capture_output=True,
                          text=True, timeout=120)
    assert done.stdout.splitlines()[-1] == "[]" and "Monte Carlo" in done.stdout, done
