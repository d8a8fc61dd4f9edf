"""Times as a user writes them, and the communication points of a run."""

from dataclasses import dataclass
from functools import lru_cache
from typing import TypeAlias

import numpy as np

from .values import DifferentialError

# a time as a user writes it: s, or text such as "5 ms"
TimeValue: TypeAlias = float | str

# times that differ by less than this part of a step are the same
SLACK = 1e-9
# more communication points than this are a slip, and would not fit into memory
MOST_STEPS = 1e8
# how many of a unit make a second
PER_SECOND = {"": 1.0, "s": 1.0, "ms": 1e3, "us": 1e6, "min": 1.0 / 60.0, "h": 1.0 / 3600.0}


def seconds(what: str, time: TimeValue) -> float:
    """A time: seconds, or text such as "5 ms". `what` names it in errors."""
    if isinstance(time, str):
        number, _, unit = time.strip().partition(" ")
        try:
            time = float(number) / PER_SECOND[unit.strip()]
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


@dataclass(frozen=True)
class Steps:
    """Communication steps of a run.

    `points`: where steps begin and end, s, from 0 to the end, shape (steps + 1,). `begins`: the same as steps name their
    beginning, shape (steps,). `slack`: times that differ by less are the same, s."""

    points: np.ndarray
    begins: np.ndarray
    slack: float

    @classmethod
    def of(cls, stop: float, step: float | None, jumps: np.ndarray, exact: bool = False) -> "Steps":
        """Steps to multiples of `step`, to jumps of inputs, and to `stop`; without a step to jumps and to `stop` alone.

        Hosts begin a step where the one before was asked to end. With `exact` beginning and size add up to the end to the last
        bit, as in the library itself."""
        if len(jumps) == 0:
            return _regular_steps(stop, step, exact)
        slack = SLACK * (step or stop)
        regular = _regular(stop, step, slack)
        inner = jumps[(jumps > 0.0) & (jumps < stop)]
        near = np.abs(inner[:, None] - regular).min(axis=1, initial=np.inf) < slack
        return cls._between(np.union1d(regular, inner[~near]), slack, exact)

    @classmethod
    def _between(cls, points: np.ndarray, slack: float, exact: bool) -> "Steps":
        return cls(points, points[1:] - np.diff(points) if exact else points[:-1], slack)


@lru_cache(64)
def _regular_steps(stop, step, exact):
    """Steps without jumps, kept: designs of a sweep share them."""
    slack = SLACK * (step or stop)
    steps = Steps._between(_regular(stop, step, slack), slack, exact)
    steps.points.flags.writeable = steps.begins.flags.writeable = False
    return steps


def _regular(stop, step, slack):
    if step is None:
        return np.array([0.0, stop])
    if stop / step > MOST_STEPS:
        raise DifferentialError(f"{stop:g} s in steps of {step:g} s are more than {MOST_STEPS:g} steps: end earlier, or take "
                                "longer steps")
    regular = np.arange(int(stop / step * (1.0 + SLACK)) + 1) * step
    return np.append(regular[regular < stop - slack], stop)
