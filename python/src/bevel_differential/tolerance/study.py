"""Study of tolerances: drawn differentials by shares of probability, their runs and results."""

from collections.abc import Callable, Sequence
from dataclasses import dataclass, field

import numpy as np

from ..designs import Row
from ..extras import require
from ..values import DifferentialError
from ..want import Condition, Want
from .factor import Factor


@dataclass(frozen=True)
class Alternative:
    """Other tolerances of some factors, by variable. `cost`: their additional cost as a fraction of the price of a differential; None
    if it is not known."""

    name: str
    factors: dict[str, Factor]
    cost: float | None = None


@dataclass(frozen=True)
class Draws:
    """Results of drawn differentials.

    `figures`: by want, SI, shape (runs,), nan if a run failed. `good`: true for runs that succeeded and are within all limits, shape
    (runs,). `failures`: messages of failed runs."""

    figures: dict[str, np.ndarray]
    good: np.ndarray
    failures: list[str]


@dataclass(frozen=True)
class Indices:
    """Sobol indices of a figure for each factor that varies, with the half widths of their intervals; shape (factors,).

    `first`: fraction of the variance that the factor causes by itself; `total`: fraction to which it contributes."""

    first: np.ndarray
    first_half: np.ndarray
    total: np.ndarray
    total_half: np.ndarray


@dataclass(frozen=True)
class Result:
    """Result of a study.

    `names`: factors that vary, in the order of the indices. `indices`: by want, or the reason why there are none. `others`: draws of
    each alternative, in their order. `rows`: all runs, in order of run."""

    names: list[str]
    base: Draws
    indices: dict[str, Indices | str]
    others: list[Draws]
    rows: list[Row] = field(repr=False)


class Study:
    """Study with tolerances, wanted figures and alternatives.

    `runs`: number of draws of all factors together, a power of two; indices need half of this number more for each factor that varies.
    `limits` must be on wanted figures. Alternatives are drawn at the same shares of probability: if a factor keeps its tolerance, its
    values are the same, run by run."""

    def __init__(self, factors: Sequence[Factor], wants: Sequence[Want], limits: Sequence[Condition] = (),
                 alternatives: Sequence[Alternative] = (), runs: int = 512, seed: int = 1, indices: bool = True):
        self.factors, self.wants, self.limits = {factor.variable: factor for factor in factors}, list(wants), list(limits)
        self.alternatives, self.runs, self.indices = list(alternatives), check_runs(runs), indices
        if isinstance(seed, bool) or not isinstance(seed, int) or seed < 0:
            raise DifferentialError(f"seed = {seed!r}: it is a whole number from 0 on")
        self.seed = seed
        if not self.factors:
            raise DifferentialError("nothing has a tolerance: name factors, such as geometry.backlash = \"0.1 mm +- 0.02 mm\"")
        if not self.wants:
            raise DifferentialError("nothing is wanted: name an output and a statistic, such as torque_bias_ratio:mean")
        for limit in self.limits:
            if limit.want not in self.wants:
                known = ", ".join(map(str, self.wants))
                raise DifferentialError(f"limit {limit}: {limit.want} is not wanted; wanted are {known}")
        for one in self.alternatives:
            for name in one.factors.keys() - self.factors.keys():
                raise DifferentialError(f"alternative {one.name!r}: {name} is not one of the factors {', '.join(self.factors)}")

    @property
    def names(self) -> list[str]:
        """Factors that vary, in the study or in an alternative."""
        sets = [self.factors, *(one.factors for one in self.alternatives)]
        return [name for name in self.factors if any(name in each and each[name].law.varies for each in sets)]

    def designs(self) -> list[tuple[int, dict]]:
        """All runs, numbered: the scheme of `crossed`, then the draws of each alternative."""
        shares, drawn = self._shares()
        kept = shares if self.indices else shares[drawn]
        designs = self._values(self.factors, kept)
        for one in self.alternatives:
            designs += self._values({**self.factors, **one.factors}, shares[drawn])
        return list(enumerate(designs))

    def run(self, evaluate: Callable[[list], list[Row]]) -> Result:
        """Result of the study. `evaluate` receives numbered designs [(run, values)] and returns a row for each, in order of run."""
        rows = list(evaluate(self.designs()))
        _, drawn = self._shares()
        first = len(drawn) if self.indices else self.runs
        scheme = rows[:first]
        base = self._draws([row for row, is_draw in zip(scheme, drawn) if is_draw] if self.indices else scheme)
        others = [self._draws(rows[begin:begin + self.runs]) for begin in range(first, len(rows), self.runs)]
        indices = {str(want): self._analysed(scheme, str(want)) for want in self.wants}
        return Result(self.names, base, indices, others, rows)

    def _shares(self):
        shares = crossed(len(self.names), self.runs, self.seed)
        return shares, is_drawn(len(self.names), len(shares))

    def _values(self, factors, shares):
        column = {name: shares[:, i] for i, name in enumerate(self.names)}
        nowhere = np.full(len(shares), 0.5)
        values = {name: factor.at(column.get(name, nowhere)) for name, factor in factors.items()}
        return [dict(zip(values, row)) for row in zip(*values.values())]

    def _draws(self, rows):
        figures = {str(want): _figures(rows, str(want)) for want in self.wants}
        good = [bool(row.figures) and all(limit.holds(row.figures.get(str(limit.want), np.nan)) for limit in self.limits) for row in rows]
        return Draws(figures, np.array(good), [row.message for row in rows if row.message])

    def _analysed(self, rows, want):
        if not self.indices:
            return "not requested"
        figures = _figures(rows, want)
        missing = np.sum(~np.isfinite(figures))
        if missing:
            return f"none, because {missing} of {len(rows)} runs failed: make tolerances narrower, or the scene more robust"
        if np.ptp(figures) <= 1e-10 * np.abs(figures).max():
            return "none, because the figure does not vary"
        return analyse(len(self.names), figures, self.seed)


def _figures(rows, want):
    return np.array([row.figures.get(want, np.nan) for row in rows], float)


def check_runs(runs: int) -> int:
    """Returns `runs` if it is a length of Sobol sequences."""
    if isinstance(runs, bool) or not isinstance(runs, int) or runs < 8 or runs & (runs - 1):
        raise DifferentialError(f"runs = {runs!r}: it is a power of two, 8 or more, such as 512, because Sobol sequences have such lengths")
    return runs


def crossed(factors: int, runs: int, seed: int) -> np.ndarray:
    """Shares by Saltelli's scheme: blocks of rows A, AB_1 … AB_k, B; shape (runs/2 · (factors + 2), factors).

    AB_i is A with the share of factor i from B. A and B are points of one scrambled Sobol sequence."""
    if not factors:
        return np.empty((runs, 0))
    sobol = require("SALib.sample.sobol", "design")
    problem = _problem(factors)
    return sobol.sample(problem, check_runs(runs) // 2, calc_second_order=False, seed=seed)


def is_drawn(factors: int, rows: int) -> np.ndarray:
    """True for rows of `crossed` that are draws of all factors (A and B), shape (rows,)."""
    index = np.arange(rows) % (factors + 2)
    return (index == 0) | (index == factors + 1) if factors else np.ones(rows, bool)


def _problem(factors):
    return {"num_vars": factors, "names": [str(i) for i in range(factors)], "bounds": [[0.0, 1.0]] * factors}


def analyse(factors: int, figures: np.ndarray, seed: int, level: float = 0.95) -> Indices:
    """Sobol indices from the figures at `crossed`, shape (rows,)."""
    sobol = require("SALib.analyze.sobol", "design")
    # SALib treats a seed of 0 as no seed
    found = sobol.analyze(_problem(factors), figures, calc_second_order=False, num_resamples=500, conf_level=level, seed=seed + 1)
    return Indices(*(np.asarray(found[name]) for name in ("S1", "S1_conf", "ST", "ST_conf")))
