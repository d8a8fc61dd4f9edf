"""Plans: selections of designs from a space."""

import math
from dataclasses import dataclass

import numpy as np

from ..extras import require
from ..values import DifferentialError, Number, suggestion
from .space import Space

KINDS = {"grid": "all combinations of lists and ranges", "lhs": "a Latin hypercube", "sobol": "a scrambled Sobol sequence",
         "random": "Monte Carlo"}
SHORT = {"latin_hypercube": "lhs", "latin": "lhs", "monte_carlo": "random", "mc": "random"}
# more runs than this are probably a mistake
MOST_RUNS = 10_000_000


@dataclass(frozen=True)
class Plan:
    """Plan of one kind.

    `kind`: a key of KINDS. `runs`: number of designs: all combinations for a grid, a power of two for Sobol. `seed`: seed of all
    draws. Random designs and the seeds of a run depend only on this seed and the number of the run, not on the workers or on the
    number of runs."""

    space: Space
    kind: str
    runs: int
    seed: int

    @classmethod
    def parse(cls, space: Space, kind: str, runs: int | None = None, seed: int = 0) -> "Plan":
        """Plan of the named kind. Rounds `runs` up to a power of two for Sobol."""
        kind = SHORT.get(kind, kind)
        if kind not in KINDS:
            raise DifferentialError(f"there is no plan {kind!r}{suggestion(kind, KINDS)}; known: {', '.join(KINDS)}")
        if seed != int(seed) or seed < 0:
            raise DifferentialError(f"seed = {seed!r}: it is a whole number, 0 or more")
        counted = next((one for one in space.dimensions if one.count is not None), None)
        if kind != "grid" and counted is not None:
            raise DifferentialError(f"{counted.variable}: plan {kind} draws from the whole range; leave the count "
                                    f"{counted.count} out, or choose the plan grid")
        if kind == "grid":
            runs = _size_of_grid(space, runs)
        elif runs is None or runs != int(runs) or runs < 1:
            raise DifferentialError(f"plan {kind}: name the number of runs, 1 or more")
        if kind == "sobol":
            # only a power of two fills the space evenly
            runs = 2 ** math.ceil(math.log2(runs))
        if runs > MOST_RUNS:
            raise DifferentialError(f"plan {kind}: {runs} runs are more than {MOST_RUNS}")
        return cls(space, kind, int(runs), int(seed))

    def designs(self) -> list[tuple[int, dict[str, Number]]]:
        """All designs: [(run, {name: value in SI})]."""
        planned, seeds = _split(self.space)
        designs = planned.grid() if self.kind == "grid" else planned.at(self._shares(len(planned.dimensions)))
        return [(run, self._with_seeds(run, values, seeds)) for run, values in enumerate(designs)]

    def _shares(self, size):
        """Points of the unit cube, shape (runs, size)."""
        if size == 0:
            return np.empty((self.runs, 0))
        if self.kind == "random":
            return np.array([_generator(self.seed, run).random(size) for run in range(self.runs)])
        qmc = require("scipy.stats.qmc", "sweep")
        engine = {"lhs": qmc.LatinHypercube, "sobol": qmc.Sobol}[self.kind]
        return engine(size, rng=np.random.default_rng(self.seed)).random(self.runs)

    def _with_seeds(self, run, values, seeds):
        if not seeds.dimensions:
            return values
        # a separate branch: the seeds do not depend on the other variables that are drawn
        drawn = seeds.at(_generator(self.seed, run, 1).random((1, len(seeds.dimensions))))[0]
        return {name: {**values, **drawn}[name] for name in self.space.names}


def _generator(root, *key):
    return np.random.default_rng(np.random.SeedSequence(root, spawn_key=key))


def _split(space):
    """Dimensions that the plan sets, and dimensions whose values each run draws."""
    own = tuple(one for one in space.dimensions if one.kind == "seed")
    return Space(tuple(one for one in space.dimensions if one.kind != "seed")), Space(own)


def _size_of_grid(space, runs):
    size = math.prod(one.size() for one in _split(space)[0].dimensions)
    if runs not in (None, size):
        raise DifferentialError(f"this grid has {size} runs, not {runs}: leave the number out")
    return size
