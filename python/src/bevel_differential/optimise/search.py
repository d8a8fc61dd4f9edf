"""Search by pymoo's NSGA-II on the unit cube, one generation at a time, and a folder with all evaluated designs, from which the search
can continue."""

import itertools
import json
from collections import Counter
from collections.abc import Callable
from pathlib import Path

import numpy as np
import pandas as pd
from pymoo.algorithms.moo.nsga2 import NSGA2
from pymoo.core.evaluator import Evaluator
from pymoo.core.problem import Problem as PymooProblem
from pymoo.core.repair import Repair
from pymoo.operators.mutation.pm import PM
from pymoo.operators.sampling.lhs import LHS
from pymoo.problems.static import StaticProblem

from ..designs.farm import Farm
from ..designs.space import Dimension, Space
from ..values import DifferentialError, FileName, Number
from ..writing import whole, write_whole
from .design_task import DesignRow, DesignTask, evaluated
from .front import costs, front, thinned
from .problem import Problem

# index of the distribution of mutations; smaller is wider. Whole numbers need steps as wide as their cells
WIDTH = 8
# cost of an infeasible design
OUT_OF_REACH = 1e30
EVALUATIONS, PROBLEM = "evaluations.parquet", "problem.json"


class Store:
    """Rows of a problem in a folder. `rows`: rows by the values of the design, in order of run."""

    def __init__(self, folder: FileName, problem: Problem, resume: bool = False):
        self.folder, self.problem = Path(folder), problem
        self.rows: dict[tuple[Number, ...], DesignRow] = {}
        if resume:
            self._read()
        elif (self.folder / EVALUATIONS).exists():
            raise DifferentialError(f"{self.folder} has results already: continue with --resume, or name another folder by --out")
        try:
            self.folder.mkdir(parents=True, exist_ok=True)
        except OSError as error:
            raise DifferentialError(f"{self.folder}: {error.strerror}; name another folder by --out", kind="failed") from None
        write_whole(self.folder / PROBLEM, json.dumps({"key": problem.key, "description": problem.description}, indent=1) + "\n")

    def save(self) -> None:
        """Writes all rows."""
        with whole(self.folder / EVALUATIONS) as part:
            pd.DataFrame([row.flat() for row in self.rows.values()]).to_parquet(part, index=False)

    def _read(self):
        try:
            key = json.loads((self.folder / PROBLEM).read_text(encoding="utf-8"))["key"]
            table = pd.read_parquet(self.folder / EVALUATIONS)
        except (OSError, ValueError, KeyError, TypeError) as error:
            raise DifferentialError(f"{self.folder} has no results to continue from ({error}); leave out --resume") from None
        if key != self.problem.key:
            raise DifferentialError(f"{self.folder} has the results of another problem, scene, seed or FMU; name another "
                                    "folder by --out")
        for row in rows_of(table, self.problem.space):
            self.rows[tuple(row.values.values())] = row


def rows_of(table: pd.DataFrame, space: Space) -> list[DesignRow]:
    """Rows from a table that `save` has written."""
    figures = [name for name in table.columns if ":" in name]
    rows = []
    for entry in table.to_dict("records"):
        rows.append(DesignRow(entry["run"], {name: entry[name] for name in space.names},
                              {name: entry[name] for name in figures if pd.notna(entry[name])},
                              feasible=entry["feasible"], message=entry["message"], seconds=entry["seconds"],
                              violation=entry["violation"],
                              refused=tuple(entry["refused"].split("; ")) if entry["refused"] else ()))
    return rows


class _Cells(Repair):
    """Moves shares of whole numbers and lists to the centres of their cells, so that equal designs have equal shares."""

    def __init__(self, space: Space):
        super().__init__()
        self.counts = np.array([_cells(each) for each in space.dimensions], float)

    def _do(self, problem, shares, **_):
        whole = np.isfinite(self.counts)
        counts = self.counts[whole]
        shares[:, whole] = (np.minimum(np.floor(shares[:, whole] * counts), counts - 1.0) + 0.5) / counts
        return shares


def _cells(dimension: Dimension) -> float:
    """Number of values of a dimension; infinite for a range of real numbers."""
    if dimension.kind == "list":
        return len(dimension.numbers)
    return dimension.numbers[1] - dimension.numbers[0] + 1.0 if dimension.whole else np.inf


def search(problem: Problem, farm: Farm, store: Store,
           each: Callable[[int, list[DesignRow]], None] = lambda *_: None) -> list[DesignRow]:
    """Front of all evaluated designs. The store has all designs, after each generation and when the search is interrupted.

    A population settles on few numbers of teeth, so each of several starts begins with new designs; a last start begins with the best
    designs of all. `each(generation, rows)` receives the front so far. Designs in the store are not evaluated again. Raises
    `DifferentialError` if no design is feasible."""
    run = _Run(problem, farm, store, each)
    for start in range(problem.starts):
        run.start(LHS(), problem.seed + start)
    if problem.starts > 1 and run.best:
        run.start(run.shares(thinned(run.best, problem.objectives, problem.population)), problem.seed + problem.starts)
    if not run.best:
        raise DifferentialError(no_design(list(store.rows.values()), problem), kind="finding")
    return run.best


class _Run:
    """Search in progress. `best`: the front so far."""

    def __init__(self, problem, farm, store, each):
        self.problem, self.farm, self.store, self.each = problem, farm, store, each
        self.task, self.best, self.generation = DesignTask(problem), [], 0
        # points of the unit cube by number of the run
        self.known = {}
        self.cube = PymooProblem(n_var=len(problem.space.dimensions), n_obj=len(problem.objectives), n_ieq_constr=1,
                                 xl=0.0, xu=1.0)

    def start(self, sampling, seed):
        """Runs all generations from a first one."""
        algorithm = NSGA2(pop_size=self.problem.population, sampling=sampling, mutation=PM(eta=WIDTH),
                          repair=_Cells(self.problem.space))
        algorithm.setup(self.cube, termination=("n_gen", self.problem.generations), seed=seed, verbose=False)
        while algorithm.has_next():
            asked = algorithm.ask()
            points = asked.get("X")
            rows = _evaluated(self.problem.space.at(points), self.task, self.farm, self.store)
            self.known.update((row.run, point) for row, point in zip(rows, points))
            Evaluator().eval(self._figures(rows), asked)
            algorithm.tell(infills=asked)
            self.best = front(list({row.run: row for row in [*self.best, *rows]}.values()), self.problem.objectives)
            self.generation += 1
            self.each(self.generation, self.best)

    def shares(self, rows):
        """Points of the unit cube from which these rows were evaluated, shape (rows, dimensions)."""
        return np.array([self.known[row.run] for row in rows])

    def _figures(self, rows):
        """Costs and violations for pymoo, which compares infeasible designs only by their violation."""
        cost = np.full((len(rows), len(self.problem.objectives)), OUT_OF_REACH)
        sound = [i for i, row in enumerate(rows) if row.feasible]
        cost[sound] = costs([rows[i] for i in sound], self.problem.objectives)
        return StaticProblem(self.cube, F=cost, G=np.array([[row.violation] for row in rows]))


def _evaluated(designs, task, farm, store):
    """Rows of designs, in their order; new designs are evaluated and stored."""
    keys = [tuple(values.values()) for values in designs]
    new = {key: values for key, values in zip(keys, designs) if key not in store.rows}
    # after an interrupt, some rows of the generation exist: the others get the remaining numbers, as without the interrupt
    taken = {row.run for row in store.rows.values()}
    numbered = list(zip((run for run in itertools.count() if run not in taken), new.values()))
    arrived = []
    try:
        for row in evaluated(farm, task, numbered):
            arrived.append(row)
    finally:
        rows = sorted([*store.rows.values(), *arrived], key=lambda row: row.run)
        store.rows = {tuple(row.values.values()): row for row in rows}
        if arrived:
            store.save()
    return [store.rows[key] for key in keys]


def _reason(row):
    return [f"It does not run: {row.message}"] if row.message else []


def described(row: DesignRow, problem: Problem) -> list[str]:
    """Lines with the values and figures of a design, in display units."""
    catalogue = problem.scene.fmu
    values = {name: catalogue.variable(name).text(value) for name, value in row.values.items()}
    figures = {str(want).removesuffix(":final"): want.quantity(catalogue).text(row.figures[str(want)]) for want in problem.wants
               if str(want) in row.figures}
    return [f"  {name} = {text}" for name, text in (*values.items(), *figures.items())]


def no_design(rows: list[DesignRow], problem: Problem) -> str:
    """Message if no design is feasible: the number of designs that each check refuses, and the nearest design with its values."""
    counts = Counter(check for row in rows for check in row.refused)
    lines = [f"  {count:6d}  {check}" for check, count in counts.most_common()]
    with DesignTask(problem, thorough=True) as task:
        nearest = task.evaluate(-1, min(rows, key=lambda row: row.violation).values)
    return "\n".join([f"no feasible design among {len(rows)}. Designs refused by each check:", *lines,
                      f"The nearest one fails in: {'; '.join(nearest.refused)}.", *described(nearest, problem), *_reason(nearest),
                      "Widen the ranges of [vary], loosen these conditions, or let more generations search."])
