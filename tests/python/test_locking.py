"""Friction of teeth, washers and pins: its locking effect and its heat, against closed forms."""

from math import radians

import numpy as np
import pytest
import theory
from driving import BIAS, STEADY_TURN

RADII = {"pin": 8e-3, "planet": 14e-3, "side": 22e-3}
PATH = ["left.shaft_torque", "right.shaft_torque", "left.thrust_force", "right.thrust_force", "planet[1].thrust_force",
        "planet[1].pin_force", "planet[1].spin_angle", "locking_value", "torque_bias_ratio"]


def over_whole_cycles(record, names):
    """Means over whole mesh cycles after the start has settled."""
    cycle = record["planet[1].spin_angle"] / theory.TOOTH_PITCH
    first = np.ceil(np.interp(0.3, record["time"], cycle))
    last = np.floor(cycle[-1])
    assert last - first >= 4
    inside = (cycle >= first) & (cycle < last)
    return {name: record[name][inside].mean() for name in names}


def parts_of_bias(mean, mu):
    """Locking values of side washers, pins and planet washers, by the formula with the averages of the run."""
    thrust = 0.5 * (mean["left.thrust_force"] + mean["right.thrust_force"])
    torque = mean["left.shaft_torque"] + mean["right.shaft_torque"]
    side = 2.0 * mu * thrust * RADII["side"] / torque
    pins = theory.PLANETS / theory.RATIO * mu * mean["planet[1].pin_force"] * RADII["pin"] / torque
    washers = theory.PLANETS / theory.RATIO * mu * mean["planet[1].thrust_force"] * RADII["planet"] / torque
    return side, pins, washers


@pytest.mark.parametrize("law", ["impact", "line"])
def test_without_friction_a_differential_shares_torque_equally(run, law):
    record = run({**BIAS, "contact.law": law}, stop=1.5, output=PATH)
    mean = over_whole_cycles(record, PATH)
    difference = abs(mean["left.shaft_torque"] - mean["right.shaft_torque"])
    assert difference / (mean["left.shaft_torque"] + mean["right.shaft_torque"]) < 2e-3
    assert record["locking_value"][-1] < 2e-3


@pytest.mark.parametrize("part", range(3))
@pytest.mark.parametrize("law", ["impact", "line"])
def test_each_surface_locks_by_its_formula(run, part, law):
    mu = 0.05
    off = {"thrust_friction.side_washer_radius": 0.0, "thrust_friction.pin_radius": 0.0,
           "thrust_friction.planet_washer_radius": 0.0}
    name, radius = [("side_washer_radius", "side"), ("pin_radius", "pin"), ("planet_washer_radius", "planet")][part]
    values = {**BIAS, **off, f"thrust_friction.{name}": RADII[radius], "contact.law": law,
              "effects.thrust_friction": True}
    record = run(values, stop=1.5, output=PATH)
    mean = over_whole_cycles(record, PATH)
    measured = (mean["right.shaft_torque"] - mean["left.shaft_torque"]) / (
        mean["left.shaft_torque"] + mean["right.shaft_torque"])
    expected = parts_of_bias(mean, mu)[part]
    assert measured == pytest.approx(expected, rel=0.03)
    # the textbook's value is for the pitch point
    textbook = [0.01234, 0.02326, 0.00785][part]
    assert expected == pytest.approx(textbook, rel=0.25)
    assert record["locking_value"][-1] == pytest.approx(expected, rel=0.05)


def test_teeth_lock_by_the_losses_of_their_path(run):
    mu = 0.05
    record = run({**BIAS, "effects.tooth_friction": True, "tooth_friction.regularisation_speed": 1e-5}, stop=1.5,
                 output=PATH + ["heat.tooth_friction"])
    mean = over_whole_cycles(record, PATH)
    total = mean["left.shaft_torque"] + mean["right.shaft_torque"]
    measured = (mean["right.shaft_torque"] - mean["left.shaft_torque"]) / total
    # loss factor from the heat: H = mu H_v T (|dw_L| + |dw_R|) over whole cycles
    cycle = record["planet[1].spin_angle"] / theory.TOOTH_PITCH
    bounds = np.ceil(np.interp(0.3, record["time"], cycle)), np.floor(cycle[-1])
    heat = np.diff(np.interp(bounds, cycle, record["heat.tooth_friction"]))[0]
    turned = 2.0 * (bounds[1] - bounds[0]) * theory.TOOTH_PITCH * theory.RATIO
    loss_factor = heat / (mu * total / 2.0 * turned)
    assert measured == pytest.approx(mu * loss_factor, rel=0.03)
    # IMPACT's load sharing gives 0.267, the planar formula 0.2391
    assert loss_factor == pytest.approx(0.267, rel=0.03)


@pytest.mark.parametrize("mu, ratio", [(0.05, 1.117), (0.08, 1.195), (0.10, 1.249)])
def test_all_friction_together_is_near_the_textbook_s_bias_ratio(run, mu, ratio):
    record = run({**BIAS, "effects.thrust_friction": True, "effects.tooth_friction": True,
                  "thrust_friction.coefficient": mu, "thrust_friction.pin_coefficient": mu,
                  "tooth_friction.coefficient": mu}, stop=1.5, output=PATH)
    mean = over_whole_cycles(record, PATH)
    measured = mean["right.shaft_torque"] / mean["left.shaft_torque"]
    # path averages differ from the values at the pitch point by some per cent of the bias
    assert measured - 1.0 == pytest.approx(ratio - 1.0, rel=0.1)
    assert record["torque_bias_ratio"][-1] == pytest.approx(measured, rel=0.01)


@pytest.mark.parametrize("law", ["benedict_kelley", "iso_14179", "xu_kahraman"])
def test_published_friction_laws_lose_energy_by_their_coefficients(run, law):
    record = run({**STEADY_TURN, "effects.tooth_friction": True, "tooth_friction.law": law}, stop=0.36,
                 output=["heat.tooth_friction", "solver.energy_residual"])
    # mu H_v T |dw| of both sides, H_v = 0.267 on the path; all three values are between 0.02 and 0.2 here
    per_mu = 0.267 * 2.0 * theory.LOAD * radians(200.0) * theory.RATIO * 0.36
    assert 0.02 < record["heat.tooth_friction"][-1] / per_mu < 0.2
    assert abs(record["solver.energy_residual"][-1]) < 1e-3 * record["heat.tooth_friction"][-1]


def test_a_friction_law_outside_its_range_warns_once(drive):
    outside = drive(STEADY_TURN | {"effects.tooth_friction": True, "tooth_friction.law": "xu_kahraman"}).to(0.02, 1e-3)
    warnings = [line for line in outside.messages if "tooth_friction.law" in line]
    assert len(warnings) == 1 and "outside" in warnings[0], outside.messages
    inside = drive(STEADY_TURN | {"effects.tooth_friction": True}).to(0.02, 1e-3)
    assert not any("tooth_friction" in line for line in inside.messages)


def test_pins_and_washers_that_do_not_fit_the_gears_warn(drive):
    small = STEADY_TURN | {"geometry.module": 2.25e-3, "geometry.face_width": 10e-3, "effects.thrust_friction": True}
    for values, expected in [({}, 3), ({"thrust_friction.radii_from_geometry": True}, 0)]:
        opened = drive(small | values)
        assert sum("radii_from_geometry" in line for line in opened.messages) == expected, opened.messages
