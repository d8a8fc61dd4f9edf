"""Parameter sets of SSP as start values. Errors name file, variable and value."""

from collections.abc import Mapping
from pathlib import Path
from typing import Any

from lxml import etree

from ..values import suggestion
from .files import Broken, local, number

# kinds of values that fmpy takes as text
_PLAIN = ("real", "integer", "boolean", "string")


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
            number(text)
        except Broken as error:
            raise Broken(f"{name}: {of} {error}") from None
        if (unit := element.get("unit")) and variable.unit and unit != variable.unit:
            raise Broken(f"{name}: {of} has the unit {unit}; the variable has {variable.unit}")
    return text
