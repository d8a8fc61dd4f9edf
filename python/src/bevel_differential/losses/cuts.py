"""Cuts through a map: a few of its lines, and what lies along an axis."""

import numpy as np

from .loss_map import LossMap

# points of a curve
POINTS = 60


def some(line: np.ndarray, most: int) -> np.ndarray:
    """Positions of at most so many lines of an axis, its ends among them."""
    return np.unique(np.linspace(0, len(line) - 1, most).round().astype(int))


def along(made: LossMap, axis: int, fixed: np.ndarray, sign: float) -> tuple[np.ndarray, np.ndarray]:
    """Values of an axis, and torques left and right and loss there, shape (POINTS, 3), with the other axes at `fixed`, a point whose
    difference has the direction `sign`."""
    at = np.linspace(made.lines[axis][0], made.lines[axis][-1], POINTS)
    points = np.tile(np.asarray(fixed, float), (POINTS, 1))
    points[:, axis] = at
    points[:, 2] *= sign
    return at, made.at(points)
