"""Tables of a front and of the designs to choose from."""

from collections.abc import Iterable, Sequence

import pandas as pd

from ..values import FileName
from .confirm import Confirmed
from .design_task import DesignRow
from .front import costs, dominates
from .pair import heights
from .problem import Problem
from .quantities import Catalogue

LETTERS = "ABCDEFGHIJKLMNOPQRSTUVWXYZ"
NO_CHANGE = {"+0.0 %", "-0.0 %"}


def to_csv(confirmed: Iterable[Confirmed], problem: Problem, file: FileName) -> None:
    """The front, SI; numbers read back to the same bits."""
    pd.DataFrame([each.flat(problem) for each in confirmed]).to_csv(file, index=False)


def choice_table(chosen: Sequence[tuple[str, Confirmed]], compared: dict[str, DesignRow], problem: Problem) -> str:
    """A Markdown table with a column for each chosen and each compared design, in the units that are usually shown."""
    columns = [each.row for _, each in chosen] + list(compared.values())
    lines = [["", *(LETTERS[k] for k in range(len(chosen))), *compared]]
    catalogue = Catalogue(problem.scene.fmu)
    known = [_with_heights({**catalogue.starts(), **problem.scene.values, **problem.complete(row.values)}) for row in columns]
    for name in problem.space.names:
        lines.append(_line(catalogue, name, name, [each[name] for each in known]))
    wants = dict.fromkeys([*(str(each.want) for each in problem.objectives), *(str(each.want) for each in problem.conditions)])
    for want in wants:
        lines.append(_line(catalogue, want.removesuffix(":final"), want.rpartition(":")[0],
                           [row.figures.get(want) for row in columns]))
        for model in problem.confirm if want in {str(each.want) for each in problem.objectives} else ():
            changes = [f"{100.0 * each.difference(model, want):+.1f} %" for _, each in chosen]
            lines += _unless(changes, NO_CHANGE, f"… with {model}", compared)
    for model in problem.confirm:
        broken = ["; ".join(each.models[model].refused) or "–" for _, each in chosen]
        lines += _unless(broken, {"–"}, f"breaks with {model}", compared)
    head = f"| {' | '.join(lines[0])} |\n|---|{'---:|' * len(columns)}"
    body = "\n".join(f"| {' | '.join(line)} |" for line in lines[1:])
    reasons = "\n".join(f"- {LETTERS[k]}: {reason}." for k, (reason, _) in enumerate(chosen))
    return f"{head}\n{body}\n\n{reasons}\n"


def standing(name: str, row: DesignRow, best: Sequence[DesignRow], problem: Problem) -> str:
    """Where a compared design stands against a front."""
    checks = f"; refused by: {'; '.join(row.refused)}" if row.refused else "; it meets all conditions"
    if not all(str(each.want) in row.figures for each in problem.objectives):
        return f"{name}: it does not run{checks}. {row.message}".strip()
    old = costs([row], problem.objectives)[0]
    better = [each for each, cost in zip(best, costs(best, problem.objectives)) if dominates(cost, old)]
    if better:
        numbers = ", ".join(str(each.run) for each in better[:8])
        return f"{name}: {len(better)} of {len(best)} designs of the front are better in all objectives (run {numbers}){checks}."
    return f"{name}: no design of the front is better in all objectives{checks}."


def _unless(cells, nothing, label, compared):
    """A row of the chosen designs, unless all its cells say nothing."""
    return [] if nothing.issuperset(cells) else [[label, *cells, *("" for _ in compared)]]


def _with_heights(values):
    """Parameters with the addenda and dedenda that the addendum system makes, in modules."""
    addenda, dedenda = heights({name.removeprefix("geometry."): value for name, value in values.items()})
    told = {f"geometry.{gear}_{what}": height / values["geometry.module"]
            for what, pair in (("addendum", addenda), ("dedendum", dedenda)) for gear, height in zip(("planet", "side"), pair)}
    return {**values, **told}


def _line(catalogue, label, name, values):
    unit = catalogue.variable(name).shown(0.0)[0]
    return [f"{label}, {unit}" if unit else label, *(_shown(catalogue.variable(name), value) for value in values)]


def _shown(variable, value):
    if value is None:
        return ""
    if variable.literals:
        return next(literal for literal, number in variable.literals.items() if number == value)
    return f"{variable.shown(value)[1]:.4g}" if variable.kind in ("Real", "Integer") else str(value).lower()
