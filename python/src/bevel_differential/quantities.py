"""Quantities that the FMU does not give: calculated from its parameters and outputs.

They are dimensions and loads of the parts around the gears: envelope, pin, washers."""

import copy
import math
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from math import cos, pi, sin

import numpy as np

from .pair import Pair, tool_room
from .values import DifferentialError, Number, Variable


@dataclass(frozen=True)
class Quantity:
    """Definition of a quantity. `like`: a variable of the FMU with the same unit. `of`: value in SI, from all parameters and outputs by
    name, and the pair. `outputs`: outputs of the FMU that it needs and that do not change in a run. `loads`: outputs of which it needs
    the largest value in the run."""

    like: str
    of: Callable[[Mapping, Pair], float]
    outputs: tuple[str, ...] = ()
    loads: tuple[str, ...] = ()

    @property
    def is_dimension(self) -> bool:
        """True if the quantity needs no run."""
        return not self.outputs and not self.loads


def _rim(pair, i):
    """Rim of gear `i` (planet, side gear) between bore and root cone at the toe, in modules there."""
    return pair.rim(i) / (pair.module * pair.inner_cone / pair.outer_cone)


def _pin(values):
    """Diameter of the pin, m, equal to the planet's bore."""
    diameter = values["geometry.planet_bore"]
    if not diameter > 0.0:
        raise DifferentialError("geometry.planet_bore = 0: a pin needs a bore; set or vary it")
    return diameter


def _largest(values, names):
    """Largest load of identical parts, N."""
    return max(values[name] for name in names if name in values)


def _envelope(pair):
    """Envelope diameter, m: 2 √(R_e² + h²), with h the larger of the planet's addendum and dedendum. The corner of the back cone is the
    point farthest from the apex; the side gears are smaller."""
    planet = pair.gears[0]
    return 2.0 * math.hypot(pair.outer_cone, max(planet.addendum, planet.dedendum))


NUMBER, LENGTH, STRESS = "geometry.contact_ratio", "geometry.module", "stress.contact_max"
# the FMU has at most four planets; the loads of planets that a design does not have are 0
PIN_FORCES = tuple(f"planet[{k}].pin_force" for k in range(1, 5))
PLANET_THRUSTS = tuple(f"planet[{k}].thrust_force" for k in range(1, 5))
SIDE_THRUSTS = ("left.thrust_force", "right.thrust_force")
QUANTITIES = {
    # all planets and both side gears: N m_p + 2 m_s
    "gears.mass": Quantity("geometry.planet_mass", lambda values, pair:
                           pair.planets * values["geometry.planet_mass"] + 2.0 * values["geometry.side_mass"],
                           ("geometry.planet_mass", "geometry.side_mass")),
    # bore of the case in which the planets turn about the carrier's axis
    "envelope.diameter": Quantity(LENGTH, lambda _, pair: _envelope(pair)),
    # over the back faces of both side gears: 2 (R_e cos δ + h_fe sin δ), where the root cone meets the back cone
    "envelope.length": Quantity(LENGTH, lambda _, pair: 2.0 * (pair.outer_cone * cos(pair.gears[1].pitch)
                                                               + pair.gears[1].dedendum * sin(pair.gears[1].pitch))),
    # b / R_e and b / m
    "face.width_over_cone": Quantity(NUMBER, lambda _, pair: pair.face_width / pair.outer_cone),
    "face.width_in_modules": Quantity(NUMBER, lambda _, pair: pair.face_width / pair.module),
    # tip lands at the heel, in modules
    "teeth.planet_land": Quantity(NUMBER, lambda _, pair: pair.land(0) / pair.module),
    "teeth.side_land": Quantity(NUMBER, lambda _, pair: pair.land(1) / pair.module),
    # greatest common divisor of both numbers of teeth: 1 if each tooth meets every tooth of the mate (hunting teeth)
    "teeth.common_divisor": Quantity(NUMBER, lambda _, pair: float(math.gcd(pair.gears[0].teeth, pair.gears[1].teeth))),
    # room for the tip radius of the tool of the roots, in modules
    "teeth.tool_room": Quantity(NUMBER, lambda values, pair: tool_room(pair, values["strength.tool_radius"])),
    # rims between bore and root cone at the toe, in modules there: of the planet on its pin, and of the side gear on its shaft
    "pin.rim": Quantity(NUMBER, lambda _, pair: _rim(pair, 0)),
    "shaft.rim": Quantity(NUMBER, lambda _, pair: _rim(pair, 1)),
    # largest shear stress of the pin next to the planet: 4/3 F/(π d²/4), of a solid round section (Shigley, Mechanical Engineering
    # Design). The case supports the pin outside each planet, so one section transmits the planet's whole force
    "pin.shear": Quantity(STRESS, lambda values, _: 16.0 * _largest(values, PIN_FORCES) / (3.0 * pi * _pin(values) ** 2),
                          loads=PIN_FORCES),
    # mean pressure between pin and planet: F/(d l), l = b cos δ_f the length of the bore
    "pin.pressure": Quantity(STRESS, lambda values, pair: _largest(values, PIN_FORCES) / (
        _pin(values) * pair.face_width * cos(pair.gears[0].root)), loads=PIN_FORCES),
    # width of a washer from the pin to the planet's root circle at the heel: R_e sin δ_f − d/2
    "washer.planet_width": Quantity(LENGTH, lambda values, pair: pair.back_face(0) - 0.5 * _pin(values)),
    # mean pressure of that washer: F_a/(π (r_o² − r_i²))
    "washer.planet_pressure": Quantity(STRESS, lambda values, pair: _largest(values, PLANET_THRUSTS) / (
        pi * (pair.back_face(0) ** 2 - 0.25 * _pin(values) ** 2)), loads=PLANET_THRUSTS),
    # mean pressure of the side gear's washer, from its bore to its root circle at the heel
    "washer.side_pressure": Quantity(STRESS, lambda values, pair: _largest(values, SIDE_THRUSTS) / (
        pi * (pair.back_face(1) ** 2 - 0.25 * pair.gears[1].bore ** 2)), loads=SIDE_THRUSTS),
}


def outputs_of(name: str) -> tuple[str, ...]:
    """Outputs of the FMU from which the value of a variable or quantity follows."""
    return (*QUANTITIES[name].outputs, *QUANTITIES[name].loads) if name in QUANTITIES else (name,)


def variable(name: str, variables: Mapping[str, Variable]) -> Variable:
    """Quantity `name` as an output with its unit; `variables` of the FMU by name."""
    found = copy.copy(variables[QUANTITIES[name].like])
    found.name, found.causality, found.description = name, "output", None
    return found


def series(name: str, parameters: Mapping[str, Number], record: np.ndarray) -> np.ndarray:
    """Values of the quantity `name` in the rows of a record that has its outputs. `parameters`: all of them by name, SI. Loads count from
    `strength.rate_from` on, each with its largest value so far."""
    quantity, pair = QUANTITIES[name], Pair.of(parameters)
    known = {**parameters, **{each: record[each][0].item() for each in quantity.outputs}}
    if not quantity.loads:
        return np.full(len(record), float(quantity.of(known, pair)))
    rated = record["time"] >= min(parameters["strength.rate_from"], record["time"][-1])
    loads = [np.maximum.accumulate(np.where(rated, record[each], 0.0)).tolist() for each in quantity.loads]
    return np.array([quantity.of({**known, **dict(zip(quantity.loads, row))}, pair) for row in zip(*loads)], float)
