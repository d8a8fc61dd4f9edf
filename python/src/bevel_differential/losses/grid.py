"""Lines of a map, and new lines where it bends.

The map is linear between lines in each of its axes, as the tables of system models are. By leaving a line out, its neighbours predict
the values on it; the error of that, 1/2 |f''| h1 h2 with distances h1 and h2 to the neighbours, gives the curvature, and curvature the
error 1/8 |f''| h² in the middle of an interval. The errors of all axes add up. Intervals with the largest are halved. Whether
the map is as good as that says is measured by points that it has never seen."""

import math
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from scipy.interpolate import RegularGridInterpolator
from scipy.stats import beta

# least lines of an axis that tell whether the map bends
LEAST = 3
# part of the bound that the estimates may take: the measured error has the rest
GOAL = 0.5
# an interval shorter than this part of its axis is not halved: the map jumps there
SHORTEST = 1e-3
# confidence of the measured bound
CONFIDENCE = 0.95


@dataclass(frozen=True)
class Bound:
    """What an error may be: a part of the value, and a torque [N·m] on top of it. In power the torque acts at the speeds of
    carrier and planets."""

    part: float = 0.02
    torque: float = 0.1

    def of(self, values: np.ndarray, points: np.ndarray) -> np.ndarray:
        """Bounds of the torques left and right [N·m] and the loss [W], the last axis of `values`, at `points`, whose last axis is
        torque, speed, difference of speeds and temperature."""
        speed = np.abs(points[..., 1]) + 0.5 * np.abs(points[..., 2])
        torque = np.stack([np.ones_like(speed), np.ones_like(speed), speed], axis=-1) * self.torque
        return self.part * np.abs(values) + torque

    def __str__(self) -> str:
        return f"{100.0 * self.part:g} % + {self.torque:g} N.m"


def starting(levels: Sequence[float]) -> np.ndarray:
    """Lines that an axis begins with: the given ones, 0 where they straddle it, and enough to see a bend."""
    lines = np.unique(np.asarray(levels, float))
    if lines[0] < 0.0 < lines[-1]:
        lines = np.union1d(lines, [0.0])
    while 1 < len(lines) < LEAST:
        lines = np.union1d(lines, 0.5 * (lines[1:] + lines[:-1]))
    return lines


def places(lines: Sequence[np.ndarray]) -> np.ndarray:
    """All crossings of the lines, shape (lines of each axis, axes)."""
    return np.stack(np.meshgrid(*lines, indexing="ij"), axis=-1)


def estimates(lines: Sequence[np.ndarray], values: np.ndarray, bounds: np.ndarray) -> list[np.ndarray]:
    """The largest error over its bound in each interval of each axis. `values` and `bounds`: shape (sheets, lines of each axis,
    figures)."""
    found = []
    for axis, at in enumerate(lines):
        worst = np.zeros(max(len(at) - 1, 0))
        moved, limits = np.moveaxis(values, axis + 1, 0), np.moveaxis(bounds, axis + 1, 0)
        for k in range(1, len(at) - 1):
            before, after = at[k] - at[k - 1], at[k + 1] - at[k]
            left_out = np.abs((moved[k - 1] * after + moved[k + 1] * before) / (before + after) - moved[k])
            curvature = np.max(left_out / limits[k]) * 2.0 / (before * after)
            for interval, width in ((k - 1, before), (k, after)):
                worst[interval] = max(worst[interval], curvature * width**2 / 8.0)
        found.append(worst)
    return found


def refined(lines: Sequence[np.ndarray], found: Sequence[np.ndarray], most: int) -> list[np.ndarray] | None:
    """The lines with the worst intervals halved, in all axes or, where that would make more than `most` crossings, in the worst axis;
    None where the map is good enough, or as large as it may be."""
    if sum(errors.max(initial=0.0) for errors in found) <= GOAL:
        return None
    axes = sum(len(errors) > 0 for errors in found)
    worst = max(range(len(found)), key=lambda axis: found[axis].max(initial=0.0))
    for chosen in (range(len(lines)), [worst]):
        new = [_halved(at, found[axis] > GOAL / axes) if axis in chosen else at for axis, at in enumerate(lines)]
        if size(lines) < size(new) <= most:
            return new
    return None


def size(lines: Sequence[np.ndarray]) -> int:
    """How many crossings there are."""
    return math.prod(map(len, lines))


def _halved(at, where):
    where = where & (np.diff(at) > SHORTEST * (at[-1] - at[0]))
    return np.union1d(at, 0.5 * (at[1:] + at[:-1])[where])


def interpolated(lines: Sequence[np.ndarray], values: np.ndarray, points: np.ndarray) -> np.ndarray:
    """Values at points, shape (points, figures), linear between lines; `values`: shape (lines of each axis, figures). An axis of one
    line is the same everywhere."""
    several = [axis for axis, at in enumerate(lines) if len(at) > 1]
    kept = values.reshape([len(lines[axis]) for axis in several] + [values.shape[-1]])
    if not several:
        return np.broadcast_to(kept, (len(points), values.shape[-1]))
    return RegularGridInterpolator([lines[axis] for axis in several], kept)(np.asarray(points)[:, several])


def share_beyond(count: int, beyond: int) -> float:
    """The share of points beyond a bound that is not exceeded at CONFIDENCE, after so many of `count` random points were beyond it
    (Clopper and Pearson); 1 − 0.05^(1/n) where none was."""
    return 1.0 if beyond == count else float(beta.ppf(CONFIDENCE, beyond + 1, count - beyond))
