"""Lash and wind-up: angle of the drive's port over its torque in both directions, while the side gears are held, or dog clutches behind them.

The angle is that of the equilibrium at the start, relative to the mean of the side gears at the port's speed. Dog clutches are closed, and a
side gear with a dog clutch counts without its angle in the lash of the clutch. The twist of half-shafts does not count. The play is the angle between both directions at no torque. It is extrapolated from three torques in a
geometric series by Aitken's method, which is exact for any power law of the deflection."""

from collections.abc import Mapping
from pathlib import Path
from typing import Any

import numpy as np

from ..drive_port import PORT_TORQUE, SPEED, TORQUE, drive_ratio, port_command
from ..lash import closed_dogs, lash_by_source
from ..panel import Axis, Panel, curve
from ..report import words
from ..scene import Scene
from .steady import largest_torque, written

# torques of the curve relative to the scene's, and smallest torque of the extrapolation, N·m, which bends nearly nothing
PARTS, LEAST = np.linspace(0.05, 1.0, 20), 1e-3
SIDES = ("left", "right")
CLOSED = {f"{side}.dog_command": 1.0 for side in SIDES}
HEAD = [f"{PORT_TORQUE} [N.m]", "angle_in_drive [deg]", "angle_in_coast [deg]", "total [deg]"]


def lash(scene: Scene, out: Path, _farm: Mapping[str, Any]) -> str:
    """Measures the play and the wind-up at the port, writes the curve and returns the conclusion."""
    largest = largest_torque(scene) / drive_ratio(scene.value)
    rows = []
    for torque in largest * PARTS:
        drive, coast = (np.degrees(angle_at(scene, sign * torque)) for sign in (1.0, -1.0))
        rows.append((float(torque), float(drive), float(coast), float(drive - coast)))
    play = np.degrees(play_of(scene))
    sources = words.listed(f"{np.degrees(one.angle):.5f} deg of the {one.source}" for one in _sources(scene))
    conclusion = (f"the play at no torque is {play:.5f} deg at the port of the drive, by the closed form {sources}; at {largest:g} N.m in "
                  f"both directions it is {rows[-1][3]:.4g} deg, so that teeth and shafts up to the held side gears wind up "
                  f"by {rows[-1][3] - play:.4g} deg; half-shafts come on top")
    curves = [curve([row[0] for row in rows], [row[k] for row in rows], name, form="o-") for k, name in ((1, "drive"), (2, "coast"))]
    panel = Panel(Axis("torque of the drive, N·m"), "angle of the port, deg", curves)
    return written(scene, out, conclusion, [[panel]], 4.0, "lash", HEAD, rows)


def _sources(scene):
    ideal = scene.fmu.variable("scene.gear_contact").number("ideal")
    return lash_by_source(_closed(scene), scene.value("scene.gear_contact") != ideal)


def _closed(scene):
    """Values of the scene with closed dog clutches."""
    return lambda name: CLOSED.get(name, scene.value(name))


def play_of(scene: Scene) -> float:
    """Play at the port [rad]."""
    first, second, third = (angle_at(scene, torque) - angle_at(scene, -torque) for torque in (LEAST, 2.0 * LEAST, 4.0 * LEAST))
    bend = third - 2.0 * second + first
    return first - (second - first) ** 2 / bend if bend else 2.0 * first - second


def angle_at(scene: Scene, torque: float) -> float:
    """Angle of the port relative to the held parts [rad], under this torque on the port [N·m]."""
    ratio = drive_ratio(scene.value)
    values = {"scene.carrier_drive": "torque", "scene.left_drive": "torque", "scene.right_drive": "torque", "scene.planet_spin": "free",
              "scene.start": "equilibrium", port_command(scene.value, TORQUE): torque, port_command(scene.value, SPEED): 0.0,
              "left.load_torque": 0.5 * ratio * torque, "right.load_torque": 0.5 * ratio * torque, **CLOSED}
    with scene.fmu.open() as instance:
        instance.initialise({**scene.values, **values})
        port, *held = instance.read(["propeller.angle", "left.angle", "right.angle"])
        for side in closed_dogs(_closed(scene)):
            twist, load = instance.read([f"{side}.twist", f"{side}.shaft_torque"])
            # side gear relative to the half-shaft, which twists behind the clutch
            held[SIDES.index(side)] -= twist - load / float(scene.value(f"half_shaft.{side}_stiffness"))
    return float(port - ratio * 0.5 * sum(held))
