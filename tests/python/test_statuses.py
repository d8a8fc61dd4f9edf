"""Each command has the same exit status for the same kind of end, and the same options for less work."""

import argparse
import dataclasses
import importlib
import webbrowser
from pathlib import Path

import pytest

from evidence_unit import packed
from short_scene import SCENE
from warned_lines import without_warnings
from bevel_differential import Differential, DifferentialError, cad, library, verify
from bevel_differential.command import COMMANDS, DONE, FAILED, FINDING, INTERRUPTED, PACKAGE, STATUSES, WRONG, main
from bevel_differential.command import examples as examples_command
from bevel_differential.command import page as page_command
from bevel_differential.fmu import Fmu
from bevel_differential.instance import Instance

ROOT = Path(__file__).resolve().parents[2]
# the package has a function with the same name
accuracy_module = importlib.import_module("bevel_differential.accuracy")
# a load that pushes teeth past each other in the first step, and a folder in which nobody can write
TOO_MUCH, NOWHERE = "left.load_torque=1e7", "/proc"
PROBLEM = """description = "light or strong"
scene = "scene.toml"
objectives = ["minimise gears.mass", "maximise safety.root_min"]
conditions = ["envelope.diameter <= {diameter} mm"]
population = 8
generations = 1
[vary]
geometry.module = "3.5 mm..6 mm"
geometry.face_width = "6 mm..12 mm"
"""
TOLERANCES = """description = "one tolerance"
scene = "study_turning"
runs = 8
wants = ["left.speed:mean"]
[factors]
left.load_torque = "{band}"
"""
CYCLE = """name,count,duration [s],speed [km/h],torque [N.m],wheel_radius [m],turn_radius [m],track [m]
turn,{count},10,50,{torque},0.3,20,1.5
"""
FILES = {"scene.toml": SCENE, "light.toml": PROBLEM.format(diameter=95), "tiny.toml": PROBLEM.format(diameter=5),
         "narrow.toml": TOLERANCES.format(band="800 N.m +- 10 N.m"), "wide.toml": TOLERANCES.format(band="1e7 N.m +- 9.9e6 N.m"),
         "light.csv": CYCLE.format(count=1, torque=500), "heavy.csv": CYCLE.format(count=1000000, torque=3000), "there.toml": ""}
SWEEP = "sweep --scene study_turning --stop 2ms --want left.speed --plan grid --workers 0 --vary"
LOSSES = "losses torque_bias --speed 10,20 --difference 5,10 --temperature 20degC --unseen 3 --workers 0 --torque 100,200"
COUPLING = "coupling one_wheel_on_ice --set scene.gear_contact=ideal --host"
ACCURACY = "accuracy study_turning --stop 5ms --want left.speed:mean --within"
OPTIMISE = "optimise {problem} --workers 0 --out {out}"
# command lines by command and status
CASES = {
    "run": {DONE: "run study_turning --stop 1ms", FAILED: f"run study_turning --set {TOO_MUCH}", WRONG: "run study_turnin"},
    "plan": {DONE: "plan study_turning", FAILED: f"plan study_turning --ssv {NOWHERE}/a.ssv", WRONG: "plan study_turning --set geometry.module=0"},
    "accuracy": {DONE: f"{ACCURACY} 30%", FAILED: f"{ACCURACY} 30% --set {TOO_MUCH}", WRONG: f"{ACCURACY} soon", FINDING: f"{ACCURACY} 30%"},
    "report": {DONE: "report study_turning --quick --stop 5ms", FAILED: f"report study_turning --quick --set {TOO_MUCH}",
               WRONG: "report study_turning --stop soon"},
    "loads": {DONE: "loads study_turning --stop 1ms --out a.csv", FAILED: f"loads study_turning --set {TOO_MUCH} --out a.csv",
              WRONG: "loads study_turning --every 2s --out a.csv"},
    "geometry": {DONE: "geometry", FAILED: f"geometry --out {NOWHERE}/a", WRONG: "geometry --set geometry.module=0",
                 FINDING: "geometry --set geometry.addendum_system=standard"},
    "pattern": {DONE: "pattern study_turning --quick", FAILED: f"pattern study_turning --set {TOO_MUCH}",
                WRONG: "pattern study_turning --set scene.gear_contact=lumped"},
    "sweep": {DONE: f"{SWEEP} left.load_torque=700,800", FAILED: f"{SWEEP} left.load_torque=700,800 --csv {NOWHERE}/a.csv",
              WRONG: f"{SWEEP} left.load_torque=700,8oo", FINDING: f"{SWEEP} left.load_torque=700,1e7"},
    "optimise": {DONE: OPTIMISE.format(problem="light.toml", out="a"), FAILED: OPTIMISE.format(problem="light.toml", out=f"{NOWHERE}/a"),
                 WRONG: OPTIMISE.format(problem="none.toml", out="a"), FINDING: OPTIMISE.format(problem="tiny.toml", out="a")},
    "tolerance": {DONE: "tolerance narrow.toml --stop 2ms --workers 0 --no-indices", WRONG: "tolerance narrow.toml --runs 9",
                  FAILED: f"tolerance narrow.toml --stop 2ms --workers 0 --no-indices --csv {NOWHERE}/a.csv",
                  FINDING: "tolerance wide.toml --stop 2ms --workers 0 --no-indices"},
    "spectrum": {DONE: "spectrum light.csv", FAILED: f"spectrum light.csv --csv {NOWHERE}/a.csv", WRONG: "spectrum none.csv",
                 FINDING: "spectrum heavy.csv"},
    "losses": {DONE: LOSSES, FAILED: f"{LOSSES} --csv {NOWHERE}/a.csv", WRONG: f"{LOSSES} --set geometry.module=0",
               FINDING: f"{LOSSES} --bound 1e-4,1e-4 --most 4"},
    "bench": {DONE: "bench winter_start", FAILED: f"bench winter_start --out {NOWHERE}/a", WRONG: "bench winter_start --set geometry.module=0"},
    "coupling": {DONE: f"{COUPLING} left:k=9000,c=12,J=1", FAILED: f"{COUPLING} left:k=9000,c=12,J=1 --plot {NOWHERE}/a.png",
                 WRONG: f"{COUPLING} left:k=9000,c=soon", FINDING: f"{COUPLING} left:k=9000,c=0,J=1,reads=both"},
    "study": {DONE: "study --quick", FAILED: f"study --quick --out {NOWHERE}/a", WRONG: "study --quick --fmu none.fmu"},
    "verify": {DONE: "verify good.fmu", FAILED: f"verify good.fmu --csv {NOWHERE}/a.csv", WRONG: "verify none.fmu", FINDING: "verify bad.fmu"},
    "examples": {DONE: "examples", FAILED: f"examples --out {NOWHERE}/a", WRONG: "examples --out there"},
    "variables": {DONE: "variables drag", FAILED: f"variables --csv {NOWHERE}/a.csv", WRONG: "variables --acting study_turnin"},
    "page": {DONE: "page", FAILED: "page", WRONG: "page --paht"},
}
EACH = [(status, line) for cases in CASES.values() for status, line in cases.items()]


@pytest.fixture(scope="module")
def units(fmu_file, tmp_path_factory):
    """FMUs with the evidence of one scene: good.fmu agrees with it, bad.fmu does not."""
    folder = tmp_path_factory.mktemp("units")
    for name, changes in (("good", {}), ("bad", {"results/one_wheel_on_ice.csv": lambda text: text.replace("\n0,", "\n0,1", 1)})):
        packed(fmu_file, folder / f"{name}.fmu", ["one_wheel_on_ice"], changes)
    return folder


@pytest.fixture
def prepared(units, tmp_path, monkeypatch):
    """prepared(status): a folder with the files of the command lines, and the conditions in which a command ends with this status."""
    monkeypatch.chdir(tmp_path)
    for name, text in FILES.items():
        Path(name).write_text(text, encoding="utf-8")
    main(["examples", "--out", "there"])
    for unit in units.iterdir():
        Path(unit.name).symlink_to(unit)
    # another test covers files for CAD
    monkeypatch.setattr(cad, "available", lambda: False)
    monkeypatch.setattr(page_command, "page_file", lambda: tmp_path / "there.toml")

    def met(status):
        monkeypatch.setattr(webbrowser, "open", lambda address: status != FAILED)
        if status == FINDING:
            answered = accuracy_module.accuracy
            monkeypatch.setattr(accuracy_module, "accuracy", lambda *given, **named: dataclasses.replace(answered(*given, **named), use=None))

    return met


@pytest.mark.parametrize("status, line", EACH, ids=[line.replace(" ", "_")[:60] + f"_{status}" for status, line in EACH])
def test_each_kind_of_end_has_its_status(status, line, prepared, capsys):
    prepared(status)
    assert main(line.split()) == status, capsys.readouterr().err
    said = without_warnings(capsys.readouterr().err).splitlines()
    if status in (FAILED, WRONG):
        assert said and all(text.startswith("bevel-differential") for text in said if text.strip()), said


def test_every_command_has_a_case_of_success_of_failure_and_of_wrong_use():
    assert CASES.keys() == COMMANDS.keys()
    assert all({DONE, FAILED, WRONG} <= cases.keys() for cases in CASES.values())


@pytest.mark.parametrize("name", CASES)
def test_ctrl_c_ends_every_command_with_its_status(name, prepared, monkeypatch, capsys):
    def interrupted(*_, **__):
        raise KeyboardInterrupt

    prepared(DONE)
    for owner, function in ((library, "_library"), (Instance, "start"), (verify, "simulate_fmu"), (examples_command, "write_whole"), (Fmu, "find"),
                            (webbrowser, "open")):
        monkeypatch.setattr(owner, function, interrupted)
    assert main(CASES[name][DONE].split()) == INTERRUPTED
    assert "stopped" in capsys.readouterr().err


def test_a_missing_library_of_answers_is_a_failure_that_is_named(prepared, monkeypatch, capsys):
    prepared(DONE)
    monkeypatch.setenv("BEVEL_DIFFERENTIAL_ANSWERS", "none.so")
    library._library.cache_clear()
    assert main(["plan", "study_turning"]) == FAILED
    assert "none.so is missing" in capsys.readouterr().err
    with Differential() as differential, pytest.raises(DifferentialError, match="none.so is missing"):
        differential.run()


def test_the_overview_and_one_page_state_the_statuses(capsys):
    assert main(["--help"]) == DONE
    line = capsys.readouterr().out.splitlines()[-1]
    assert line.startswith("Exit status: ") and all(f"{status} {words}" in line for status, words in STATUSES.items())
    page = (ROOT / "docs" / "python.md").read_text(encoding="utf-8")
    assert all(f"| {status} |" in page for status in STATUSES)


def test_the_verdict_of_geometry_is_its_last_line(prepared, capsys):
    prepared(DONE)
    main(["geometry", "--set", "geometry.addendum_system=standard", "--out", "gears"])
    last = capsys.readouterr().out.splitlines()[-1]
    assert "INTERFERENCE" in last and "2 above" in last and (Path("gears") / "dimensions.txt").is_file()
    main(["geometry", "--out", "gears"])
    assert capsys.readouterr().out.splitlines()[-1] == "verdict: no interference, the gears turn freely"


def having(option):
    """Commands that have an option."""
    found = set()
    for name, (place, *_) in COMMANDS.items():
        parser = argparse.ArgumentParser()
        importlib.import_module(place, PACKAGE).add_arguments(parser)
        found |= {name for action in parser._actions if option in action.option_strings}
    return found


QUICK = {"optimise": " --quick --population 8 --generations 1", "tolerance": " --quick --no-indices"}


@pytest.mark.parametrize("name", sorted(having("--quick")))
def test_a_quick_answer_lists_its_omissions(name, prepared, capsys):
    prepared(DONE)
    line = CASES[name][DONE]
    assert main((line if "--quick" in line else line + QUICK.get(name, " --quick")).split()) == DONE
    assert "quick: " in capsys.readouterr().out


def test_commands_that_simulate_a_scene_or_leave_something_out_have_the_options():
    assert having("--stop") == {"run", "plan", "loads", "accuracy", "report", "pattern", "sweep", "losses", "optimise", "tolerance"}
    assert having("--quick") == {"report", "pattern", "losses", "optimise", "tolerance", "study"}


@pytest.mark.parametrize("name", sorted(having("--stop")))
def test_every_command_with_another_end_reads_it(name, prepared, capsys):
    prepared(DONE)
    words = CASES[name][DONE].split()
    if "--stop" in words:
        place = words.index("--stop")
        del words[place:place + 2]
    assert main([*words, "--stop", "soon"]) == WRONG
    assert "stop_time" in (said := capsys.readouterr().err) and "soon" in said


def test_a_run_and_loads_end_at_the_given_stop_and_a_plan_states_it(prepared, capsys):
    prepared(DONE)
    assert main(["run", "study_turning", "--stop", "3 ms", "--csv", "run.csv"]) == DONE
    assert main(["loads", "study_turning", "--stop", "3 ms", "--out", "loads.csv"]) == DONE
    for file in ("run.csv", "loads.csv"):
        assert float(Path(file).read_text(encoding="utf-8").splitlines()[-1].split(",")[0]) == pytest.approx(3e-3, rel=1e-9)
    capsys.readouterr()
    assert main(["plan", "study_turning", "--stop", "3 ms"]) == DONE
    assert "0.003 s, communication step 0.001 s" in capsys.readouterr().out
