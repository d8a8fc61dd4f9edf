"""Limited slip as it is sold: ramps for drive and coast, viscous clutches, measured curves, and a lock with damping. Closed forms,
a published table, and refusals."""

from math import exp, pi, sqrt

import numpy as np
import pytest
import theory
from clutch_reference import Clutches, Gears, Reference, alternating_loads
from driving import SIDES, UNDAMPED
from refusals import refused

RPM = pi / 30.0
# the wheels have different imposed speeds, so that both packs slide
SLIDING = {"effects.limited_slip": True, "scene.carrier_drive": "torque", "scene.left_drive": "speed", "scene.right_drive": "speed",
           "half_shaft.left_damping": 100.0, "half_shaft.right_damping": 100.0}
KAPPA, COAST = 0.4, 0.25
RAMPS = SLIDING | {"limited_slip.torque_coefficient": KAPPA, "limited_slip.coast_ratio": COAST}
# relative tolerance of a mean over whole mesh cycles
MEAN = 1e-3


def speeds(left, right):
    return {"left.speed_command": left, "right.speed_command": right, "carrier.speed_command": 0.5 * (left + right)}


def difference(driven):
    """Torque of the slower wheel minus torque of the faster wheel [N·m]."""
    left, right = driven.read([f"{side}.shaft_torque" for side in SIDES])
    faster_is_left = driven["left.speed_command"] > driven["right.speed_command"]
    return right - left if faster_is_left else left - right


def mean_difference(driven, contact):
    """Difference of the torques; with teeth, the mean over whole mesh cycles, in which a planet rolls by one tooth."""
    driven.to(0.4, 1e-3)
    if contact != "tooth":
        return difference(driven)
    spin = abs(driven["left.speed_command"] - driven["right.speed_command"]) / (2.0 * theory.RATIO)
    cycle, count = theory.TOOTH_PITCH / spin, 200
    seen = []
    driven.to(driven.time + cycle, cycle / count, lambda d: seen.append(difference(d)))
    return np.mean(seen)


@pytest.mark.parametrize("faster", ["left", "right"])
@pytest.mark.parametrize("direction", [1.0, -1.0])
@pytest.mark.parametrize("torque", [1000.0, -1000.0])
@pytest.mark.parametrize("planets", [2, 4])
@pytest.mark.parametrize("contact", ["lumped", "tooth"])
@pytest.mark.parametrize("pressed_by", ["own_side", "both_sides"])
def test_ramps_transfer_their_torque_in_all_quadrants(drive, pressed_by, contact, planets, torque, direction, faster):
    slow, fast = direction * 20.0, direction * 24.0
    if direction < 0.0:
        slow, fast = fast, slow
    left, right = (fast, slow) if faster == "left" else (slow, fast)
    driven = drive(RAMPS | speeds(left, right) | {"scene.gear_contact": contact, "geometry.planet_count": planets,
                                                  "carrier.torque_command": torque, "limited_slip.pressed_by": pressed_by})
    # drive is the direction of the torque, whatever the speed is
    expected = KAPPA * 1000.0 if torque > 0.0 else KAPPA * COAST * 1000.0
    assert mean_difference(driven, contact) == pytest.approx(expected, rel=MEAN)


@pytest.mark.parametrize("pressed_by", ["own_side", "both_sides"])
@pytest.mark.parametrize("coast", [0.0, 0.25, 1.0, 4.0])
def test_the_torque_is_continuous_through_zero(drive, pressed_by, coast):
    driven = drive(RAMPS | speeds(22.0, 20.0) | {"scene.gear_contact": "lumped", "limited_slip.coast_ratio": coast, "effects.backlash": False,
                                                 "carrier.torque_command": 1.0, "limited_slip.pressed_by": pressed_by})
    driven.to(0.4, 1e-3)
    for torque in [1.0, 0.1, 1e-3, 0.0, -1e-3, -0.1, -1.0]:
        driven.set({"carrier.torque_command": torque})
        driven.to(driven.time + 0.2, 1e-3)
        expected = KAPPA * (torque if torque > 0.0 else -coast * torque)
        assert difference(driven) == pytest.approx(expected, rel=MEAN, abs=1e-6), torque


@pytest.mark.parametrize("torque", [1000.0, -1000.0])
def test_friction_of_the_pins_distinguishes_the_two_ways_of_pressing(drive, torque):
    friction, radius = 0.3, 8e-3
    kappa = KAPPA if torque > 0.0 else KAPPA * COAST
    found = {}
    for pressed_by in ["own_side", "both_sides"]:
        driven = drive(RAMPS | speeds(22.0, 20.0) | {
            "scene.gear_contact": "lumped", "carrier.torque_command": torque, "limited_slip.pressed_by": pressed_by,
            "effects.thrust_friction": True, "thrust_friction.pin_coefficient": friction, "thrust_friction.pin_radius": radius,
            "thrust_friction.planet_washer_radius": 0.0, "thrust_friction.side_washer_radius": 0.0})
        driven.to(0.5, 1e-3)
        # friction on the pins makes the mesh torques on the side gears differ: Q_slow - Q_fast
        unequal = theory.PLANETS * friction * radius * driven["planet[1].pin_force"] / theory.RATIO
        # T_c = Q_L + Q_R - F_fast + F_slow, and F = kappa |Q| of each side, or of their mean
        bias = unequal if pressed_by == "both_sides" else (1.0 - kappa * kappa) * unequal
        expected = bias + kappa * abs(torque)
        found[pressed_by] = difference(driven)
        assert found[pressed_by] == pytest.approx(expected, rel=1e-6)
    assert found["both_sides"] - found["own_side"] > (10.0 if torque > 0.0 else 0.5)


# published table of a viscous coupling: difference of the shaft torques over the difference of the wheel speeds
TABLE = dict(zip([60, 120, 180, 240, 300, 360, 420, 480, 540, 600, 720, 840, 960, 1080, 1200],
                 [90.09, 127.4, 156.03, 180.17, 201.44, 220.67, 238.35, 254.8, 270.26, 284.88, 312.07, 337.07, 360.35, 382.21, 402.88]))
VISCOUS = SLIDING | {"limited_slip.viscous_torque": 82.24, "limited_slip.viscous_speed": 100.0 * RPM, "limited_slip.viscous_exponent": 0.5}


@pytest.mark.parametrize("contact", ["ideal", "lumped"])
def test_a_viscous_coupling_follows_a_published_table(drive, contact):
    for rpm, torque in TABLE.items():
        half = 0.5 * rpm * RPM
        driven = drive(VISCOUS | speeds(50.0 + half, 50.0 - half) | {"scene.gear_contact": contact, "carrier.torque_command": 0.0})
        driven.to(0.5, 5e-3)
        assert difference(driven) == pytest.approx(torque, rel=1e-3), rpm


@pytest.mark.parametrize("exponent", [0.3, 0.5, 1.0, 2.0])
@pytest.mark.parametrize("contact", ["ideal", "lumped", "tooth"])
def test_a_viscous_coupling_holds_nothing_at_standstill(drive, contact, exponent):
    driven = drive({"scene.gear_contact": contact, "effects.limited_slip": True, "limited_slip.viscous_torque": 100.0,
                    "limited_slip.viscous_exponent": exponent, "scene.start": "rest", "carrier.speed_command": 0.0,
                    "left.load_torque": 60.0, "right.load_torque": -60.0, "inertia.left_end": 0.5, "inertia.right_end": 0.5})
    driven.to(3.0, 1e-2)
    # both packs of the ends resist with the torque at their slip: T_v (s/s_v)^n = 60 N·m
    assert driven["right.speed"] == pytest.approx(10.0 * 0.6 ** (1.0 / exponent), rel=2e-2)
    assert driven["held.sides"] == 0.0
    assert driven["heat.clutch"] > 0.0 and driven.imbalance() < UNDAMPED


def heat_torque(driven):
    """Torque of each pack from the heat of both [N·m], at a constant slip."""
    slip = abs(driven["left.speed"] - driven["carrier.speed"])
    begin, time = driven["heat.clutch"], driven.time
    driven.to(time + 0.2, 1e-2)
    return (driven["heat.clutch"] - begin) / (driven.time - time) / (2.0 * slip)


IMPOSED = {"scene.gear_contact": "ideal", "scene.planet_spin": "imposed", "effects.limited_slip": True}
POINTS = [(2.0, 30.0), (5.0, 90.0), (6.0, 91.0), (20.0, 140.0), (40.0, 120.0)]


def curve(points):
    return {f"limited_slip.curve[{i}].{what}": value for i, point in enumerate(points, 1)
            for what, value in zip(("slip", "torque"), point)}


@pytest.mark.parametrize("sign", [1.0, -1.0])
@pytest.mark.parametrize("breakaway", [None, 45.0])
def test_a_measured_curve_has_its_torques_in_addition_to_the_preload(drive, breakaway, sign):
    first = [] if breakaway is None else [(0.0, breakaway)]
    for slip, torque in POINTS + [(100.0, POINTS[-1][1])]:
        driven = drive(IMPOSED | curve(first + POINTS) | {"spin.command": sign * slip / theory.RATIO, "limited_slip.preload": 10.0})
        assert heat_torque(driven) == pytest.approx(torque + 10.0, rel=1e-12), slip


def test_static_ratio_and_temperature_change_the_preload_and_not_the_curve(drive):
    values = {"limited_slip.preload": 60.0, "limited_slip.static_ratio": 1.25, "limited_slip.stribeck_speed": 0.08,
              "limited_slip.mean_radius": 0.055, "limited_slip.cold_factor": 1.4, "oil.temperature": 253.15}
    driven = drive(IMPOSED | curve([(0.0, 45.0)] + POINTS) | values | {"spin.command": 5.0 / theory.RATIO})
    expected = 90.0 + 60.0 * 1.4 * (1.0 + 0.25 * exp(-0.055 * 5.0 / 0.08))
    assert heat_torque(driven) == pytest.approx(expected, rel=1e-12)


@pytest.mark.parametrize("contact", ["ideal", "lumped", "tooth"])
@pytest.mark.parametrize("breakaway", [None, 100.0])
def test_a_curve_holds_its_first_point_only_at_slip_zero(drive, contact, breakaway):
    points = [(1.0, 100.0), (10.0, 120.0)] if breakaway is None else [(0.0, breakaway), (10.0, 60.0)]
    driven = drive({"scene.gear_contact": contact, "effects.limited_slip": True, "left.load_torque": theory.LOAD + 90.0,
                    "right.load_torque": theory.LOAD - 90.0, "inertia.left_end": 0.5, "inertia.right_end": 0.5} | curve(points))
    driven.to(1.0, 1e-3)
    if breakaway:
        assert driven["held.sides"] == 2.0 and abs(driven["right.speed"] - driven["left.speed"]) < 1e-4
        # teeth hold some torque between two positions of their planets, too
        driven.load(theory.LOAD + 150.0, theory.LOAD - 150.0)
        driven.to(1.2, 1e-3)
        assert driven["held.sides"] == 0.0 and driven["right.speed"] - driven["left.speed"] > 1.0
    else:
        # it creeps with the slip at which the curve has the torque of 90 N·m
        assert driven["held.sides"] == 0.0
        assert 0.5 < driven["right.speed"] - driven["carrier.speed"] < 1.0
    assert driven.imbalance() < UNDAMPED


@pytest.mark.parametrize(("points", "said"), [
    ([(0.0, 10.0), (5.0, 20.0), (5.0, 30.0)], "limited_slip.curve[3].slip … 5 rad/s … point 2"),
    ([(0.0, 10.0), (0.0, 0.0), (5.0, 30.0)], "limited_slip.curve[2].slip … 0 rad/s … point 1"),
    ([(7.0, 10.0), (6.0, 20.0)], "limited_slip.curve[2].slip … 6 rad/s … 7 rad/s … rise"),
    ([(7.0, -10.0)], "limited_slip.curve[1].torque … -10"),
    ([(0.0, 1.0)] * 7 + [(float("nan"), 1.0)], "limited_slip.curve[8].slip"),
])
def test_a_wrong_point_is_refused_by_its_number(drive, points, said):
    with refused(said):
        drive(IMPOSED | curve(points))


def swing(drive, values):
    """Growth rate [1/s] and frequency [rad/s] of the wheels of 1 kg·m² against each other, behind a lock."""
    driven = drive({"scene.start": "rest", "carrier.speed_command": 0.0, "lock.command": 1.0, "lock.torque": 1e6, "left.load_torque": 0.0,
                    "right.load_torque": 0.0, "inertia.from_geometry": False, "inertia.side_gear": 1e-6, "inertia.planet": 1e-7,
                    "inertia.left_end": 1.0, "inertia.right_end": 1.0, "solver.relative_tolerance": 1e-9} | values)
    driven.set({"left.load_torque": 50.0, "right.load_torque": -50.0})
    return driven.vibration(lambda driven: driven["left.angle"] - driven["right.angle"], 5e-4, 160)


@pytest.mark.parametrize("contact", ["ideal", "lumped"])
def test_a_lock_has_its_frequency_and_damping_ratio(drive, contact):
    """80 N·m/deg and 0.8 N·m·s/deg."""
    stiffness, time = 2.0 * 80.0 * 180.0 / pi, 0.01
    growth, damped = swing(drive, {"scene.gear_contact": contact, "lock.stiffness": stiffness, "lock.damping_time": time,
                                   "effects.backlash": False})
    natural = sqrt(growth**2 + damped**2)
    assert natural == pytest.approx(sqrt(stiffness), rel=5e-3) and natural == pytest.approx(95.75, rel=5e-3)
    assert -growth / natural == pytest.approx(0.5 * natural * time, rel=5e-3) and -growth / natural == pytest.approx(0.479, rel=5e-3)


def test_locks_and_clutches_add_up_their_dampings(drive):
    """A clutch that holds and a lock: stiffnesses add up, and so do the products of stiffness and time."""
    ks, kl, time = 2e4, 1e4, 0.01
    growth, damped = swing(drive, {"scene.gear_contact": "ideal", "lock.stiffness": kl, "lock.damping_time": time,
                                   "effects.limited_slip": True, "limited_slip.preload": 1e4, "limited_slip.stiffness": ks})
    assert sqrt(growth**2 + damped**2) == pytest.approx(sqrt(ks + kl), rel=5e-3)
    # 1e-4 s is the damping of a clutch that holds
    assert -growth == pytest.approx(0.5 * (ks * 1e-4 + kl * time), rel=5e-3)


def warned(drive, values):
    return [message for message in drive(values).messages if "limited_slip" in message]


def test_settings_without_effect_and_self_locking_clutches_are_reported_once(drive):
    base = SLIDING | speeds(22.0, 20.0) | {"scene.gear_contact": "lumped", "carrier.torque_command": 100.0}
    of = lambda values, name: [m for m in warned(drive, base | values) if m.startswith(name)]  # noqa: E731
    locking = "limited_slip.torque_coefficient"
    assert len(of({locking: 1.0}, locking)) == 1 and not of({locking: 0.99}, locking)
    assert len(of({locking: 0.5, "limited_slip.coast_ratio": 2.5}, locking)) == 1
    for name, value in (("coast_ratio", 0.5), ("pressed_by", "both_sides")):
        idle = of({"limited_slip.preload": 5.0, f"limited_slip.{name}": value}, f"limited_slip.{name}")
        assert len(idle) == 1 and "limited_slip.torque_coefficient > 0 (now: 0)" in idle[0]
    for name in ("static_ratio", "hot_factor", "pv_limit", "friction_area"):
        unpressed = of({"limited_slip.viscous_torque": 5.0, f"limited_slip.{name}": 1.2}, f"limited_slip.{name}")
        assert len(unpressed) == 1 and "limited_slip.preload > 0 N.m (now: 0 N.m)" in unpressed[0]
    assert not warned(drive, base | {"limited_slip.viscous_torque": 5.0})
    assert not warned(drive, base | curve([(0.0, 5.0), (3.0, 9.0)]))
    nothing = of({}, "effects.limited_slip")
    assert len(nothing) == 1 and "viscous_torque" in nothing[0]


@pytest.mark.parametrize("contact", ["lumped", "tooth"])
@pytest.mark.parametrize("kappa", [1.2, 3.0])
def test_self_locking_clutches_hold_and_stay_stable(drive, contact, kappa):
    driven = drive({"scene.gear_contact": contact, "effects.limited_slip": True, "limited_slip.torque_coefficient": kappa,
                    "scene.carrier_drive": "torque", "carrier.torque_command": 500.0, "left.load_torque": 500.0, "right.load_torque": 0.0,
                    "inertia.left_end": 1.0, "inertia.right_end": 1.0, "scene.start": "rest"})
    driven.to(0.5, 1e-3)
    # all the torque flows to the wheel with the load, and no clutch slips
    assert driven["held.sides"] == 2.0 and abs(driven["left.speed"] - driven["right.speed"]) < 0.2
    driven.set({"carrier.torque_command": -500.0, "left.load_torque": -300.0, "right.load_torque": 300.0})
    driven.to(1.0, 1e-3)
    driven.set({"carrier.torque_command": 0.0, "left.load_torque": 30.0, "right.load_torque": -30.0})
    driven.to(1.1, 1e-3)
    assert driven.imbalance() < UNDAMPED


# torques that rise with slip: friction that falls with slip amplifies any difference between two programs
RISING = [(0.0, 15.0), (3.0, 25.0), (10.0, 45.0)]


@pytest.mark.parametrize("pressed_by", ["own_side", "both_sides"])
def test_clutches_with_ramps_and_a_curve_stick_and_slip_as_in_a_separate_integration(drive, pressed_by):
    gears = Gears(stiffness=3e9, damping=2e4, depth=1e-5, side=0.5, planet=5e-4)
    clutches = Clutches(10.0, 0.3, 0.3, pressed_by == "both_sides", RISING, 1e5)
    driven = drive(gears.values() | {
        "effects.limited_slip": True, "limited_slip.preload": clutches.preload, "limited_slip.torque_coefficient": clutches.coefficient,
        "limited_slip.coast_ratio": clutches.coast, "limited_slip.pressed_by": pressed_by, "limited_slip.stiffness": clutches.stiffness,
        "solver.relative_tolerance": 1e-10} | curve(RISING))
    reference, step, worst, seen = Reference(gears, clutches), 0.04, 0.0, set()
    for loads in alternating_loads():
        driven.load(*loads)
        reference.advance(step, loads)
        driven.step(step)
        found = [driven[f"{side}.angle"] - driven["carrier.angle"] for side in SIDES]
        worst = max(worst, *np.abs(np.array(found) - reference.state[:2]))
        seen.add((sum(loads) > 0.0, driven["held.sides"]))
        if reference.switches >= 50:
            break
    assert reference.switches >= 50 and max(np.abs(reference.state[:2])) > 0.1
    assert worst < 1e-6
    # drive and coast slide and stick
    assert len(seen) == 4
