"""Report of a front: tables, a picture, and chosen designs for other programs, as scene files and gears."""

import json
from collections.abc import Iterable, Iterator, Sequence
from math import isnan

import pandas as pd

from .. import cad
from ..answers import ask, assignments
from ..panel import BLUE, BROWN, GREEN, GREY, INK, RED, Mark, Panel, curve, picture
from ..readable import axis_label, in_words, wrapped
from ..values import FileName
from ..writing import whole
from .design_task import Confirmed, DesignRow
from .front import costs, dominates
from ..pair import heights
from .problem import Objective, Problem

LETTERS = "ABCDEFGHIJKLMNOPQRSTUVWXYZ"
NO_CHANGE = {"+0.0 %", "-0.0 %"}


def to_csv(confirmed: Iterable[Confirmed], problem: Problem, file: FileName) -> None:
    """Writes the front, SI; numbers are read back to the same bits."""
    with whole(file) as part:
        pd.DataFrame([each.flat(problem) for each in confirmed]).to_csv(part, index=False)


def choice_table(chosen: Sequence[tuple[str, Confirmed]], compared: dict[str, DesignRow], problem: Problem) -> str:
    """Markdown table with a column for each chosen and each compared design, in display units."""
    columns = [each.row for _, each in chosen] + list(compared.values())
    lines = [["", *(LETTERS[k] for k in range(len(chosen))), *compared]]
    catalogue = problem.scene.fmu
    known = [_with_heights(problem.known(problem.complete(row.values))) for row in columns]
    for name in problem.space.names:
        lines.append(_line(name, catalogue.variable(name), [each[name] for each in known]))
    for want, quantity in ((str(each), each.quantity(catalogue)) for each in problem.wants):
        lines.append(_line(want.removesuffix(":final"), quantity, [row.figures.get(want) for row in columns]))
        for model in problem.confirm if want in {str(each.want) for each in problem.objectives} else ():
            found = [each.difference(model, want) for _, each in chosen]
            changes = ["–" if isnan(change) else f"{100.0 * change:+.1f} %" for change in found]
            lines += _unless(changes, NO_CHANGE, f"… with {model}", compared)
    for model in problem.confirm:
        broken = ["; ".join(each.models[model].refused) or "–" for _, each in chosen]
        lines += _unless(broken, {"–"}, f"breaks with {model}", compared)
    head = f"| {' | '.join(lines[0])} |\n|---|{'---:|' * len(columns)}"
    body = "\n".join(f"| {' | '.join(line)} |" for line in lines[1:])
    reasons = "\n".join(f"- {LETTERS[k]}: {reason}." for k, (reason, _) in enumerate(chosen))
    return f"{head}\n{body}\n\n{reasons}\n"


def compared_with_front(name: str, row: DesignRow, best: Sequence[DesignRow], problem: Problem) -> str:
    """Sentence that compares a design with a front."""
    checks = f". Refused by: {'; '.join(row.refused)}" if row.refused else "; it meets all conditions"
    if not all(str(each.want) in row.figures for each in problem.objectives):
        return f"{name}: it does not run{checks}. {row.message}".strip()
    old = costs([row], problem.objectives)[0]
    better = [each for each, cost in zip(best, costs(best, problem.objectives)) if dominates(cost, old)]
    if better:
        numbers = ", ".join(str(each.run) for each in better[:8])
        return f"{name}: {len(better)} of {len(best)} designs of the front are better in all objectives (run {numbers}){checks}."
    return f"{name}: no design of the front is better in all objectives{checks}."


def below_one(chosen: Sequence[DesignRow]) -> Iterator[str]:
    """Sentences about safety factors of the chosen designs that are below 1; the conditions of the problem may allow this."""
    for letter, row in zip(LETTERS, chosen):
        below = [f"{want.split(':')[0]} = {value:.3g}" for want, value in row.figures.items() if want.startswith("safety.") and value < 1.0]
        if below:
            yield f"{letter}: {' and '.join(below)} {'is' if len(below) == 1 else 'are'} below 1."


def _unless(cells, nothing, label, compared):
    """Row of the chosen designs, or nothing if all its cells are empty."""
    return [] if nothing.issuperset(cells) else [[label, *cells, *("" for _ in compared)]]


def _with_heights(values):
    """Parameters with the addenda and dedenda of the addendum system, in modules."""
    addenda, dedenda = heights({name.removeprefix("geometry."): value for name, value in values.items()})
    in_modules = {f"geometry.{gear}_{what}": height / values["geometry.module"]
                  for what, pair in (("addendum", addenda), ("dedendum", dedenda)) for gear, height in zip(("planet", "side"), pair)}
    return {**values, **in_modules}


def _line(label, variable, values):
    unit = variable.shown(0.0)[0]
    return [f"{label}, {unit}" if unit else label, *(_shown(variable, value) for value in values)]


def _shown(variable, value):
    if value is None:
        return ""
    if variable.literals:
        return variable.written(value)
    return f"{variable.shown(value)[1]:.4g}" if variable.kind in ("Real", "Integer") else str(value).lower()


def draw(front: Sequence[DesignRow], chosen: Sequence[DesignRow], compared: dict[str, DesignRow], problem: Problem,
            file: FileName) -> None:
    """Draws the front in panels, with the chosen designs by letter and the compared ones as stars; PNG."""
    objectives, catalogue = problem.objectives, problem.scene.fmu
    across = next((each for each in objectives if each.sign > 0.0), objectives[0])
    others = [each for each in objectives if each is not across]
    compared = {name: row for name, row in compared.items() if all(str(each.want) in row.figures for each in objectives)}

    def shown(rows, objective):
        variable = objective.want.quantity(catalogue)
        return [variable.shown(row.figures[str(objective.want)])[1] for row in rows]

    olds = costs(list(compared.values()), objectives)
    better = [row for row, cost in zip(front, costs(front, objectives)) if any(dominates(cost, old) for old in olds)]
    plain = [row for row in front if row not in better]

    def points(rows, up, *look, **options):
        return [curve(shown(rows, across), shown(rows, up), *look, **options)] if rows else []

    def marks(up):
        yield from points(plain, up, "front", GREY, "o", ms=3.5)
        yield from points(better, up, "front, better in all than a compared design", BLUE, "o", ms=4.5)
        for k, (name, row) in enumerate(compared.items()):
            yield from points([row], up, name + (" (breaks conditions)" if row.refused else ""), (RED, GREEN, BROWN)[k % 3], "*", ms=14)
        yield from points(chosen, up, None, None, "o", ms=8, mfc="none", mec=INK)
        for letter, *at in zip(LETTERS, shown(chosen, across), shown(chosen, up)):
            yield Mark("annotate", letter, at, xytext=(5, 5), textcoords="offset points", fontweight="bold")

    picture([[Panel(_label(catalogue, across), _label(catalogue, up), marks(up), legend="") for up in others]],
            "Each mark is a design on the Pareto front: no other design that meets the conditions is better in one objective and nowhere worse. "
            "Letters: chosen designs. Stars: designs that are compared with the front.", file, 5.4, legend="upper center")


def _label(catalogue, objective: Objective) -> str:
    unit = objective.want.quantity(catalogue).shown(0.0)[0]
    better = "less" if objective.sign > 0.0 else "more"
    return wrapped(f"{axis_label(in_words(objective.want), unit)} ({better} is better)", 34)


def scene_text(problem: Problem, row: DesignRow, description: str) -> str:
    """Scene of the problem with the design in it, as a scene file."""
    scene = problem.scene
    held = scene.contents({**scene.values, **problem.complete(row.values)})
    head = {key: value for key, value in held.items() if key not in ("set", "at", "table")}
    lines = [*_entries({**head, "description": description}), "", "[set]", *_entries(held["set"])]
    for kind in ("at", "table"):
        for entry in held[kind]:
            lines += ["", f"[[{kind}]]", *_entries(entry)]
    return "\n".join(lines) + "\n"


def write_gears(problem: Problem, row: DesignRow, folder: FileName) -> bool:
    """Writes dimensions and curves of the design's gears, and with the extra `cad` solids, meshes and drawings. Returns true if the check
    with fillets finds no interference."""
    kinds = ("step", "glb", "dxf") if cad.available() else ()
    found = ask({"ask": "geometry", "set": settings(problem, row), "solids": bool(kinds)})
    cad.write(found, folder, kinds)
    return not found["interference"]


def settings(problem: Problem, row: DesignRow) -> list[str]:
    """Geometry values of the design that differ from the FMU's start values, each "name=value"."""
    fmu = problem.scene.fmu
    values = {**problem.scene.values, **problem.complete(row.values)}
    changed = {name: value for name, value in values.items()
               if name.startswith("geometry.") and value != fmu.variable(name).start or name == "effects.backlash" and not value}
    return assignments({name: fmu.variable(name).written(value) for name, value in changed.items()})


def _entries(table, *names):
    """Lines of a table. Numbers, strings, booleans and lists in JSON are also TOML."""
    return [f"{name} = {json.dumps(table[name], ensure_ascii=False)}" for name in names or table]
