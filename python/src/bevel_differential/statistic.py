"""Figures that a series over time is judged by: those of `accuracy`, from the same library."""

from collections.abc import Sequence
from dataclasses import dataclass
from functools import cache

import numpy as np

from .answers import ask
from .values import DifferentialError

# periods of an order need so many radians between two points at most
COARSEST = 0.5 * np.pi
# what orders are counted by
ANGLES = {"mesh": "planet[1].spin_angle", "shaft": "carrier.angle"}


@dataclass(frozen=True)
class Statistic:
    """A figure of a series.

    `word`: mean, rms, min, max, peak_to_peak, final, time_of_peak, or an order: "mesh_order_2" is the amplitude of two periods per
    pitch of planet 1, "shaft_order_1" that of one period per turn of the carrier. `angle`: the output by which an order is counted."""

    word: str
    angle: str | None = None

    @classmethod
    def parse(cls, text: str) -> "Statistic":
        """The statistic that a word names."""
        return _parsed(text)

    def of(self, times: np.ndarray, values: np.ndarray, phase: np.ndarray | None = None) -> float:
        """The figure of `values` at `times` (s), shape (points,); `phase` (rad, 2π a period of order 1) for orders."""
        if self.angle is not None and phase is None:
            raise DifferentialError(f"{self.word}: an order needs the angle that it is counted by")
        return figures([self.word], times, values, phase)[0]


def figures(words: Sequence[str], times: np.ndarray, values: np.ndarray, phase: np.ndarray | None = None) -> list[float]:
    """The figures of a series that words name; `phase` (rad) for orders."""
    series = [times, values] if phase is None else [times, values, phase]
    asked = [{"statistic": word, "series": 0, "phase": None if phase is None else 1} for word in words]
    return ask({"ask": "statistics", "points": len(times), "figures": asked}, np.array(series, float))["figures"]


@cache
def _parsed(text):
    found = ask({"ask": "word", "statistic": text})
    return Statistic(found["word"], ANGLES.get(found["angle"]))
