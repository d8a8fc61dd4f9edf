"""Times in the form that users write."""

from typing import TypeAlias

import numpy as np

from .values import DifferentialError, split

# a time in the form that users write: s, or text such as "5 ms"
TimeValue: TypeAlias = float | str
# size of a second in each unit
PER_SECOND = {"": 1.0, "s": 1.0, "ms": 1e3, "us": 1e6, "min": 1.0 / 60.0, "h": 1.0 / 3600.0}


def seconds(what: str, time: TimeValue) -> float:
    """Time in seconds from a number in s, or from text such as "5 ms". `what` names the time in errors."""
    if isinstance(time, str):
        number, unit = split(time)
        try:
            time = float(number) / PER_SECOND[unit]
        except (KeyError, ValueError):
            raise DifferentialError(f"{what} = {time!r}: write seconds, or a number and one of s, ms, us, min, h") from None
    try:
        finite = bool(np.isfinite(time)) and not isinstance(time, bool)
    except TypeError:
        finite = False
    if not finite:
        raise DifferentialError(f"{what} = {time!r}: it is a finite time, s")
    return float(time)


def span(what: str, time: TimeValue) -> float:
    """Time above 0, s."""
    time = seconds(what, time)
    if not time > 0.0:
        raise DifferentialError(f"{what} = {time!r}: it is more than 0, s")
    return time


def duration(what: str, time: TimeValue) -> float:
    """Time of 0 or more, s."""
    time = seconds(what, time)
    if time < 0.0:
        raise DifferentialError(f"{what} = {time!r}: it is 0 or more, s")
    return time


def mean_over_time(values: np.ndarray, times: np.ndarray) -> float:
    """Mean of values over time, weighted by the time between them. For a run without duration, the last value."""
    return float(np.trapezoid(values, times) / (times[-1] - times[0]) if times[-1] > times[0] else values[-1])
