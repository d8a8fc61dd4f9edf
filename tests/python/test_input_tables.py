"""Inputs that follow tables: `Differential` and `Scene` behave equally, between points, at jumps and in every period."""

import numpy as np
import pytest
from bevel_differential import Differential, DifferentialError, DifferentialWarning, Scene
from bevel_differential.designs.task import Task

# bodies that turn freely under only the drive
FREE = {"scene.gear_contact": "ideal", "scene.carrier_drive": "torque", "scene.start": "rest", "carrier.speed_command": 0.0,
        "left.load_torque": 0.0, "right.load_torque": 0.0, "inertia.left_end": 1.0, "inertia.right_end": 1.0}
DRIVE, SPEED = "carrier.torque_command", "carrier.speed"
STEPS = [None, 0.3, 0.1, 0.01, 1e-3]


@pytest.fixture(scope="module")
def free(fmu_file):
    with Differential(FREE, fmu=fmu_file) as driven:
        yield driven


@pytest.fixture(scope="module")
def inertia(free):
    """Inertia of all bodies, kg·m², from a constant torque."""
    return 100.0 / free.final([SPEED], {DRIVE: 100.0}, stop=1.0)[SPEED]


def in_scene(tables, stop, step, fmu_file, **more):
    with Scene(stop=stop, step=step, outputs=[SPEED, "carrier.angle"], set=FREE, tables=tables, fmu=fmu_file, **more) as scene:
        return scene.run()


@pytest.mark.parametrize("torque", [100.0, -100.0])
@pytest.mark.parametrize("step", STEPS)
def test_a_ramp_gives_its_momentum_at_any_step(step, torque, free, inertia, fmu_file):
    times, values = [0.0, 1.0], [0.0, torque]
    exact = 0.5 * torque / inertia
    record = free.run({DRIVE: (times, values)}, [SPEED, DRIVE.removesuffix("_command")], 1.0, step)
    assert record[SPEED][-1] == pytest.approx(exact, rel=1e-8)
    assert record["carrier.torque"][-1] == pytest.approx(torque, rel=1e-8)
    assert free.final([SPEED], {DRIVE: (times, values)}, stop=1.0)[SPEED] == pytest.approx(exact, rel=1e-8)
    if step is not None:
        of_scene = in_scene([(DRIVE, times, values, None)], 1.0, step, fmu_file)
        assert np.array_equal(of_scene["time"], record["time"])
        assert of_scene[SPEED] == pytest.approx(record[SPEED], rel=1e-12)


@pytest.mark.parametrize("stop", [0.7, 3.0])
def test_without_a_step_corners_and_jumps_count(stop, free, inertia):
    times, values = [0.1, 0.4, 0.4, 0.55, 2.0], [50.0, 200.0, -100.0, 300.0, 0.0]
    inputs = {DRIVE: (times, values)}
    # trapezoids, with the first value before them and the last one after them
    knots = [0.0, *(time for time in times if time < stop), stop]
    ends = [values[0], *(value for time, value in zip(times, values) if time < stop), np.interp(stop, times[3:], values[3:])]
    exact = np.trapezoid(ends, knots) / inertia
    assert free.final([SPEED], inputs, stop)[SPEED] == pytest.approx(exact, rel=1e-8)
    record = free.run(inputs, [SPEED], stop, None)
    # a jump has two rows
    assert record["time"].tolist() == knots
    assert record[SPEED][-1] == pytest.approx(exact, rel=1e-8)


def test_held_values_are_a_staircase(free, inertia, fmu_file):
    table = ([0.0, 1.0], [0.0, 100.0])
    exact = 100.0 * np.sum(np.arange(10) * 0.1 * 0.1) / inertia
    held = free.run({DRIVE: table}, [SPEED], 1.0, 0.1, input_slopes=False)
    assert held[SPEED][-1] == pytest.approx(exact, rel=1e-7)
    of_scene = in_scene([(DRIVE, *table, None)], 1.0, 0.1, fmu_file, input_slopes=False)
    assert of_scene[SPEED] == pytest.approx(held[SPEED], rel=1e-12)


def test_tables_that_no_long_step_follows_are_refused(fmu_file):
    with Differential(FREE, effects__limited_slip=True, limited_slip__preload=50.0, limited_slip__torque_coefficient=0.0, fmu=fmu_file) as driven:
        ramp = ([0.0, 1.0], [20.0, 80.0])
        with pytest.raises(DifferentialError, match="limited_slip.preload: its table changes between its points.*a parameter is held"):
            driven.final([SPEED], {"limited_slip.preload": ramp}, 1.0)
        driven.run({"limited_slip.preload": ramp}, [SPEED], 0.01, 1e-3)
        driven.final([SPEED], {"limited_slip.preload": ([0.0, 0.5, 0.5], [20.0, 20.0, 80.0])}, 1.0)
        with pytest.raises(DifferentialError, match="carrier.torque_command.*without input_slopes"):
            driven.run({DRIVE: ramp}, [SPEED], 1.0, None, input_slopes=False)
        with pytest.raises(DifferentialError, match="input_slopes = 'yes'"):
            driven.run({DRIVE: ramp}, [SPEED], 1.0, input_slopes="yes")


PULSES = [0.0, 0.05, 0.05, 0.1], [100.0, 100.0, 0.0, 0.0], 0.1
# by period: impulse in N·m·s, and jumps
SAWTOOTH = [0.0, 0.1], [0.0, 100.0], 0.1
CUT = [0.02, 0.06, 0.2], [100.0, 0.0, 70.0], 0.1


@pytest.mark.parametrize("input_slopes", [True, False])
@pytest.mark.parametrize("step", [0.08, 0.033, 0.4])
def test_a_jump_comes_in_every_period(step, input_slopes, inertia, fmu_file):
    record = in_scene([(DRIVE, *PULSES)], 1.0, step, fmu_file, input_slopes=input_slopes)
    apart = np.abs(record["time"] - 0.05 * np.arange(1, 20)[:, np.newaxis]).min(axis=1)
    assert apart.max() < 1e-12
    assert record[SPEED][-1] == pytest.approx(50.0 / inertia, rel=1e-8)
    # the same jumps without a period
    times = [round(k * 0.1 + time, 12) for k in range(10) for time in PULSES[0]]
    once = in_scene([(DRIVE, times, PULSES[1] * 10, None)], 1.0, step, fmu_file, input_slopes=input_slopes)
    assert once["time"] == pytest.approx(record["time"], abs=1e-12)
    assert once[SPEED] == pytest.approx(record[SPEED], rel=1e-9)


@pytest.mark.parametrize("table, impulse", [(SAWTOOTH, 50.0), (CUT, 10.0 * (2.0 + 2.0 + 0.5 * 0.04 * 20.0))])
@pytest.mark.parametrize("step", [0.08, 0.033])
def test_the_end_of_a_period_is_a_jump_if_the_next_one_begins_otherwise(step, table, impulse, inertia, fmu_file):
    record = in_scene([(DRIVE, *table)], 1.0, step, fmu_file)
    assert np.abs(record["time"] - 0.1 * np.arange(1, 10)[:, np.newaxis]).min(axis=1).max() < 1e-12
    assert record[SPEED][-1] == pytest.approx(impulse / inertia, rel=1e-7)


# a pulse between communication points, and a ramp whose middle point is on a straight line
PULSE = [0.0, 0.11, 0.13, 0.15, 0.19], [0.0, 0.0, 500.0, 1000.0, 0.0]


@pytest.mark.parametrize("sign", [1.0, -1.0])
@pytest.mark.parametrize("step", STEPS)
def test_a_pulse_between_communication_points_gives_its_momentum(step, sign, free, inertia, fmu_file):
    times, values = PULSE[0], [sign * value for value in PULSE[1]]
    exact = sign * 0.5 * 0.08 * 1000.0 / inertia
    record = free.run({DRIVE: (times, values)}, [SPEED], 1.0, step)
    assert record[SPEED][-1] == pytest.approx(exact, rel=1e-8)
    if step is None:
        return
    # the record has no rows at corners
    assert record["time"] == pytest.approx(np.append(np.arange(0.0, 1.0 - 1e-9, step), 1.0), abs=1e-12)
    with Scene(stop=1.0, step=step, outputs=[SPEED], set=FREE, tables=[(DRIVE, times, values, 0.25)], fmu=fmu_file) as scene:
        assert scene.run()[SPEED][-1] == pytest.approx(4.0 * exact, rel=1e-8)
        assert scene.final()[SPEED] == pytest.approx(4.0 * exact, rel=1e-8)
        row = Task(scene, [f"{SPEED}:max" if sign > 0.0 else f"{SPEED}:min"]).evaluate(0, {})
        assert row.figures == pytest.approx({next(iter(row.figures)): 4.0 * exact}, rel=1e-8)


def test_held_values_are_sampled_only_at_the_start_of_steps(free, inertia):
    held = free.run({DRIVE: PULSE}, [SPEED], 1.0, 0.05, input_slopes=False)
    assert held[SPEED][-1] == pytest.approx(1000.0 * 0.05 / inertia, rel=1e-7)
    assert len(held) == 21


def test_a_table_with_many_points_between_communication_points_says_so_once(fmu_file):
    times = np.arange(0, 2001) * 1e-4
    noise = np.random.default_rng(1).normal(100.0, 5.0, len(times))
    with Differential(FREE, fmu=fmu_file) as driven, pytest.warns(DifferentialWarning) as caught:
        driven.run({DRIVE: (times, noise)}, [SPEED], 0.2, 0.01)
        assert [text for text in driven.warnings if "points of tables" in text] == [str(one.message) for one in caught
                                                                                    if "1980 points of tables" in str(one.message)]
        driven.run({DRIVE: (times, noise)}, [SPEED], 0.2, 1e-4)
        assert not [text for text in driven.warnings if "points of tables" in text]


def test_strength_does_not_depend_on_where_a_blow_of_the_load_is_between_communication_points(fmu_file):
    times = np.arange(0.0, 0.0905, 1e-3)
    torque = np.full(len(times), 400.0)
    blow = slice(52, 59)
    torque[blow] += 1000.0 * np.sin(np.pi * (times[blow] - 0.0515) / 0.007)
    loads = {f"{side}.load_torque": (times, torque) for side in ("left", "right")}
    rated = {"safety.root_min", "damage.planet"}
    with Differential({"scene.gear_contact": "lumped", "carrier.speed_command": 20.0, "effects.strength": True}, fmu=fmu_file) as driven:
        found = [driven.run(loads, sorted(rated), 0.09, step)[-1] for step in (1e-3, 10e-3, 45e-3)]
    for name in rated:
        assert [row[name] for row in found] == pytest.approx([found[0][name]] * 3, rel=0.01), name
    assert found[0]["damage.planet"] > 0.0 and found[0]["safety.root_min"] < 1.0


def test_countless_jumps_are_refused(fmu_file):
    with pytest.raises(DifferentialError, match=r"carrier.torque_command jumps more than 1e\+08 times in 1 s; its period is 2e-10 s"):
        in_scene([(DRIVE, [0.0, 1e-10, 1e-10], [1.0, 1.0, 0.0], 2e-10)], 1.0, 0.1, fmu_file)


def test_a_scene_file_holds_or_follows_as_the_scene(tmp_path, fmu_file):
    ramp = "[[table]]\ninput = 'carrier.torque_command'\ntime = [0.0, 1.0]\nvalue = [0.0, 100.0]\n"
    for line, follows in (("", True), ("input_slopes = true\n", True), ("input_slopes = false\n", False)):
        text = f"description = 'd'\nstop_time = 1\nstep = 0.1\noutputs = ['carrier.speed']\n{line}{ramp}"
        (tmp_path / "ramp.toml").write_text(text, encoding="utf-8")
        with Scene.load(tmp_path / "ramp.toml", fmu=fmu_file) as scene:
            assert scene.input_slopes is follows
            assert scene.contents()["input_slopes"] is follows
