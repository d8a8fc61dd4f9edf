"""Dry friction with stiction: thrust friction that holds a bias, limited slip, lock."""

import pytest
import theory
from driving import BIAS, SIDES

STEP = 1e-3


def test_a_stuck_differential_carries_any_bias_up_to_its_friction(drive):
    # lumped teeth have no cogging, so only friction holds
    base = {"scene.gear_contact": "lumped", "effects.thrust_friction": True}
    limit = drive(base | BIAS).to(1.0, STEP)["locking_value"]
    for share, holds in ((0.5, True), (0.9, True), (0.98, True), (1.05, False)):
        extra = share * limit * theory.LOAD
        driven = drive(base).to(0.2, STEP)
        driven.load(theory.LOAD + extra, theory.LOAD - extra)
        driven.to(0.6, STEP)
        difference = driven["left.speed"] - driven["right.speed"]
        if holds:
            assert abs(difference) < 1e-6, share
            assert driven["locking_value"] == pytest.approx(share * limit, rel=1e-6)
        else:
            assert abs(difference) > 1.0


def test_shafts_keep_their_twist_when_both_wheels_come_to_the_same_speed(drive):
    driven = drive(BIAS | {"scene.gear_contact": "lumped", "effects.thrust_friction": True}).to(1.0, STEP)
    sliding = driven["locking_value"]
    driven.set({f"{side}.speed_command": 50.0 for side in SIDES})
    driven.to(2.0, STEP)
    kept = driven["right.shaft_torque"] - driven["left.shaft_torque"]
    # the bias remains, limited by friction, and does not creep away
    assert 0.0 < kept / 1670.0 <= sliding * 1.001
    driven.to(12.0, 1e-2)
    assert driven["right.shaft_torque"] - driven["left.shaft_torque"] == pytest.approx(kept, rel=1e-6)
    assert driven["held.sides"] == 2.0


@pytest.mark.parametrize("contact", ["ideal", "lumped", "tooth"])
def test_a_limited_slip_below_its_lock_torque_does_not_creep(drive, contact):
    driven = drive({"scene.gear_contact": contact, "effects.limited_slip": True, "limited_slip.preload": 100.0,
                    "limited_slip.torque_coefficient": 0.0, "left.load_torque": theory.LOAD + 90.0,
                    "right.load_torque": theory.LOAD - 90.0})
    turned = lambda: [driven[f"{side}.angle"] - driven["carrier.angle"] for side in SIDES]  # noqa: E731
    driven.to(0.5, STEP)
    wound_up = turned()
    driven.to(10.5, 1e-2)
    assert turned() == pytest.approx(wound_up, abs=1e-6)
    assert driven["held.sides"] == 2.0
    # above this torque it slips: the lighter side is accelerated by the remaining torque
    driven.load(theory.LOAD + 150.0, theory.LOAD - 150.0)
    driven.to(10.6, STEP)
    assert driven["right.speed"] > driven["left.speed"] + 1.0


@pytest.mark.parametrize("contact", ["ideal", "lumped", "tooth"])
def test_a_locked_differential_turns_as_one(drive, contact):
    driven = drive({"scene.gear_contact": contact, "left.load_torque": 1600.0, "right.load_torque": 70.0,
                    "lock.command": 1.0, "inertia.left_end": 0.5, "inertia.right_end": 0.5}).to(0.5, STEP)
    carrier = driven["carrier.speed"]
    assert driven["left.speed"] == pytest.approx(carrier, rel=1e-6)
    assert driven["right.speed"] == pytest.approx(carrier, rel=1e-6)
    # after opening, the lighter side becomes faster
    driven.set({"lock.command": 0.0})
    driven.to(0.51, STEP)
    assert driven["right.speed"] > carrier + 5.0
    assert driven["left.speed"] < carrier - 5.0


def test_an_ideal_limited_slip_accelerates_the_ends_by_its_closed_form(drive):
    end, preload = 0.5, 60.0
    driven = drive({"scene.gear_contact": "ideal", "effects.limited_slip": True, "limited_slip.preload": preload,
                    "limited_slip.torque_coefficient": 0.0, "inertia.left_end": end, "inertia.right_end": end,
                    "inertia.from_geometry": False, "inertia.side_gear": 1e-4, "inertia.planet": 2e-5,
                    "left.load_torque": 1000.0, "right.load_torque": 600.0}).to(0.1, STEP)
    begin = driven["right.speed"]
    driven.to(0.3, STEP)
    # r (T_L - T_R) less the friction of both clutches, over the inertia of the relative motion
    relative = 2.0 * theory.RATIO * (end + 1e-4) + theory.PLANETS * 2e-5 / theory.RATIO
    acceleration = (0.5 * 400.0 - preload) * 2.0 / relative * theory.RATIO
    assert driven["right.speed"] - begin == pytest.approx(acceleration * 0.2, rel=1e-6)


@pytest.mark.parametrize("contact", ["ideal", "lumped"])
def test_a_clutch_that_slides_and_sticks_does_not_depend_on_the_communication_step(drive, contact):
    """Bodies turn by many tooth pitches within one step, slide, reach the carrier's speed, and are held there."""
    ends = []
    for step in (1e-3, 0.25):
        driven = drive({"scene.gear_contact": contact, "effects.limited_slip": True, "limited_slip.preload": 100.0,
                        "limited_slip.torque_coefficient": 0.0, "inertia.left_end": 0.5, "inertia.right_end": 0.5})
        for until, difference in ((0.5, 150.0), (1.5, -30.0), (2.5, 60.0)):
            driven.load(theory.LOAD + difference, theory.LOAD - difference)
            driven.to(until, step)
        assert driven["held.sides"] == 2.0
        assert abs(driven["left.speed"] - driven["right.speed"]) < 1e-3
        assert abs(driven["solver.energy_residual"]) < 1e-3 * driven["heat.clutch"]
        ends.append(driven.read(["left.angle", "right.angle", "heat.clutch", "solver.steps"]))
    fine, coarse = ends
    assert coarse[:2] == pytest.approx(fine[:2], abs=1e-3)
    assert coarse[2] == pytest.approx(fine[2], rel=1e-3)
    # no chatter
    assert coarse[3] < 5e3
