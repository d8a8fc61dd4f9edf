"""Rows of a record: a jump of an input has two, before and after it, and means over time are exact."""

import csv

import numpy as np
import pytest
from bevel_differential import Scene, compare
from bevel_differential.answers import about, ask
from bevel_differential.designs.sweep import sweep
from bevel_differential.designs.task import Task
from bevel_differential.points import at_times, from_time
from bevel_differential.report.forces import rolling
from bevel_differential.report.simulated import Simulated

TORQUE, POWER = "carrier.torque", "power.in"
# two wheels of 1 kg·m² that turn freely under the drive
FREE = {"scene.gear_contact": "ideal", "scene.carrier_drive": "torque", "left.load_torque": 0.0, "right.load_torque": 0.0,
        "inertia.left_end": 1.0, "inertia.right_end": 1.0, "carrier.speed_command": 0.0}
STEP = [0.0, 0.5, 0.5], [100.0, 100.0, 0.0], None


def jumping(kind, sign=1.0, step=0.1):
    """Scene whose torque is 100 N·m for 0.5 s, and then 0."""
    given = {"changes": [(0.5, {"carrier.torque_command": 0.0})]} if kind == "change" else {
        "tables": [("carrier.torque_command", STEP[0], [sign * value for value in STEP[1]], None)]}
    start = {"carrier.torque_command": sign * 100.0} if kind == "change" else {}
    return Scene(kind, stop=1.0, step=step, outputs=[TORQUE, POWER], set=FREE | start, **given)


@pytest.mark.parametrize("sign", [1.0, -1.0])
@pytest.mark.parametrize("kind", ["change", "table"])
@pytest.mark.parametrize("step", [0.1, 0.3])
def test_a_jump_has_two_rows_and_the_mean_across_it_is_exact(kind, step, sign, tmp_path):
    with jumping(kind, sign, step) as scene:
        record = scene.run()
        at = np.flatnonzero(record["time"] == 0.5)
        assert record[TORQUE][at].tolist() == [sign * 100.0, 0.0]
        assert np.all(np.diff(record["time"]) >= 0.0) and len(at) == 2
        # all of the power of the drive goes into the bodies, whose speed is linear
        exact = {f"{TORQUE}:mean": sign * 50.0, f"{POWER}:mean": 0.5 * record[POWER][at[0]] * 0.5}
        assert Task(scene, list(exact)).evaluate(0, {}).figures == pytest.approx(exact, rel=1e-7)
        means = [line.split()[3] for line in scene.summary(record).splitlines()[1:]]
        assert [float(mean) for mean in means] == pytest.approx(list(exact.values()), rel=1e-5)
        with open(scene.to_csv(record, tmp_path / "a.csv"), encoding="utf-8") as file:
            rows = list(csv.DictReader(file))
        assert [float(row["time"]) for row in rows] == record["time"].tolist()
        assert [float(row[TORQUE]) for row in rows] == record[TORQUE].tolist()


@pytest.mark.parametrize("sign", [1.0, -1.0])
@pytest.mark.parametrize("step", [0.02, 0.25])
def test_run_report_sweep_comparison_and_accuracy_have_the_same_figures_with_the_first_point(step, sign):
    # from 300 N·m down to 0 within 0.5 s: the first point is the largest
    table = "carrier.torque_command", [0.0, 0.5], [sign * 300.0, 0.0], None
    with Scene("falling", stop=1.0, step=step, outputs=[TORQUE], tables=[table], set=FREE) as scene:
        mean, least, most = sign * 75.0, min(sign * 300.0, 0.0), max(sign * 300.0, 0.0)
        wants = [f"{TORQUE}:{word}" for word in ("mean", "min", "max")]
        shown = [float(cell) for cell in scene.summary(scene.run()).splitlines()[1].split()[2:5]]
        assert shown == pytest.approx([least, mean, most], abs=1e-6)
        row, = sweep(scene, {"inertia.carrier": "0.02"}, "grid", wants=wants, workers=0).table.to_pylist()
        assert [row[want] for want in wants] == pytest.approx([mean, least, most], abs=1e-6)
        assert compare(scene, scene).table()["falling (1)"][:2].tolist() == pytest.approx([mean, sign * 300.0])
        assert Simulated.of(scene).mean(TORQUE) == pytest.approx(mean)
        found = ask({"ask": "accuracy", "of": about(scene), "want": wants, "within": "1%"})
        assert found["values"] == pytest.approx([mean, least, most], abs=1e-6)


def test_a_figure_from_a_jump_on_does_not_contain_the_values_before_it():
    with jumping("change") as scene:
        wants = [f"{TORQUE}:{word}" for word in ("mean", "max", "rms")]
        assert list(Task(scene, wants, start=0.5).evaluate(0, {}).figures.values()) == [0.0] * 3
        # from a time between two points, and from the start, which counts
        assert Task(scene, wants, start=0.35).evaluate(0, {}).figures[wants[0]] == pytest.approx(100.0 * 0.15 / 0.65, rel=1e-9)
        speeds = Task(scene, ["carrier.speed:min", "carrier.speed:mean"]).evaluate(0, {}).figures
        assert speeds["carrier.speed:min"] == 0.0


def test_equal_scenes_with_a_jump_and_other_steps_do_not_differ_at_the_jump(tmp_path):
    from bevel_differential.comparison.picture import _apart

    with jumping("change", step=0.1) as first, jumping("table", step=0.05) as second:
        found = compare(first, second)
        assert _apart(found, TORQUE)[0] < 1e-9 and _apart(found, POWER)[0] < 1e-6
        assert [row[3] for row in found.table()] == pytest.approx([row[4] for row in found.table()], rel=1e-9)
        found.plot(tmp_path / "a.svg")


def test_series_are_read_on_the_side_of_a_jump_that_the_time_names():
    rows, values = np.array([0.0, 1.0, 1.0, 2.0]), np.array([0.0, 1.0, 5.0, 7.0])
    assert at_times(np.array([0.5, 1.0, 1.0, 1.5]), rows, values).tolist() == [0.5, 1.0, 5.0, 6.0]
    assert at_times(np.array([1.0, 3.0]), rows, values).tolist() == [1.0, 7.0]
    record = np.array(list(zip(rows, values)), [("time", float), ("x", float)])
    for start, times, first in ((0.0, [0.0, 1.0, 1.0, 2.0], 0.0), (1.0, [1.0, 2.0], 5.0), (1.5, [1.5, 2.0], 6.0)):
        found = from_time(record, start, 1e-9)
        assert found["time"].tolist() == times and found["x"][0] == first


def test_a_jump_does_not_interrupt_a_rolling_planet():
    times = np.array([0.0, 1.0, 2.0, 2.0, 3.0, 4.0, 5.0])
    assert rolling(times, np.array([0.0, 1.0, 2.0, 2.0, 3.0, 4.0, 3.0]), 10) == slice(0, 6)
