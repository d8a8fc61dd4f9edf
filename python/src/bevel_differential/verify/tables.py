"""Tables of the evidence in CSV: inputs and results over time, and tolerances. Errors name file, line, column and value."""

from collections.abc import Collection, Iterable, Mapping
from pathlib import Path
from typing import Any

import numpy as np

from ..csv_table import lines_of
from ..values import DifferentialError, suggestion
from .files import Broken, number

# reasons to leave a column out
UNKNOWN, TEXT = "unknown", "text"
# types of FMI whose values are no numbers
_TEXTS = ("String", "Binary", "Clock")


def table(name: str, file: Path, variables: Mapping[str, Any], faults: list[str], left_out: Collection[str] = ()) -> np.ndarray:
    """A table over time as a structured array; its first field is "time". A cell of an array has its elements between blanks.

    `left_out`: for which reasons a column is left out with a fault; without them it is an error."""
    texts = [of for of, variable in variables.items() if variable.type in _TEXTS]
    (line, head), *rows = _lines(name, file, texts)
    heads = ["time", *(cell.strip() for cell in head[1:])]
    if head[0] != "time":
        if head[0].strip().lower() != "time":
            raise Broken(f"{name}, line {line}: the first column is {head[0]!r}; it must be time")
        faults.append(f"{name}: the first column is {head[0]!r} instead of time")
    if twice := [of for of in dict.fromkeys(heads) if heads.count(of) > 1]:
        raise Broken(f"{name}, line {line}: {twice[0]} stands here twice")
    places = [place for place, of in enumerate(heads) if place > 0 and _is_kept(f"{name}, line {line}", of, variables, faults, left_out)]
    if not places or not rows:
        raise Broken(f"{name}: it has no {'values' if places else 'column that can be read beside the time'}")
    columns = {"time": [_cell(name, line, "time", cells[0]) for line, cells in rows]}
    for place in places:
        of = heads[place]
        columns[of] = _elements(name, of, [(line, cells[place]) for line, cells in rows]) if variables[of].dimensions else [
            _cell(name, line, of, cells[place]) for line, cells in rows]
    found = np.empty(len(rows), [(of, float, np.shape(values)[1:]) for of, values in columns.items()])
    for of, values in columns.items():
        found[of] = values
    if np.any(np.diff(found["time"]) < 0.0):
        raise Broken(f"{name}: times fall; they must rise from line to line")
    return found


def _is_kept(place, of, variables, faults, left_out):
    if of not in variables:
        reason, fault = UNKNOWN, f"{place}: {of}: there is no such variable{suggestion(of, variables)}"
    elif variables[of].type in _TEXTS:
        reason, fault = TEXT, f"{place}: {of}: values of the type {variables[of].type} are not read"
    else:
        return True
    if reason not in left_out:
        raise Broken(fault)
    faults.append(f"{fault}; the column is left out")
    return False


def _elements(name, of, cells):
    """Values of an array, of as many elements in each line."""
    found = [[_cell(name, line, of, word) for word in cell.split()] for line, cell in cells]
    for (line, _), values in zip(cells, found):
        if not values or len(values) != len(found[0]):
            raise Broken(f"{name}, line {line}, column {of}: it has {len(values)} elements, {len(found[0])} in the first line")
    return found


def tolerances_of(name: str, file: Path, experiment: str, columns: Iterable[str]) -> dict[str, float]:
    """The tolerance of each column in an experiment, in the unit of the variable."""
    (_, head), *rows = _lines(name, file, ("experiment", "variable"))
    missing = {"experiment", "variable", "tolerance"} - set(head)
    if missing:
        raise Broken(f"{name}: it has no column {', '.join(sorted(missing))}")
    allowed = {}
    for line, cells in rows:
        given = dict(zip(head, cells))
        if given["experiment"] == experiment:
            value = allowed[given["variable"]] = _cell(name, line, "tolerance", given["tolerance"])
            if not value > 0.0:
                raise Broken(f"{name}, line {line}, column tolerance, value {value:g}: it must be above 0")
    if untold := [of for of in columns if of not in allowed]:
        raise Broken(f"{name}: it has no tolerance of {untold[0]} in the experiment {experiment}")
    return allowed


def _lines(name, file, texts=()):
    """Numbers and cells of the lines that are neither empty nor comments, the header first."""
    try:
        return lines_of(file, name, texts)
    except DifferentialError as error:
        raise Broken(str(error)) from None


def _cell(name, line, column, cell):
    try:
        return number(cell)
    except Broken as error:
        raise Broken(f"{name}, line {line}, column {column} {error}") from None
