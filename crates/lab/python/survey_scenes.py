"""Plausible random scenes: gears, loads, drives and effects of differentials that could be built."""

import math
from dataclasses import dataclass

import numpy as np

# number of communication steps of a scene, and its duration in tooth cycles
STEPS, CYCLES = 240.0, 2.6
# load of a wheel [N·m] per cube of the outer cone distance [m³], around which loads are drawn, from the study
LOAD = 835.0 / 0.04245**3
# added to the seed of kinds of clutches
CLUTCHES = 1
# clutch packs without dry friction
NOT_PRESSED = {"limited_slip.preload": 0.0, "limited_slip.torque_coefficient": 0.0}
# slips of measured clutch torques [rad/s]
SLIPS = (2.0, 6.0, 15.0)
# possible quantities, of which three are wanted of a scene
WANTS = ["left.speed:mean", "left.speed:peak_to_peak", "right.speed:rms", "carrier.torque:mean", "left.shaft_torque:max",
         "planet[1].left_normal_force:mean", "planet[1].left_normal_force:max", "planet[1].left_transmission_error:mean",
         "planet[1].left_transmission_error:peak_to_peak", "planet[1].left_transmission_error:mesh_order_1", "efficiency:mean",
         "planet[1].spin_speed:max"]


@dataclass(frozen=True)
class Drawn:
    """A scene for `ask`, with its wanted quantities."""

    name: str
    stop: float
    step: float
    values: dict
    wants: list

    def contents(self):
        """Contents of a scene file."""
        outputs = [want.partition(":")[0] for want in self.wants]
        return {"description": "drawn at random", "stop_time": self.stop, "step": self.step, "outputs": outputs, "set": self.values}


def drawn(seed, index):
    """Scene number `index` of a seed; some cannot be built."""
    d = np.random.default_rng([seed, index])
    planet = int(d.integers(9, 15))
    side = planet + int(d.integers(3, 13))
    fitting = [count for count in (2, 3, 4) if 2 * side % count == 0]
    module = d.uniform(2.5e-3, 7e-3)
    cone = 0.5 * module * math.hypot(planet, side)
    values = {"geometry.planet_teeth": planet, "geometry.side_teeth": side,
              "geometry.planet_count": int(d.choice(fitting)), "geometry.module": module, "geometry.pressure_angle": f"{d.uniform(20.0, 24.0):.2f} deg",
              "geometry.face_width": cone * d.uniform(0.2, 0.33), "geometry.backlash": module * d.uniform(0.01, 0.03)}
    if d.random() < 0.5:
        values |= {"geometry.planet_bore": module * d.uniform(2.0, 3.5), "geometry.side_bore": module * d.uniform(4.0, 7.0)}
    load, spin, carrier = LOAD * cone**3 * d.uniform(0.1, 1.2), d.uniform(400.0, 1500.0), d.uniform(500.0, 2500.0)
    values |= {"carrier.speed_command": f"{carrier:.1f} deg/s", **_drive(d, load, spin, carrier, planet / side)}
    values |= _effects(d, module, load)
    if values.get("effects.limited_slip"):
        # a separate generator, because all other values were drawn before there were kinds of clutches
        values |= _clutches(np.random.default_rng([seed, index, CLUTCHES]), load)
    first = int(d.integers(len(WANTS)))
    stop = CYCLES * 360.0 / (planet * spin)
    # quantities of different kinds
    wants = [WANTS[(first + k) % len(WANTS)] for k in (0, 5, 9)]
    return Drawn(f"random_{seed}_{index}", stop, stop / STEPS, values, wants)


def _drive(d, load, spin, carrier, ratio):
    """A turn with imposed spin, wheels driven by speed, or wheels with inertia."""
    kind = int(d.integers(3))
    if kind == 1:
        values = {"scene.carrier_drive": "torque", "carrier.torque_command": 2.0 * load}
        for side, sign in (("left", 1.0), ("right", -1.0)):
            values |= {f"scene.{side}_drive": "speed", f"{side}.speed_command": f"{carrier + sign * spin * ratio:.1f} deg/s"}
        return values
    values = {"scene.planet_spin": "imposed", "spin.command": f"{spin:.1f} deg/s",
              "left.load_torque": load, "right.load_torque": load}
    if kind == 2:
        values |= {"inertia.left_end": load * 1e-3, "inertia.right_end": load * 1e-3 * d.uniform(0.5, 2.0)}
    return values


def _effects(d, module, load):
    values = {}
    if d.random() < 0.5:
        values |= {"effects.tooth_errors": True, "tooth_errors.accuracy_grade": int(d.integers(5, 9)), "tooth_errors.seed": int(d.integers(1, 1001))}
        if d.random() < 0.5:
            values |= {f"tooth_errors.{gear}_tip_relief": module * d.uniform(0.002, 0.006) for gear in ("planet", "side")}
        if d.random() < 0.3:
            values["tooth_errors.crowning"] = module * d.uniform(0.001, 0.004)
    for effect, share in (("tooth_friction", 0.5), ("thrust_friction", 0.4), ("bearing_drag", 0.4), ("limited_slip", 0.2)):
        if d.random() < share:
            values[f"effects.{effect}"] = True
    values["limited_slip.preload"] = 0.05 * load
    values["limited_slip.torque_coefficient"] = 0.1
    values |= {"bearing_drag.carrier_torque": 0.5, "bearing_drag.carrier_viscous": 5e-3, "bearing_drag.carrier_churning": 1e-4,
               "bearing_drag.side_torque": 0.2, "bearing_drag.side_viscous": 1e-3}
    if d.random() < 0.3:
        values["effects.pin_compliance"] = True
    return values


def _clutches(d, load):
    """Changes plain clutch packs: not at all, to ramps, to sheared oil, or to a measured curve, half of them with a breakaway torque."""
    kind = int(d.integers(4))
    torque = load * d.uniform(0.03, 0.1)
    if kind == 1:
        return {"limited_slip.pressed_by": str(d.choice(["own_side", "both_sides"])), "limited_slip.coast_ratio": d.uniform(0.0, 1.0)}
    if kind == 2:
        return NOT_PRESSED | {"limited_slip.viscous_torque": torque, "limited_slip.viscous_exponent": d.uniform(0.4, 1.0)}
    if kind == 3:
        points = [(0.0, torque * d.uniform(0.5, 1.0))] * int(d.integers(2)) + [(slip, torque * d.uniform(0.5, 1.5)) for slip in SLIPS]
        return NOT_PRESSED | {f"limited_slip.curve[{i}].{name}": value for i, point in enumerate(points, 1)
                              for name, value in zip(("slip", "torque"), point)}
    return {}
