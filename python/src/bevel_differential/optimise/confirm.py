"""Designs of a front once more, with richer models of the same scene."""

from collections.abc import Sequence
from dataclasses import dataclass

from ..designs.farm import Farm
from .design_task import DesignRow, DesignTask
from .problem import Problem


@dataclass(frozen=True)
class Confirmed:
    """A design and its rows by model: names of [[confirm]]."""

    row: DesignRow
    models: dict[str, DesignRow]

    def difference(self, model: str, want: str) -> float:
        """What the model changes of a figure, relative to the search's own; NaN where the model did not run."""
        first = self.row.figures[want]
        other = self.models[model].figures.get(want, float("nan")) if model in self.models else float("nan")
        return other / first - 1.0 if first else float("nan")

    def flat(self, problem: Problem) -> dict:
        """As a row of a table: the design, what follows from it, and for each model figures, differences and what it breaks."""
        told = {**self.row.flat(), **problem.complete(self.row.values)}
        for model, row in self.models.items():
            for each in problem.objectives:
                want = str(each.want)
                told[f"{want} | {model}"] = row.figures.get(want, float("nan"))
                told[f"{want} | {model}, difference"] = self.difference(model, want)
            told[f"breaks | {model}"] = "; ".join(row.refused)
        return told


def confirm(rows: Sequence[DesignRow], chosen: Sequence[DesignRow], problem: Problem, farm: Farm) -> list[Confirmed]:
    """Runs rows with each model of the problem; with models for chosen designs alone only those."""
    found: dict[int, dict[str, DesignRow]] = {row.run: {} for row in rows}
    for name, model in problem.confirm.items():
        task = DesignTask(problem.at(model), thorough=True)
        wanted = chosen if model.only_chosen else rows
        for row in farm.evaluate(task, [(row.run, row.values) for row in wanted]):
            found[row.run][name] = row
    return [Confirmed(row, found[row.run]) for row in rows]
