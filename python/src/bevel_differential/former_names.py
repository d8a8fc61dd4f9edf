"""Former names of variables, from the library of answers. They still find their variables, with a warning about the present name."""

from collections.abc import Mapping
from functools import cache
from typing import TypeVar

from .answers import ask
from .values import DifferentialError
from .warned import warn

_Of = TypeVar("_Of")


def present(name: str) -> str:
    """Present name of the variable that `name` names or formerly named; a former name causes a warning. Returns other texts unchanged."""
    found = _former().get(name)
    if found is None:
        return name
    warn([found["says"]])
    return found["name"]


def by_present_names(values: Mapping[str, _Of]) -> dict[str, _Of]:
    """Values by present names. Fails if a variable is given by both names."""
    found: dict[str, _Of] = {}
    for written, value in values.items():
        name = present(written)
        if name in found:
            raise DifferentialError(f"{name}: it is given twice, once by its former name; leave one of them out")
        found[name] = value
    return found


@cache
def _former() -> dict[str, dict[str, str]]:
    return ask({"ask": "former_names"})["names"]
