"""The start `equilibrium` carries its loads with any tooth errors, or the log says that it does not.

Unbalanced torques are inertias times accelerations at t = 0. If the log reports a missing equilibrium, own_statics
searches for one. `python3 crates/lab/lab.py test-python -k loaded_start --scenes 2000` tries more random scenes."""

import numpy as np
import pytest
import theory
from opened_scenes import INERTIAS, UM, scene
from own_statics import BALANCED, Statics

SIDES = ["left", "right"]
NOTHING_FOUND = ("not an equilibrium", "no equilibrium was found")
OUTWARD = {"effects.tooth_errors": True, "tooth_errors.planet_axial_offset": 200.0 * UM}
RELIEF = {"effects.tooth_errors": True, "tooth_errors.planet_tip_relief": 40.0 * UM, "tooth_errors.side_tip_relief": 40.0 * UM,
          "tooth_errors.relief_length": 1.0}
OPENED = {
    "outward": {**OUTWARD, "contact.law": "line"} | {f"{side}.load_torque": 200.0 for side in SIDES},
    "far outward": {**OUTWARD, "contact.law": "line", "geometry.planet_count": 4, "tooth_errors.planet_axial_offset": 400.0 * UM}
                   | {f"{side}.load_torque": 835.0 for side in SIDES},
    "long relief": {**RELIEF, "contact.law": "line"} | {f"{side}.load_torque": 20.0 for side in SIDES},
    "crowned": {"effects.tooth_errors": True, "contact.law": "line_weber", "tooth_errors.crowning": 20.0 * UM}
               | {f"{side}.load_torque": 5.0 for side in SIDES},
    "impact": {**OUTWARD, "contact.law": "impact"} | {f"{side}.load_torque": 200.0 for side in SIDES},
}
# time over which the largest force is determined, and its steps [s]
SHOWN, FINE = 0.05, 1e-4
# duration of the ramp of the loads, and its steps [s]
RAMP, COARSE = 0.3, 1e-3
MOST = 1.05
# fraction of the loads at the start of the ramp: teeth that touch from the start do not collide
FIRST = 0.01
# of the random scenes, every SHOWN_EVERY-th runs over time; every LOOKED_EVERY-th without equilibrium is searched for one
SHOWN_EVERY, LOOKED_EVERY = 20, 3


def left_over(driven, values):
    """Largest unbalanced torque, relative to the larger load."""
    count = values.get("geometry.planet_count", 2)
    weights = {f"der({side}.speed)": values["inertia.side_gear"] for side in SIDES}
    if values.get("scene.planet_spin") != "imposed":
        weights |= {f"der(planet[{i + 1}].spin_speed)": values["inertia.planet"] for i in range(count)}
    if values.get("effects.pin_compliance"):
        # inertias of pins are close to those of the planets
        weights |= {f"der(planet[{i + 1}].pin_speed)": values["inertia.planet"] for i in range(count)}
    if values.get("effects.half_shaft"):
        weights |= {f"der({side}.end_speed)": values[f"inertia.{side}_end"] for side in SIDES}
    torques = np.abs(driven.read(weights)) * list(weights.values())
    return np.max(torques) / max(abs(values[f"{side}.load_torque"]) for side in SIDES)


def said(driven):
    return [message for message in driven.messages if message.startswith("scene.start")]


def is_without_equilibrium(driven):
    return any(phrase in message for message in said(driven) for phrase in NOTHING_FOUND)


def forces(values):
    return [f"planet[{i + 1}].{side}_normal_force" for i in range(values.get("geometry.planet_count", 2)) for side in SIDES]


def largest_force(opened, values, stop):
    """Largest force of a mesh from now to `stop` [s]."""
    names, largest = forces(values), 0.0
    while opened.time < stop - 0.5 * FINE:
        opened.step(FINE)
        largest = max(largest, max(opened.read(names)))
    return largest


def without_blow(fmu, values, opened):
    """True if the first forces of a scene that has just been started do not exceed those after a slow ramp of its loads.

    Teeth with errors are in balance at several positions, and a ramp may end at another one. A start at rest then still has its first
    forces when an impact would long have died away."""
    first = largest_force(opened, values, SHOWN)
    if first <= MOST * largest_after_ramp(fmu, values):
        return True
    opened.step(RAMP)
    return first <= MOST * largest_force(opened, values, opened.time + SHOWN)


def largest_after_ramp(fmu, values):
    """Largest force of a mesh after a slow ramp of the loads."""
    loads = {f"{side}.load_torque": values[f"{side}.load_torque"] for side in SIDES}
    with fmu.open() as opened:
        opened.initialise(values | {name: FIRST * load for name, load in loads.items()})
        for k in range(1, round(RAMP / COARSE) + 1):
            opened.set({name: load * max(FIRST, k * COARSE / RAMP) for name, load in loads.items()})
            opened.step(COARSE)
        return largest_force(opened, values, opened.time + SHOWN)


@pytest.mark.parametrize("name", OPENED)
def test_teeth_that_errors_keep_apart_carry_from_the_start_on_without_a_blow(fmu, started, name):
    values = INERTIAS | OPENED[name]
    opened = started(values)
    assert left_over(opened, values) < BALANCED
    assert min(opened.read(forces(values))) > 0.0
    assert not said(opened)
    assert without_blow(fmu, values, opened)


def test_random_starts_with_errors_are_in_equilibrium_or_there_is_none_and_the_log_says_so(fmu, request):
    without = []
    for number in range(request.config.getoption("--scenes")):
        values = scene(number)
        with fmu.open() as opened:
            opened.initialise(values)
            if is_without_equilibrium(opened):
                without.append(number)
            else:
                assert left_over(opened, values) < BALANCED, number
    for number in without[::LOOKED_EVERY]:
        values = scene(number)
        pitch = 2.0 * np.pi / values["geometry.planet_teeth"]
        with Statics(fmu, values) as statics:
            # positions away from a possible maximum of the potential
            for part in (-0.81, -0.33, 0.07, 0.55):
                assert statics.equilibrium(part * pitch, pitch) is None, number


def test_random_starts_with_errors_begin_without_a_blow(fmu, request):
    # the ramp of scene 121 ends at another tooth
    for number in {*range(0, request.config.getoption("--scenes"), SHOWN_EVERY), 121}:
        values = scene(number)
        with fmu.open() as opened:
            opened.initialise(values)
            if not is_without_equilibrium(opened):
                assert without_blow(fmu, values, opened), number


@pytest.mark.parametrize("planet_teeth, side_teeth, load", [(24, 7, 33e3), (196, 19, 71e3), (33, 7, 40e3), (165, 10, 64e3)])
def test_a_load_for_which_no_equilibrium_is_found_is_carried_nowhere(fmu, started, planet_teeth, side_teeth, load):
    values = INERTIAS | {"geometry.planet_count": 2, "geometry.planet_teeth": planet_teeth, "geometry.side_teeth": side_teeth,
                         "contact.law": "line", "effects.body_compliance": True, "left.load_torque": load, "right.load_torque": load}
    opened = started(values)
    assert is_without_equilibrium(opened)
    with Statics(fmu, values) as statics:
        # up to a deflection beyond that at which another tooth would be loaded
        assert statics.carried(np.linspace(-0.5, 0.5, 9) * 2.0 * np.pi / planet_teeth, 1.2 * np.pi / side_teeth) < 1.0


def test_planets_that_begin_to_roll_and_planets_that_carry_little_are_reported(fmu):
    unequal = {"contact.law": "line", "left.load_torque": 400.0, "right.load_torque": 100.0}
    with fmu.open() as opened:
        [message] = said(opened.initialise(unequal))
        assert "start to roll" in message
        [message] = said(opened.initialise({**OPENED["outward"], "tooth_errors.axis_offset": 20.0 * UM}))
        assert "planets carry unequal parts" in message
        carried = np.array(opened.read(forces({}))).reshape(2, 2).sum(axis=1)
        told = [float(part.split()[1]) for part in message.split(": ")[-1].removesuffix(" of it").split(", ")]
        np.testing.assert_allclose(told, carried / carried.sum(), atol=0.01)
        assert min(told) < 0.25


DRAG = {**theory.DRAG, "bearing_drag.side_torque": 20.0, "bearing_drag.carrier_torque": 30.0}
BALANCED_DRIVES = {
    "drag": {**DRAG, "carrier.speed_command": 50.0},
    "drag, driven by torque": {**DRAG, "scene.carrier_drive": "torque", "carrier.torque_command": 0.0,
                               "left.load_torque": 300.0, "right.load_torque": 300.0, "carrier.speed_command": 50.0},
    "final drive": {"effects.final_drive": True, "pinion.speed_command": 205.0},
    "elastic final drive behind a joint": {
        "effects.final_drive": True, "final_drive.elastic_mesh": True, "final_drive.error_1": 2e-6, "effects.propeller_shaft": True,
        "propeller_shaft.joint_angle": 0.1, "pinion.speed_command": 20.0},
    "one wheel held at its speed": {"scene.left_drive": "speed", "left.speed_command": 50.0, "carrier.speed_command": 50.0,
                                    "right.load_torque": 300.0},
}


@pytest.mark.parametrize("name", BALANCED_DRIVES)
def test_gears_under_drag_and_drives_start_without_accelerating_against_each_other(started, name):
    values = INERTIAS | {"contact.law": "line", **BALANCED_DRIVES[name]}
    opened = started(values)
    left, right, carrier, planet = opened.read(
        ["der(left.speed)", "der(right.speed)", "der(carrier.speed)", "der(planet[1].spin_speed)"])
    assert values["inertia.side_gear"] * max(abs(left - carrier), abs(right - carrier), abs(planet)) < BALANCED * 300.0
    assert not said(opened)
    at_start = max(opened.read(forces(values)))
    assert largest_force(opened, values, 0.01) < MOST * at_start
