"""The search: NSGA-II of pymoo on the unit cube, a generation at a time."""

from collections import Counter
from collections.abc import Callable

import numpy as np
from pymoo.algorithms.moo.nsga2 import NSGA2
from pymoo.core.evaluator import Evaluator
from pymoo.core.problem import Problem as PymooProblem
from pymoo.core.repair import Repair
from pymoo.operators.mutation.pm import PM
from pymoo.operators.sampling.lhs import LHS
from pymoo.problems.static import StaticProblem

from ..designs.space import Dimension, Space
from ..values import DifferentialError
from .design_task import DesignRow, DesignTask
from .front import costs, front
from .problem import Problem
from .store import Store

# index of the distribution of mutations, less is wider: whole numbers need steps as wide as their cells
WIDTH = 8


class _Cells(Repair):
    """Moves shares of whole numbers and lists to the middles of their cells, so that equal designs are seen to be equal."""

    def __init__(self, space: Space):
        super().__init__()
        self.counts = np.array([_cells(each) for each in space.dimensions], float)

    def _do(self, problem, shares, **_):
        whole = np.isfinite(self.counts)
        counts = self.counts[whole]
        shares[:, whole] = (np.minimum(np.floor(shares[:, whole] * counts), counts - 1.0) + 0.5) / counts
        return shares


def _cells(dimension: Dimension) -> float:
    """How many values a dimension has; infinite for a range of real numbers."""
    if dimension.kind == "list":
        return len(dimension.numbers)
    return dimension.numbers[1] - dimension.numbers[0] + 1.0 if dimension.whole else np.inf


def search(problem: Problem, farm, store: Store,
           each: Callable[[int, list[DesignRow]], None] = lambda *_: None) -> list[DesignRow]:
    """The front of all designs evaluated; the store has them all, after each generation and where the search is interrupted.

    `each(generation, rows)` is told of the front so far. What the store knows is not evaluated again. Raises where no design is
    feasible."""
    space, objectives = problem.space, problem.objectives
    task = DesignTask(problem)
    cube = PymooProblem(n_var=len(space.dimensions), n_obj=len(objectives), n_ieq_constr=1, xl=0.0, xu=1.0)
    algorithm = NSGA2(pop_size=problem.population, sampling=LHS(), mutation=PM(eta=WIDTH), repair=_Cells(space))
    algorithm.setup(cube, termination=("n_gen", problem.generations), seed=problem.seed, verbose=False)
    best: list[DesignRow] = []
    generation = 0
    while algorithm.has_next():
        generation += 1
        asked = algorithm.ask()
        rows = _evaluated(space.at(asked.get("X")), task, farm, store)
        cost = np.full((len(rows), len(objectives)), np.inf)
        sound = [i for i, row in enumerate(rows) if row.feasible]
        cost[sound] = costs([rows[i] for i in sound], objectives)
        # pymoo compares infeasible designs by their violation alone
        static = StaticProblem(cube, F=np.where(np.isfinite(cost), cost, 1e30), G=np.array([[row.violation] for row in rows]))
        Evaluator().eval(static, asked)
        algorithm.tell(infills=asked)
        best = front(list({row.run: row for row in [*best, *rows]}.values()), objectives)
        each(generation, best)
    if not best:
        raise DifferentialError(no_design(list(store.rows.values())))
    return best


def _evaluated(designs, task, farm, store):
    """Rows of designs, in their order; new ones are evaluated and stored."""
    keys = [tuple(values.values()) for values in designs]
    new = {key: values for key, values in zip(keys, designs) if key not in store.rows}
    numbered = [(len(store.rows) + k, values) for k, values in enumerate(new.values())]
    arrived = []
    try:
        for row in farm.rows(task, numbered):
            arrived.append(row)
    finally:
        store.rows.update((tuple(row.values.values()), row) for row in sorted(arrived, key=lambda row: row.run))
        if arrived:
            store.save()
    return [store.rows[key] for key in keys]


def no_design(rows: list[DesignRow]) -> str:
    """What to say where no design is feasible: which checks refuse how many."""
    counts = Counter(check for row in rows for check in row.refused)
    lines = [f"  {count:6d}  {check}" for check, count in counts.most_common()]
    nearest = min(rows, key=lambda row: row.violation)
    return "\n".join([f"no feasible design among {len(rows)}. So many were refused by:", *lines,
                      f"The nearest one fails in: {'; '.join(nearest.refused)}.",
                      "Widen the ranges of [vary], loosen these conditions, or let more generations search."])
