"""What an optimisation wants or bounds and the FMU does not give: calculated from its parameters and outputs.

Each quantity is a function below, with equation, unit and the FMU's outputs that it needs. They are dimensions and loads of the
parts around the gears: envelope, pin, washers."""

import copy
import math
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from math import cos, pi, sin

from ..fmu import Fmu
from ..values import DifferentialError, Number, Variable, suggestion
from .checks import tool_room
from .pair import Pair


@dataclass(frozen=True)
class Quantity:
    """`like`: a variable of the FMU with the same unit. `outputs`: what it needs of the FMU. `of`: its value in SI, from all
    parameters and the outputs by name, and the pair."""

    name: str
    like: str
    outputs: tuple[str, ...]
    of: Callable[[Mapping, Pair], float]

    @property
    def description(self) -> str:
        """What it is."""
        return self.of.__doc__ or ""


QUANTITIES: dict[str, Quantity] = {}


def _quantity(name, like, *outputs):
    def register(function):
        QUANTITIES[name] = Quantity(name, like, outputs, function)
        return function
    return register


@_quantity("gears.mass", "geometry.planet_mass", "geometry.planet_mass", "geometry.side_mass")
def _mass(values, pair):
    """All planets and both side gears: N m_p + 2 m_s."""
    return pair.planets * values["geometry.planet_mass"] + 2.0 * values["geometry.side_mass"]


@_quantity("envelope.diameter", "geometry.module")
def _diameter(values, pair):
    """Bore of the case in which the planets turn about the carrier's axis: 2 √(R_e² + h²), h the larger of the planet's addendum
    and dedendum, as the corner of the back cone is farthest from the apex. The side gears are smaller."""
    planet = pair.gears[0]
    return 2.0 * math.hypot(pair.outer_cone, max(planet.addendum, planet.dedendum))


@_quantity("envelope.length", "geometry.module")
def _length(values, pair):
    """Over the back faces of both side gears: 2 (R_e cos δ + h_fe sin δ), where the root cone meets the back cone."""
    side = pair.gears[1]
    return 2.0 * (pair.outer_cone * cos(side.pitch) + side.dedendum * sin(side.pitch))


@_quantity("face.width_over_cone", "geometry.contact_ratio")
def _face(values, pair):
    """b / R_e."""
    return pair.face_width / pair.outer_cone


@_quantity("face.width_in_modules", "geometry.contact_ratio")
def _face_in_modules(values, pair):
    """b / m."""
    return pair.face_width / pair.module


@_quantity("teeth.planet_land", "geometry.contact_ratio")
def _planet_land(values, pair):
    """Tip land of the planet at the heel, in modules."""
    return pair.land(0) / pair.module


@_quantity("teeth.side_land", "geometry.contact_ratio")
def _side_land(values, pair):
    """Tip land of the side gear at the heel, in modules."""
    return pair.land(1) / pair.module


@_quantity("teeth.common_divisor", "geometry.contact_ratio")
def _divisor(values, pair):
    """Greatest common divisor of both numbers of teeth: 1 where each tooth meets each other one (hunting teeth)."""
    return float(math.gcd(pair.gears[0].teeth, pair.gears[1].teeth))


@_quantity("teeth.tool_room", "geometry.contact_ratio")
def _tool_room(values, pair):
    """Room for the tip radius of the tool of the roots, in modules; see checks.tool_room."""
    return tool_room(pair, values["strength.tool_radius"])


@_quantity("pin.rim", "geometry.contact_ratio")
def _pin_rim(values, pair):
    """Rim of the planet between pin and root cone at the toe, in modules there."""
    return pair.rim(0) / (pair.module * pair.inner_cone / pair.outer_cone)


@_quantity("pin.shear", "stress.contact_max", "planet[1].pin_force")
def _shear(values, pair):
    """Largest shear stress of the pin beside the planet: 4/3 F/(π d²/4), of a solid round section (Shigley, Mechanical
    Engineering Design). The case holds the pin outside each planet, so that one section carries the planet's whole force."""
    return 16.0 * values["planet[1].pin_force"] / (3.0 * pi * _pin(values) ** 2)


@_quantity("pin.pressure", "stress.contact_max", "planet[1].pin_force")
def _pressure(values, pair):
    """Mean pressure between pin and planet: F/(d l), l = b cos δ_f the length of the bore."""
    return values["planet[1].pin_force"] / (_pin(values) * pair.face_width * cos(pair.gears[0].root))


@_quantity("washer.planet_width", "geometry.module")
def _planet_washer(values, pair):
    """Width of a washer from the pin to the planet's root circle at the heel: R_e sin δ_f − d/2."""
    return pair.back_face(0) - 0.5 * _pin(values)


@_quantity("washer.planet_pressure", "stress.contact_max", "planet[1].thrust_force")
def _planet_washer_pressure(values, pair):
    """Mean pressure of that washer: F_a/(π (r_o² − r_i²))."""
    return values["planet[1].thrust_force"] / (pi * (pair.back_face(0) ** 2 - 0.25 * _pin(values) ** 2))


@_quantity("washer.side_pressure", "stress.contact_max", "left.thrust_force")
def _side_washer_pressure(values, pair):
    """Mean pressure of the side gear's washer, from its bore to its root circle at the heel."""
    return values["left.thrust_force"] / (pi * (pair.back_face(1) ** 2 - 0.25 * pair.gears[1].bore ** 2))


def _pin(values):
    """Diameter of the pin, m: it fills the planet's bore."""
    diameter = values["geometry.planet_bore"]
    if not diameter > 0.0:
        raise DifferentialError("geometry.planet_bore = 0: a pin needs a bore; set or vary it")
    return diameter


class Catalogue:
    """Variables of the FMU and the quantities, by name, as `Want.parse` and `Condition.parse` look them up."""

    def __init__(self, fmu: Fmu):
        self.fmu = fmu

    def starts(self) -> dict[str, Number]:
        """Start values of all parameters by name, SI, as the FMU declares them."""
        return {each.name: each.start for each in self.fmu.variables.values() if each.causality == "parameter" and each.start is not None}

    def variable(self, name: str) -> Variable:
        """The variable, or the quantity as an output of its unit."""
        if name not in QUANTITIES:
            if name in self.fmu.variables:
                return self.fmu.variables[name]
            raise DifferentialError(f"{name}: there is no such variable{suggestion(name, [*self.fmu.variables, *QUANTITIES])}")
        found = copy.copy(self.fmu.variable(QUANTITIES[name].like))
        found.name, found.causality, found.description = name, "output", QUANTITIES[name].description
        return found
