"""Evaluation of a design in an optimisation: checks of its dimensions first, then the run. Designs of a front run again with richer
models of the same scene."""

import math
from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass

import numpy as np

from ..designs.farm import Farm
from ..designs.task import Row, Task
from ..pair import Pair, violations
from ..quantities import QUANTITIES
from ..values import DifferentialError, Number
from ..want import ANGLES, Condition, Statistic, Want
from .problem import Problem

# prefixes of warnings that a design must not cause: gears, pins and washers that do not fit
REFUSED_WARNINGS = ("geometry.", "thrust_friction.")
# outputs of effects.mesh_history are 0 until a whole mesh cycle has passed
HISTORY = "_peak_to_peak"
# points at which loads of pins and washers are read in a run, because each costs about half a step of the solver; and the largest part
# of a mesh cycle between two points, so that no peak is missed
POINTS, FINEST = 128, 1.0 / 32.0
# a figure below this fraction of another one counts as zero, so that there is no relative difference
VANISHES = 1e-9


@dataclass
class DesignRow(Row):
    """Design of an optimisation and its results. `violation`: 0 for a feasible design; of two others, the one with the smaller violation
    is nearer to a feasible design. `refused`: names of the checks that refuse it."""

    violation: float = 0.0
    refused: tuple[str, ...] = ()

    def flat(self) -> dict:
        """Design as a row of a table."""
        return {"run": self.run, **self.values, **self.figures, "feasible": self.feasible, "message": self.message,
                "seconds": self.seconds, "violation": self.violation, "refused": "; ".join(self.refused)}


class DesignTask(Task):
    """Scene of a problem, with all wants of the problem.

    A design goes through these stages: gears that can be built; conditions on dimensions; the run; conditions on figures. A design
    that fails in one stage skips the others, which saves the run, unless `thorough`. A design that fails in a later stage is nearer to
    a feasible one."""

    def __init__(self, problem: Problem, thorough: bool = False):
        self.problem, self.thorough = problem, thorough
        self.wanted = problem.wants
        self.on_dimensions = [each for each in problem.conditions if _on_dimensions(each.want)]
        self.on_figures = [each for each in problem.conditions if not _on_dimensions(each.want)]
        final = Statistic("final")
        simulated = [want for want in self.wanted if want.name not in QUANTITIES]
        quantities = [QUANTITIES[want.name] for want in self.wanted if want.name in QUANTITIES]
        simulated += [Want(name, final) for quantity in quantities for name in quantity.outputs]
        self.loads = list(dict.fromkeys(name for quantity in quantities for name in quantity.loads))
        super().__init__(problem.scene, simulated or [Want("geometry.contact_ratio", final)])
        self.known = problem.known({})

    def evaluate(self, run: int, values: Mapping[str, Number]) -> DesignRow:
        """Evaluates a design."""
        row = DesignRow(run, dict(values)).filled(self._judge)
        if row.message:
            self.failed(row)
        row.feasible = not row.refused
        return row

    def failed(self, row: Row) -> DesignRow:
        """Row of a design without figures, for the reason in its message."""
        found = row if isinstance(row, DesignRow) else DesignRow(row.run, row.values, message=row.message)
        self._fails(found, {_refusal(found.message): 1.0}, 1)
        return found

    def _judge(self, row):
        complete = self.problem.complete(row.values)
        known = {**self.known, **complete}
        pair = Pair.of(known)
        found = violations(pair)
        if self._fails(row, found, 3):
            return
        for want in filter(_on_dimensions, self.wanted):
            row.figures[str(want)] = QUANTITIES[want.name].of(known, pair)
        if self._fails(row, _broken(self.on_dimensions, row.figures), 2):
            return
        known.update(self._simulated(row, complete))
        for want in self.wanted:
            if str(want) not in row.figures:
                row.figures[str(want)] = QUANTITIES[want.name].of(known, pair)
        self._fails(row, _broken(self.on_figures, row.figures), 0)

    def _simulated(self, row, complete):
        """Runs the scene and adds its figures to the row. Returns outputs by name."""
        figures, loads = self._run(complete)
        if self.undefined:
            raise DifferentialError("; ".join(self.undefined))
        row.warnings = tuple(self.scene.warnings)
        row.figures.update((str(want), figures[str(want)]) for want in self.wanted if want.name not in QUANTITIES)
        without = [name for name in figures if name.endswith(f"{HISTORY}:final") and figures[name] == 0.0]
        if without:
            raise DifferentialError(f"{without[0].partition(':')[0]}: no whole mesh cycle passes; let the scene run longer, or "
                                    "faster")
        warned = [text for text in self.scene.warnings
                  if text.startswith(REFUSED_WARNINGS) and text.partition(":")[0] not in self.scene.unfelt
                  # the checks of the dimensions may already have found it
                  and (not row.refused or text.startswith("geometry.root_fillet"))]
        self._fails(row, {_refusal(text): 1.0 for text in warned}, 0)
        return {**{name.rpartition(":")[0]: value for name, value in figures.items()}, **loads}

    def _run(self, complete):
        """Runs the scene. Returns figures by want, and the largest value of each load since rating began, by output."""
        if not self.loads:
            return self._figures(complete), {}
        scene, is_short = self.scene, self._only_final() and not self.scene.tables
        step = max(scene.step, scene.stop / POINTS) if is_short else scene.step
        outputs = dict.fromkeys([ANGLES["mesh"], "geometry.planet_teeth", *self.loads, *([] if is_short else self._recorded())])
        record = scene._record(list(outputs), complete, step=step)
        self.undefined = []
        figures = self._final_figures() if is_short else self._statistics(record)
        cycles = np.abs(np.diff(record[ANGLES["mesh"]])).max(initial=0.0) * record["geometry.planet_teeth"][0] / (2.0 * np.pi)
        # a shorter step changes the motion only if inputs are held within steps
        if cycles > FINEST and (scene.input_slopes or not scene.tables):
            record = scene._record(self.loads, complete, step=step / math.ceil(cycles / FINEST))
        rated_from = {**self.known, **complete}["strength.rate_from"]
        rated = record[record["time"] >= min(rated_from, record["time"][-1])]
        return figures, {name: float(rated[name].max()) for name in self.loads}

    def _final_figures(self):
        """Figures at the end of the last run, if all of them are final values."""
        names = [want.name for want in self.figures]
        return {str(want): float(value) for want, value in zip(self.figures, self.scene._instance().read(names))}

    def _fails(self, row, found, stage):
        """Adds violations to the row. Returns true if the evaluation of the design ends here."""
        if not found:
            return False
        row.refused += tuple(found)
        # the lowest violation in a stage is above the sum of all violations in later stages
        least = stage * (len(self.problem.conditions) + len(REFUSED_WARNINGS) + 1.0)
        # each violation counts less than 1, so that a large one does not hide the others
        row.violation = max(row.violation, least) + sum(excess / (1.0 + excess) for excess in found.values())
        return not self.thorough


def _on_dimensions(want: Want) -> bool:
    return want.name in QUANTITIES and QUANTITIES[want.name].is_dimension


def _broken(conditions: list[Condition], figures: Mapping) -> dict[str, float]:
    """Relative excess of each condition that is not met, by condition."""
    broken = {}
    for each in conditions:
        figure = figures[str(each.want)]
        if not each.holds(figure):
            excess = each.excess(figure)
            broken[str(each)] = max(excess, 1e-9) if math.isfinite(excess) else 1e9
    return broken


def _refusal(message: str) -> str:
    """Subject of a message: the parameter at its beginning, without the values of this design."""
    return message.partition(": ")[0].partition(" = ")[0]


@dataclass(frozen=True)
class Confirmed:
    """Design and its rows by model: names of [[confirm]]."""

    row: DesignRow
    models: dict[str, DesignRow]

    def difference(self, model: str, want: str) -> float:
        """Relative change of a figure by the model; NaN if the model did not run or if the figure of the search vanishes compared with that
        of the model."""
        first = self.row.figures[want]
        other = self.models[model].figures.get(want, float("nan")) if model in self.models else float("nan")
        return other / first - 1.0 if abs(first) > VANISHES * abs(other) else float("nan")

    def flat(self, problem: Problem) -> dict:
        """Row of a table: the design, parameters that follow from it, and for each model figures, differences and broken conditions."""
        table_row = {**self.row.flat(), **problem.complete(self.row.values)}
        for model, row in self.models.items():
            for each in problem.objectives:
                want = str(each.want)
                table_row[f"{want} | {model}"] = row.figures.get(want, float("nan"))
                table_row[f"{want} | {model}, difference"] = self.difference(model, want)
            table_row[f"breaks | {model}"] = "; ".join(row.refused)
        return table_row


def evaluated(farm: Farm, task: DesignTask, designs: Iterable[tuple[int, Mapping[str, Number]]]) -> Iterator[DesignRow]:
    """Rows in the order of completion. If the worker process of a design died each time, the row has only a message."""
    for row in farm.rows(task, designs):
        yield row if isinstance(row, DesignRow) else task.failed(row)


def confirm(rows: Sequence[DesignRow], chosen: Sequence[DesignRow], problem: Problem, farm: Farm) -> list[Confirmed]:
    """Runs rows with each model of the problem. Models with `only_chosen` run only the chosen rows."""
    found: dict[int, dict[str, DesignRow]] = {row.run: {} for row in rows}
    for name, model in problem.confirm.items():
        task = DesignTask(problem.at(model), thorough=True)
        wanted = chosen if model.only_chosen else rows
        for row in evaluated(farm, task, [(row.run, row.values) for row in wanted]):
            found[row.run][name] = row
    return [Confirmed(row, found[row.run]) for row in rows]
