"""Measured clutch curves, given to the package as a list of points or as a CSV file."""

import math
from pathlib import Path

import numpy as np
import pytest

from bevel_differential import Differential, DifferentialError, Scene, accuracy
from bevel_differential.answers import about, ask
from bevel_differential.command import main
from bevel_differential.curve import CURVE, beside, expanded
from refusals import refused

RPM = math.tau / 60.0
NAMES = [f"{CURVE}[{number}].{column}" for number in range(1, 9) for column in ("slip", "torque")]
MEASURED = [0.0, 50.0, 100.0 * RPM, 80.0, 30.0, 90.0]
TEXTS = [["0 rpm", "50 N.m"], ["100 rpm", "80 N·m"], [30.0, 90.0]]
CSV = "torque [N·m];slip [rpm]\n50;0\n80;100\n90;286,47889756541161\n"
# each side gear slips by 100 rpm in its clutch
SCENE = """
description = "a turn in which both clutches slip at a point of their curve"
stop_time = "1 s"
step = "10 ms"
outputs = ["left.speed", "left.shaft_torque", "right.shaft_torque"]

[set]
scene.gear_contact = "ideal"
scene.carrier_drive = "torque"
carrier.torque_command = "800 N.m"
scene.left_drive = "speed"
scene.right_drive = "speed"
left.speed_command = "400 rpm"
right.speed_command = "200 rpm"
effects.limited_slip = true
"""


def points(values):
    """Values of all points, by order of their names."""
    return [values[name] for name in NAMES]


def padded(numbers):
    return pytest.approx([*numbers, *[0.0] * (len(NAMES) - len(numbers))], rel=1e-12)


@pytest.fixture
def folder(tmp_path, monkeypatch):
    """Folder with a scene and a curve, and another working folder."""
    (tmp_path / "scene.toml").write_text(f'{SCENE}limited_slip.curve = "clutch.csv"\n', encoding="utf-8")
    (tmp_path / "clutch.csv").write_text(CSV, encoding="utf-8")
    work = tmp_path / "work"
    work.mkdir()
    monkeypatch.chdir(work)
    return tmp_path


@pytest.mark.parametrize("curve", [
    TEXTS, tuple(map(tuple, TEXTS)), [[0, (50, "N.m")], ((100, "rpm"), (0.08, "kN.m")), (30, (90.0, None))],
    [[np.float64(0.0), np.int64(50)], np.array([100.0 * RPM, 80.0]), [30, 90]],
    np.array([[0.0, 50.0], [100.0 * RPM, 80.0], [30.0, 90.0]]), '[[0, 50], ["100 rpm", 80], [30, 90]]',
], ids=["texts", "tuples", "units", "entries of numpy", "array of numpy", "text"])
def test_a_list_sets_all_points(fmu, curve):
    differential = Differential({CURVE: curve}, fmu=fmu)
    assert points(differential.values) == padded(MEASURED)
    assert points(Differential(limited_slip__curve=curve, fmu=fmu).values) == padded(MEASURED)


def test_a_new_curve_replaces_all_points(fmu):
    differential = Differential({CURVE: TEXTS}, fmu=fmu)
    assert points(differential.set({CURVE: [[5, 60]]}).values) == padded([5.0, 60.0])
    # a later value changes one point
    assert points(differential.set({f"{CURVE}[1].torque": "70 N.m"}).values) == padded([5.0, 70.0])


def test_a_path_is_relative_to_the_working_folder(fmu, folder):
    for path in ("../clutch.csv", Path("..", "clutch.csv"), folder / "clutch.csv"):
        assert points(Differential({CURVE: path}, fmu=fmu).values) == padded(MEASURED)


def test_a_scene_reads_its_curve_from_a_file_next_to_it(fmu, folder):
    scene = Scene.load(folder / "scene.toml", fmu)
    assert points(scene.values) == padded(MEASURED)
    # the faster wheel loses the torque of its clutch, and the slower one gains it
    assert scene.final() == pytest.approx({"left.speed": 400.0 * RPM, "left.shaft_torque": 400.0 - 80.0,
                                           "right.shaft_torque": 400.0 + 80.0}, rel=1e-3)
    # values for one run replace the curve of the scene in every question about it
    halved = {CURVE: [["100 rpm", "40 N.m"]]}
    assert scene.final(["right.shaft_torque"], halved)["right.shaft_torque"] == pytest.approx(400.0 + 40.0, rel=1e-3)
    assert scene.plan_text({CURVE: [[5, 60]]})
    assert not scene.unfelt_of({CURVE: [[5, 60]]})
    assert ask({"ask": "scene", "of": about(scene)})["set"][f"{CURVE}[3].torque"] == 90.0


def test_questions_to_the_library_of_answers_accept_a_curve(folder):
    found = ask({"ask": "scene", "of": about(folder / "scene.toml", {CURVE: [[(5, "rpm"), "60 N.m"]]})})["set"]
    assert points(found) == padded([5.0 * RPM, 60.0])


def test_the_command_line_replaces_the_curve_of_a_scene(fmu_file, folder, capsys):
    scene = str(folder / "scene.toml")
    (folder / "work" / "other.csv").write_text("slip,torque\n0,50\n10.471975511965978,80\n30,90\n", encoding="utf-8")
    records = []
    for number, change in enumerate(([], ["--set", f"{CURVE}=other.csv"], ["--set", f"{CURVE}=[[0, 500]]"])):
        assert main(["run", scene, "--fmu", str(fmu_file), "--csv", f"{number}.csv", *change]) == 0
        records.append(np.loadtxt(f"{number}.csv", delimiter=",", skiprows=3))
        assert main(["plan", scene, "--python", f"{number}.py", *change]) == 0
    assert np.allclose(records[0], records[1], rtol=1e-9) and not np.allclose(records[0], records[2], rtol=1e-2)
    assert f'"{CURVE}[1].torque": 500.0' in Path("2.py").read_text(encoding="utf-8")
    capsys.readouterr()


@pytest.mark.parametrize(("curve", "parts"), [
    ([[0, 50], ["10 rpn", 60]], "limited_slip.curve, point 2, slip = \"10 rpn\" … units that do: rad/s"),
    ([[0, 50], [0, 60]], "point 2 … not above the slip of the point before"),
    ([[0, 50, 1]], "point 1 has 3 entries … [slip, torque]"),
    ([0, 50], "point 1 = 0 … [slip, torque]"),
    ([], "has no points"),
    ([[number, 1] for number in range(9)], "point 9 … at most 8 points"),
    ([[None, 1]], "is not a list such as"),
    (5, "limited_slip.curve = 5 … list of points"),
    ((5, "rpm"), "5 rpm: there is no such file"),
    ("clutches.csv", "clutches.csv: there is no such file … working folder"),
], ids=str)
def test_a_wrong_curve_is_refused_with_position_value_and_remedy(fmu, folder, curve, parts):
    with refused(parts) as error:
        Differential({CURVE: curve}, fmu=fmu)
    assert error.value.kind == "use" and error.value.problems


def test_a_curve_and_one_of_its_points_together_are_refused(fmu):
    with pytest.raises(DifferentialError, match=r"limited_slip\.curve sets all points, and limited_slip\.curve\[3\]\.slip is set as well"):
        Differential({f"{CURVE}[3].slip": 5, CURVE: TEXTS}, fmu=fmu)


def test_a_curve_is_refused_during_a_run(fmu):
    with pytest.raises(DifferentialError, match=r"limited_slip\.curve\[1\]\.slip is fixed"):
        Scene(fmu=fmu, changes=[(0.1, {CURVE: TEXTS})])


def test_a_path_in_the_file_of_a_command_is_relative_to_that_file(folder):
    file = folder / "plan.toml"
    assert points(expanded(beside({CURVE: "clutch.csv"}, file))) == padded(MEASURED)
    for other in ({CURVE: TEXTS}, {CURVE: '[[0, 50]]'}, {"limited_slip.preload": 5}):
        assert beside(other, file) == other


def test_a_sweep_reads_the_curve_next_to_its_plan(fmu_file, folder, capsys):
    plan = folder / "plan.toml"
    plan.write_text(f'scene = "{(folder / "scene.toml").as_posix()}"\nwant = ["right.shaft_torque:final"]\nplan = "grid"\n'
                    '[set]\nlimited_slip.curve = "half.csv"\n[vary]\ncarrier.torque_command = "700 N.m, 900 N.m"\n', encoding="utf-8")
    (folder / "half.csv").write_text("slip [rpm],torque\n100,40\n", encoding="utf-8")
    assert main(["sweep", "--plan-file", str(plan), "--fmu", str(fmu_file), "--workers", "0", "--csv", "sweep.csv"]) == 0
    rows = np.genfromtxt("sweep.csv", delimiter=",", names=True, dtype=None, encoding="utf-8", deletechars="")
    assert rows["right.shaft_torque:final"] == pytest.approx([350.0 + 40.0, 450.0 + 40.0], rel=1e-3)
    capsys.readouterr()


@pytest.mark.parametrize(("changes", "numbers", "is_kept"), [
    ({}, MEASURED, True), ({CURVE: [[0, 50], [5, 60]]}, [0.0, 50.0, 5.0, 60.0], False), ({"effects.limited_slip": False}, [], False),
], ids=["as in the scene", "changed", "without effect"])
def test_the_scene_of_the_cheapest_model_has_the_same_curve(fmu, folder, changes, numbers, is_kept):
    scene, reduced = folder / "scene.toml", folder / "work" / "reduced.toml"
    scene.write_text(scene.read_text(encoding="utf-8").replace("1 s", "20 ms").replace("10 ms", "1 ms"), encoding="utf-8")
    text = accuracy(scene, "left.shaft_torque:final", set=changes, file=reduced).answer["file"]
    reduced.write_text(text, encoding="utf-8")
    values = Scene.load(reduced, fmu).values
    assert [values.get(name, 0.0) for name in NAMES] == padded(numbers)
    assert ('"../clutch.csv"' in text) == is_kept
