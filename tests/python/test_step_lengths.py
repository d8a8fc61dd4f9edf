"""Outputs do not depend on the steps of solver and host: one step per straight piece of the inputs, or steps of 1 s, 100 ms and 1 ms.

Tables have points within the steps. All teeth stay in contact, because the phase of an impact is chaotic."""

import numpy as np
import pytest
from bevel_differential import Differential

STEPS = [None, 1.0, 0.1, 1e-3]
STOP = 1.0
# values below this limit (SI) are the rounding of zero
ROUNDING = 1e-9
# accelerations are small differences of large torques: floor of their limit, rad/s^2
ACCELERATION = 1e-3
LOADS = ["left.load_torque", "right.load_torque"]
# accelerations are small differences of tooth forces, so the solver needs a smaller tolerance than the comparison
STRENGTH = {"effects.strength": True, "effects.mesh_history": True, "solver.relative_tolerance": 1e-7}
# both wheels turn by themselves behind half-shafts, so that shaft torques are means over mesh cycles
SHAFTS = {"effects.half_shaft": True, "inertia.left_end": 1.0, "inertia.right_end": 1.0, "half_shaft.left_damping": 20.0,
          "half_shaft.right_damping": 20.0}
BY_TORQUE = {"scene.carrier_drive": "torque", "carrier.torque_command": 900.0, "inertia.carrier": 0.3, "carrier.speed_command": 30.0}
# the difference of the wheels' speeds is imposed, so the clutches slide all the time, and a step spans several mesh cycles
SLIPPING = {"scene.left_drive": "speed", "scene.right_drive": "speed", "left.speed_command": 60.0, "right.speed_command": 20.0,
            "carrier.speed_command": 40.0}
CLUTCHES = {"effects.limited_slip": True, "limited_slip.preload": 50.0, "limited_slip.torque_coefficient": 0.1}
HEAT = {"effects.warm_up": True, "effects.bearing_drag": True, "bearing_drag.carrier_torque": 0.5, "bearing_drag.carrier_churning": 1e-4}
TURN = {"scene.planet_spin": "imposed", "carrier.speed_command": 16.65, "spin.command": 3.5}


def table(*points):
    """Times and values of a table from pairs."""
    return tuple(np.array(column, float) for column in zip(*points))


def loads(*points):
    return dict.fromkeys(LOADS, table(*points))


# parameters, tables
SCENES = {
    "torque over slipping clutches": (
        BY_TORQUE | SLIPPING | CLUTCHES | {"carrier.torque_command": 1600.0},
        {"carrier.torque_command": table((0, 1600), (0.12, 1550), (1, 300))}),
    "half-shafts in a turn": (
        TURN | SHAFTS, loads((0, 300), (0.25, 800), (0.333, 500), (1, 700))),
    "wheels by speed, warm clutches": (
        BY_TORQUE | SLIPPING | CLUTCHES | HEAT,
        {"left.speed_command": table((0, 60), (0.45, 64), (1, 61)), "carrier.torque_command": table((0, 900), (0.62, 1400), (1, 1100))}),
    "free wheels behind half-shafts": (
        BY_TORQUE | SHAFTS | HEAT | dict.fromkeys(LOADS, 300.0),
        {"left.load_torque": table((0, 300), (0.15, 300), (0.417, 480), (0.7, 350), (1, 350))}),
    "turn with drag": (
        TURN | HEAT | {"effects.thrust_friction": True},
        loads((0, 500), (0.05, 500), (0.13, 900), (0.55, 900), (0.75, 250), (1, 400))),
}


def compared(record, reference):
    """Rows of both records at the times that they have in common. Rows at the same time are counted."""
    def keys(rows):
        times = [round(time * 1e9) for time in rows["time"].tolist()]
        return {(time, times[:row].count(time)): row for row, time in enumerate(times)}

    rows, others = keys(record), keys(reference)
    common = sorted(rows.keys() & others.keys())
    return record[[rows[key] for key in common]], reference[[others[key] for key in common]]


@pytest.mark.parametrize("contact", ["lumped", "tooth"])
@pytest.mark.parametrize("scene", SCENES)
def test_outputs_do_not_depend_on_the_steps(fmu, outputs, scene, contact):
    values, tables = SCENES[scene]
    names = [name for name in outputs if not name.startswith(("solver.", "coupling."))]
    with Differential({**STRENGTH, "scene.gear_contact": contact, "contact.law": "line", **values}, fmu=fmu) as differential:
        records = [differential.run(tables, names, STOP, step) for step in STEPS]
    finest = records[-1]
    for step, record in zip(STEPS, records[:-1]):
        rows, others = compared(record, finest)
        assert rows["time"][-1] == STOP and len(rows) >= (11 if step == 0.1 else 2)
        for name in names:
            largest = np.abs(finest[name]).max()
            floor = ACCELERATION if name.endswith("acceleration") else ROUNDING
            limit = 0.02 * largest if name.startswith("damage.") else max(1e-3 * largest, floor)
            off = np.abs(rows[name].astype(float) - others[name])
            assert off.max() <= limit, (name, step, rows["time"][off.argmax()], off.max(), limit)
