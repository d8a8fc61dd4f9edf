"""From what is known of a vehicle on its road to the inputs of the differential.

```text
carrier.speed_command = v/r                      v speed, r radius of the wheels
ω_left − ω_right      = −(v/r) w/R               w track, R radius of the turn, positive to the left
planet.spin_command   = (ω_left − ω_right)/2 · z_side/z_planet
load torques          = T/2 on each side         T torque of the ring gear; an open differential halves it
```

So where the scene drives the carrier by speed and the sides by torque. A carrier that is driven by torque takes T as its command, and
v/r as its first speed. Sides that are driven by speed take v/r ± (ω_left − ω_right)/2, and the spin stays free.

The left wheel is the inner one of a turn to the left, at R − w/2; nothing slips (Ackermann). Torque is positive when the engine
drives forward, speed when the vehicle goes forward."""

from collections.abc import Mapping
from math import pi

import numpy as np

from ..csv_table import Quantity
from ..values import DifferentialError

LENGTH = {"m": 1.0, "mm": 1e-3, "km": 1e3}
QUANTITIES = {quantity.name: quantity for quantity in [
    Quantity("speed", {"m/s": 1.0, "km/h": 1.0 / 3.6}),
    Quantity("torque", {"N.m": 1.0, "kN.m": 1e3}),
    Quantity("turn_radius", LENGTH),
    Quantity("speed_difference", {"rad/s": 1.0, "deg/s": pi / 180.0, "rpm": pi / 30.0}),
    Quantity("wheel_radius", LENGTH),
    Quantity("tyre_circumference", LENGTH),
    Quantity("track", LENGTH),
]}
SPIN = "scene.planet_spin"
# how the FMU drives each shaft; the sense in which half the difference of speeds adds to each side
DRIVES = ("scene.carrier_drive", "scene.left_drive", "scene.right_drive")
SIDES = {"left": 1.0, "right": -1.0}


def inputs_of(vehicle: Mapping[str, float | np.ndarray], teeth: tuple[int, int],
              drives: Mapping[str, str]) -> dict[str, float | str | np.ndarray]:
    """Inputs and parameters of the FMU, SI, that follow from the quantities of `vehicle` ({name: number or array of shape
    (points,)}, SI) with the numbers of `teeth` (planet, side gear) and the literals of `DRIVES` by name. Raises
    `DifferentialError` for what is missing."""
    found: dict[str, float | str | np.ndarray] = {}
    by_speed = [side for side in SIDES if drives[f"scene.{side}_drive"] == "speed"]
    if "torque" in vehicle:
        found.update({f"{side}.load_torque": vehicle["torque"] / 2.0 for side in SIDES if side not in by_speed})
        if drives["scene.carrier_drive"] == "torque":
            found["carrier.torque_command"] = vehicle["torque"]
    speed = vehicle["speed"] / wheel_radius(vehicle, "speed") if "speed" in vehicle else None
    # both sides together give the carrier its speed
    if speed is not None and len(by_speed) < len(SIDES):
        found["carrier.speed_command"] = speed
    difference = _difference(vehicle)
    if by_speed and speed is not None:
        found.update({f"{side}.speed_command": speed + 0.5 * SIDES[side] * (0.0 if difference is None else difference)
                      for side in by_speed})
    elif by_speed and difference is not None and np.any(difference):
        raise DifferentialError(f"speed_difference: it needs speed where scene.{by_speed[0]}_drive = speed; give it as a column or "
                                "a parameter")
    elif difference is not None and not by_speed:
        found["planet.spin_command"] = difference / 2.0 * teeth[1] / teeth[0]
        found[SPIN] = "imposed"
    return found


def wheel_radius(vehicle: Mapping[str, float | np.ndarray], needed_by: str) -> float | np.ndarray:
    """Radius of the wheels [m], given or from the circumference of the tyres."""
    if "wheel_radius" not in vehicle and "tyre_circumference" not in vehicle:
        raise DifferentialError(f"{needed_by}: it needs wheel_radius or tyre_circumference; give one as a column or a parameter")
    if "wheel_radius" in vehicle:
        return _positive(vehicle, "wheel_radius")
    return _positive(vehicle, "tyre_circumference") / (2.0 * pi)


def _difference(vehicle):
    """Speed of the left side gear minus that of the right one [rad/s], or None if nothing says."""
    if "turn_radius" in vehicle and "speed_difference" in vehicle:
        raise DifferentialError("turn_radius: speed_difference says the same; leave one of them empty")
    if "speed_difference" in vehicle:
        return vehicle["speed_difference"]
    if "turn_radius" not in vehicle:
        return None
    for name in ("speed", "track"):
        if name not in vehicle:
            raise DifferentialError(f"turn_radius: it needs {name}; give it as a column or a parameter")
    if not np.all(np.abs(vehicle["turn_radius"]) > _positive(vehicle, "track") / 2.0):
        raise DifferentialError("turn_radius: it must be more than half the track, of either sign; leave it empty straight ahead")
    return -vehicle["speed"] / wheel_radius(vehicle, "speed") * vehicle["track"] / vehicle["turn_radius"]


def _positive(vehicle, name):
    if not np.all(np.asarray(vehicle[name]) > 0.0):
        raise DifferentialError(f"{name}: it must be more than 0 m")
    return vehicle[name]
