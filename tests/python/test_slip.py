"""Dry friction by slip speed, temperature and p v: closed forms, onset of judder by linear theory, wrong input."""

from math import exp, pi, sqrt

import pytest
import theory
from bevel_differential.instance import Instance
from driving import BIAS, SIDES, UNDAMPED
from refusals import refused
from test_clutch_kinds import heat_torque

PRELOAD, RADIUS, RATIO, STRIBECK, SLOPE = 60.0, 0.055, 1.25, 0.08, -0.012
CLUTCH = {"scene.gear_contact": "ideal", "scene.planet_spin": "imposed", "effects.limited_slip": True, "limited_slip.preload": PRELOAD,
          "limited_slip.torque_coefficient": 0.0, "limited_slip.mean_radius": RADIUS, "limited_slip.static_ratio": RATIO,
          "limited_slip.stribeck_speed": STRIBECK, "limited_slip.slip_slope": SLOPE}


def over_kinetic(speed):
    """Ratio of friction to its kinetic value at a sliding speed [m/s]."""
    return 1.0 + (RATIO - 1.0) * exp(-abs(speed) / STRIBECK) + SLOPE * abs(speed)


@pytest.mark.parametrize("sign", [1.0, -1.0])
@pytest.mark.parametrize("spin", [0.02, 1.0, 20.0, 150.0])
def test_a_clutch_has_the_torque_of_its_slip_and_temperature(drive, spin, sign):
    temperature, cold = 303.15, 1.4
    driven = drive(CLUTCH | {"spin.command": sign * spin, "oil.temperature": temperature, "limited_slip.cold_factor": cold})
    driven.to(0.1, 1e-2)
    slip = driven["left.speed"] - driven["carrier.speed"]
    assert abs(slip) == pytest.approx(spin * theory.RATIO, rel=1e-12)
    # halfway between the cold point at 253.15 K and the reference at 353.15 K
    expected = PRELOAD * 0.5 * (cold + 1.0) * over_kinetic(RADIUS * slip)
    assert heat_torque(driven) == pytest.approx(expected, rel=1e-12)


AREA, PLATES, BEYOND, BAND = 0.03, 0.12, 0.7, 0.05


def over_unlimited(pv, limit):
    """Ratio of friction to its value without a limit of p v."""
    share = min(max((pv / limit - 1.0) / BAND, 0.0), 1.0)
    return 1.0 + (BEYOND - 1.0) * share**2 * (3.0 - 2.0 * share)


@pytest.mark.parametrize("sign", [1.0, -1.0])
@pytest.mark.parametrize("share", [0.5, 0.999, 1.005, 1.025, 1.045, 1.06, 10.0])
def test_a_clutch_has_the_torque_of_its_pressure_times_speed_at_any_temperature(drive, share, sign):
    slip = 20.0 * theory.RATIO
    pv = PRELOAD * slip / (PLATES * AREA)
    driven = drive(CLUTCH | {"spin.command": sign * 20.0, "oil.temperature": 303.15, "limited_slip.cold_factor": 1.4,
                             "limited_slip.friction_area": AREA, "limited_slip.plate_coefficient": PLATES,
                             "limited_slip.pv_limit": pv / share, "limited_slip.beyond_limit": BEYOND}).to(0.1, 1e-2)
    assert driven["pv.clutch"] == pytest.approx(pv, rel=1e-12)
    expected = PRELOAD * 1.2 * over_kinetic(RADIUS * slip) * over_unlimited(pv, pv / share)
    assert heat_torque(driven) == pytest.approx(expected, rel=1e-12)


@pytest.mark.parametrize("sign", [1.0, -1.0])
@pytest.mark.parametrize("share", [0.5, 1.02, 3.0])
def test_a_brake_has_the_torque_of_its_pressure_times_speed(drive, share, sign):
    pv = 400.0 * SPEED / (0.35 * 0.008)
    driven = drive({"scene.gear_contact": "ideal", "scene.planet_spin": "imposed", "spin.command": 0.0,
                    "carrier.speed_command": sign * SPEED, "effects.wheel_brake": True, "left.brake_torque": 400.0,
                    "wheel_brake.lining_coefficient": 0.35, "wheel_brake.friction_area": 0.008, "wheel_brake.pv_limit": pv / share,
                    "wheel_brake.beyond_limit": BEYOND, "left.load_torque": 0.0, "right.load_torque": 0.0}).to(0.02, 1e-2)
    assert driven["pv.brake"] == pytest.approx(pv, rel=1e-12)
    assert driven["left.shaft_torque"] == pytest.approx(sign * 400.0 * over_unlimited(pv, pv / share), rel=1e-12)


# radius [m] and area [m2]
PIN, PLANET_WASHER, SIDE_WASHER = (8e-3, 3e-4), (14e-3, 1e-3), (22e-3, 2e-3)


@pytest.mark.parametrize("spoilt", [1.0, 0.01, 100.0])
def test_washers_and_pins_have_the_pressure_times_speed_of_their_forces_and_the_energy_balances_beyond_the_limit(drive, spoilt):
    pin_area = PIN[1] * spoilt
    driven = drive(BIAS | {"scene.gear_contact": "lumped", "effects.thrust_friction": True, "thrust_friction.pin_area": pin_area,
                           "thrust_friction.pv_limit": 2e4, "thrust_friction.beyond_limit": 1.5}).to(0.5, 1e-3)
    spin = abs(driven["planet[1].spin_speed"])
    sides = [SIDE_WASHER[0] / SIDE_WASHER[1] * driven[f"{side}.thrust_force"] * abs(driven[f"{side}.speed"] - driven["carrier.speed"])
             for side in SIDES]
    pin = PIN[0] / pin_area * driven["planet[1].pin_force"] * spin
    # the planet's washer also bears the planet's centrifugal force of some 10 N
    washer = PLANET_WASHER[0] / PLANET_WASHER[1] * (driven["planet[1].thrust_force"] + 10.0) * spin
    assert driven["pv.washers"] == pytest.approx(max(*sides, pin, washer), rel=1e-9 if max(*sides, pin) > washer else 1e-2)
    assert driven["pv.washers"] > 2e4 and driven.imbalance() < UNDAMPED


def test_a_pressure_times_speed_above_its_limit_is_reported_once_in_a_run(drive):
    values = CLUTCH | {"spin.command": 20.0, "limited_slip.friction_area": AREA, "limited_slip.plate_coefficient": PLATES,
                       "limited_slip.pv_limit": 2e5}
    driven = drive(values).to(0.3, 1e-2)
    pv = PRELOAD * 20.0 * theory.RATIO / (PLATES * AREA) * 1e-6
    reported = [message for message in driven.messages if "p v" in message]
    assert len(reported) == 1 and reported[0].startswith("limited_slip.pv_limit: p v of the ")
    assert all(word in reported[0] for word in ["side gear", f"{pv:.3f} W/mm2", "the limit of 0.200 W/mm2", "t = 0.010000 s"])
    torque = driven["heat.clutch"]
    plain = drive(values | {"limited_slip.pv_limit": 0.0}).to(0.3, 1e-2)
    # without a value beyond the limit, the only effect is a warning
    assert plain["heat.clutch"] == torque and not [message for message in plain.messages if "p v" in message]
    driven.reset()
    driven.initialise(values)
    Instance.step(driven, 1e-2)
    assert len([message for message in driven.messages if "p v" in message]) == 1


# a wheel with inertia at the end of an undamped half-shaft, between an imposed speed and a brake
END, STIFFNESS, LINING, TORQUE, SPEED = 0.8, 6000.0, 0.12, 400.0, 10.0
BRAKED = {"scene.gear_contact": "ideal", "scene.planet_spin": "imposed", "spin.command": 0.0, "carrier.speed_command": SPEED,
          "effects.half_shaft": True, "half_shaft.left_stiffness": STIFFNESS, "half_shaft.left_damping": 0.0,
          "inertia.left_end": END, "inertia.right_end": END, "effects.wheel_brake": True, "wheel_brake.mean_radius": LINING,
          "left.load_torque": 0.0, "right.load_torque": 0.0, "solver.relative_tolerance": 1e-10}


def growth(drive, slope, kick):
    """Growth rate [1/s] and frequency [rad/s] of a small vibration of the left wheel."""
    driven = drive(BRAKED | {"wheel_brake.slip_slope": slope, "left.brake_torque": TORQUE - kick})
    driven.to(0.01, 1e-3)
    driven.set({"left.brake_torque": TORQUE})
    return driven.vibration(lambda driven: driven["left.end_speed"], 2e-3, 300)


@pytest.mark.parametrize("slope", [-0.02, -0.005, 0.005, 0.02])
def test_falling_friction_judders_and_rising_friction_damps_by_the_linear_theory(drive, slope):
    # J w' = ... - T (1 + k r w): growth rate -T k r/(2 J) about the rolling speed
    rate, frequency = growth(drive, slope, 0.5)
    assert rate == pytest.approx(-TORQUE * slope * LINING / (2.0 * END), rel=0.01)
    assert frequency == pytest.approx(sqrt(STIFFNESS / END), rel=0.01)


def test_judder_grows_until_the_wheel_sticks(drive):
    driven = drive(BRAKED | {"wheel_brake.static_ratio": 1.3, "wheel_brake.stribeck_speed": 0.5, "carrier.speed_command": 1.0,
                             "left.brake_torque": TORQUE - 1.0})
    driven.to(0.01, 1e-3)
    driven.set({"left.brake_torque": TORQUE})
    driven.to(6.0, 1e-2)
    held, speeds = 0, []
    for _ in range(int(2.0 * pi * 5.0 / sqrt(STIFFNESS / END) / 1e-3)):
        driven.step(1e-3)
        held += driven["held.wheels"] >= 1.0
        speeds.append(driven["left.end_speed"])
    # the wheel sticks for part of the time, and is at other times faster than the other end of its shaft
    assert 0 < held < len(speeds) and max(speeds) > 1.5


@pytest.mark.parametrize(("name", "value", "said"), [
    ("limited_slip.cold_temperature", 360.0, "limited_slip.cold_temperature … 360 K … limited_slip.reference_temperature"),
    ("limited_slip.hot_temperature", 300.0, "limited_slip.hot_temperature … 300 K … must increase"),
    ("limited_slip.hot_temperature", 700.0, "limited_slip.hot_temperature … 700 … 673.15"),
    ("oil.temperature", 200.0, "oil.temperature … 200 … 213.15"),
    ("limited_slip.pv_limit", -1.0, "limited_slip.pv_limit … -1"),
    ("limited_slip.beyond_limit", -0.1, "limited_slip.beyond_limit … -0.1"),
    ("limited_slip.friction_area", 0.0, "limited_slip.friction_area … 0"),
    ("limited_slip.plate_coefficient", 1.5, "limited_slip.plate_coefficient … 1.5"),
    ("limited_slip.cold_factor", -0.1, "limited_slip.cold_factor … -0.1"),
])
def test_bad_points_are_refused_by_name(drive, name, value, said):
    with refused(said):
        drive(CLUTCH | {"limited_slip.cold_factor": 1.2, name: value})
