"""Values in which scenes differ: communication steps, parameters, and inputs at the start, over time and later."""

from collections.abc import Iterator, Mapping
from typing import Any, TypeAlias

from ..fmu import Fmu
from ..points import seconds
from ..report import words
from ..scene import Scene
from ..values import Number, Value, Variable

# a value to compare, and its texts with `DIGITS` and `ALL_DIGITS` digits
Cell: TypeAlias = tuple[Any, str, str]
DIGITS, ALL_DIGITS = 6, 15
NOTHING: Cell = (None, "–", "–")


def differing(scenes: Mapping[str, Scene], values: Mapping[str, Value], fmu: Fmu) -> list[tuple[str, ...]]:
    """Table of the values that are not the same in all scenes: its head, then a row for each value, in the display units of `fmu`.
    `values` change all scenes."""
    changed = {variable.name: number for variable, number in fmu.numbers(values)}
    rows: list[tuple[str, ...]] = [("value", *scenes)]
    for name, cells in _all(list(scenes.values()), changed, fmu):
        if any(cell[0] != cells[0][0] for cell in cells):
            texts = [cell[1] for cell in cells]
            rows.append((name, *(texts if len(set(texts)) > 1 else (cell[2] for cell in cells))))
    return rows


def _all(scenes: list[Scene], changed: Mapping[str, Number], fmu: Fmu) -> Iterator[tuple[str, list[Cell]]]:
    """Name and cells of each value that a scene sets."""
    yield "step", [(scene.step, f"{scene.step:g} s", f"{scene.step:.{ALL_DIGITS}g} s") for scene in scenes]
    yield "tables within a step", [(scene.input_slopes, *2 * ("linear" if scene.input_slopes else "held",)) if scene.tables else NOTHING
                                   for scene in scenes]
    tables = [{name: table for name, *table in scene.tables} for scene in scenes]
    named = {name for scene, own in zip(scenes, tables) for name in (*scene.values, *own)}
    for name, variable in fmu.variables.items():
        if name in named:
            yield name, [_table(variable, own[name]) if name in own else _value(variable, changed.get(name, scene.value(name)))
                         for scene, own in zip(scenes, tables)]
    later = [_later(scene) for scene in scenes]
    for name in dict.fromkeys(name for changes in later for name in changes):
        yield f"{name}, later", [_changes(fmu.variable(name), changes.get(name, [])) for changes in later]


def _value(variable: Variable, value: Number) -> Cell:
    return value, words.shown(variable, value, DIGITS), words.shown(variable, value, ALL_DIGITS)


def _table(variable: Variable, table: list[Any]) -> Cell:
    times, values, period = table
    numbers = [variable.number(value) for value in values]
    points = [seconds("time", time) for time in times]
    ends = f"{words.shown(variable, min(numbers), DIGITS)} to {words.shown(variable, max(numbers), DIGITS)}"
    text = f"table of {len(points)} points, {ends}{f', every {period:g} s' if period else ''}"
    every = ", ".join(f"{words.shown(variable, value, DIGITS)} at {time:g} s" for time, value in zip(points, numbers))
    return (points, numbers, period), text, f"{text}: {every}"


def _later(scene: Scene) -> dict[str, list[tuple[float, Number]]]:
    """Changes during a run by variable: times, s, and values."""
    found: dict[str, list[tuple[float, Number]]] = {}
    for time, values in scene.changes:
        for variable, number in scene.fmu.numbers(values):
            found.setdefault(variable.name, []).append((time, number))
    return found


def _changes(variable: Variable, changes: list[tuple[float, Number]]) -> Cell:
    if not changes:
        return NOTHING

    def written(digits):
        return ", ".join(f"{words.shown(variable, number, digits)} at {time:g} s" for time, number in changes)

    return changes, written(DIGITS), written(ALL_DIGITS)
