"""Scenes with a final drive: inertia of all that turns with the carrier, and steps with records."""

import numpy as np

RATIO = 4.1
DRIVEN = {"effects.final_drive": True, "scene.carrier_drive": "torque"}
ELASTIC = {"effects.final_drive": True, "final_drive.elastic_mesh": True}
UNLOADED = {"left.load_torque": 0.0, "right.load_torque": 0.0}


def loads(torque):
    """Equal loads on both sides, with this sum [N.m]."""
    return {"left.load_torque": 0.5 * torque, "right.load_torque": 0.5 * torque}


def turning_inertia(fmu, values=None):
    """Inertia of carrier, planets, side gears and ends of rigid half-shafts [kg.m2]: torque over acceleration of the carrier, without
    final drive. Torque-driven ideal gears have a closed form."""
    torque = 100.0
    with fmu.open() as opened:
        opened.initialise((values or {}) | UNLOADED | {"scene.carrier_drive": "torque", "scene.gear_contact": "ideal",
                                                       "carrier.torque_command": torque})
        return torque / opened.get("carrier.acceleration")


def sampled(opened, names, size, count):
    """Values of outputs before each of `count` steps, shape (count, names)."""
    seen = []
    for _ in range(count):
        seen.append(opened.read(names))
        opened.step(size)
    return np.array(seen)
