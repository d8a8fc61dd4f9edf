"""Lines of a map, and new lines where it has curvature.

The map is linear between lines in each of its axes, as the tables of system models are. If a line is left out, its neighbours
predict the values on it with the error 1/2 |f''| h1 h2, where h1 and h2 are the distances to the neighbours. This gives the
curvature f'', and the curvature gives the error 1/8 |f''| h² in the middle of an interval. The errors of all axes add up.
Intervals with the largest errors are halved. The true error is measured at points that were not used for the map.

Interpolation uses torques instead of powers: a drag that grows with speed is a straight line, but its power is a parabola. Points
are carrier torque T, speed ω, difference of speeds Δ and temperature. From the wheel torques T_L and T_R and the loss P the map
calculates

    M = T_L − T_R,  Q = T − T_L − T_R,  D = (P + M Δ/2) / (|ω| + |Δ|/2)

the locking torque, the drag on shafts, and the loss other than by slip: P = −M Δ/2 + D (|ω| + |Δ|/2)."""

import math
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from ..extras import require

# smallest number of lines of an axis that show curvature
LEAST = 3
# sum over all axes of the largest error over its bound, below which the map is accurate enough
GOAL = 1.0
# an interval shorter than this fraction of its axis is not halved, because the map jumps there
SHORTEST = 1e-3
# confidence of the measured bound
CONFIDENCE = 0.95


@dataclass(frozen=True)
class Bound:
    """Largest allowed error: a fraction of the value plus a torque [N·m]. For power, the torque acts at the speeds of carrier and
    planets."""

    part: float = 0.02
    torque: float = 0.1

    def of_torques(self, figures: np.ndarray, points: np.ndarray) -> np.ndarray:
        """Bounds of M, Q and D [N·m] that ensure those of T_L, T_R and P: half of Q is in each of the wheels' torques."""
        bounds = self.part * np.abs(torques_of(figures, points)) + self.torque
        bounds[..., 1] = 2.0 * (self.part * np.abs(figures[..., :2]).min(axis=-1) + self.torque)
        return bounds

    def of_figures(self, figures: np.ndarray, points: np.ndarray) -> np.ndarray:
        """Bounds of T_L, T_R [N·m] and P [W]. `figures` and `points` are along the last axis."""
        return self.part * np.abs(figures) + self.torque * np.stack([np.ones(points.shape[:-1])] * 2 + [_speed(points)], axis=-1)

    def __str__(self) -> str:
        return f"{100.0 * self.part:g} % + {self.torque:g} N.m"


def torques_of(figures: np.ndarray, points: np.ndarray) -> np.ndarray:
    """M, Q and D from T_L, T_R and P at points, all along the last axis; D is 0 at standstill."""
    left, right, loss = np.moveaxis(figures, -1, 0)
    locking, speed = left - right, _speed(points)
    lost = np.divide(loss + 0.5 * locking * points[..., 2], speed, out=np.zeros_like(speed), where=speed > 0.0)
    return np.stack([locking, points[..., 0] - left - right, lost], axis=-1)


def figures_of(torques: np.ndarray, points: np.ndarray) -> np.ndarray:
    """T_L, T_R and P from M, Q and D at points, all along the last axis."""
    locking, dragging, lost = np.moveaxis(torques, -1, 0)
    total = points[..., 0] - dragging
    return np.stack([0.5 * (total + locking), 0.5 * (total - locking), lost * _speed(points) - 0.5 * locking * points[..., 2]], axis=-1)


def efficiency(points: np.ndarray, figures: np.ndarray) -> np.ndarray:
    """Output power over input power, in the direction in which the power flows; 1 if the input power is zero.

    `points` and `figures` (T_L, T_R and P) are along the last axis. If torque and speed have opposite signs, the wheels are the input,
    so that the carrier delivers |T ω| of |T ω| + P."""
    left, right, loss = np.moveaxis(figures, -1, 0)
    torque, speed, difference, _ = np.moveaxis(points, -1, 0)
    powers = (torque * speed, -left * (speed + 0.5 * difference), -right * (speed - 0.5 * difference))
    fed = sum(np.maximum(power, 0.0) for power in powers)
    return 1.0 - np.divide(np.maximum(loss, 0.0), fed, out=np.zeros_like(fed), where=fed > 0.0)


def _speed(points):
    return np.abs(points[..., 1]) + 0.5 * np.abs(points[..., 2])


def starting(levels: Sequence[float]) -> np.ndarray:
    """Initial lines of an axis: the given ones, 0 if it is between them, and enough lines to detect curvature."""
    lines = np.unique(np.asarray(levels, float))
    if lines[0] < 0.0 < lines[-1]:
        lines = np.union1d(lines, [0.0])
    while 1 < len(lines) < LEAST:
        lines = np.union1d(lines, 0.5 * (lines[1:] + lines[:-1]))
    return lines


def grid_points(lines: Sequence[np.ndarray]) -> np.ndarray:
    """Points at all crossings of the lines, shape (lines of each axis, axes)."""
    return np.stack(np.meshgrid(*lines, indexing="ij"), axis=-1)


def estimates(lines: Sequence[np.ndarray], values: np.ndarray, bounds: np.ndarray) -> list[np.ndarray]:
    """Largest error over its bound in each interval of each axis. `values` and `bounds`: shape (sheets, lines of each axis,
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
    """Lines with the worst intervals halved. If this gives more than `most` crossings, only the worst interval is halved. Returns None
    if the map is accurate enough or has its maximum size."""
    worst = [errors.max(initial=0.0) for errors in found]
    if sum(worst) <= GOAL:
        return None
    for part in (0.5, 1.0):
        new = [_halved(at, errors >= part * max(worst)) for at, errors in zip(lines, found)]
        if size(lines) < size(new) <= most:
            return new
    return None


def size(lines: Sequence[np.ndarray]) -> int:
    """Number of crossings of the lines."""
    return math.prod(map(len, lines))


def _halved(at, where):
    where = where & (np.diff(at) > SHORTEST * (at[-1] - at[0]))
    return np.union1d(at, 0.5 * (at[1:] + at[:-1])[where])


def interpolated(lines: Sequence[np.ndarray], values: np.ndarray, points: np.ndarray) -> np.ndarray:
    """Values at points by linear interpolation between lines, shape (points, figures). `values`: shape (lines of each axis, figures).
    Along an axis with one line, values are constant."""
    several = [axis for axis, at in enumerate(lines) if len(at) > 1]
    kept = values.reshape([len(lines[axis]) for axis in several] + [values.shape[-1]])
    if not several:
        return np.broadcast_to(kept, (len(points), values.shape[-1]))
    # this import takes a second, so workers that do not need it skip it
    interpolate = require("scipy.interpolate", "sweep")
    return interpolate.RegularGridInterpolator([lines[axis] for axis in several], kept)(np.asarray(points)[:, several])


def share_beyond(count: int, beyond: int) -> float:
    """Share of points beyond a bound that is not exceeded at CONFIDENCE, if `beyond` of `count` random points are beyond the bound
    (Clopper and Pearson); 1 − 0.05^(1/n) if none is."""
    beta = require("scipy.stats", "sweep").beta
    return 1.0 if beyond == count else float(beta.ppf(CONFIDENCE, beyond + 1, count - beyond))
