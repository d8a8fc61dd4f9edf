"""Measured clutch curve, given as a list of points or as a CSV file. The library of answers reads it; the FMU has only its points."""

from collections.abc import Mapping
from pathlib import Path
from typing import Any

from .answers import ask, written
from .values import DifferentialError, Value

CURVE = "limited_slip.curve"


def expanded(values: Mapping[str, Value]) -> dict[str, Value]:
    """Values by name, with all points of a curve in its place: those that the curve does not give are unset. A path is relative to the
    working folder."""
    found = dict(values)
    if CURVE not in found:
        return found
    points = ask({"ask": "curve", "value": written(found.pop(CURVE))})["set"]
    for name in points.keys() & found.keys():
        raise DifferentialError(f"{CURVE} sets all points, and {name} is set as well; leave one out")
    return found | points


def beside(values: Mapping[str, Any], file: Path) -> dict[str, Any]:
    """Values from the TOML file `file`, by name, with the path of a curve relative to that file."""
    curve = values.get(CURVE)
    is_path = isinstance(curve, str) and not curve.lstrip().startswith("[")
    return {**values, CURVE: str(file.parent / curve)} if is_path else dict(values)
