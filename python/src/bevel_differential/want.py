"""Wanted results of a run: statistics of outputs over time, and conditions on them. The command `accuracy` uses the same statistics,
from the same library."""

import operator
import re
from collections.abc import Sequence
from dataclasses import dataclass, field
from functools import cache

import numpy as np

from .answers import ask
from .points import seconds
from .values import DifferentialError, Quantity, Variable, Variables, split

RELATIONS = {"<=": operator.le, ">=": operator.ge, "<": operator.lt, ">": operator.gt}
# largest phase between two points of an order, rad
COARSEST = 0.5 * np.pi
# angles that count orders
ANGLES = {"mesh": "planet[1].spin_angle", "shaft": "carrier.angle"}


@dataclass(frozen=True)
class Statistic:
    """Statistic of a series.

    `word`: mean, rms, min, max, peak_to_peak, final, time_of_peak, or an order: "mesh_order_2" is the amplitude of two periods per
    pitch of planet 1, "shaft_order_1" is that of one period per turn of the carrier. `angle`: the output that counts the periods of an
    order."""

    word: str
    angle: str | None = None

    @staticmethod
    @cache
    def parse(text: str) -> "Statistic":
        """Statistic by its word."""
        found = ask({"ask": "word", "statistic": text})
        return Statistic(found["word"], ANGLES.get(found["angle"]))

    @property
    def is_difference(self) -> bool:
        """True if the figure is a difference between values, which is converted without the offset of a unit."""
        return self.word == "peak_to_peak" or self.angle is not None

    def of(self, times: np.ndarray, values: np.ndarray, phase: np.ndarray | None = None) -> float:
        """Figure of `values` at `times` (s), shape (points,); `phase` (rad, 2π for a period of order 1) for orders."""
        if self.angle is not None and phase is None:
            raise DifferentialError(f"{self.word}: an order needs the angle that counts its periods")
        return figures([self.word], times, values, phase)[0]


def figures(words: Sequence[str], times: np.ndarray, values: np.ndarray, phase: np.ndarray | None = None) -> list[float]:
    """Figures of a series by the words of their statistics; `phase` (rad) for orders."""
    series = [times, values] if phase is None else [times, values, phase]
    asked = [{"statistic": word, "series": 0, "phase": None if phase is None else 1} for word in words]
    return ask({"ask": "statistics", "points": len(times), "figures": asked}, np.array(series, float))["figures"]


def mean_over_time(values: np.ndarray, times: np.ndarray) -> float:
    """Mean of values over time (s), linear between the rows. For a run without duration, the last value."""
    return figures(["mean"], times, values)[0]


@dataclass(frozen=True)
class Want:
    """Statistic of an output."""

    name: str
    statistic: Statistic

    @classmethod
    def parse(cls, fmu: Variables, text: str) -> "Want":
        """Reads "OUTPUT:STATISTIC"; the default statistic is the final value."""
        name, _, word = text.strip().partition(":")
        variable = fmu.output(name.strip())
        return cls(variable.name, Statistic.parse(word or "final"))

    def __str__(self) -> str:
        return f"{self.name}:{self.statistic.word}"

    def unit(self, fmu: Variables) -> str:
        """SI unit of the figure; "1" if it has none."""
        return self.quantity(fmu).unit or "1"

    def quantity(self, fmu: Variables) -> Variable:
        """Variable that represents the figure: it reads numbers with a unit, and shows the figure."""
        if self.statistic.word == "time_of_peak":
            return Quantity("time", "s")
        variable = fmu.variable(self.name)
        return variable.differences() if self.statistic.is_difference else variable

    def of(self, record: np.ndarray, planet_teeth: int) -> float:
        """Figure of a record, a structured array with this output and, for orders, the angle that counts their periods."""
        angle = self.statistic.angle
        # a pitch of the planet is a period of the mesh
        teeth = planet_teeth if angle == "planet[1].spin_angle" else 1
        return self.statistic.of(record["time"], record[self.name].astype(float),
                                 None if angle is None else record[angle] * teeth)


@dataclass(frozen=True)
class Condition:
    """Limit of a wanted figure, in SI: "safety.root_min >= 1.2", "left.speed:max < 30 rad/s". `written`: the limit as users wrote it, with
    its unit."""

    want: Want
    relation: str
    limit: float
    written: str = field(default="", compare=False)

    @classmethod
    def parse(cls, fmu: Variables, text: str) -> "Condition":
        """Reads "OUTPUT:STATISTIC RELATION LIMIT"; the limit may have a unit."""
        parts = re.split(r"(<=|>=|<|>)", text, maxsplit=1)
        if len(parts) != 3:
            raise DifferentialError(f"condition {text!r}: write it as \"safety.root_min >= 1.2\", with one of "
                                    f"{', '.join(RELATIONS)}")
        want = Want.parse(fmu, parts[0])
        written = parts[2].strip()
        is_time = want.statistic.word == "time_of_peak"
        limit = seconds(f"condition {text!r}: the time", written) if is_time else want.quantity(fmu).number(written)
        unit = want.quantity(fmu).unit or "1"
        shown = written if unit == "1" or split(written)[1] else f"{written} {unit}"
        return cls(want, parts[1], float(limit), shown)

    def __str__(self) -> str:
        return f"{self.want} {self.relation} {self.written or f'{self.limit!r}'}"

    def holds(self, figure: float) -> bool:
        """True if a figure, SI, meets the condition."""
        return bool(RELATIONS[self.relation](figure, self.limit))

    def excess(self, figure: float) -> float:
        """Excess of a figure over the limit, relative to the limit; negative if the condition is met."""
        scale = abs(self.limit) or 1.0
        return (figure - self.limit) / scale * (1.0 if self.relation.startswith("<") else -1.0)
