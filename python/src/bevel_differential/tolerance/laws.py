"""Laws by which a factor is spread over the differentials that are made.

Each has `at(shares)`: values (SI) at shares of probability in (0, 1), shape (runs,); `varies`; `scaled(ratio)`: the same law
with a spread `ratio` times as large; and `graded(steps)`: the same with a grade that is so many steps coarser."""

import math
from abc import ABC, abstractmethod
from dataclasses import dataclass, replace

import numpy as np
from scipy import stats

from ..designs import Dimension
from ..values import DifferentialError, Number
from .grade import Gear, grade


class Law(ABC):
    """A law, of no grade."""

    varies = True

    @abstractmethod
    def at(self, shares: np.ndarray) -> list[Number]:
        """Values (SI) at shares of probability in (0, 1), shape (runs,)."""

    @abstractmethod
    def scaled(self, ratio: float) -> "Law":
        """The same law with a spread `ratio` times as large. Raises `DifferentialError` where there is none."""

    def graded(self, steps: int) -> "Law | None":
        """None: this law is no grade's."""
        return None


@dataclass(frozen=True)
class Fixed(Law):
    """One value for all."""

    value: Number
    varies = False

    def at(self, shares: np.ndarray) -> list[Number]:
        return [self.value] * len(shares)

    def scaled(self, ratio: float) -> Law:
        raise DifferentialError("it has one value and no spread")


@dataclass(frozen=True)
class Given(Law):
    """A distribution, a range or a list."""

    dimension: Dimension

    def at(self, shares: np.ndarray) -> list[Number]:
        return self.dimension.at(shares)

    def scaled(self, ratio: float) -> Law:
        numbers, whole = self.dimension.numbers, self.dimension.whole
        if self.dimension.kind == "lognormal":
            # the logarithm is what is spread
            return self._with(numbers[0], numbers[1]**ratio)
        if self.dimension.kind == "normal":
            return self._with(numbers[0], numbers[1] * ratio)
        if self.dimension.kind == "list" or whole:
            raise DifferentialError("a list of values or of whole numbers has no spread to make finer: write the other values")
        centre = numbers[1] if self.dimension.kind == "triangular" else 0.5 * (numbers[0] + numbers[1])
        return self._with(*(centre + ratio * (number - centre) for number in numbers))

    def _with(self, *numbers):
        return Given(replace(self.dimension, numbers=numbers))


@dataclass(frozen=True)
class PitchGrade(Law):
    """Gears that just meet a grade of pitch deviations. Which deviations they have is for the seed to say."""

    number: int
    varies = False

    def at(self, shares: np.ndarray) -> list[Number]:
        return [self.number] * len(shares)

    def scaled(self, ratio: float) -> Law:
        raise DifferentialError("the pitch has grades: write the grade")

    def graded(self, steps: int) -> Law:
        return PitchGrade(grade("pitch", self.number + steps))


@dataclass(frozen=True)
class RunoutGrade(Law):
    """Runout of gears that are made for a grade.

    Both components of the eccentricity are normal and alike, so that the runout is a Rayleigh variable. The part of gears
    beyond the tolerance is that of a centred normal characteristic beyond its limits at the same capability C_p."""

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
    """Part of a centred normal characteristic beyond its limits, which are ± 3 C_p standard deviations from the middle."""
    return 2.0 * stats.norm.sf(3.0 * capability)


def band(variable: str, middle: float, half: float, capability: float) -> Law:
    """Normal law of a tolerance `middle` ± `half`: a standard deviation of half/(3 C_p)."""
    if half < 0.0:
        raise DifferentialError(f"{variable}: a tolerance of ± {half:g} is negative")
    return Given(Dimension(variable, "normal", (middle, half / (3.0 * capability)))) if half > 0.0 else Fixed(middle)
