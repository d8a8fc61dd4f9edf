"""Heat agrees with power, and the largest pressure with the pressures over the face. two_places.py and test_random_scenes.py compare
other pairs of outputs in random scenes."""

import os

import numpy as np
import pytest
from driving import TURN
from effects_list import effects
from integrals import Walk
from two_places import Scene

TOLERANCE = 1e-8
# effects with instantaneous heat: springs of dry friction, a tooth that breaks, pairs that enter or leave contact abruptly
AT_ONCE = ["thrust_friction", "limited_slip", "clutches", "wheel_brake", "tooth_fault"]
# heat of brakes is part of the output power
OUTSIDE = "heat.brake"
# communication steps [s]
STEPS = [2e-4, 5e-4, 1e-3, 2e-3, 1e-4, 3e-3]


EFFECTS = {effect.name: effect for effect in effects(os.environ["FMU"]) if effect.name not in AT_ONCE and effect.switch}


@pytest.mark.parametrize("effect", EFFECTS)
def test_heat_is_the_integral_of_the_power_that_is_lost(fmu, started, effect):
    on = EFFECTS[effect].on if "tooth" in EFFECTS[effect].contact else {"scene.gear_contact": EFFECTS[effect].contact[-1]}
    heats = tuple(name for name in fmu.variables if name.startswith("heat.") and name != OUTSIDE)
    opened = started(TURN | on | {"solver.relative_tolerance": TOLERANCE})
    walk = Walk(opened, [(heats, "power.loss")], TOLERANCE)
    for size in STEPS:
        # if a step passes the end of a contact, its inner points are not balanced until the step is complete
        before = abs(opened.get("solver.energy_residual"))
        wrong = walk.step(size)
        after = abs(opened.get("solver.energy_residual"))
        assert all(abs(gained - lost) <= allowed + before + after for _, gained, lost, allowed in wrong), wrong
    assert sum(opened.read(heats)) > 0.0


# crowning, lateral displacement of the pins, and load of each side [m, N.m]; the whole face carries
FACES = [(0.0, 0.0, 835.0), (1e-5, 0.0, 835.0), (2e-5, 1e-5, 835.0), (0.0, 2e-5, 400.0)]


@pytest.mark.parametrize("crowning, offset, load", FACES)
def test_the_largest_pressure_is_that_of_the_quadratic_through_toe_middle_and_heel(fmu, started, crowning, offset, load):
    """Under the law `line`, load per width over radius is c₀/R + c₁ + c₂ R over the face, and so is the square of pressure."""
    values = {"contact.law": "line", "effects.strength": True, "effects.tooth_errors": True, "tooth_errors.crowning": crowning,
              "tooth_errors.axis_offset": offset, "scene.planet_spin": "imposed",
              "left.load_torque": load, "right.load_torque": load}
    opened = started(values)
    scene = Scene(fmu, opened)
    o = scene.read(opened)
    cones = np.array([scene.inner, scene.mean, scene.outer])
    names = ("toe", "middle", "heel")
    largest = 0.0
    for k in (1, 2, 3):
        squares = np.array([o[f"mesh.pair[{k}].{name}_pressure"] for name in names]) ** 2
        if squares[1] == 0.0:
            continue
        assert np.all(squares > 0.0)
        factors = np.linalg.solve(np.stack([1.0 / cones, np.ones(3), cones], axis=1), squares)
        face = np.linspace(scene.inner, scene.outer, 2001)
        largest = max(largest, np.sqrt(np.max(factors[0] / face + factors[1] + factors[2] * face)))
    # planet 1 carries as much as the others, or more where the displaced pins load it
    assert largest == pytest.approx(o["stress.contact_max"], rel=1e-6)
