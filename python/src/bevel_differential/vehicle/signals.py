"""Requests over time: of the motor's torque and of the steering angle."""

import math
from collections.abc import Callable, Sequence
from typing import TypeAlias

import numpy as np

from ..values import DifferentialError

# a number, a pair (times, values) with straight lines between, or a function of time
Course: TypeAlias = float | tuple[Sequence[float], Sequence[float]] | Callable[[float], float]


def course(name: str, given: Course) -> Callable[[float], float]:
    """`given` as a function of time (s); `name` names it in errors."""
    if callable(given):
        return given
    if isinstance(given, tuple):
        times, values = (np.asarray(each, float) for each in given)
        if times.ndim != 1 or times.shape != values.shape or len(times) == 0:
            raise DifferentialError(f"{name}: it is a pair of lists (times, values) of one length")
        if not (np.all(np.isfinite(times)) and np.all(np.isfinite(values))) or np.any(np.diff(times) < 0.0):
            raise DifferentialError(f"{name}: times and values must be finite, and times must not fall")
        return lambda time: float(np.interp(time, times, values))
    try:
        value = float(given)
    except (TypeError, ValueError):
        value = math.nan
    if not math.isfinite(value):
        raise DifferentialError(f"{name} = {given!r}: it is a finite number, a pair (times, values) or a function of time")
    return lambda _: value
