"""All outputs scale with lengths, masses and times by their units (Buckingham's theorem), if the laws are homogeneous.

`CARRIERS` lists exceptions with a constant that has units: they scale as long as these units stay, but not when they change."""

import os
import re

import numpy as np
import pytest
import random_scenes
import theory
from bevel_differential import DifferentialError
from driving import TURN
from effects_list import effects
from scaling import Scale, differences, dimension

LIMIT = 1e-7
# the largest stresses are those at step ends and at peaks of the approach, and may be higher by some 1e-5 in between;
# damage is proportional to at least the ninth power of the stress (S-N curves), which amplifies its error;
# ratios of torques, like small sums, amplify changes by other steps of the solver
LIMITS = {"safety.": 1e-5, "damage.": 10.0 * LIMIT, "locking_value": 10.0 * LIMIT, "torque_bias_ratio": 10.0 * LIMIT}
# smallest change that counts as an effect of a constant, far above remaining errors of rounding and of the solver's tolerance
SEEN = 1e-6
SEED, SCENES, POINTS = 21, 24, 6
# numbers of literals in the interface
ADAPTIVE, FIXED_STEP, GLEASON, EXPLICIT = 1, 2, 2, 4
# error control is not homogeneous (below), so motions are resolved more finely than they are compared
TIGHT = {"solver.relative_tolerance": 1e-11}
# factors of lengths, masses and times
ALL, NO_LENGTH, NO_TIME, NONE = [1.31, 0.77, 1.19], [1.0, 0.77, 1.19], [1.31, 0.77, 1.0], [1.0, 1.0, 1.0]
ONLY_MASS = [1.0, 0.77, 1.0]
# all calculated variables except those of the solver; and the whole numbers of the solver, because its step sizes contain rounding
OUTPUTS, COUNTS = r"(?!solver\.)", r"solver\.(steps|rejected|rhs_calls)"
DIMENSIONS = ["lengths", "masses", "times"]
# range of the factors of random scenes, in powers of two: most stay within the ranges of the variables
RANGE = 0.5

# a start without load: teeth collide, so nothing is constant
BLOWS = {**TURN, **TIGHT, "geometry.addendum_system": "standard"}
LIGHT = {**BLOWS, "left.load_torque": 2.0, "right.load_torque": 2.0}
WHEELS = {**TIGHT, "geometry.addendum_system": "standard", "scene.carrier_drive": "torque", "inertia.left_end": 0.1,
          "inertia.right_end": 0.1}
HELD = {**WHEELS, "effects.wheel_brake": True, "left.brake_torque": 500.0, "right.brake_torque": 400.0, "scene.start": "rest",
        "carrier.speed_command": 0.0, "carrier.torque_command": 60.0, "wheel_brake.stiffness": 7e8, "left.load_torque": 20.0, "right.load_torque": 25.0}
STEPS = [(5e-4, {})] * POINTS
# side gears in stiction are loaded unequally for some time
UNEQUAL = [(2e-3, {"left.load_torque": load}) for load in (835.0, 835.0, 870.0, 870.0, 870.0, 835.0, 835.0)]
STEADY = [(2e-3, {})] * POINTS

SPRING = "springs of stuck friction have a damping time of 0.1 ms, and a body stands below 1e-6 rad/s"
# (values, steps, factors under which it scales, variables that it changes, the constant)
CARRIERS = {
    "gleason": (BLOWS | {"geometry.addendum_system": "gleason"}, STEPS, NO_LENGTH, OUTPUTS, "0.05 mm of the whole depth"),
    "accuracy_grade": (BLOWS | {"effects.tooth_errors": True, "tooth_errors.accuracy_grade": 7}, STEPS, NO_LENGTH, OUTPUTS,
                       "tolerances in um from lengths in mm (ISO 17485)"),
    "benedict_kelley": (LIGHT | {"effects.tooth_friction": True, "tooth_friction.law": "benedict_kelley"}, STEPS, NONE, OUTPUTS,
                        "roughness in um, speeds in m/s, and at least 1 N/mm"),
    "iso_14179": (BLOWS | {"effects.tooth_friction": True, "tooth_friction.law": "iso_14179"}, STEPS, NONE, OUTPUTS,
                  "N/mm, mm, m/s, mPa.s and um under powers"),
    "xu_kahraman": (BLOWS | {"effects.tooth_friction": True, "tooth_friction.law": "xu_kahraman"}, STEPS, NONE, OUTPUTS,
                    "GPa, m, m/s and mPa.s under powers"),
    "oil": (BLOWS | {**theory.DRAG, "bearing_drag.viscosity_from_oil": True, "oil.temperature": 320.0}, STEPS, ONLY_MASS,
            OUTPUTS, "0.7 mm2/s in the line of ASTM D341"),
    "churning": (BLOWS | {**theory.DRAG, "bearing_drag.churning_from_geometry": True}, STEPS, NONE, OUTPUTS,
                 "kW, mm2/s, 1/min and mm under powers (ISO/TR 14179-1)"),
    "thrust_friction": (WHEELS | {"effects.thrust_friction": True}, UNEQUAL, NO_TIME, OUTPUTS, SPRING),
    "limited_slip": (WHEELS | {**theory.CLUTCHES}, UNEQUAL, NO_TIME, OUTPUTS, SPRING),
    "wheel_brake": (HELD, STEADY, NO_TIME, OUTPUTS, SPRING),
    "solver": (BLOWS | {"solver.relative_tolerance": 1e-6}, STEPS, NO_TIME, COUNTS, "error control resolves speeds to 1 rad/s, and the first step is 1 us"),
}
# with faceted teeth, errors are those of whole flanks
SOLID = {"scene.gear_contact": "solid", "tooth_errors.accuracy_grade": 0, "tooth_errors.planet_tip_relief": 0.0}
ERRORS = {"effects.tooth_errors": True, "tooth_errors.crowning": 2e-5, "tooth_errors.axis_offset": 2e-5,
          "tooth_errors.shaft_angle_error": 1e-3, "tooth_errors.planet_axial_offset": 3e-5}
SLIPPING = {"effects.limited_slip": True, "limited_slip.preload": 0.0}
EFFECTS = {effect.name: effect.on for effect in effects(os.environ["FMU"]) if effect.name not in CARRIERS}
HOMOGENEOUS = {
    **{contact: {"scene.gear_contact": contact} for contact in ("ideal", "lumped", "tooth", "solid")},
    **{law: {"contact.law": law, **ERRORS, "tooth_errors.planet_tip_relief": 2e-5} for law in ("impact", "line", "line_weber")},
    "misaligned solids": SOLID | ERRORS | {"solid.facets": 8},
    "viscous clutches": SLIPPING | {"limited_slip.viscous_torque": 60.0, "limited_slip.viscous_speed": 3.0,
                                    "limited_slip.viscous_exponent": 0.6},
    "measured clutches": SLIPPING | {"limited_slip.curve[1].slip": 1.0, "limited_slip.curve[1].torque": 40.0,
                                     "limited_slip.curve[2].slip": 4.0, "limited_slip.curve[2].torque": 90.0},
    **EFFECTS, "tooth_errors": EFFECTS["tooth_errors"] | {"tooth_errors.accuracy_grade": 0},
}


def test_dimensions_from_units_are_those_of_the_description(fmu):
    for unit in fmu.description.unitDefinitions:
        if unit.baseUnit is not None:
            assert list(dimension(unit.name)) == [unit.baseUnit.m, unit.baseUnit.kg, unit.baseUnit.s], unit.name
    assert list(dimension("N/m^1.5")) == [-0.5, 1.0, -2.0]


def wrong(found, pattern=OUTPUTS, limit=LIMIT):
    """Outputs of a pattern that do not scale, by name."""
    return {name: off for name, off in found.items() if re.match(pattern, name)
            and off > next((own for prefix, own in LIMITS.items() if name.startswith(prefix)), limit)}


def homogeneous(start):
    """Plausible scene without parameters and effects that have units in constants."""
    start = start | {f"effects.{name}": False for name in CARRIERS if f"effects.{name}" in start}
    start |= {"lock.command": 0.0, "tooth_friction.law": 1, "tooth_errors.accuracy_grade": 0, "tooth_errors.runout_by_grade": False,
              "bearing_drag.viscosity_from_oil": False, "bearing_drag.churning_from_geometry": False,
              # a clutch on command stops within 1e-6 rad/s, and then its spring acts
              "effects.clutches": False,
              # the vibration of an elastic mesh puts peaks of the stress between the ends of steps
              "final_drive.elastic_mesh": False,
              # the spring of stuck friction has a damping time of 0.1 ms
              "final_drive.friction_torque": 0.0, "final_drive.drive_loss": 0.0, "final_drive.coast_loss": 0.0,
              "material.density": min(start["material.density"], 10e3), **TIGHT}
    if start["geometry.addendum_system"] == GLEASON:
        start["geometry.addendum_system"] = EXPLICIT
    # Newton's method of the fixed steps ends after four iterations, in any state after an impact
    if start["solver.method"] == FIXED_STEP:
        start["solver.method"] = ADAPTIVE
    return start


def in_range(fmu, start):
    """True if all numbers are within the ranges of their variables, which do not scale."""
    numbers = ((fmu.variables[name], value) for name, value in start.items() if fmu.variables[name].kind == "Real")
    return all(variable.minimum is None or variable.minimum <= value <= variable.maximum for variable, value in numbers)


def test_all_outputs_of_random_scenes_scale_with_lengths_masses_and_times(fmu):
    ran, failures = 0, []
    for index, found in random_scenes.scenes(fmu, "plausible", SCENES, SEED):
        factors = 2.0 ** np.random.default_rng([SEED, index]).uniform(-RANGE, RANGE, 3)
        steps = [(0.2 * size, {name: value for name, value in inputs.items() if name != "lock.command"})
                 for size, inputs in found["steps"][:POINTS]]
        scene = {"start": homogeneous(found["start"]), "steps": steps}
        if not in_range(fmu, Scale(fmu, factors, scene["start"]).scene(scene)["start"]):
            continue
        try:
            off, points = differences(fmu, scene, factors)
        except DifferentialError:
            # the scene and its image are both refused
            continue
        ran += points > 1
        if wrong(off):
            failures.append((index, list(factors), wrong(off)))
    assert not failures, f"scenes, factors and what does not scale: {failures}"
    assert ran > 0.8 * SCENES


@pytest.mark.parametrize("name", HOMOGENEOUS)
def test_all_outputs_scale_with_each_contact_law_and_effect(fmu, name):
    off, points = differences(fmu, {"start": BLOWS | HOMOGENEOUS[name], "steps": STEPS}, ALL)
    assert points == POINTS + 1 and not wrong(off), wrong(off)


@pytest.mark.parametrize("name", CARRIERS)
def test_parts_with_units_scale_only_while_those_units_are_unchanged(fmu, name):
    values, steps, stands, what, constant = CARRIERS[name]
    off, _ = differences(fmu, {"start": values, "steps": steps}, stands)
    assert not wrong(off, what), wrong(off, what)
    for k, dimension_of in enumerate(DIMENSIONS):
        if stands[k] == 1.0:
            factors = [ALL[k] if i == k else 1.0 for i in range(3)]
            off, _ = differences(fmu, {"start": values, "steps": steps}, factors)
            assert wrong(off, what, SEEN), f"{name} scales with {dimension_of} as well: {constant}"
