"""When the teeth of a mesh are in the lash."""

import numpy as np


def bands(times: np.ndarray, force: np.ndarray) -> list[tuple[float, float]]:
    """Stretches of time (s) in which a mesh carries nothing, neither on its drive nor on its coast flanks.

    `force`: normal force of the mesh at `times`, N; a mesh in the lash has exactly none. A stretch reaches to the middle between
    points with and without load, as more is not known."""
    free = force == 0.0
    edges = np.flatnonzero(np.diff(free.astype(int)))
    middles = 0.5 * (times[edges] + times[edges + 1])
    ends = np.concatenate([[times[0]] if free[0] else [], middles, [times[-1]] if free[-1] else []])
    return [(float(begin), float(end)) for begin, end in ends.reshape(-1, 2)]


def share(times: np.ndarray, found: list[tuple[float, float]]) -> float:
    """Part of the time that they take."""
    return sum(end - begin for begin, end in found) / (times[-1] - times[0])
