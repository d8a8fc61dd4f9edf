"""Cuts through a map: some of its lines, and its values along an axis."""

import numpy as np

from .loss_map import LossMap

# number of points of a curve
POINTS = 60


def some(line: np.ndarray, most: int) -> np.ndarray:
    """Positions of at most `most` lines of an axis, including its ends."""
    return np.unique(np.linspace(0, len(line) - 1, most).round().astype(int))


def along(result: LossMap, axis: int, fixed: np.ndarray, sign: float) -> tuple[np.ndarray, np.ndarray]:
    """Values of an axis, with torques left and right and loss at them, shape (POINTS, 3). The other axes are at the point `fixed`, whose
    difference has the direction `sign`."""
    at = np.linspace(result.lines[axis][0], result.lines[axis][-1], POINTS)
    points = np.tile(np.asarray(fixed, float), (POINTS, 1))
    points[:, axis] = at
    points[:, 2] *= sign
    return at, result.at(points)
