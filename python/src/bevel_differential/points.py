"""Times as a user writes them, and the communication points of a run."""

import math
from collections.abc import Sequence
from dataclasses import dataclass
from functools import lru_cache
from typing import TypeAlias

import numpy as np

from .values import DifferentialError, split

# a time as a user writes it: s, or text such as "5 ms"
TimeValue: TypeAlias = float | str
# a time at which inputs change, s, and the period after which it comes again, s, or None
Recurring: TypeAlias = tuple[float, float | None]

# times that differ by less than this part of a step are the same
SLACK = 1e-9
# the same as a part of a run without regular steps, whose inputs may change within a small part of it
FINEST = 1e-12
# more communication points than this are a slip, and would not fit into memory
MOST_STEPS = 1e8
# how many of a unit make a second
PER_SECOND = {"": 1.0, "s": 1.0, "ms": 1e3, "us": 1e6, "min": 1.0 / 60.0, "h": 1.0 / 3600.0}


def seconds(what: str, time: TimeValue) -> float:
    """A time: seconds, or text such as "5 ms". `what` names it in errors."""
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
    """A time above 0, s."""
    time = seconds(what, time)
    if not time > 0.0:
        raise DifferentialError(f"{what} = {time!r}: it is more than 0, s")
    return time


def duration(what: str, time: TimeValue) -> float:
    """A time of 0 or more, s."""
    time = seconds(what, time)
    if time < 0.0:
        raise DifferentialError(f"{what} = {time!r}: it is 0 or more, s")
    return time


def mean_over_time(values: np.ndarray, times: np.ndarray) -> float:
    """Mean of values between which time passes; of a run without any duration, the value at its time."""
    return float(np.trapezoid(values, times) / (times[-1] - times[0]) if times[-1] > times[0] else values[-1])


@dataclass(frozen=True)
class Steps:
    """Communication steps of a run.

    `points`: where steps begin and end, s, from 0 to the end, shape (steps + 1,). `begins`: the same as steps name their
    beginning, shape (steps,). `slack`: times that differ by less are the same, s."""

    points: np.ndarray
    begins: np.ndarray
    slack: float

    @staticmethod
    @lru_cache(64)
    def of(stop: float, step: float | None, jumps: tuple[Recurring, ...], exact: bool = False) -> "Steps":
        """Steps to multiples of `step`, to `jumps` of inputs in all their periods, and to `stop`; without a step only to jumps and to
        `stop`. They are kept: designs of a sweep share them.

        Hosts begin a step where the one before was asked to end. With `exact` beginning and size add up to the end to the last
        bit, as in the library itself."""
        slack = FINEST * stop if step is None else SLACK * step
        points = _regular(stop, step, slack)
        inner = _all(jumps, stop)
        if len(inner):
            after = np.searchsorted(points, inner)
            inner = inner[(inner > points[after - 1] + slack) & (inner < points[after] - slack)]
            points = np.union1d(points, _apart(inner, slack))
        begins = points[1:] - np.diff(points) if exact else points[:-1]
        points.flags.writeable = begins.flags.writeable = False
        return Steps(points, begins, slack)


def _regular(stop, step, slack):
    if step is None:
        return np.unique([0.0, stop])
    if stop / step > MOST_STEPS:
        raise DifferentialError(f"{stop:g} s in steps of {step:g} s are more than {MOST_STEPS:g} steps: end earlier, or take "
                                "longer steps")
    regular = np.arange(int(stop / step * (1.0 + SLACK)) + 1) * step
    return np.append(regular[regular < stop - slack], stop)


def _all(jumps: Sequence[Recurring], stop: float) -> np.ndarray:
    """Times of jumps between 0 and `stop`, s, rising."""
    found = [np.array([time for time, period in jumps if period is None])]
    for period in sorted({period for _, period in jumps if period is not None}):
        within = np.array([time for time, other in jumps if other == period])
        rounds = math.ceil(stop / period)
        if rounds * len(within) > MOST_STEPS:
            raise DifferentialError(f"inputs with a period of {period:g} s jump more than {MOST_STEPS:g} times in {stop:g} s: end earlier, "
                                    "or give a longer period")
        found.append((np.arange(rounds)[:, np.newaxis] * period + within).ravel())
    times = np.unique(np.concatenate(found))
    return times[(times > 0.0) & (times < stop)]


def _apart(times, slack):
    """Rising times without those that are the same as the one before."""
    if np.all(np.diff(times) > slack):
        return times
    kept: list[float] = []
    for time in times.tolist():
        if not kept or time > kept[-1] + slack:
            kept.append(time)
    return np.array(kept)
