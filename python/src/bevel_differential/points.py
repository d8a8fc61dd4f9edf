"""Times in the form that users write."""

from typing import TypeAlias

import numpy as np

from .values import DifferentialError, Quantity

# a time in the form that users write: s, or text such as "5 ms"
TimeValue: TypeAlias = float | str

# communication points are rounded: times that differ by less than this fraction of a step are equal
SAME = 1e-6


def seconds(what: str, time: TimeValue) -> float:
    """Time in seconds from a number in s, or from text such as "5 ms". `what` names the time in errors."""
    return float(Quantity(what, "s").number(time))


def span(what: str, time: TimeValue) -> float:
    """Time above 0, s."""
    time = seconds(what, time)
    if not time > 0.0:
        raise DifferentialError(f"{what} = {time!r}: it is more than 0 s")
    return time


def duration(what: str, time: TimeValue) -> float:
    """Time of 0 or more, s."""
    time = seconds(what, time)
    if time < 0.0:
        raise DifferentialError(f"{what} = {time!r}: it is 0 or more, s")
    return time


def at_times(times: np.ndarray, rows: np.ndarray, values: np.ndarray) -> np.ndarray:
    """Values at `times` (s) of a series with `values` at the times `rows` (s), linear between them. At a jump, a time has the value before
    it, and its second occurrence in `times` has the value after it."""
    before, after = -np.interp(-times, -rows[::-1], -values[::-1]), np.interp(times, rows, values)
    return np.where(np.append(False, np.diff(times) == 0.0), after, before)


def from_time(record: np.ndarray, start: float, step: float) -> np.ndarray:
    """Rows of a record with the communication step `step` (s) from `start` (s) on. The first one is interpolated, or the second row of a
    jump."""
    slack = SAME * step
    first = int(np.searchsorted(record["time"], start + slack, side="right")) - 1
    if start <= 0.0 or first + 1 >= len(record):
        return record
    found = record[first:].copy()
    if start - found["time"][0] > slack:
        share = (start - found["time"][0]) / (found["time"][1] - found["time"][0])
        for name in found.dtype.names:
            if found.dtype[name].kind == "f":
                found[name][0] += share * (found[name][1] - found[name][0])
    return found
