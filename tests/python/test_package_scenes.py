"""Scenes in the Python package: the same bits as from the library, and errors in files."""

import csv
import pickle

import numpy as np
import pytest
from test_scenes import CYCLE, EVERYTHING, SCENES, SHORTER, TEXTS

from bevel_differential import DifferentialError, Scene, shipped_scenes
from bevel_differential.answers import about, ask
from refusals import refused


@pytest.fixture
def everything(tmp_path):
    (tmp_path / "cycle.csv").write_text(CYCLE, encoding="utf-8")
    file = tmp_path / "everything.toml"
    file.write_text(EVERYTHING, encoding="utf-8")
    return file


def by_itself(scene, tmp_path, changes=None):
    """Record of the library itself, shape (points, 1 + outputs)."""
    file = tmp_path / "record.csv"
    ask({"ask": "run", "of": about(scene, changes), "out": file})
    lines = file.read_text(encoding="utf-8").splitlines()
    return np.array([[float(cell) for cell in row] for row in list(csv.reader(lines))[1:]])


def test_the_shipped_scenes_are_known():
    assert shipped_scenes() == SCENES


@pytest.mark.parametrize("name", [*SCENES, *TEXTS])
def test_a_scene_has_the_bits_of_the_command(name, tmp_path, everything):
    if name in TEXTS:
        everything.write_text(TEXTS[name], encoding="utf-8")
    what = name if name in SCENES else everything
    changes = SHORTER.get(name, {})
    with Scene.load(what) as scene:
        scene.stop = changes.get("stop_time", scene.stop)
        record = scene.run()
        with pickle.loads(pickle.dumps(scene)) as copy:
            assert np.array_equal(copy.run(), record)
    assert np.array_equal(np.array(record.tolist(), float), by_itself(what, tmp_path, changes))


@pytest.mark.parametrize("old, new, parts", [
    ("stop_time = \"20.3 ms\"", "stop_time = \"20.3 mm\"", "stop_time … ms"),
    ("stop_time = \"20.3 ms\"", "", "missing: stop_time … a scene has description, stop_time, step and outputs"),
    ("step =", "stop =", "unknown field `stop` … `step`"),
    ("[[table]]", "[[table]]\ngeometry.module = \"5 mm\"", "unknown field `geometry` … belong in the table [set]"),
    ("geometry.planet_teeth", "geometry.planet_tooth", "[set] … geometry.planet_tooth … did you mean geometry.planet_teeth"),
    ("\"0.1 N.m\"", "\"0.1 kg\"", "right.load_torque … unit kg … N.m"),
    ("time = \"3.7 ms\"", "time = \"30.7 ms\"", "0.0307 s … outside"),
    ("tooth_friction.coefficient = 0.07", "tooth_friction.static_ratio = 1.2", "tooth_friction.static_ratio is fixed"),
    ("\"700 N.m\", 100.3", "\"700 N.m\"", "[[table]] … 3 times and 2 values"),
    ("\"700 N.m\"", "\"heavy\"", "[[table]] … right.load_torque … heavy"),
    ("left.load_torque = 300", "right.load_torque = 300", "0.01 s … right.load_torque follows a table"),
    ("cycle.csv", "circle.csv", "circle.csv"),
    ("\"carrier.torque\"", "\"carrier.tork\"", "outputs … carrier.tork … did you mean carrier.torque"),
    ("step = \"1 ms\"", "step = \"1 ms\"\ninput_slopes = \"yes\"", "input_slopes … yes … true or false"),
    ("description =", "description ", "everything.toml"),
])
def test_errors_in_a_file_are_named(old, new, parts, everything):
    text = everything.read_text(encoding="utf-8")
    assert old in text
    everything.write_text(text.replace(old, new, 1), encoding="utf-8")
    with refused(parts):
        Scene.load(everything)


def test_missing_keys_are_listed_together_with_other_errors(tmp_path):
    file = tmp_path / "bare.toml"
    file.write_text("[set]\ngeometry.modul = 1\n", encoding="utf-8")
    with pytest.raises(DifferentialError) as error:
        Scene.load(file)
    first, second = str(error.value).splitlines()
    assert "missing: description, stop_time, step, outputs" in first and "did you mean geometry.module" in second


@pytest.mark.parametrize("old, new, parts", [
    ("103.3", "fast", "cycle.csv, line 3 … carrier.speed_command … fast"),
    ("[rpm]", "[kg]", "cycle.csv … kg … rpm"),
    ("time [ms]", "clock [ms]", "no column time"),
    (",90", "", "line 6 … 1 cells … 2"),
    ("11.1", "1.1", "is earlier than in the line above"),
])
def test_errors_in_a_file_of_inputs_are_named(old, new, parts, everything):
    file = everything.parent / "cycle.csv"
    file.write_text(CYCLE.replace(old, new, 1), encoding="utf-8")
    with refused(parts):
        Scene.load(everything)


@pytest.mark.parametrize("table, parts", [
    (("left.load_torque", ["0 s", "soon"], [1.0, 2.0], None), "time … soon"),
    (("left.load_torque", [0.0, 1.0], [1.0, 2.0], -1.0), "period … more than 0"),
    (("left.load_torque", [0.0, 1.0], [1.0], None), "2 times for 1 values"),
])
def test_errors_in_tables_from_python_are_named(table, parts):
    with refused(parts):
        Scene(outputs=["left.speed"], tables=[table])


@pytest.mark.parametrize("input_slopes", [False, True])
def test_speeds_that_go_on_straight_turn_the_carrier_by_their_integral(input_slopes):
    # rad/s over s: a ramp, a kink within a step, a jump at 50 ms, and all of it again from 80 ms, where the value also jumps
    step, times, speeds, period = 8e-3, [0.0, 0.03, 0.05, 0.05, 0.08], [10.0, 40.0, 30.0, 20.0, 60.0], 0.08
    with Scene(stop=0.16, step=step, outputs=["carrier.angle", "carrier.speed"], set={"scene.gear_contact": "ideal"},
               tables=[("carrier.speed_command", times, speeds, period)], input_slopes=input_slopes) as scene:
        record = scene.run()
        assert scene.contents().get("input_slopes", False) == input_slopes
    begins, ends = record["time"][:-1], record["time"][1:]
    assert 0.05 in ends and min(abs(ends - 0.13)) < 1e-12

    def speed(time):
        within = (time + 1e-11) % period
        return np.interp(within, times[:3], speeds[:3]) if within < 0.05 else np.interp(within, times[3:], speeds[3:])

    corners = np.add.outer([0.0, period], times).ravel()
    for begin, end, turned in zip(begins, ends, np.diff(record["carrier.angle"])):
        # slopes follow the table through its kinks; otherwise a speed is held within a step
        pieces = [begin, *sorted(set(corners[(corners > begin + 1e-9) & (corners < end - 1e-9)])), end]
        integral = sum((speed(a) + speed(b - 2e-11)) / 2.0 * (b - a) for a, b in zip(pieces, pieces[1:]))
        assert turned == pytest.approx(integral if input_slopes else speed(begin) * (end - begin), rel=1e-7), begin


def test_a_wrong_choice_of_slopes_is_refused():
    with refused("input_slopes = 'yes'"):
        Scene(outputs=["left.speed"], input_slopes="yes")
