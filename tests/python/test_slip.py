"""Dry friction by slip speed and temperature: closed forms, the onset of judder by the linear theory, and bad input."""

from math import exp, pi, sqrt

import numpy as np
import pytest
import theory
from bevel_differential import DifferentialError

PRELOAD, RADIUS, RATIO, STRIBECK, SLOPE = 60.0, 0.055, 1.25, 0.08, -0.012
CLUTCH = {"scene.gear_contact": "ideal", "scene.planet_spin": "imposed", "effects.limited_slip": True, "limited_slip.preload": PRELOAD,
          "limited_slip.torque_coefficient": 0.0, "limited_slip.mean_radius": RADIUS, "limited_slip.static_ratio": RATIO,
          "limited_slip.stribeck_speed": STRIBECK, "limited_slip.slip_slope": SLOPE}


def over_kinetic(speed):
    """Friction over its kinetic value at a speed of sliding [m/s]."""
    return 1.0 + (RATIO - 1.0) * exp(-abs(speed) / STRIBECK) + SLOPE * abs(speed)


@pytest.mark.parametrize("sign", [1.0, -1.0])
@pytest.mark.parametrize("spin", [0.02, 1.0, 20.0, 150.0])
def test_a_clutch_has_the_torque_of_its_slip_and_temperature(drive, spin, sign):
    temperature, cold = 303.15, 1.4
    driven = drive(CLUTCH | {"planet.spin_command": sign * spin, "oil.temperature": temperature, "limited_slip.cold_factor": cold})
    driven.to(0.1, 1e-2)
    slip = driven["left.speed"] - driven["carrier.speed"]
    assert abs(slip) == pytest.approx(spin * theory.RATIO, rel=1e-12)
    begin, time = driven["heat.clutch"], driven.time
    driven.to(0.3, 1e-2)
    torque = (driven["heat.clutch"] - begin) / (driven.time - time) / (2.0 * abs(slip))
    # half way from the cold point at 253.15 K to the reference at 353.15 K
    expected = PRELOAD * 0.5 * (cold + 1.0) * over_kinetic(RADIUS * slip)
    assert torque == pytest.approx(expected, rel=1e-12)


# a wheel with its end's inertia on an undamped half-shaft between a speed and a brake
END, STIFFNESS, LINING, TORQUE, SPEED = 0.8, 6000.0, 0.12, 400.0, 10.0
BRAKED = {"scene.gear_contact": "ideal", "scene.planet_spin": "imposed", "planet.spin_command": 0.0, "carrier.speed_command": SPEED,
          "effects.half_shaft": True, "half_shaft.left_stiffness": STIFFNESS, "half_shaft.left_damping": 0.0,
          "inertia.left_end": END, "inertia.right_end": END, "effects.wheel_brake": True, "wheel_brake.mean_radius": LINING,
          "left.load_torque": 0.0, "right.load_torque": 0.0, "solver.relative_tolerance": 1e-10}


def growth(drive, slope, kick):
    """Rate at which a small vibration of the left wheel grows [1/s], and its frequency [rad/s]: those of a recurrence of its
    differences (Prony)."""
    driven = drive(BRAKED | {"wheel_brake.slip_slope": slope, "left.brake_torque": TORQUE - kick})
    driven.to(0.01, 1e-3)
    driven.set({"left.brake_torque": TORQUE})
    step, speeds = 2e-3, []
    for _ in range(300):
        driven.step(step)
        speeds.append(driven["left.end_speed"])
    change = np.diff(speeds)
    (second, first), *_ = np.linalg.lstsq(np.column_stack([change[1:-1], change[:-2]]), change[2:], rcond=None)
    rate = 0.5 * np.log(-first) / step
    return rate, np.arccos(0.5 * second / sqrt(-first)) / step


@pytest.mark.parametrize("slope", [-0.02, -0.005, 0.005, 0.02])
def test_falling_friction_judders_and_rising_friction_damps_as_the_linear_theory_has_it(drive, slope):
    # J w' = ... - T (1 + k r w): growth -T k r/(2 J) about the speed of rolling
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
    # the wheel stands part of the time, and is faster than the other end of its shaft at others
    assert 0 < held < len(speeds) and max(speeds) > 1.5


@pytest.mark.parametrize(("name", "value", "words"), [
    ("limited_slip.cold_temperature", 360.0, ["limited_slip.cold_temperature", "360 K", "limited_slip.reference_temperature"]),
    ("limited_slip.hot_temperature", 300.0, ["limited_slip.hot_temperature", "300 K", "in order"]),
    ("limited_slip.hot_temperature", 700.0, ["limited_slip.hot_temperature", "700", "673.15"]),
    ("oil.temperature", 200.0, ["oil.temperature", "200", "213.15"]),
    ("limited_slip.cold_factor", -0.1, ["limited_slip.cold_factor", "-0.1"]),
])
def test_bad_points_are_refused_by_name(drive, name, value, words):
    with pytest.raises(DifferentialError) as refused:
        drive(CLUTCH | {"limited_slip.cold_factor": 1.2, name: value})
    assert all(word in str(refused.value) for word in words), str(refused.value)
