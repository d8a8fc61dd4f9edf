"""Distribution of a figure, and yield, with intervals of 95 % confidence, from which alternatives are evaluated."""

from dataclasses import dataclass
from functools import cache

import numpy as np
from scipy import stats

from .study import Alternative, Draws, Indices, Result, Study

LEVEL = 0.95
QUANTILES = (0.05, 0.5, 0.95, 0.99)
RESAMPLES = 2000


@dataclass(frozen=True)
class Estimate:
    """Value and the ends of its interval; an end is nan if the runs are too few for it."""

    value: float
    low: float
    high: float


@dataclass(frozen=True)
class Spread:
    """Distribution of a figure, SI. `quantiles`: values by share of probability. `runs`: number of values."""

    runs: int
    mean: Estimate
    deviation: Estimate
    quantiles: dict[float, Estimate]

    @classmethod
    def of(cls, figures: np.ndarray, seed: int = 1) -> "Spread | None":
        """Distribution of the figures of runs, shape (runs,), nan if a run failed; None with fewer than two values."""
        sound = figures[np.isfinite(figures)]
        if len(sound) < 2:
            return None
        return cls(len(sound), _resampled(sound, np.mean, seed), _resampled(sound, _deviation, seed),
                   {share: _quantile(sound, share) for share in QUANTILES})


def proportion(good: np.ndarray) -> Estimate:
    """Fraction of good runs, shape (runs,), with the interval of Wilson."""
    count, runs = int(np.sum(good)), len(good)
    return Estimate(count / runs, *_wilson(count, runs))


@cache
def _wilson(count, runs):
    # cached, because it is slow and alternatives often have the same counts
    between = stats.binomtest(count, runs).proportion_ci(LEVEL, method="wilson")
    return between.low, between.high


def gain(before: np.ndarray, after: np.ndarray, cost: float) -> Estimate:
    """Gain Y′ − (1 + cost) Y from yields Y before and Y′ after of paired runs, shape (runs,), with an interval.

    It follows from the fractions of runs that become good, become bad and stay good: p − (1 + cost) q − cost g. Their Wilson intervals
    are combined by the method of variance estimates recovery (Donner and Zou 2012). If no run changes, p and q may still be above 0,
    which widens the interval."""
    parts = [proportion(each) for each in (after & ~before, before & ~after, before & after)]
    weight = np.array([1.0, -(1.0 + cost), -cost])
    value, low, high = (np.array([getattr(part, end) for part in parts]) for end in ("value", "low", "high"))
    rises = weight > 0.0
    middle = float(weight @ value)
    return Estimate(middle, middle - _together(value, weight * np.where(rises, value - low, value - high), weight),
                    middle + _together(value, weight * np.where(rises, high - value, low - value), weight))


def _together(value, reaches, weight):
    """Half width of the weighted sum of mutually exclusive fractions, from the half width of each term, shape (parts,)."""
    odds = np.sqrt(value / np.maximum(1.0 - value, 1e-300))
    correlation = -np.outer(odds, odds)
    np.fill_diagonal(correlation, 1.0)
    signed = np.sign(weight) * reaches
    return float(np.sqrt(max(0.0, signed @ correlation @ signed)))


def _deviation(values, axis=-1):
    return np.std(values, axis=axis, ddof=1)


def _resampled(values, statistic, seed):
    value = float(statistic(values))
    # figures that differ only by rounding have no spread
    if np.ptp(values) <= 1e-12 * np.abs(values).max():
        value = float(values[0]) if statistic is np.mean else 0.0
        return Estimate(value, value, value)
    found = stats.bootstrap((values,), statistic, confidence_level=LEVEL, n_resamples=RESAMPLES, method="percentile",
                            vectorized=True, random_state=np.random.default_rng(seed)).confidence_interval
    return Estimate(value, float(found.low), float(found.high))


def _quantile(values, share):
    # by order statistics, which assume no distribution
    between = stats.quantile_test(values, p=share).confidence_interval(LEVEL)
    return Estimate(float(np.quantile(values, share)), float(between.low), float(between.high))


@dataclass(frozen=True)
class Verdict:
    """Evaluation of an alternative.

    `word`: "worth its money", "not worth its money" or "undecided"; without costs "raises the yield", "lowers the yield" or
    "no change seen". `yield_`: yield of the alternative. `gain`: this yield less (1 + cost) times the yield before. It is above 0 if a
    good differential becomes cheaper, because its price is (1 + cost)/yield if the others are scrapped. `why`: share of the factors in
    a variance."""

    alternative: Alternative
    word: str
    yield_: Estimate
    gain: Estimate
    why: str

    def line(self, before: float) -> str:
        """Text of the evaluation in a line; `before`: the yield with the given tolerances."""
        cost = "" if self.alternative.cost is None else f" at {100.0 * self.alternative.cost:+.3g} % of the price"
        gain = f"{self.gain.value:+.3f} [{self.gain.low:+.3f}, {self.gain.high:+.3f}]"
        return (f"{self.word}: {self.alternative.name}{cost} (yield {self.yield_.value:.3f} for {before:.3f}, gain {gain}"
                f"{'; ' + self.why if self.why else ''})")


def verdicts(study: Study, result: Result) -> list[Verdict]:
    """Evaluations of all alternatives, the best first; none without limits, which define the yield."""
    if not study.limits:
        return []
    found = [_verdict(study, result, one, draws) for one, draws in zip(study.alternatives, result.others)]
    return sorted(found, key=lambda verdict: verdict.gain.value, reverse=True)


def _verdict(study, result, one: Alternative, draws: Draws):
    cost = one.cost or 0.0
    change = gain(result.base.good, draws.good, cost)
    if one.cost is None:
        words = "raises the yield", "lowers the yield", "no change seen"
    else:
        words = "worth its money", "not worth its money", "undecided"
    word = words[0] if change.low > 0.0 else words[1] if change.high < 0.0 else words[2]
    return Verdict(one, word, proportion(draws.good), change, _why(study, result, one))


def _why(study, result, one):
    """Text about the limited figure in whose variance the factors have the largest share."""
    columns = [result.names.index(name) for name in one.factors if name in result.names]
    parts = []
    for limit in study.limits:
        indices = result.indices[str(limit.want)]
        if columns and isinstance(indices, Indices):
            parts.append((float(np.max(indices.total[columns])), str(limit.want)))
    if not parts:
        return ""
    part, want = max(parts)
    return f"it has a part in {100.0 * min(max(part, 0.0), 1.0):.0f} % of the variance of {want}"
