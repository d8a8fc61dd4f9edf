"""Communication steps from microseconds to hours, and a day of driving: the same trajectory, and no drift."""

import numpy as np
import pytest
import theory
from driving import CARRIER, SIDES, TURN, UNDAMPED

DAY = 86400.0


def wind_up(scene):
    """Angle of the left side gear behind carrier and planets [rad]."""
    return scene["carrier.angle"] + theory.RATIO * scene["planet[1].spin_angle"] - scene["left.angle"]


@pytest.mark.parametrize("step", [10.0, 60.0])
def test_a_day_of_straight_driving_drifts_neither_in_speed_nor_in_force(drive, step):
    scene = drive({"scene.start": "rolling"}).to(DAY, step)
    for side in SIDES:
        assert scene[f"{side}.speed"] == pytest.approx(CARRIER, rel=1e-6)
        assert scene[f"{side}.tangential_force"] == pytest.approx(theory.TANGENTIAL_FORCE, rel=1e-6)
    # after 4.3 million radians, the mean lag of both side gears, at any rest position of the free planets, is still exact to less than
    # a micrometre at the teeth
    lag = scene["carrier.angle"] - 0.5 * (scene["left.angle"] + scene["right.angle"])
    assert lag == pytest.approx(theory.half_play() + theory.largest_wind_up(), abs=1e-5)
    assert scene["carrier.angle"] == pytest.approx(DAY * CARRIER, rel=1e-12)
    assert scene.imbalance() < UNDAMPED


def test_a_day_in_a_slow_turn_keeps_the_phase_of_the_teeth(drive):
    # five mesh periods in an hour and a half: 80 in a day
    spin = 80.0 * 2.0 * np.pi / theory.PLANET_TEETH / DAY
    scene = drive(TURN | {"scene.start": "equilibrium", "spin.command": spin})
    begin = scene["left.tangential_force"]
    scene.to(DAY, 60.0)
    assert scene["planet[1].spin_angle"] == pytest.approx(DAY * spin, rel=1e-11)
    assert scene["left.tangential_force"] == pytest.approx(begin, rel=1e-6)
    assert begin == pytest.approx(theory.TANGENTIAL_FORCE, rel=1e-6)
    for side, expected in zip(SIDES, theory.side_speeds(np.radians(954.0), spin)):
        assert scene[f"{side}.speed"] == pytest.approx(expected, rel=1e-6)
    assert wind_up(scene) == pytest.approx(theory.half_play() + theory.largest_wind_up(), abs=1e-5)
    assert scene.imbalance() < UNDAMPED


def test_ten_minutes_in_the_study_s_turn_keep_the_phase_of_the_teeth(drive):
    # more than three thousand whole mesh periods
    scene = drive(TURN).to(594.0, 0.18)
    assert scene["planet[1].spin_angle"] == pytest.approx(594.0 * np.radians(200.0), rel=1e-11)
    assert scene["left.tangential_force"] == pytest.approx(theory.TANGENTIAL_FORCE, rel=1e-6)
    assert wind_up(scene) == pytest.approx(theory.half_play() + theory.largest_wind_up(), abs=1e-5)
    assert scene.imbalance() < UNDAMPED


# attempts at steps in a second after which the FMU discards a communication step, with effects on bodies
ATTEMPTS = 500_000
# a car at standstill: brakes hold its wheels, and the free carrier rattles in the backlash
HELD = {"scene.gear_contact": "lumped", "scene.carrier_drive": "torque", "carrier.torque_command": 0.0, "scene.start": "rolling",
        "carrier.speed_command": 5.0, "effects.wheel_brake": True, "left.brake_torque": 100.0, "right.brake_torque": 100.0,
        "left.load_torque": 0.0, "right.load_torque": 0.0, "inertia.left_end": 1.0, "inertia.right_end": 1.0, "contact.law": "line"}


def test_a_step_of_minutes_may_take_more_attempts_than_are_allowed_in_a_second(drive):
    rattling = drive(HELD).to(120.0, 120.0)
    assert sum(rattling.read(["solver.steps", "solver.rejected"])) > ATTEMPTS
    assert rattling["held.wheels"] == 2.0 and rattling.imbalance() < UNDAMPED


def test_between_impacts_a_rattle_costs_few_steps(drive):
    standing = drive(HELD | {"effects.thrust_friction": True}).to(2.0, 0.1)
    before, speeds = standing["solver.steps"], []
    standing.to(4.0, 1e-3, lambda driven: speeds.append(driven["carrier.speed"]))
    # the wheels ring after each impact of the carrier
    impacts = np.count_nonzero(np.diff(np.sign(speeds)))
    assert impacts > 10 and standing["solver.steps"] - before < 75 * impacts
