"""Accuracy grades of bevel gears by ISO 17485:2006, and the gears of a scene that they are for."""

import math
from dataclasses import dataclass

from ..scene import Scene
from ..values import DifferentialError

GRADES = range(2, 12)
# in which the standard gives its equations: mean normal module and tolerance diameter in m, number of teeth
MODULES, DIAMETERS, TEETH = (1e-3, 50e-3), (5e-3, 2.5), (5, 400)
_GEOMETRY = ("geometry.outer_cone_distance", "geometry.planet_pitch_angle", "geometry.side_pitch_angle", "geometry.face_width",
             "geometry.module", "geometry.planet_teeth", "geometry.side_teeth", "geometry.addendum_system",
             "geometry.planet_addendum", "geometry.side_addendum")


def grade(name: str, number: int) -> int:
    """`number` if it is an accuracy grade; `name` is the variable that it is for."""
    if number not in GRADES:
        raise DifferentialError(f"{name} = grade {number}: ISO 17485 has the grades {GRADES[0]} (finest) to {GRADES[-1]}")
    return number


@dataclass(frozen=True)
class Gear:
    """What the tolerances of a gear follow from.

    `diameter`: tolerance diameter d_T, m, where the mean cone distance meets the middle of the working depth. `module`: mean
    normal module m_mn, m. `teeth`: their number."""

    diameter: float
    module: float
    teeth: int

    def single_pitch(self, number: int) -> float:
        """Single pitch tolerance f_ptT of a grade, m: deviations are within ± this."""
        return _step(number) * (0.003 * self._diameter + 0.3 * self._module + 5.0)

    def cumulative_pitch(self, number: int) -> float:
        """Total cumulative pitch tolerance F_pT of a grade, m."""
        return _step(number) * (0.025 * self._diameter + 0.3 * self._module + 19.0)

    def runout(self, number: int) -> float:
        """Runout tolerance F_rT of a grade, m, peak to peak."""
        return 0.8 * self.cumulative_pitch(number)

    def check(self, name: str) -> None:
        """Raises what lies outside the ranges of the standard; `name` is the variable that a grade is given for."""
        ranges = (("mean module", self.module, MODULES, " m"), ("number of teeth", self.teeth, TEETH, ""),
                  ("tolerance diameter", self.diameter, DIAMETERS, " m"))
        for what, value, (low, high), unit in ranges:
            if not low <= value <= high:
                raise DifferentialError(f"{name}: ISO 17485 gives no tolerances for a {what} of {value:.6g}{unit}, but from "
                                        f"{low:g} to {high:g}{unit}: give a distribution instead of a grade")

    # the equations take mm and give µm
    @property
    def _diameter(self):
        return 1e3 * self.diameter

    @property
    def _module(self):
        return 1e3 * self.module


def _step(number):
    return 1e-6 * math.sqrt(2.0) ** (number - 4)


def gears(scene: Scene) -> dict[str, Gear]:
    """The gears of a scene, "planet" and "side"."""
    first = scene.run(_GEOMETRY, stop=scene.step)[0]
    value = {name.removeprefix("geometry."): first[name].item() for name in _GEOMETRY}
    at_mean = 1.0 - 0.5 * value["face_width"] / value["outer_cone_distance"]
    module = value["module"]
    cosine = {kind: math.cos(value[f"{kind}_pitch_angle"]) for kind in ("planet", "side")}
    ratio = value["side_teeth"] * cosine["planet"] / (value["planet_teeth"] * cosine["side"])
    systems = {number: name for name, number in scene.fmu.variable("geometry.addendum_system").literals.items()}
    difference = _addendum_difference(systems[value["addendum_system"]], ratio, value) * module
    return {kind: Gear(at_mean * (module * value[f"{kind}_teeth"] + sign * difference * cosine[kind]), at_mean * module,
                       value[f"{kind}_teeth"]) for kind, sign in (("planet", 1.0), ("side", -1.0))}


def _addendum_difference(system, ratio, value):
    """Addendum of a planet less that of a side gear, in modules: twice the distance of the pitch cone from the middle of the
    working depth. `ratio`: virtual teeth of a side gear over those of a planet."""
    if system == "explicit":
        return value["planet_addendum"] - value["side_addendum"]
    larger = max(ratio, 1.0 / ratio)
    shorter = {"standard": 1.0, "gleason": 0.54 + 0.46 / larger, "iso23509": 2.0 * (0.21 + 0.29 / larger)}[system]
    return (2.0 - 2.0 * shorter) * (1.0 if ratio >= 1.0 else -1.0)
