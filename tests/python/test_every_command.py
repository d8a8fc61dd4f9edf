"""Properties that all commands share, each tested on the list of commands: exit statuses, Ctrl-C, warnings, options, files."""

import csv
import dataclasses
import importlib
import io
import os
import re
import shlex
import subprocess
import sys
import webbrowser
from pathlib import Path

import numpy as np
import pandas as pd
import pytest
from command_line import command, without_warnings
from command_list import EXAMPLES, having, line, options, prepare
from refusals import pattern

from bevel_differential import cad, library, verify
from bevel_differential.command import COMMANDS, DONE, FAILED, FINDING, INTERRUPTED, STATUSES, WRONG, main
from bevel_differential.command import examples as examples_command
from bevel_differential.command import page as page_command
from bevel_differential.fmu import Fmu
from bevel_differential.instance import Instance
from bevel_differential.output_file import ENDINGS

ROOT = Path(__file__).resolve().parents[2]
# the package has a function with the same name
accuracy_module = importlib.import_module("bevel_differential.accuracy")
KINDS = {"done": DONE, "wrong": WRONG, "failed": FAILED, "finding": FINDING}
ENDS = [(name, kind) for name, example in EXAMPLES.items() for kind in KINDS if getattr(example, kind) is not None]
# options for files to read
READ = {"--fmu", "--scene", "--plan-file"}
WRITTEN = [(name, option) for name in COMMANDS for option, value in options(name) if "FILE" in value and option not in READ]
# wrong values of `--set`, and parts of the message
WRONG_SET = [
    ("--set left.load_torque", "left.load_torque … NAME=VALUE"),
    ("--set oil.density=900 --set oil.density=901", "oil.density: it is given twice"),
    ("--set geometry.planet_teeth=12.5", "geometry.planet_teeth … must be a whole number"),
    ("--set geometry.modul=1", "did you mean geometry.module"),
]
# commands without a line that warns; the warnings of their sweeps, scenes and runs are tested in the package
QUIET = {"variables", "tolerance", "bench", "study", "verify", "examples", "page"}


@pytest.fixture
def folder(folder, units, monkeypatch):
    """Current folder with the files of all examples, and a browser."""
    prepare(folder)
    for unit in units.iterdir():
        Path(unit.name).symlink_to(unit)
    # another test covers files for CAD
    monkeypatch.setattr(cad, "available", lambda: False)
    monkeypatch.setattr(page_command, "page_file", lambda: folder / "there.toml")
    monkeypatch.setattr(webbrowser, "open", lambda address: True)
    command("examples --out there")
    return folder


def test_every_command_is_in_the_list():
    assert EXAMPLES.keys() == COMMANDS.keys()
    # all others write files; test_full_disk.py runs them
    assert {name for name, example in EXAMPLES.items() if not example.files} == {"page"}
    assert {name for name, example in EXAMPLES.items() if example.warned is None} == QUIET


@pytest.mark.parametrize("name, kind", ENDS)
def test_each_kind_of_end_has_its_status_and_prints_in_plain_letters(name, kind, folder, monkeypatch):
    if kind == "failed":
        monkeypatch.setattr(webbrowser, "open", lambda address: False)
    if name == "accuracy" and kind == "finding":
        answered = accuracy_module.accuracy
        monkeypatch.setattr(accuracy_module, "accuracy", lambda *given, **named: dataclasses.replace(answered(*given, **named), use=None))
    out, err = streams = [io.TextIOWrapper(io.BytesIO(), encoding="ascii", errors="strict") for _ in range(2)]
    monkeypatch.setattr(sys, "stdout", out)
    monkeypatch.setattr(sys, "stderr", err)
    status = main(shlex.split(line(name, kind)))
    # a caller of `main` keeps its streams
    assert [stream.errors for stream in streams] == ["strict"] * 2
    printed, said = ([text for text in stream.buffer.getvalue().decode().splitlines() if text.strip()] for stream in streams)
    said = without_warnings("\n".join([*said, ""])).splitlines()
    assert status == KINDS[kind], said
    assert all(text.startswith("bevel-differential") for text in said) and (printed if kind in ("done", "finding") else said), said
    assert kind != "done" or not said, said


@pytest.mark.parametrize("name", EXAMPLES)
def test_ctrl_c_ends_every_command_with_its_status(name, folder, monkeypatch):
    def interrupted(*_, **__):
        raise KeyboardInterrupt

    for owner, function in ((library, "_library"), (Instance, "start"), (verify, "simulate_fmu"), (examples_command, "write_whole"), (Fmu, "find"),
                            (webbrowser, "open")):
        monkeypatch.setattr(owner, function, interrupted)
    assert "stopped" in command(line(name), INTERRUPTED).err


def test_the_overview_and_one_page_state_the_commands_and_the_statuses():
    printed = command("--help").out
    last = printed.splitlines()[-1]
    assert last.startswith("Exit status: ") and all(f"{status} {words}" in last for status, words in STATUSES.items())
    assert all(f"\n  {name} " in printed for name in COMMANDS)
    page = (ROOT / "docs" / "python.md").read_text(encoding="utf-8")
    assert all(f"| {status} |" in page for status in STATUSES)


@pytest.mark.parametrize("name", [name for name, example in EXAMPLES.items() if example.warned])
def test_each_warning_is_printed_once_to_standard_error(name, folder):
    printed, expected = command(line(name, "warned")), EXAMPLES[name].warnings
    warnings = printed.warnings
    assert len(set(warnings)) == len(warnings) and "DifferentialWarning" not in printed.err, warnings
    for text in expected:
        assert sum(text in warning for warning in warnings) == 1 and text not in printed.out, (text, warnings)
    if name == "report":
        page = Path("report-warned.html").read_text(encoding="utf-8")
        assert page.count("left.brake_torque: 200 N.m changes nothing in this scene. It acts only if effects.wheel_brake = true (now: false)") == 1


def test_commands_that_simulate_a_scene_or_leave_something_out_have_the_options():
    assert set(having("--stop")) == {"run", "plan", "loads", "accuracy", "report", "pattern", "sweep", "losses", "optimise", "tolerance"}
    assert set(having("--quick")) == {"report", "pattern", "losses", "optimise", "tolerance", "study"}


@pytest.mark.parametrize("name", having("--quick"))
def test_a_quick_answer_lists_its_omissions(name, folder):
    assert "quick: " in command(f"{line(name)} {EXAMPLES[name].quick}").out


@pytest.mark.parametrize("name", having("--stop"))
def test_every_command_with_another_end_reads_it(name, folder):
    assert "stop_time" in (said := command(f"{line(name)} --stop soon", WRONG).err) and "soon" in said


@pytest.mark.parametrize("name", having("--fmu"))
def test_a_missing_unit_is_named(name, folder):
    [said] = command(f"{line(name)} --fmu none.fmu", WRONG).errors
    assert "none.fmu: there is no such FMU" in said


@pytest.mark.parametrize("given, message", WRONG_SET)
@pytest.mark.parametrize("name", having("--set"))
def test_a_wrong_value_is_named(name, given, message, folder):
    [said] = command(f"{line(name)} {given}", WRONG).errors
    assert re.search(pattern(message), said), said


@pytest.mark.parametrize("name", having("--unit"))
def test_a_wrong_unit_is_named(name, folder):
    assert "did you mean rpm" in command(f"{line(name)} --unit rmp", WRONG).err


@pytest.mark.parametrize("name, option", WRITTEN)
def test_an_impossible_file_is_refused_before_any_work(name, option, folder, monkeypatch):
    monkeypatch.setattr(Instance, "start", lambda *_: pytest.fail("it works"))
    before = {*folder.iterdir()}
    for file, why in (("x.xlsx", "a … ends with"), ("none/a.csv", "there is no folder"), (".", "it is a folder; name a file")):
        [said] = command(f"{line(name)} {option} {file}", WRONG).errors
        assert re.search(pattern(f"argument {option}: {file}: {why}"), said), said
        if file == "x.xlsx":
            kind = next(kind for kind in ENDINGS if f"{file}: a {kind} ends with" in said)
            assert all(ending in said for ending in ENDINGS[kind])
    assert {*folder.iterdir()} == before


@pytest.mark.parametrize("name", ["sweep", "losses"])
def test_results_are_kept_until_the_user_resumes(name, folder):
    whole, file = f"{line(name)} --out a.parquet", folder / "a.parquet"
    command(whole)
    kept = file.read_bytes()
    assert "--resume" in command(whole, WRONG).err
    command(f"{whole} --resume")
    assert file.read_bytes() == kept


@pytest.mark.parametrize("name", [*(name for name, example in EXAMPLES.items() if example.table), "run of two"])
def test_a_table_has_a_plain_header_and_may_have_decimal_commas(name, folder):
    own = "run scene.toml clutch.toml --output left.speed --csv" if name == "run of two" else f"{line(name)} {EXAMPLES[name].table}"
    command(f"{own} point.csv")
    command(f"{own} comma.csv --csv-decimal comma")
    rows = list(csv.reader(Path("point.csv").read_text(encoding="utf-8").splitlines()))
    assert not rows[0][0].startswith("#") and len(rows) > 1 and all(len(row) == len(rows[0]) for row in rows)
    found, commas = pd.read_csv("point.csv"), pd.read_csv("comma.csv", sep=";", decimal=",")
    assert list(found.columns) == list(commas.columns) == rows[0]
    assert not any(" [" in head for head in rows[0] if head != "locking_value [%]")
    # all but the computing time
    numbers = [head for head in found.select_dtypes("number").columns if head != "seconds"]
    assert len(numbers) and np.allclose(commas[numbers].to_numpy(float), found[numbers].to_numpy(float), rtol=1e-12, equal_nan=True)


@pytest.mark.parametrize("buffering", [[], ["-u"]], ids=["buffered", "unbuffered"])
@pytest.mark.parametrize("name", ["accuracy", "run", "plan", "sweep"])
def test_a_command_writes_its_files_although_the_reader_of_its_output_has_ended(name, buffering, folder):
    reading, writing = os.pipe()
    os.close(reading)
    files = EXAMPLES[name].files[0]
    with os.fdopen(writing, "w") as closed:
        done = subprocess.run([sys.executable, *buffering, "-m", "bevel_differential", *line(name).split(), *files.options.split()], stdout=closed,
                              stderr=subprocess.PIPE, text=True, check=False)
    assert Path(files.old).is_file() and done.returncode == FAILED
    assert not without_warnings(done.stderr), done.stderr


def test_a_missing_library_of_answers_is_a_failure_that_is_named(monkeypatch):
    monkeypatch.setenv("BEVEL_DIFFERENTIAL_ANSWERS", "none.so")
    library._library.cache_clear()
    assert "none.so is missing" in command("plan study_turning", FAILED).err
    assert "none.so is missing" in command("run study_turning", FAILED).err
