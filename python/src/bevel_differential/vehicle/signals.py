"""Requests over time, for the motor's torque and the steering angle."""

import math
from collections.abc import Callable, Mapping, Sequence
from typing import TypeAlias

import numpy as np

from ..inputs import Signals, Table
from ..values import DifferentialError, Quantity

# a number, a pair (times, values) with linear interpolation, or a function of time
Course: TypeAlias = float | tuple[Sequence[float], Sequence[float]] | Callable[[float], float]


def course(name: str, given: Course) -> Callable[[float], float]:
    """`given` as a function of time (s); `name` names it in errors."""
    if callable(given):
        return given
    if isinstance(given, tuple):
        times, values = given
        table = Table(Quantity(name, "1"), times, values)
        return lambda time: float(np.interp(time, table.times, table.values))
    try:
        value = float(given)
    except (TypeError, ValueError):
        value = math.nan
    if not math.isfinite(value):
        raise DifferentialError(f"{name} = {given!r}: it is a finite number, a pair (times, values) or a function of time")
    return lambda _: value


class Requests:
    """Requests of a run by name. A step ends at every point of those that are tables."""

    def __init__(self, given: Mapping[str, Course]):
        self._courses = {name: course(name, each) for name, each in given.items()}
        self._tables = [name for name, each in given.items() if isinstance(each, tuple)]
        self._signals = Signals((), [Table(Quantity(name, "1"), *given[name]) for name in self._tables])

    def steps(self, stop: float, step: float) -> np.ndarray:
        """Steps to `stop`; see `Signals.steps`."""
        return self._signals.steps(stop, step)

    def within(self, step: np.void, begin: float) -> dict[str, Callable[[float], float]]:
        """Functions of time (s) in one of the steps, from `begin` (s) on. Tables are lines, so that a jump at the end does not count."""
        def line(value, slope):
            return lambda time: value + slope * (time - begin)

        lines = zip(self._tables, step["values"].tolist(), step["slopes"].tolist())
        return self._courses | {name: line(value, slope) for name, value, slope in lines}


def speed_value(given: float | str) -> float:
    """Speed in m/s from a number, m/s, or from text such as "54 km/h"."""
    return float(Quantity("speed", "m/s").number(given))
