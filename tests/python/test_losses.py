"""Loss maps: points against closed forms, lines where a map has curvature, measured errors, and runs that are never lost."""

import re
from math import exp, tanh
from types import SimpleNamespace

import numpy as np
import pyarrow.parquet as pq
import pytest
from command_line import command
import theory
from bevel_differential import Scene, losses as package
from bevel_differential.csv_table import CsvTable, Text
from bevel_differential.designs.sweep import Stopped
from bevel_differential.losses import VARIABLES, inputs, losses
from bevel_differential.losses.command import _axes
from bevel_differential.losses.grid import (Bound, estimates, figures_of, grid_points, interpolated, refined, share_beyond, starting,
                                            torques_of)
from bevel_differential.losses.point import FIGURES, PointTask, benched
from bevel_differential.losses.tables import HEAD, bias
from bevel_differential.values import Quantity
from refusals import refused

PRELOAD, RADIUS, RATIO, STRIBECK = 60.0, 0.055, 1.25, 0.3
CLUTCH = {"scene.gear_contact": "ideal", **theory.CLUTCHES, "limited_slip.preload": PRELOAD,
          "limited_slip.torque_coefficient": 0.0, "limited_slip.mean_radius": RADIUS, "limited_slip.static_ratio": RATIO}
STRIBECK_CLUTCH = CLUTCH | {"limited_slip.stribeck_speed": STRIBECK}
LEVELS = dict(zip(VARIABLES, ([300.0, 900.0], [5.0, 40.0], [0.5, 20.0], [300.0, 350.0])))
TORQUE, SPEED, TEMPERATURE = 800.0, 30.0, 330.0
DRAG = {"scene.gear_contact": "ideal", **theory.DRAG, "bearing_drag.carrier_torque": 2.0, "bearing_drag.side_torque": 0.7,
        "bearing_drag.carrier_viscous": 0.02, "bearing_drag.side_viscous": 0.005, "bearing_drag.carrier_churning": 1e-3}


@pytest.fixture
def scene():
    with Scene("plain", set=CLUTCH) as made:
        yield made


@pytest.fixture
def point(scene):
    """point(values, torque, speed, difference): figures of FIGURES."""
    def run(values, *at):
        task = PointTask(benched(scene.set(values)))
        row = task.evaluate(0, inputs((*at, TEMPERATURE)))
        task.close()
        assert row.feasible and not row.message, row.message
        return [row.figures[name] for name in FIGURES]

    return run


# points

@pytest.mark.parametrize("difference", [20.0, -20.0, 1.0, -0.05, 2.0 * SPEED])
def test_preload_moves_its_torque_from_the_fast_wheel_to_the_slow_one(point, difference):
    # at 2 w one wheel is at rest; means settle to a thousandth, and their remainder decays like exp(-t/10 ms)
    left, right, loss, low, high = point({}, TORQUE, SPEED, difference)
    shift = np.sign(difference) * PRELOAD
    assert [left, right, loss] == pytest.approx([TORQUE / 2.0 - shift, TORQUE / 2.0 + shift, PRELOAD * abs(difference)], rel=1e-4)
    assert low == pytest.approx(left, rel=1e-4) and high == pytest.approx(left, rel=1e-4)
    ratio, effect = bias(left, right)
    assert ratio == pytest.approx((TORQUE / 2.0 + PRELOAD) / (TORQUE / 2.0 - PRELOAD), rel=1e-4)
    assert effect == pytest.approx(100.0 * (ratio - 1.0) / (ratio + 1.0), rel=1e-9)


@pytest.mark.parametrize("stribeck", [0.0, STRIBECK])
def test_a_stuck_differential_holds_up_to_its_breakaway_torque_in_both_directions(point, stribeck):
    left, right, loss, low, high = point({"limited_slip.stribeck_speed": stribeck}, TORQUE, SPEED, 0.0)
    assert [left, right] == pytest.approx([TORQUE / 2.0] * 2, rel=1e-6) and abs(loss) < 1e-6
    assert [low, high] == pytest.approx([TORQUE / 2.0 - RATIO * PRELOAD, TORQUE / 2.0 + RATIO * PRELOAD], abs=0.05)


@pytest.mark.parametrize("difference", [0.0, 8.0])
def test_drag_is_lost_by_its_formula(point, difference):
    *_, loss, _, _ = point(DRAG | {"effects.limited_slip": False}, TORQUE, SPEED, difference)

    def drag(coulomb, viscous, speed):
        return (coulomb * tanh(speed / 0.1) + viscous * speed) * speed

    sides = sum(drag(0.7, 0.005, SPEED + sign * difference / 2.0) for sign in (1.0, -1.0))
    assert loss == pytest.approx(drag(2.0, 0.02, SPEED) + 1e-3 * SPEED**3 + sides, rel=1e-4)


@pytest.mark.parametrize("elastic", [False, True])
def test_a_final_drive_adds_its_friction_to_the_losses_at_its_port(point, elastic):
    """Torque and speed of a point are those of the port, referred to the carrier."""
    final = {"effects.final_drive": True, "final_drive.elastic_mesh": elastic, "final_drive.friction_torque": 3.0, "final_drive.viscous": 0.01}
    left, right, loss, _, _ = point(final, TORQUE, SPEED, 2.0)
    friction = 3.0 + 0.01 * 4.1 * SPEED
    assert left + right == pytest.approx(TORQUE - 4.1 * friction, rel=1e-4)
    assert loss == pytest.approx(PRELOAD * 2.0 + friction * 4.1 * SPEED, rel=1e-3)
    assert TORQUE * SPEED == pytest.approx(left * (SPEED + 1.0) + right * (SPEED - 1.0) + loss, rel=1e-4)


def test_a_small_difference_costs_no_more_than_a_large_one_and_agrees_with_it(point):
    # teeth whose friction does not depend on speed
    teeth = {"scene.gear_contact": "tooth", "effects.limited_slip": False, "effects.thrust_friction": True}
    slow, fast = (point(teeth, TORQUE, SPEED, difference) for difference in (0.01, 10.0))
    assert slow[:2] == pytest.approx(fast[:2], rel=2e-3)
    assert slow[2] / 0.01 == pytest.approx(fast[2] / 10.0, rel=0.02)


def test_tooth_errors_are_averaged_until_all_teeth_have_met(scene):
    task = PointTask(benched(Scene("errors", set={"effects.tooth_errors": True, "tooth_errors.accuracy_grade": 8}, fmu=scene.fmu)))
    row = task.evaluate(0, inputs((TORQUE, SPEED, 40.0, TEMPERATURE)))
    # 80 pairs of 10 and 16 teeth, at least twice
    assert row.feasible and task._instance.time >= 2.0 * 80.0 * 4.0 * np.pi / (16.0 * 40.0) * (1.0 - 1e-9)
    task.close()


def test_a_point_refused_by_the_fmu_is_reported_with_its_values(scene):
    with refused("at 300 N.m, 5 rad/s … oil.viscosity_100"):
        losses(scene.set({"oil.viscosity_100": 2e-4, **theory.DRAG, "bearing_drag.viscosity_from_oil": True}), LEVELS,
               workers=0)


# lines

def test_omitting_lines_gives_the_error_of_a_parabola():
    lines = [np.array([0.0, 1.0, 3.0]), np.array([0.0, 0.5, 1.0])]
    at = grid_points(lines)
    values = (at[..., 0] ** 2 + 5.0 * at[..., 1] + at[..., 0] * at[..., 1])[None, ..., None]
    along_x, along_y = estimates(lines, values, np.full(values.shape, 0.1))
    # h²/4 in the middle of an interval of x²; linear and bilinear terms have no error
    assert along_x == pytest.approx([2.5, 10.0]) and along_y == pytest.approx([0.0, 0.0], abs=1e-9)
    finer = refined(lines, [along_x, along_y], 100)
    assert finer[0].tolist() == [0.0, 1.0, 2.0, 3.0] and finer[1] is not None and len(finer[1]) == 3
    assert refined(lines, [along_x, along_y], 11) is None and refined(lines, [along_y, along_y], 100) is None


def test_axes_begin_with_a_middle_and_with_zero_between_signs():
    assert starting([2.0, 6.0]).tolist() == [2.0, 4.0, 6.0] and starting([-4.0, 6.0]).tolist() == [-4.0, 0.0, 6.0]
    assert starting([5.0]).tolist() == [5.0]


def test_torques_and_figures_convert_into_each_other():
    points = np.random.default_rng(1).normal(size=(20, 4))
    figures = np.random.default_rng(2).normal(size=(20, 3))
    assert figures_of(torques_of(figures, points), points) == pytest.approx(figures)
    lines = [np.array([0.0, 2.0]), np.array([7.0])]
    assert interpolated(lines, np.array([[[1.0]], [[3.0]]]), np.array([[0.5, 7.0]])).tolist() == [[1.5]]


def test_the_measured_share_is_that_of_the_rule():
    assert share_beyond(300, 0) == pytest.approx(1.0 - 0.05 ** (1.0 / 300.0), rel=1e-12) and share_beyond(300, 0) < 0.01
    assert 0.01 < share_beyond(300, 1) < share_beyond(300, 2) < share_beyond(300, 300) == 1.0


# whole maps

def over_kinetic(difference):
    return 1.0 + (RATIO - 1.0) * exp(-RADIUS * abs(difference) / 2.0 / STRIBECK)


@pytest.fixture(scope="module")
def mapped():
    with Scene("stribeck", set=STRIBECK_CLUTCH) as made:
        yield losses(made, LEVELS, bound=Bound(0.002, 0.1), unseen=60, workers=0)


def test_a_map_keeps_its_bound_against_the_closed_form(mapped):
    torque, speed, difference, temperature = mapped.lines
    # only the slip speed causes curvature
    assert [len(torque), len(speed), len(temperature)] == [3, 3, 3] and len(difference) > 3
    assert np.diff(difference)[0] <= np.diff(difference)[-1]
    assert mapped.beyond == 0 and "60 unseen points, none beyond 0.2 % + 0.1 N.m: at most 4.9 % are, at 95 %" in mapped.error
    points = np.array([[512.0, 11.0, sign * at, 311.0] for at in np.linspace(0.5, 20.0, 57) for sign in (1.0, -1.0)])
    clutch = np.array([PRELOAD * over_kinetic(at) for at in points[:, 2]])
    shift = np.sign(points[:, 2]) * clutch
    expected = np.stack([256.0 - shift, 256.0 + shift, clutch * np.abs(points[:, 2])], axis=-1)
    assert np.all(np.abs(mapped.at(points) - expected) <= mapped.bound.of_figures(expected, points))


def test_tables_have_the_same_numbers(mapped, tmp_path):
    from bevel_differential.losses.tables import save, save_for_simulink
    table = CsvTable(save(mapped, tmp_path / "map.csv"), lambda name: Text(name) if name == "kind" else Quantity(name, "%"))
    rows = [values for _, values in table.rows]
    assert [column.head for column in table.columns.values()] == HEAD
    counts = {kind: sum(row["kind"] == kind for row in rows) for kind in ("map", "stuck", "unseen")}
    assert counts == {"map": mapped.slipping[..., 0].size, "stuck": 27, "unseen": 60}
    row = rows[0]
    ratio, effect = bias(row["left.shaft_torque"], row["right.shaft_torque"])
    assert row["torque_bias_ratio"] == ratio > 1.0 and row["locking_value"] == effect
    parquet = pq.read_table(save(mapped, tmp_path / "map.parquet"))
    assert parquet.column_names == HEAD and parquet["power.loss"].to_pylist() == [row["power.loss"] for row in rows]
    script = save_for_simulink(mapped, tmp_path / "map.m").read_text(encoding="utf-8")

    def array(name):
        found = re.search(rf"^{name} = (?:reshape\()?\[([^]]*)\](?:, \[([^]]*)\]\))?;$", script, re.MULTILINE)
        shape = [int(size) for size in found[2].split()] if found[2] else -1
        return np.array([float(value) for value in found[1].split()]).reshape(shape, order="F")

    slip, locking = array("slip_bpts"), array("locking_tbl")
    assert array("Trq_bpts") == pytest.approx(mapped.lines[0]) and array("eta_tbl") == pytest.approx(np.ones((3, 3, 3)))
    assert "% eta_tbl is 1 everywhere, because the scene has no drag" in script
    assert locking.shape == (3, 3, len(slip), 3) and np.all(np.diff(slip) > 0.0)
    for place, at in enumerate(slip):
        assert locking[1, 1, place, 1] == pytest.approx(-2.0 * np.sign(at) * PRELOAD * over_kinetic(at), rel=1e-5, abs=1e-6)


def test_torques_that_oppose_each_other_or_vanish_have_no_ratio_and_no_locking_value():
    assert bias(-10.0, 50.0) == bias(0.0, 50.0) == bias(0.0, 0.0) == bias(-60.46, 61.38) == bias(1e-9, -3e-9) == (None, None)
    assert bias(20.0, 60.0) == bias(60.0, 20.0) == bias(-20.0, -60.0) == (3.0, 50.0)


def test_no_percentage_grows_without_bound_where_torque_and_loss_vanish(tmp_path):
    """A preload of 60 N·m at ±0.9 N·m moves 130 times the transmitted torque, so a locking value is not defined."""
    from bevel_differential.losses.tables import save
    levels = dict(zip(VARIABLES, ([-0.92, 0.92, 300.0], [5.0, 40.0], [0.5, 20.0], [TEMPERATURE])))
    with Scene("plain", set=CLUTCH) as made:
        table = pq.read_table(save(losses(made, levels, unseen=5, workers=0), tmp_path / "map.parquet")).to_pylist()
    effects = [row["locking_value [%]"] for row in table]
    assert any(effect is not None for effect in effects) and all(effect is None or 0.0 <= effect <= 100.0 for effect in effects)
    for row in table:
        if row["kind"] == "map":
            moved, total = 2.0 * PRELOAD, abs(row["carrier.torque"])
            expected = pytest.approx(100.0 * moved / total, rel=1e-3) if total > moved else None
            assert row["locking_value [%]"] == expected, row


def test_the_efficiency_is_power_out_over_power_in_in_drive_and_overrun(tmp_path):
    """Drag of the bearings by its formula; in overrun, the wheels supply the carrier's output and the loss."""
    from bevel_differential.losses.tables import save_for_simulink
    levels = dict(zip(VARIABLES, ([-300.0, -100.0, 0.0, 100.0, 300.0], [10.0, SPEED], [5.0], [TEMPERATURE])))
    with Scene("drag", set=DRAG) as made:
        mapped = losses(made, levels, bound=Bound(10.0, 1000.0), unseen=0, workers=0)
        script = save_for_simulink(mapped, tmp_path / "map.m").read_text(encoding="utf-8")
    found = re.search(r"^eta_tbl = reshape\(\[([^]]*)\], \[([^]]*)\]\);$", script, re.MULTILINE)
    table = np.array([float(value) for value in found[1].split()]).reshape([int(size) for size in found[2].split()], order="F")
    torques, speeds = mapped.lines[:2]
    for i, torque in enumerate(torques):
        for k, speed in enumerate(speeds):
            sides = 2.0 * (0.7 + 0.005 * speed) * speed
            loss = (2.0 + 0.02 * speed + 1e-3 * speed**2) * speed + sides
            power = abs(torque) * speed
            eta = 1.0 - loss / power if torque > 0.0 else power / (power + loss)
            assert table[i, k, 0] == pytest.approx(max(eta, 0.01), rel=1e-4)
    assert "power out over power in" in script and "overrun" in script and "no drag" not in script


@pytest.mark.parametrize("set, table, torque, speed", [
    # the speed follows from the wheels, and the command of the speed has no effect
    ({"scene.carrier_drive": "torque", "carrier.torque_command": -400.0, **dict.fromkeys(("scene.left_drive", "scene.right_drive"), "speed"),
      "left.speed_command": -80.0, "right.speed_command": -70.0}, None, 400.0, 75.0),
    # the torque follows from the loads, and the command of the torque has no effect
    ({"scene.carrier_drive": "speed", "carrier.speed_command": 30.0, "carrier.torque_command": 9.0, "left.load_torque": 100.0,
      "right.load_torque": 200.0}, None, 300.0, 30.0),
    # an input grows during the scene, slowly, so that inertia adds little to the torque
    ({"scene.carrier_drive": "speed", "left.load_torque": 100.0, "right.load_torque": 200.0}, (0.0, 60.0), 300.0, 60.0),
])
def test_axes_end_at_the_torque_and_the_speed_that_the_scene_reaches(set, table, torque, speed):
    tables = [] if table is None else [("carrier.speed_command", [0.0, 10.0], list(table), None)]
    with Scene("reached", stop=10.0, step=1.0, set={"scene.gear_contact": "ideal", **set}, tables=tables) as made:
        asked = SimpleNamespace(torque=None, speed=None, difference=None, temperature=None)
        of_torque, of_speed, *_ = (of.levels() for of in _axes(made, asked))
    assert of_torque[-1] == pytest.approx(torque, rel=1e-3) and of_speed[-1] == pytest.approx(speed, rel=1e-3)
    assert of_torque[0] == pytest.approx(0.1 * of_torque[-1]) and of_speed[0] == pytest.approx(0.1 * of_speed[-1])


def test_a_map_without_drag_says_why_its_efficiencies_are_1(scene_file, tmp_path):
    scene = scene_file({"scene.gear_contact": "ideal", "carrier.speed_command": 30.0})
    said = command(f"losses {scene} --quick --unseen 0 --difference 5 --simulink {tmp_path / 'map.m'} --workers 0").out
    assert "map.m: eta_tbl is 1 everywhere, because the scene has no drag" in said


# nothing is lost

def test_an_interrupt_loses_nothing(tmp_path, monkeypatch):
    levels, evaluate = LEVELS | {VARIABLES[-1]: [TEMPERATURE]}, PointTask.evaluate
    given = {"bound": Bound(0.002, 0.1), "unseen": 20, "workers": 0}
    kept = {"out": tmp_path / "runs.parquet", **given}

    def stopping(task, run, values):
        if run == 100:
            raise KeyboardInterrupt
        return evaluate(task, run, values)

    with Scene("stribeck", set=STRIBECK_CLUTCH) as made:
        whole = losses(made, levels, **given)
        monkeypatch.setattr(PointTask, "evaluate", stopping)
        with pytest.raises(Stopped, match="^stopped; 100 of .* runs are kept .*--resume"):
            losses(made, levels, **kept)
        monkeypatch.undo()
        resumed, again = (losses(made, levels, **kept, resume=True) for _ in range(2))
    assert resumed.new == whole.new - 100 > 0 and again.new == 0
    for one in (resumed, again):
        assert np.array_equal(one.slipping, whole.slipping) and np.array_equal(one.found, whole.found)


def test_accuracy_chooses_the_model(scene, monkeypatch):
    asked, said = [], []

    def chosen(of, wants, within, from_):
        asked.append((of.values, wants, within))
        run = SimpleNamespace(setting="ideal")
        return SimpleNamespace(use=SimpleNamespace(set={"scene.gear_contact": "ideal"}, run=run))

    monkeypatch.setattr(package, "accuracy", chosen)
    made = losses(scene.set({"scene.gear_contact": "lumped"}), {name: values[:1] for name, values in LEVELS.items()}, within="1%",
                  unseen=0, workers=0, tell=said.append)
    (values, wants, within), = asked
    assert said[0] == "model: ideal"
    assert within == "1%" and wants == ["left.shaft_torque:mean", "right.shaft_torque:mean"]
    assert values["left.speed_command"] - values["right.speed_command"] == 0.5
    assert made.scene.values["scene.gear_contact"] == scene.fmu.variable("scene.gear_contact").literals["ideal"]
    assert "not measured" in made.error


def test_the_chosen_model_runs_at_the_edge_of_the_map_too():
    """In the middle of the map, teeth may come into contact by jumps; when cold and slow, they would stall."""
    said = []
    with Scene.load("torque_bias") as scene:
        levels = dict(zip(VARIABLES, ([167.0, 1670.0], [5.0, 50.0], [0.5, 20.0], [253.15, 393.15])))
        made = losses(scene, levels, within="1%", unseen=3, most=16, workers=0, tell=said.append)
        assert said[0].startswith("model: tooth") and "corner contact" in said[0].replace("_", " "), said[0]
        assert made.restless == 0
        # a point that would stall has a message with the remedy
        stalled = PointTask(benched(scene).set({"effects.corner_contact": False, "solver.relative_tolerance": 1e-4}))
        row = stalled.evaluate(0, {"carrier.torque_command": 167.0, "carrier.speed_command": 5.0, "left.speed_command": 4.75,
                                   "right.speed_command": 5.25, "oil.temperature": 253.15})
        stalled.close()
    assert "effects.corner_contact = true" in row.message, row.message


def test_temperatures_on_which_nothing_depends_share_their_runs():
    """The loss of a preload is M times the difference, at any oil temperature; a clutch with a cold factor depends on it."""
    levels = dict(zip(VARIABLES, ([300.0, 900.0], [5.0, 40.0], [0.5, 20.0], [253.15, 293.15, 353.15, 393.15])))
    runs = {}
    for cold in (1.0, 1.3):
        said = []
        with Scene("oil", set=CLUTCH | {"limited_slip.cold_factor": cold, "effects.strength": False}) as scene:
            made = losses(scene, levels, unseen=0, workers=0, tell=said.append)
        runs[cold] = made.new
        assert set(levels["oil.temperature"]) <= set(made.lines[3])
        assert made.slipping.shape[4] == made.stuck.shape[3] == len(made.lines[3])
        told = [text for text in said if text.startswith("oil.temperature has no effect here")]
        assert len(told) == (cold == 1.0) and all("4 temperatures share the runs at 80 degC" in text for text in told)
        loss = made.at(np.array([[500.0, 20.0, 10.0, temperature] for temperature in levels["oil.temperature"]]))[:, 2]
        factors = [cold, 1.0 + (cold - 1.0) * 0.6, 1.0, 1.0]
        assert loss == pytest.approx([PRELOAD * 10.0 * factor for factor in factors], rel=5e-3)
    assert 3 * runs[1.0] < runs[1.3]
