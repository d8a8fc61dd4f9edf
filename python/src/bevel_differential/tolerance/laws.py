"""Laws for the distribution of a factor in production, and accuracy grades of bevel gears by ISO 17485:2006.

Each law has `at(shares)`: values (SI) at shares of probability in (0, 1), shape (runs,); `varies`; `scaled(ratio)`: a law with a
spread `ratio` times as large; and `graded(steps)`: a law with a grade that is `steps` steps coarser."""

import math
from abc import ABC, abstractmethod
from dataclasses import dataclass, replace

import numpy as np
from scipy import stats

from ..designs import Dimension
from ..pair import Pair
from ..scene import Scene
from ..values import DifferentialError, Number

GRADES = range(2, 12)
# ranges of the standard's equations: mean normal module and tolerance diameter in m, number of teeth
MODULES, DIAMETERS, TEETH = (1e-3, 50e-3), (5e-3, 2.5), (5, 400)


def grade(name: str, number: int) -> int:
    """Returns `number` if it is an accuracy grade; `name` is the variable with this grade."""
    if number not in GRADES:
        raise DifferentialError(f"{name} = grade {number}: ISO 17485 has the grades {GRADES[0]} (finest) to {GRADES[-1]}")
    return number


@dataclass(frozen=True)
class Gear:
    """Dimensions of a gear from which its tolerances follow.

    `diameter`: tolerance diameter d_T, m, at the intersection of the mean cone distance and the middle of the working depth. `module`:
    mean normal module m_mn, m. `teeth`: number of teeth."""

    diameter: float
    module: float
    teeth: int

    def cumulative_pitch(self, number: int) -> float:
        """Total cumulative pitch tolerance F_pT of a grade, m. The equation takes mm and gives µm."""
        return 1e-6 * math.sqrt(2.0) ** (number - 4) * (0.025 * (1e3 * self.diameter) + 0.3 * (1e3 * self.module) + 19.0)

    def runout(self, number: int) -> float:
        """Runout tolerance F_rT of a grade, m, peak to peak."""
        return 0.8 * self.cumulative_pitch(number)

    def check(self, name: str) -> None:
        """Raises `DifferentialError` for a value outside the ranges of the standard; `name` is the variable with a grade."""
        ranges = (("mean module", self.module, MODULES, " m"), ("number of teeth", self.teeth, TEETH, ""),
                  ("tolerance diameter", self.diameter, DIAMETERS, " m"))
        for what, value, (low, high), unit in ranges:
            if not low <= value <= high:
                raise DifferentialError(f"{name}: ISO 17485 gives no tolerances for a {what} of {value:.6g}{unit}, but from "
                                        f"{low:g} to {high:g}{unit}: give a distribution instead of a grade")


def gears(scene: Scene) -> dict[str, Gear]:
    """Gears of a scene, "planet" and "side"."""
    # the FMU refuses gears that cannot be built
    scene.run(["geometry.module"], stop=scene.step)
    pair = Pair.of({name: scene.value(name) for name in scene.fmu.variables if name.startswith("geometry.")})
    at_mean = 1.0 - 0.5 * pair.face_width / pair.outer_cone
    # the middle of the working depth is at half of the difference from the pitch cone
    difference = pair.gears[0].addendum - pair.gears[1].addendum
    return {kind: Gear(at_mean * (pair.module * gear.teeth + sign * difference * math.cos(gear.pitch)), at_mean * pair.module, gear.teeth)
            for kind, sign, gear in zip(("planet", "side"), (1.0, -1.0), pair.gears)}


class Law(ABC):
    """Distribution without a grade."""

    varies = True

    @abstractmethod
    def at(self, shares: np.ndarray) -> list[Number]:
        """Values (SI) at shares of probability in (0, 1), shape (runs,)."""

    @abstractmethod
    def scaled(self, ratio: float) -> "Law":
        """Law with a spread `ratio` times as large. Raises `DifferentialError` if such a law does not exist."""

    def graded(self, steps: int) -> "Law | None":
        """Law with a coarser grade; None for laws without a grade."""
        return None


@dataclass(frozen=True)
class Fixed(Law):
    """Law with a single value."""

    value: Number
    varies = False

    def at(self, shares: np.ndarray) -> list[Number]:
        return [self.value] * len(shares)

    def scaled(self, ratio: float) -> Law:
        raise DifferentialError("it has one value and no spread")


@dataclass(frozen=True)
class Given(Law):
    """Law of a distribution, a range or a list."""

    dimension: Dimension

    def at(self, shares: np.ndarray) -> list[Number]:
        return self.dimension.at(shares)

    def scaled(self, ratio: float) -> Law:
        numbers, whole = self.dimension.numbers, self.dimension.whole
        if self.dimension.kind == "lognormal":
            # the logarithm has the spread
            return self._with(numbers[0], numbers[1]**ratio)
        if self.dimension.kind == "normal":
            return self._with(numbers[0], numbers[1] * ratio)
        if self.dimension.kind == "list" or whole:
            raise DifferentialError("a list of values or of whole numbers has no spread to make finer: write the other values")
        centre = numbers[1] if self.dimension.kind == "triangular" else 0.5 * (numbers[0] + numbers[1])
        return self._with(*(centre + ratio * (number - centre) for number in numbers))

    def _with(self, *numbers):
        return Given(replace(self.dimension, numbers=numbers))


class PitchGrade(Fixed):
    """Gears that just meet a grade of pitch deviations. The seed determines the deviations."""

    @property
    def number(self) -> Number:
        """Grade of the gears."""
        return self.value

    def graded(self, steps: int) -> Law:
        return PitchGrade(grade("pitch", int(self.value) + steps))


@dataclass(frozen=True)
class RunoutGrade(Law):
    """Runout of gears that are made for a grade.

    Both components of the eccentricity have the same normal distribution, so that the runout is a Rayleigh variable. The fraction of
    gears beyond the tolerance equals that of a centred normal characteristic beyond its limits at the same capability C_p."""

    number: int
    gear: Gear
    capability: float

    @property
    def tolerance(self) -> float:
        """Runout tolerance F_rT, m."""
        return self.gear.runout(self.number)

    def at(self, shares: np.ndarray) -> list[Number]:
        shares = np.asarray(shares, float)
        return (self.tolerance * np.sqrt(np.log1p(-shares) / math.log(beyond(self.capability)))).tolist()

    def scaled(self, ratio: float) -> Law:
        raise DifferentialError("it has a grade: write the grade")

    def graded(self, steps: int) -> Law:
        return replace(self, number=grade("runout", self.number + steps))


def beyond(capability: float) -> float:
    """Fraction of a centred normal characteristic beyond its limits, which are ± 3 C_p standard deviations from the middle."""
    return 2.0 * stats.norm.sf(3.0 * capability)


def band(variable: str, middle: float, half: float, capability: float) -> Law:
    """Normal law of a tolerance `middle` ± `half`, with the standard deviation half/(3 C_p)."""
    if half < 0.0:
        raise DifferentialError(f"{variable}: a tolerance of ± {half:g} is negative")
    return Given(Dimension(variable, "normal", (middle, half / (3.0 * capability)))) if half > 0.0 else Fixed(middle)
