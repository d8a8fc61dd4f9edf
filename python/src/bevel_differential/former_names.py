"""Former names of variables, as the library of answers lists them. They still find their variables, and a warning gives the present
names."""

from collections.abc import Mapping
from functools import cache
from typing import TypeVar

from .answers import ask
from .values import DifferentialError
from .warned import warn

_Of = TypeVar("_Of")


def present(name: str) -> str:
    """The present name of the variable that `name` names or once named, with a warning about a former name. Other texts as they are."""
    found = _former().get(name)
    if found is None:
        return name
    warn([found["says"]])
    return found["name"]


def by_present_names(values: Mapping[str, _Of]) -> dict[str, _Of]:
    """Values by present names. Refuses a variable that has two names here."""
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
