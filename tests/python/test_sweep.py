"""Sweeps: equal rows with any workers, and no loss by a killed worker, an interrupt, a crash or a full disk."""

import io
import json
import os
import signal
import subprocess
import sys
import time
from pathlib import Path

import psutil
import pyarrow.parquet as pq
import pytest
from interrupts import changed_command, with_interrupts
from command_line import command, without_warnings

from bevel_differential import DifferentialError, Scene
from bevel_differential.designs import Farm, Row, Space, Task, cluster, store
from bevel_differential.command import FINDING
from bevel_differential.designs.plan import Plan
from bevel_differential.designs.sweep import Stopped, SweepResult, sweep
from bevel_differential.designs.store import Columns, digest
from refusals import refused

ROOT = Path(__file__).resolve().parents[2]
RUNS = 200
# a third of these gears cannot be assembled
VARY = {"left.load_torque": "700 N.m..900 N.m", "contact.law": "impact, line_weber", "geometry.planet_teeth": "8..11",
        "geometry.side_teeth": "14, 15, 16", "geometry.planet_count": "2, 3, 4", "tooth_errors.seed": "seed"}
WANTS, CONDITIONS = ["left.speed", "efficiency"], ["efficiency >= 0.99999"]
PLAN = {"vary": VARY, "plan": "lhs", "runs": RUNS, "seed": 1, "wants": WANTS, "conditions": CONDITIONS}


@pytest.fixture(scope="module")
def scene():
    with Scene.load("study_turning") as loaded:
        yield loaded


@pytest.fixture(scope="module")
def expected(scene):
    return sweep(scene, **PLAN, workers=0)


@pytest.fixture(scope="module")
def two():
    """A farm of two processes; other tests do not affect it."""
    with Farm(workers=2) as farm:
        yield farm


def few(**changed):
    return {**PLAN, "runs": 20, "workers": 0, **changed}


def test_gears_that_cannot_be_assembled_are_a_row_with_its_message(expected):
    rows = expected.table.to_pylist()
    failed = [row for row in rows if row["message"]]
    assert [row["run"] for row in rows] == list(range(RUNS)) and 0.1 * RUNS < len(failed) < 0.9 * RUNS
    for row in rows:
        # planets are evenly spaced and both side gears have the same number of teeth, so twice that number is a multiple of planets
        assembles = 2 * row["geometry.side_teeth"] % row["geometry.planet_count"] == 0
        assert assembles == (row["message"] == ""), row
        assert assembles or ("geometry.planet_count" in row["message"] and row["left.speed:final"] is None)
        assert row["feasible"] == (assembles and row["efficiency:final"] >= 0.99999)


def test_rows_are_the_same_with_any_workers(scene, expected, two):
    assert sweep(scene, **PLAN, workers=3, processes=False).digest() == expected.digest()
    task, space = Task(scene, WANTS, CONDITIONS), Space.parse(scene.fmu, VARY)
    rows = two.rows(task, Plan.parse(space, "lhs", RUNS, 1).designs())
    assert digest(Columns(task, space).table(list(rows))) == expected.digest()


def workers_of_this_process():
    children = psutil.Process().children(recursive=True)
    return [child for child in children if "multiprocessing.spawn" in " ".join(child.cmdline())]


class Terminal(io.StringIO):
    def isatty(self):
        return True


def test_closing_the_rows_early_also_closes_the_rows_behind_the_progress_bar(monkeypatch):
    ended = []

    def rows(_task, designs):
        try:
            yield from (Row(run, values) for run, values in designs)
        finally:
            ended.append(True)

    monkeypatch.setattr(sys, "stderr", Terminal())
    monkeypatch.setattr(Farm, "_here", staticmethod(rows))
    with Farm(workers=0, progress=True) as farm:
        shown = farm.rows(None, [(run, {}) for run in range(3)])
        assert next(shown).run == 0 and not ended
        shown.close()
        assert ended
    assert "0/3" in sys.stderr.getvalue()


def test_chunks_of_a_killed_worker_run_again(scene, expected, two):
    task, space = Task(scene, WANTS, CONDITIONS), Space.parse(scene.fmu, VARY)
    rows, killed = [], None
    for row in two.rows(task, Plan.parse(space, "lhs", RUNS, 1).designs()):
        rows.append(row)
        if killed is None and len(rows) > RUNS // 4:
            killed = workers_of_this_process()[0]
            killed.send_signal(signal.SIGKILL)
    assert killed is not None and digest(Columns(task, space).table(rows)) == expected.digest()


class Deadly:
    """A task with one design that kills its process."""

    def evaluate(self, run, values):
        if values["deadly"]:
            os.kill(os.getpid(), signal.SIGKILL)
        return Row(run, values, {"figure": 1.0}, True)

    def close(self):
        pass


def test_a_design_that_kills_its_worker_each_time_is_a_failed_row(two):
    rows = two.evaluate(Deadly(), [(run, {"deadly": run == 30}) for run in range(60)])
    assert [row.run for row in rows] == list(range(60))
    assert [row.run for row in rows if row.message] == [30] and "worker process died" in rows[30].message


def test_a_missing_scheduler_is_reported_within_seconds(monkeypatch):
    assert cluster.ANSWER_TIMEOUT <= 5.0
    monkeypatch.setattr(cluster, "ANSWER_TIMEOUT", 0.5)
    begun = time.monotonic()
    with refused("tcp://127.0.0.1:9: nothing answers"), Farm(scheduler="tcp://127.0.0.1:9"):
        pass
    assert time.monotonic() - begun < 20.0


# results on disk

def test_a_file_describes_its_contents(scene, tmp_path):
    file = tmp_path / "found.parquet"
    result = sweep(scene, **few(), out=file)
    read = SweepResult.load(file)
    assert read.digest() == result.digest() and not (tmp_path / "found.parquet.parts").exists()
    assert read.metadata["plan"] == "lhs" and read.metadata["seed"] == 1 and read.metadata["runs"] == 20
    assert read.metadata["scene"]["set"]["left.load_torque"] == 835.0 and len(read.metadata["fmu"]) == 64
    assert read.metadata["conditions"] == ["efficiency:final >= 0.99999"]
    units = {"left.load_torque": "N.m", "left.speed:final": "rad/s", "contact.law": "1", "seconds": "s"}
    assert {name: read.unit(name) for name in units} == units
    assert set(read.table["contact.law"].to_pylist()) == {"impact", "line_weber"}
    assert read.frame().index.tolist() == list(range(20))


def test_existing_results_are_overwritten_only_on_request(scene, tmp_path):
    file = tmp_path / "found.parquet"
    first = sweep(scene, **few(), out=file)
    before = file.read_bytes()
    other = "other results"
    for changed, options, message in [({}, {}, "--resume"), ({"seed": 2}, {}, other), ({"seed": 2}, {"resume": True}, other),
                                      ({"wants": ["right.speed"]}, {"resume": True}, other)]:
        with pytest.raises(DifferentialError, match=message):
            sweep(scene, **few(**changed), out=file, **options)
        assert file.read_bytes() == before
    again = sweep(scene, **few(), out=file, resume=True)
    assert again.new == 0 and again.digest() == first.digest() and file.read_bytes() == before
    assert sweep(scene, **few(seed=2), out=file, force=True).digest() != first.digest()
    (tmp_path / "text.parquet").write_text("mine")
    with refused("other results"):
        sweep(scene, **few(), out=tmp_path / "text.parquet", resume=True)
    with refused("no folder"):
        sweep(scene, **few(), out=tmp_path / "nowhere" / "found.parquet")


def test_an_interrupt_and_a_crash_keep_the_finished_rows(scene, expected, tmp_path, monkeypatch):
    file, evaluate = tmp_path / "found.parquet", Task.evaluate
    for ends, caught in [(RUNS // 4, KeyboardInterrupt), (RUNS // 2, RuntimeError)]:

        def failing(task, run, values, ends=ends, caught=caught):
            if run == ends:
                raise caught("an end")
            return evaluate(task, run, values)

        monkeypatch.setattr(Task, "evaluate", failing)
        with pytest.raises(Stopped if caught is KeyboardInterrupt else caught) as stop:
            sweep(scene, **PLAN, out=file, workers=0, resume=ends == RUNS // 2)
        assert caught is RuntimeError or f"{RUNS // 4} of {RUNS} runs are kept" in str(stop.value)
    monkeypatch.undo()
    with refused("--resume"):
        sweep(scene, **PLAN, out=file, workers=0)
    with refused("another plan"):
        sweep(scene, **{**PLAN, "seed": 2}, out=file, workers=0, resume=True)
    rest = sweep(scene, **PLAN, out=file, workers=0, resume=True)
    assert rest.new == RUNS - RUNS // 2 and rest.digest() == expected.digest() == SweepResult.load(file).digest()


class Freed:
    """An object whose destructor is interrupted, where Python loses exceptions."""

    def __del__(self):
        os.kill(os.getpid(), signal.SIGINT)
        # Python runs signal handlers between its bytecode instructions
        time.sleep(0.0)


@pytest.mark.parametrize("at", ["submit", "result"])
def test_an_interrupt_while_dask_frees_something_is_not_lost(scene, tmp_path, monkeypatch, at):
    from distributed import Future
    from distributed.client import Client

    lost, calls = [], []
    of = Client if at == "submit" else Future
    plain = getattr(of, at)

    def interrupted(self, *given, **named):
        calls.append(at)
        if len(calls) == 3:
            Freed()
        return plain(self, *given, **named)

    monkeypatch.setattr(of, at, interrupted)
    monkeypatch.setattr(sys, "unraisablehook", lost.append)
    before = signal.signal(signal.SIGINT, signal.default_int_handler)
    try:
        with pytest.raises(Stopped, match=f"of {RUNS} runs are kept"):
            sweep(scene, **PLAN, workers=1, processes=False, out=tmp_path / "found.parquet")
    finally:
        signal.signal(signal.SIGINT, before)
    assert not lost and len(calls) == 3


def arguments(scene, out, wants, more):
    """Line of a sweep."""
    vary = " ".join(f"--vary '{name}={values}'" for name, values in VARY.items())
    wanted = " ".join(f"--want {want}" for want in wants)
    return f"sweep --scene {scene} {vary} {wanted} --plan lhs --seed 1 --out {out} {more}"


def test_ctrl_c_keeps_the_finished_rows_and_the_same_command_continues(tmp_path):
    # a mean over two thousand steps, so that the interrupt comes before the end
    scene = tmp_path / "turn.toml"
    scene.write_text((ROOT / "scenes/study_turning.toml").read_text().replace("step = 1e-3", "step = 2.5e-4"))
    wants = ["left.speed:mean"]
    out, parts = tmp_path / "found.parquet", tmp_path / "found.parquet.parts"
    running = subprocess.Popen(changed_command(0.1, arguments(scene, out, wants, f"--runs {RUNS} --workers 2")), stdout=subprocess.PIPE,
                               stderr=subprocess.PIPE, text=True, start_new_session=True, preexec_fn=with_interrupts)
    while running.poll() is None and not list(parts.glob("part-*")):
        time.sleep(0.02)
    # to the whole process group, as a terminal sends it
    os.killpg(running.pid, signal.SIGINT)
    said = running.communicate(timeout=60)
    assert running.returncode == 130 and len(without_warnings(said[1]).splitlines()) == 1 and "--resume" in said[1], said
    # an interrupt during the writing of a part may write its rows twice; they count once
    kept = len({run for part in parts.glob("part-*.parquet") for run in pq.read_table(part)["run"].to_pylist()})
    assert 0 < kept < RUNS and f"{kept} of {RUNS} runs are kept" in said[1]
    # a resumed sweep may have other workers; gears that cannot be assembled give the status 3
    told = command(arguments(scene, out, wants, f"--runs {RUNS} --workers 0 --resume"), FINDING)
    assert not told.errors and f"{kept} runs were kept from before" in told.out
    with Scene.load(scene) as loaded:
        whole = sweep(loaded, VARY, "lhs", RUNS, 1, wants, workers=0)
    assert SweepResult.load(out).digest() == whole.digest()


def test_a_file_that_cannot_be_written_is_one_line_and_the_parts_are_kept(scene, tmp_path):
    out = tmp_path / "found.parquet"
    given = arguments("study_turning", out, WANTS, "--runs 50 --workers 0")
    full = subprocess.run(changed_command(0.0, given, most=7000), capture_output=True, text=True, timeout=120)
    assert full.returncode == 1 and len(without_warnings(full.stderr).splitlines()) == 1, full.stderr
    assert "50 of 50 runs are kept" in full.stderr and "--resume" in full.stderr and not out.exists()
    command(f"{given} --resume", FINDING)
    assert SweepResult.load(out).digest() == sweep(scene, VARY, "lhs", 50, 1, WANTS, workers=0).digest()


def test_a_disk_that_fills_during_a_sweep_keeps_the_earlier_parts(scene, tmp_path, monkeypatch):
    monkeypatch.setattr(store, "INTERVAL", 0.0)
    write, written = pq.write_table, []

    def filling(table, to):
        if len(written) == 7:
            raise OSError(28, "No space left on device")
        written.append(to)
        write(table, to)

    monkeypatch.setattr(store.pq, "write_table", filling)
    file = tmp_path / "found.parquet"
    with refused("No space left on device; 7 of 20 runs are kept"):
        sweep(scene, **few(), out=file)
    monkeypatch.undo()
    assert sorted(path.name[:4] for path in file.with_name("found.parquet.parts").iterdir()) == ["part"] * 7 + ["plan"]
    rest = sweep(scene, **few(), out=file, resume=True)
    assert rest.new == 13 and rest.digest() == sweep(scene, **few()).digest()


def test_a_part_that_is_cut_off_is_left_out_and_its_runs_are_repeated(scene, tmp_path, monkeypatch):
    monkeypatch.setattr(store, "INTERVAL", 0.0)
    evaluate, done = Task.evaluate, []

    def stopping(task, run, values):
        if len(done) == 7:
            raise KeyboardInterrupt
        done.append(run)
        return evaluate(task, run, values)

    monkeypatch.setattr(Task, "evaluate", stopping)
    file = tmp_path / "found.parquet"
    with pytest.raises(Stopped):
        sweep(scene, **few(), out=file)
    monkeypatch.undo()
    for part, length in zip(sorted(file.with_name("found.parquet.parts").glob("part-*")), (0, 5, 300)):
        part.write_bytes(part.read_bytes()[:length])
    with pytest.warns(match="part-000002.*: it is incomplete; its runs are repeated"):
        rest = sweep(scene, **few(), out=file, resume=True)
    assert rest.new == 13 + 3 and rest.digest() == sweep(scene, **few()).digest()


def test_a_folder_of_parts_without_its_plan_starts_from_the_beginning(scene, tmp_path):
    # a full disk or a killed process leaves such a folder
    (tmp_path / "found.parquet.parts").mkdir()
    assert sweep(scene, **few(), out=tmp_path / "found.parquet").new == 20


def test_plan_json_of_the_parts_is_the_metadata(scene, tmp_path, monkeypatch):
    monkeypatch.setattr(Task, "evaluate", lambda *_: (_ for _ in ()).throw(KeyboardInterrupt))
    with pytest.raises(Stopped, match="0 of 20"):
        sweep(scene, **few(), out=tmp_path / "found.parquet")
    assert json.loads((tmp_path / "found.parquet.parts" / "plan.json").read_text())["plan"] == "lhs"


def test_a_script_without_a_guard_is_told_so_and_does_not_wait_for_itself(tmp_path):
    (tmp_path / "all.py").write_text("import sys\nfrom bevel_differential.command import main\nsys.exit(main())\n", encoding="utf-8")
    words = "sweep --scene clunk --vary left.load_torque=1,2 --plan grid --want left.speed --workers 2 --out all.parquet"
    done = subprocess.run([sys.executable, "all.py", *words.split()], cwd=tmp_path, capture_output=True, text=True, timeout=120, check=False)
    assert done.returncode == 1 and "if __name__" in done.stderr and "another command writes there" not in done.stderr
