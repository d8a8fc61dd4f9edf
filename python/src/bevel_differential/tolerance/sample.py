"""Shares of probability at which all factors are drawn."""

import numpy as np

from ..extras import needed
from ..values import DifferentialError


def check_runs(runs: int) -> int:
    """`runs` if Sobol sequences have that length."""
    if isinstance(runs, bool) or not isinstance(runs, int) or runs < 8 or runs & (runs - 1):
        raise DifferentialError(f"runs = {runs!r}: it is a power of two from 8 on, such as 512, as Sobol sequences have it")
    return runs


def crossed(factors: int, runs: int, seed: int) -> np.ndarray:
    """Shares by the scheme of Saltelli: blocks of rows A, AB_1 … AB_k, B; shape (runs/2 · (factors + 2), factors).

    AB_i is A with the share of factor i from B. A and B are points of one scrambled Sobol sequence."""
    if not factors:
        return np.empty((runs, 0))
    sobol = needed("SALib.sample.sobol", "design")
    problem = _problem(factors)
    return sobol.sample(problem, check_runs(runs) // 2, calc_second_order=False, seed=seed)


def is_drawn(factors: int, rows: int) -> np.ndarray:
    """Which rows of `crossed` are draws of all factors, A and B: shape (rows,)."""
    place = np.arange(rows) % (factors + 2)
    return (place == 0) | (place == factors + 1) if factors else np.ones(rows, bool)


def _problem(factors):
    return {"num_vars": factors, "names": [str(i) for i in range(factors)], "bounds": [[0.0, 1.0]] * factors}


def analyse(factors: int, figures: np.ndarray, seed: int, level: float = 0.95) -> dict[str, np.ndarray]:
    """Sobol indices of figures at `crossed`, shape (rows,): "S1", "ST" and the half widths "S1_conf", "ST_conf" of their
    intervals, shape (factors,)."""
    sobol = needed("SALib.analyze.sobol", "design")
    # SALib takes a seed of 0 for none
    found = sobol.analyze(_problem(factors), figures, calc_second_order=False, num_resamples=500, conf_level=level, seed=seed + 1)
    return {name: np.asarray(found[name]) for name in ("S1", "S1_conf", "ST", "ST_conf")}
