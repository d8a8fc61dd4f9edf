"""Wheel brakes: held wheels, stops, rolling against a brake; heat and energy, against closed forms."""

from math import sqrt

import numpy as np
import pytest
from braking import (BRAKED, CARRIER_INERTIA, CONTACTS, END, EXACT, MASSLESS, STIFFNESS, WHOLE, brakes, drive_torque,
                     wheel_angles)
from driving import GIVEN, SIDES, UNDAMPED, UNLOADED

RATIO = 10.0 / 16.0
LEDGERS = {"stop": {"carrier.speed_command": 30.0}, "hold and release": {"scene.start": "rest"},
           "blow": {"scene.carrier_drive": "speed", "carrier.speed_command": 10.0, "scene.start": "rest"}}


@pytest.mark.parametrize("shafts", [False, True])
@CONTACTS
def test_a_standing_wheel_winds_up_by_its_torque_does_not_drift_and_rolls_above_its_brake(drive, contact, shafts):
    torque = 50.0
    driven = drive(BRAKED | brakes(750.0) | drive_torque(2.0 * torque)
                   | {"scene.gear_contact": contact, "scene.start": "rest", "effects.half_shaft": shafts})
    begin = wheel_angles(driven)
    early = wheel_angles(driven.to(1.0, 1e-2))
    assert early - begin == pytest.approx(torque / STIFFNESS, rel=1e-4)
    steps = driven["solver.steps"]
    late = wheel_angles(driven.to(10.0, 0.1))
    assert np.abs(late - early).max() < 1e-6
    assert driven.read(["left.shaft_torque", "right.shaft_torque"]) == pytest.approx([torque] * 2, rel=1e-6)
    assert driven["held.wheels"] == 2.0
    # no chatter: at most two steps between communication points
    assert driven["solver.steps"] - steps <= 2 * 90
    # a wheel rolls above its brake torque
    driven.set(drive_torque(2.0 * 800.0))
    driven.to(10.1, 1e-2)
    assert driven["held.wheels"] == 0.0
    speed = driven["carrier.speed"]
    driven.to(10.5, 1e-2)
    # gears add less than one percent to the inertia
    assert (driven["carrier.speed"] - speed) / 0.4 == pytest.approx(2.0 * (800.0 - 750.0) / WHOLE, rel=0.01)
    # below the brake torque it stops, and remains where it stopped
    driven.set(drive_torque(2.0 * torque))
    driven.to(11.5, 1e-2)
    stopped = wheel_angles(driven)
    driven.to(21.5, 0.1)
    assert driven["held.wheels"] == 2.0
    assert np.abs(wheel_angles(driven) - stopped).max() < 1e-6


@CONTACTS
def test_a_brake_holds_a_wheel_that_a_load_of_that_torque_would_drive_backwards(drive, contact):
    """From rest, 750 N·m of load against 100 N·m of drive; the brake also holds the light side gear."""
    base = {"scene.gear_contact": contact, "scene.start": "rest", "scene.carrier_drive": "torque",
            "carrier.torque_command": 100.0, "effects.wheel_brake": True}
    loaded = drive(base | {"left.load_torque": 750.0, "right.load_torque": 750.0}).to(0.01, 1e-3)
    assert loaded["left.speed"] < -1.0
    least = []
    braked = drive(base | UNLOADED | brakes(750.0))
    braked.to(0.5, 1e-3, lambda d: least.append(min(d.read(["left.angle", "right.angle"]))))
    assert min(least) > -1e-9
    assert braked.read(["left.angle", "right.angle"]) == pytest.approx([50.0 / STIFFNESS] * 2, rel=1e-6)
    assert braked.read(["left.speed", "right.speed"]) == pytest.approx([0.0] * 2, abs=1e-6)


def test_a_stop_takes_the_angle_and_the_heat_of_its_closed_form(drive):
    """Both wheels slide from 30 rad/s to a stop under the brake torque T; springs then hold them against the drive T_e."""
    brake, torque, speed = 400.0, 150.0, 30.0
    driven = drive(BRAKED | MASSLESS | EXACT | brakes(brake) | drive_torque(2.0 * torque)
                   | {"scene.gear_contact": "ideal", "carrier.speed_command": speed, "scene.start": "rolling"})
    begin = wheel_angles(driven)
    deceleration = 2.0 * (brake - torque) / WHOLE
    stop, slip = speed / deceleration, speed**2 / (2.0 * deceleration)
    half = driven.to(0.5 * stop, 0.05 * stop)
    assert half["left.speed"] == pytest.approx(0.5 * speed, rel=1e-9)
    # two wheels, each with ∫T dφ over its slip
    assert half["heat.brake"] == pytest.approx(2.0 * brake * 0.75 * slip, rel=1e-9)
    driven.to(2.0 * stop, 0.05 * stop)
    assert wheel_angles(driven) - begin == pytest.approx(slip - (brake - torque) / STIFFNESS, rel=1e-7)
    wound_up = 0.5 * brake**2 / STIFFNESS
    # energy that the spring loses from T to T_e, of which the drive takes T_e (T − T_e)/k
    unwound = 0.5 * (brake - torque) ** 2 / STIFFNESS
    assert driven["heat.brake"] == pytest.approx(2.0 * (brake * slip - wound_up + unwound), rel=1e-6)
    assert driven.imbalance() < 1e-6


@CONTACTS
def test_at_a_stop_only_the_energy_of_the_springs_returns_from_the_heat(drive, contact):
    brake = 300.0
    driven = drive(BRAKED | EXACT | brakes(brake) | drive_torque(0.0)
                   | {"scene.gear_contact": contact, "effects.half_shaft": True, "carrier.speed_command": 10.0, "scene.start": "rolling"})
    names = ["heat.brake", "heat.contact", "heat.half_shaft", "heat.drag", "heat.thrust", "heat.clutch"]
    rows = []
    while driven.time < 0.1:
        driven.step(2e-4)
        rows.append(driven.read(names))
    falls = dict(zip(names, (np.maximum.accumulate(rows) - rows).max(axis=0)))
    assert driven["held.wheels"] == 2.0
    # two springs that are wound to the torque of the brakes
    assert falls.pop("heat.brake") == pytest.approx(brake**2 / STIFFNESS, rel=0.05)
    assert max(falls.values()) < 1e-6 * max(map(max, rows)), falls


@pytest.mark.parametrize("shafts", [False, True])
@CONTACTS
def test_heat_of_a_slip_is_its_torque_times_its_angle(drive, contact, shafts):
    left, right = 300.0, 120.0
    driven = drive(BRAKED | EXACT | brakes(left, right) | drive_torque(500.0)
                   | {"scene.gear_contact": contact, "effects.half_shaft": shafts, "carrier.speed_command": 60.0})
    begin = wheel_angles(driven)
    driven.to(0.05, 1e-3)
    assert driven["held.wheels"] == 0.0
    slid = wheel_angles(driven) - begin
    assert driven["heat.brake"] == pytest.approx(slid @ [left, right], rel=1e-6)
    assert driven.imbalance() < 1e-6


@CONTACTS
@pytest.mark.parametrize("scene", LEDGERS)
def test_the_ledger_closes(drive, contact, scene):
    """Within 1e-6 of the energy turned over at a tolerance of 1e-9. At 1e-6 the limit is twice the imbalance without brakes, or the
    requirement for scenes without losses if that is larger."""

    def imbalance(torque, tolerance):
        driven = drive(BRAKED | brakes(torque, 0.8 * torque) | drive_torque(150.0) | LEDGERS[scene]
                       | {"scene.gear_contact": contact, "solver.relative_tolerance": tolerance}).to(0.1, 1e-3)
        driven.set(brakes(0.5 * torque))
        driven.to(0.2, 1e-3).set(brakes(0.0))
        return driven.to(0.3, 1e-3).imbalance()

    assert imbalance(400.0, 1e-9) < 1e-6
    assert imbalance(400.0, 1e-6) < max(2.0 * imbalance(0.0, 1e-6), UNDAMPED)


def launched(torque, brake, side_gear=1e-12, planet=1e-12):
    """Accelerations of carrier, left and right wheel from rest with a braked left wheel, by Willis' equation."""
    carrier = (torque - brake) / (CARRIER_INERTIA + 2.0 * (END + side_gear))
    spin = -RATIO * brake / (2.0 * RATIO**2 * (END + side_gear) + 2.0 * planet)
    return np.array([carrier, carrier + RATIO * spin, carrier - RATIO * spin])


@pytest.mark.parametrize("shafts", [False, True])
def test_a_launch_with_one_wheel_braked_shares_the_torque_equally(drive, shafts):
    """T_left = T_brake + J dω_left/dt = T_right = J dω_right/dt."""
    torque, brake = 1000.0, 300.0
    driven = drive(BRAKED | MASSLESS | EXACT | brakes(brake, 0.0) | drive_torque(torque)
                   | {"scene.gear_contact": "ideal", "scene.start": "rest", "effects.half_shaft": shafts,
                      "half_shaft.left_damping": 100.0, "half_shaft.right_damping": 100.0}).to(0.5, 1e-2)
    _, left, right = launched(torque, brake)
    shared = driven.read(["left.shaft_torque", "right.shaft_torque"])
    # a shaft's damping turns speed errors into torque errors
    exact = 1e-5 if shafts else 1e-9
    assert shared == pytest.approx([brake + END * left] * 2, rel=exact)
    assert shared[1] == pytest.approx(END * right, rel=exact)
    # before the wheels slip and turn together, the springs of brake and shafts wind up
    assert driven.read([f"{side}.speed" for side in SIDES]) == pytest.approx([0.5 * left, 0.5 * right], rel=0.02)


@pytest.mark.parametrize("contact", ["lumped", "tooth", "solid"])
def test_gears_with_teeth_launch_a_braked_wheel_like_ideal_gears_on_average(drive, contact):
    torque, brake, stop = 1000.0, 300.0, 0.2
    driven = drive(BRAKED | GIVEN | brakes(brake, 0.0) | drive_torque(torque)
                   | {"scene.gear_contact": contact, "carrier.speed_command": 20.0})
    before = np.array(driven.read([f"{body}.angle" for body in ["carrier", *SIDES]]))
    driven.to(stop, 1e-3)
    turned = np.array(driven.read([f"{body}.angle" for body in ["carrier", *SIDES]])) - before
    expected = 20.0 * stop + 0.5 * launched(torque, brake, 9e-5, 2e-5) * stop**2
    # the damping of teeth takes a few thousandths of the torque
    assert turned == pytest.approx(expected, rel=5e-3)
    for side, at in zip(SIDES, (brake, 0.0)):
        delivered = at + END * driven[f"{side}.acceleration"]
        assert driven[f"{side}.shaft_torque"] == pytest.approx(delivered, rel=1e-9)


@CONTACTS
def test_under_an_imposed_carrier_the_wheel_with_the_stronger_brake_stops(drive, contact):
    """The stopped wheel carries the torque of the other brake, and the other wheel turns twice as fast as the carrier."""
    speed, left, right = 20.0, 300.0, 200.0
    driven = drive(BRAKED | brakes(left, right) | {"scene.carrier_drive": "speed", "carrier.speed_command": speed,
                                                   "scene.gear_contact": contact}).to(1.0, 1e-2)
    stopped = wheel_angles(driven)[0]
    driven.to(2.0, 1e-2)
    assert driven["held.wheels"] == 1.0
    turned, spins = [], []
    for _ in range(100):
        driven.to(driven.time + 1e-3, 1e-3)
        turned.append(driven.read(["carrier.torque", "left.shaft_torque", "right.shaft_torque"]))
        spins.append(driven["right.speed"])
    # no bias, within the effect of the teeth's uneven ratio
    assert np.mean(turned, axis=0) == pytest.approx([2.0 * right, right, right], rel=1e-2)
    assert np.mean(spins) == pytest.approx(2.0 * speed, rel=1e-3)
    assert wheel_angles(driven)[0] == pytest.approx(stopped, abs=2e-4)
    # with equal brakes, both wheels turn with the carrier
    alike = drive(BRAKED | brakes(left) | {"scene.carrier_drive": "speed", "carrier.speed_command": speed,
                                           "scene.gear_contact": contact}).to(0.2, 1e-2)
    assert alike.read(["left.speed", "right.speed"]) == pytest.approx([speed] * 2, rel=1e-6)
    assert alike["carrier.torque"] == pytest.approx(2.0 * left, rel=1e-6)


@CONTACTS
def test_rolling_wheels_start_in_balance_with_their_brakes(drive, contact):
    """Preload includes a brake that slides, so that the start equals one with loads of the same torque."""
    base = BRAKED | {"scene.carrier_drive": "speed", "carrier.speed_command": 20.0, "scene.gear_contact": contact}
    speeds = []
    for by in (brakes(300.0), {"left.load_torque": 300.0, "right.load_torque": 300.0}):
        driven, passed = drive(base | by), []
        assert driven["left.shaft_torque"] == pytest.approx(300.0, rel=1e-9)
        driven.to(0.05, 1e-3, lambda d: passed.append(d.read(["left.speed", "right.speed"])))
        speeds.append(np.array(passed))
    assert speeds[0] == pytest.approx(speeds[1], rel=1e-6)


@CONTACTS
def test_a_speed_driven_wheel_works_against_its_brake_through_zero(drive, contact):
    """ω = 10 − 20 t: slip, a spring that unwinds from T and winds up to −T, slip backwards."""
    brake, start, slope = 200.0, 10.0, -20.0
    driven = drive(BRAKED | EXACT | brakes(brake, 0.0) | drive_torque(0.0)
                   | {"scene.gear_contact": contact, "scene.left_drive": "speed", "left.speed_command": start,
                      "carrier.speed_command": start})
    name = "left.speed_command"
    for k in range(20):
        driven.set({name: start + slope * driven.time})
        driven.set_slopes({name: slope})
        driven.step(0.05 * (k + 1) - driven.time)
    damping = 2.0 * sqrt(END / STIFFNESS)
    forward = 0.5 * start**2 / -slope
    # s after the stop the spring is at T/k + ½ ω̇ s²; it slips where spring and damping reach −T
    wound = 2.0 * brake / STIFFNESS
    s = np.roots([-0.5 * slope, -slope * damping, -wound]).max()
    at = brake / STIFFNESS + 0.5 * slope * s**2
    held = -0.5 * brake**2 / STIFFNESS + STIFFNESS * damping * slope**2 * s**3 / 3.0 + 0.5 * STIFFNESS * at**2
    backward = 0.5 * -slope * (0.5**2 - s**2)
    assert driven["heat.brake"] == pytest.approx(brake * (forward + backward) + held, rel=1e-6)
    assert driven.imbalance() < 1e-6
