"""Scenes with wheel brakes: both wheels have inertia and no loads except brakes, and the carrier is driven by torque."""

import numpy as np
import pytest
from driving import SIDES, UNLOADED

CONTACTS = pytest.mark.parametrize("contact", ["ideal", "lumped", "tooth", "solid"])
STIFFNESS, END, CARRIER_INERTIA = 1e5, 0.5, 0.02
# inertia of everything that turns with the carrier, without gears
WHOLE = CARRIER_INERTIA + 2.0 * END
BRAKED = {"effects.wheel_brake": True, "wheel_brake.stiffness": STIFFNESS, "inertia.left_end": END,
          "inertia.right_end": END, "inertia.carrier": CARRIER_INERTIA, "scene.carrier_drive": "torque"} | UNLOADED
# gears without inertia
MASSLESS = {"inertia.from_geometry": False, "inertia.side_gear": 1e-12, "inertia.planet": 1e-12}
EXACT = {"solver.relative_tolerance": 1e-9}


def brakes(left, right=None):
    return {"left.brake_torque": left, "right.brake_torque": left if right is None else right}


def drive_torque(torque):
    return {"carrier.torque_command": torque}


def wheel_angles(driven):
    return np.array(driven.read([f"{side}.wheel_angle" for side in SIDES]))
