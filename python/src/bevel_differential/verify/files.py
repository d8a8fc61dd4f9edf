"""Files of the evidence: parameter sets of SSP 1.0, tables and tolerances in CSV. Errors name file, line, column and value."""

import csv
import math
from collections.abc import Iterable, Mapping
from pathlib import Path
from typing import Any

import numpy as np
from lxml import etree

from ..values import suggestion

# kinds of values of SSP that fmpy takes as text
_PLAIN = ("real", "integer", "boolean", "string")
_WORDS = {"true": 1.0, "false": 0.0}


class Broken(Exception):
    """Evidence that cannot be used."""


def local(what: Any) -> str:
    """Name of an element or an attribute in small letters without its namespace, also where the prefix is not declared."""
    tag = getattr(what, "tag", what)
    return tag.rpartition("}")[2].rpartition(":")[2].lower() if isinstance(tag, str) else ""


def attribute_number(text: str | None) -> float | None:
    """The number of an attribute, None where it is not given."""
    return None if text is None else _number(text)


def parameter_set(name: str, file: Path, variables: Mapping[str, Any]) -> dict[str, Any]:
    """Start values by name, as fmpy takes them."""
    try:
        root = etree.fromstring(file.read_bytes())
    except etree.XMLSyntaxError as error:
        raise Broken(f"{name}: it is no valid XML ({error})") from None
    own = {kind.get("name"): {item.get("name"): item.get("value") for item in kind} for kind in root.iter() if local(kind) == "enumeration"
           and len(kind)}
    values = {}
    for parameter in (element for element in root.iter() if local(element) == "parameter"):
        of = parameter.get("name", "")
        if of not in variables:
            raise Broken(f"{name}: {of}: there is no such variable{suggestion(of, variables)}")
        if not len(parameter):
            raise Broken(f"{name}: {of}: it has no value")
        values[of] = _value(name, of, parameter[0], variables[of], own)
    return values


def _value(name, of, element, variable, own):
    kind, text = local(element), element.get("value", "")
    if kind == "enumeration":
        literals = {item.name: item.value for item in getattr(variable.declaredType, "items", None) or ()}
        literals = literals or own.get(element.get("name"), {})
        if text not in literals:
            raise Broken(f"{name}: {of}, value {text!r}: it is no literal; known: {', '.join(literals) or 'none'}")
        return int(literals[text])
    if kind not in _PLAIN:
        raise Broken(f"{name}: {of}: a value of the kind {kind} is not supported")
    if kind == "real":
        try:
            _number(text)
        except Broken as error:
            raise Broken(f"{name}: {of} {error}") from None
        if (unit := element.get("unit")) and variable.unit and unit != variable.unit:
            raise Broken(f"{name}: {of} has the unit {unit}; the variable has {variable.unit}")
    return text


def table(name: str, file: Path, variables: Mapping[str, Any], faults: list[str]) -> np.ndarray:
    """A table over time as a structured array; its first field is "time"."""
    (line, head), *rows = _lines(name, file)
    if head[0] != "time":
        if head[0].strip().lower() != "time":
            raise Broken(f"{name}, line {line}: the first column is {head[0]!r}; it must be time")
        faults.append(f"{name}: the first column is {head[0]!r} instead of time")
    heads = [cell.strip() for cell in head[1:]]
    for of in heads:
        if of not in variables:
            raise Broken(f"{name}, line {line}: {of}: there is no such variable{suggestion(of, variables)}")
    if twice := [of for of in dict.fromkeys(heads) if heads.count(of) > 1]:
        raise Broken(f"{name}, line {line}: {twice[0]} stands here twice")
    if not heads or not rows:
        raise Broken(f"{name}: it has no {'values' if heads else 'column beside the time'}")
    found = np.empty(len(rows), [("time", float), *((of, float) for of in heads)])
    for row, (line, cells) in zip(found, rows):
        _same_length(name, line, cells, head)
        for of, cell in zip(found.dtype.names, cells):
            row[of] = _cell(name, line, of, cell)
    if np.any(np.diff(found["time"]) < 0.0):
        raise Broken(f"{name}: times fall; they must rise from line to line")
    return found


def tolerances_of(name: str, file: Path, experiment: str, columns: Iterable[str]) -> dict[str, float]:
    """The tolerance of each column in an experiment, in the unit of the variable."""
    (_, head), *rows = _lines(name, file)
    missing = {"experiment", "variable", "tolerance"} - set(head)
    if missing:
        raise Broken(f"{name}: it has no column {', '.join(sorted(missing))}")
    allowed = {}
    for line, cells in rows:
        _same_length(name, line, cells, head)
        given = dict(zip(head, cells))
        if given["experiment"] == experiment:
            value = allowed[given["variable"]] = _cell(name, line, "tolerance", given["tolerance"])
            if not value > 0.0:
                raise Broken(f"{name}, line {line}, column tolerance, value {value:g}: it must be above 0")
    if untold := [of for of in columns if of not in allowed]:
        raise Broken(f"{name}: it has no tolerance of {untold[0]} in the experiment {experiment}")
    return allowed


def _lines(name, file):
    """Numbers and cells of the lines that are neither empty nor comments, the header first."""
    try:
        text = file.read_text(encoding="utf-8-sig")
    except UnicodeDecodeError:
        raise Broken(f"{name}: it is no text in UTF-8") from None
    lines = [(number, next(csv.reader([line]))) for number, line in enumerate(text.splitlines(), 1)
             if line.strip() and not line.startswith("#")]
    if not lines:
        raise Broken(f"{name}: it is empty")
    return lines


def _same_length(name, line, cells, head):
    if len(cells) != len(head):
        raise Broken(f"{name}, line {line}: it has {len(cells)} cells where the header has {len(head)}")


def _cell(name, line, column, cell):
    try:
        return _number(cell)
    except Broken as error:
        raise Broken(f"{name}, line {line}, column {column} {error}") from None


def _number(text):
    word = text.strip().lower()
    try:
        value = _WORDS[word] if word in _WORDS else float(word)
    except ValueError:
        raise Broken(f"is {text!r}: it is no number") from None
    if not math.isfinite(value):
        raise Broken(f"is {text!r}: it must be finite")
    return value
