"""Distribution of a figure, and yield, with intervals of 95 % confidence."""

from dataclasses import dataclass

import numpy as np
from scipy import stats

LEVEL = 0.95
QUANTILES = (0.05, 0.5, 0.95, 0.99)
RESAMPLES = 2000


@dataclass(frozen=True)
class Estimate:
    """A value and the ends of its interval; an end is nan where the runs are too few for one."""

    value: float
    low: float
    high: float


@dataclass(frozen=True)
class Spread:
    """How a figure is spread, SI. `quantiles`: by share of probability. `runs`: how many it is from."""

    runs: int
    mean: Estimate
    deviation: Estimate
    quantiles: dict[float, Estimate]

    @classmethod
    def of(cls, figures: np.ndarray, seed: int = 1) -> "Spread | None":
        """Of figures of runs, shape (runs,), nan where a run failed; None with fewer than two."""
        sound = figures[np.isfinite(figures)]
        if len(sound) < 2:
            return None
        return cls(len(sound), _resampled(sound, np.mean, seed), _resampled(sound, _deviation, seed),
                   {share: _quantile(sound, share) for share in QUANTILES})


def proportion(good: np.ndarray) -> Estimate:
    """Part of runs that are good, shape (runs,), with the interval of Wilson."""
    count, runs = int(np.sum(good)), len(good)
    between = stats.binomtest(count, runs).proportion_ci(LEVEL, method="wilson")
    return Estimate(count / runs, between.low, between.high)


def mean_of_pairs(differences: np.ndarray, seed: int = 1) -> Estimate:
    """Mean of differences between runs that are alike but for one tolerance, shape (runs,)."""
    return _resampled(differences, np.mean, seed)


def _deviation(values, axis=-1):
    return np.std(values, axis=axis, ddof=1)


def _resampled(values, statistic, seed):
    value = float(statistic(values))
    # figures that differ by rounding alone have no spread
    if np.ptp(values) <= 1e-12 * np.abs(values).max():
        value = float(values[0]) if statistic is np.mean else 0.0
        return Estimate(value, value, value)
    found = stats.bootstrap((values,), statistic, confidence_level=LEVEL, n_resamples=RESAMPLES, method="percentile",
                            vectorized=True, random_state=np.random.default_rng(seed)).confidence_interval
    return Estimate(value, float(found.low), float(found.high))


def _quantile(values, share):
    # by order statistics, which need no distribution
    between = stats.quantile_test(values, p=share).confidence_interval(LEVEL)
    return Estimate(float(np.quantile(values, share)), float(between.low), float(between.high))
