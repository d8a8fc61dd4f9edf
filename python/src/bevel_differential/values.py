"""Values in the form that users write, and in the form of the FMU."""

import copy
import math
import os
import re
from collections.abc import Iterable, Mapping, Sequence, Set
from typing import TYPE_CHECKING, Any, Protocol, Self, TypeAlias, TypeVar

import numpy as np

from .library import reply

if TYPE_CHECKING:
    from fmpy.model_description import ScalarVariable, Unit

# value in the form of the FMU: SI, number of a literal, bool
Number: TypeAlias = float | int | bool
FileName: TypeAlias = str | os.PathLike[str]
# number in SI, text with a unit, or a pair (number, unit), in SI without a unit
_Quantity: TypeAlias = float | str | tuple[float | str, str | None]
# value in the form that users write: also a bool, a literal's name, or, for limited_slip.curve, a file or pairs of slip and torque
Value: TypeAlias = _Quantity | int | bool | np.bool_ | os.PathLike[str] | Sequence[Sequence[_Quantity]] | np.ndarray
# text in warnings about values that have no effect in the scene
UNFELT = " changes nothing in this scene. "
# prefix of the line that lists values which take effect and which nobody set; groups with "; " between them follow
NOBODY_SET = "these start values of the study influence this scene, and nobody set them (set them if your differential differs): "
# statuses from this one on are errors: fmi2Discard, fmi2Error, fmi2Fatal
DISCARD = 2

_Shown = TypeVar("_Shown", float, np.ndarray)

# kinds of FMI 3.0 by the names of FMI 2.0
_KINDS = {"Float64": "Real", "Int32": "Integer", "UInt64": "Integer"}
_NUMBER_AND_UNIT = re.compile(r"\s*([-+]?(?:\d+\.?\d*|\.\d+)(?:[eE][-+]?\d+)?)\s*(\S.*?)?\s*$")

# separator between the middle of a band and its half width
BAND = re.compile(r"\+-|\+/-|±")
# alternative spellings of units
_SPELLINGS = {"·": ".", "*": ".", "°": "deg", "µ": "u", "μ": "u", "²": "2", "Nm": "N.m", "1/min": "rpm"}


def spelled(unit: str) -> str:
    """Name of a unit as the FMU spells it: "N.m" for "N·m"."""
    for spelling, name in _SPELLINGS.items():
        unit = unit.replace(spelling, name)
    return unit


def split(text: str) -> tuple[str, str]:
    """Number and unit of a text, with or without a blank between. If the text does not begin with a number, all of it is the number."""
    match = _NUMBER_AND_UNIT.match(text)
    return (match[1], match[2] or "") if match else (text.strip(), "")


class DifferentialError(ValueError):
    """Error of an invalid parameter, input or output, or of a failed simulation. The message names the item, the reason and a remedy.

    `status`: status of the FMU if it refused: 2 (fmi2Discard), 3 (fmi2Error) or 4 (fmi2Fatal); else None. `kind`: "use" if a value is
    wrong or the request makes no sense, "failed" if the work fails, "finding" if the work is done and its result is not as wanted.
    `problems`: dicts, each with a `message` and, if known, `variable`, `value`, `unit`, `range` and `hint`."""

    def __init__(self, message: str, status: int | None = None, kind: str = "use", problems: Sequence[Mapping[str, object]] = ()):
        super().__init__(message)
        self.status, self.kind, self.problems = status, kind, list(problems)


class DifferentialWarning(UserWarning):
    """Warning of the FMU about an unusual value, an exceeded limit, or a value that has no effect in its scene."""


class Variable:
    """Variable of the FMU, with its units and literals.

    Attributes: `name`, `kind` ("Real", "Integer", "Boolean" or "Enumeration"), `causality`, `variability`, `reference`, `unit` (SI) and
    `description`; `start`, `minimum` and `maximum`, in the form of the FMU, or None; `literals`, numbers by name; `is_relative`, true if
    its values are differences, which are converted without the offset of a unit."""

    name: str
    kind: str
    causality: str
    variability: str
    reference: int
    unit: str | None
    description: str | None
    start: Number | None
    minimum: Number | None
    maximum: Number | None
    literals: dict[str, int]
    units: dict[str, tuple[float, float]]
    is_relative: bool = False
    _usual: str | None = None
    _with_offset: Set[str] = frozenset()

    def __init__(self, described: "ScalarVariable", units: "Mapping[str, Unit]"):
        self.name = described.name
        self.kind = _KINDS.get(described.type, described.type)
        self.causality = described.causality
        self.variability = described.variability
        self.reference = described.valueReference
        self.description = described.description
        declared = described.declaredType
        self.unit = described.unit or (declared.unit if declared is not None else None)
        self.literals = {item.name: int(item.value) for item in getattr(declared, "items", None) or []}
        self._usual = getattr(declared, "displayUnit", None) or described.displayUnit
        # fmpy reads this attribute of a variable as a bool or None, and that of a type as a bool or, in older versions, as text
        self.is_relative = any(getattr(each, "relativeQuantity", None) in (True, "true", "1") for each in (described, declared))
        shown = units.get(self.unit) if self.unit else None
        # a value in SI is (value in the shown unit - offset) / factor
        self.units = {self.unit: (1.0, 0.0)} if self.unit else {}
        self._with_offset = {unit.name for unit in (shown.displayUnits if shown is not None else []) if float(unit.offset or 0.0)}
        for unit in shown.displayUnits if shown is not None else []:
            self.units[unit.name] = (float(unit.factor), 0.0 if self.is_relative else float(unit.offset or 0.0))
        self.start, self.minimum, self.maximum = map(self._declared, (described.start, described.min, described.max))

    def number(self, value: Value) -> Number:
        """`value` in the form of the FMU: SI, number of a literal, bool.

        `value` may be a number, a pair (number, unit), text such as "4.5 mm", or a literal's name."""
        if self.kind == "Boolean":
            return self._boolean(value)
        if self.kind == "Enumeration":
            return self._literal(value)
        if isinstance(value, tuple) and len(value) == 2:
            return self._whole(self._si(value[0], value[1], value))
        if isinstance(value, str):
            return self._whole(self._parsed(value))
        return self._whole(self._float(value, value))

    def checked(self, value: Value) -> Number:
        """`value` in the form of the FMU. A value with a unit must be within the range, because the message of the FMU would guess the
        intended unit."""
        number = self.number(value)
        if self.has_unit(value):
            self.check_range(number, value)
        return number

    def differences(self) -> Self:
        """Variable for differences between values of this one, without the offsets of units and without a range. Differences are shown
        in SI if the usual unit has an offset: 5 K between two temperatures in degC."""
        found = copy.copy(self)
        found.is_relative, found.start, found.minimum, found.maximum = True, None, None, None
        found.units = {name: (factor, 0.0) for name, (factor, _) in self.units.items()}
        if self.units.get(self._usual or "", (1.0, 0.0))[1] != 0.0:
            found._usual = self.unit
        return found

    def written(self, value: Value) -> Number | str:
        """`value` in the form of scene files: SI, bool, or a literal's name."""
        number = self.number(value)
        return next((name for name, literal in self.literals.items() if literal == number), number)

    def numbers(self, parts: Sequence[str], written: str) -> tuple[Number, ...]:
        """Values of the texts in a list, range, distribution or band, which is `written` as a whole. The second number of a normal
        distribution and of a band is a difference. If only some of the numbers have a unit, this is an error: in "4..5 mm" the first number
        would be 4 m."""
        matches = [_NUMBER_AND_UNIT.match(part) for part in parts]
        bare = [part for part, match in zip(parts, matches) if match and not match[2] and float(match[1]) != 0.0]
        if bare and any(match and match[2] for match in matches):
            raise DifferentialError(f"{self.name} = {written}: {bare[0]} has no unit, but others have one; write it at each "
                                    "number")
        second = self.differences() if written.startswith("normal(") or BAND.search(written) else self
        return tuple((second if place == 1 else self).number(part) for place, part in enumerate(parts))

    def has_unit(self, value: Value) -> bool:
        """True if `value` is written with its unit."""
        if self.kind != "Real":
            return False
        match = _NUMBER_AND_UNIT.match(value) if isinstance(value, str) else None
        return bool(match and match[2]) or (isinstance(value, tuple) and value[1] is not None)

    def check_range(self, number: Number, written: Value) -> None:
        """Refuses an SI number outside the range of the model description; the message shows values in the usual unit."""
        low, high = self.minimum, self.maximum
        if (low is None or number >= low) and (high is None or number <= high):
            return
        text = " ".join(map(str, written)) if isinstance(written, tuple) else written
        unit, ends = self.shown(np.array([-math.inf if low is None else low, math.inf if high is None else high]))
        raise DifferentialError(f"{self.name}: {text} is outside [{ends[0]:.6g}, {ends[1]:.6g}] {unit}".rstrip())

    def shown_in(self, unit: str | None) -> Self:
        """Copy of this variable with `unit`, one of `units`, as its usual unit. Differences are never shown in a unit with an offset: 5 K,
        not 5 degC."""
        found = copy.copy(self)
        if unit is not None and not (self.is_relative and unit in self._with_offset):
            found._usual = unit
        return found

    def shown(self, values: _Shown) -> tuple[str, _Shown]:
        """Usual unit of the variable, and SI `values` in it."""
        factor, offset = self.units.get(self._usual, (1.0, 0.0))
        name = self._usual or self.unit or ""
        return ("" if name == "1" else name), values * factor + offset

    def text(self, value: Number) -> str:
        """Value with its usual unit, or the name of its literal, for messages."""
        if self.kind not in ("Real", "Integer"):
            return str(self.written(value)).lower() if self.kind == "Boolean" else str(self.written(value))
        unit, number = self.shown(value)
        return f"{number:.6g} {unit}".strip()

    def in_files(self, values: _Shown, preferred: Mapping[str, str]) -> tuple[str, _Shown]:
        """Unit in files, and SI `values` in it: SI, unless `preferred` has another unit of its dimension, by SI unit."""
        return self.shown(values) if (self.unit or "") in preferred else (self.unit or "", values)

    def column(self, name: str, values: Iterable[Any], preferred: Mapping[str, str]) -> tuple[str, list[Any]]:
        """Head and cells of a column of SI `values`. With `preferred` units, the head contains the unit, as in "left.speed:mean [rpm]".
        Empty cells stay empty."""
        if not preferred or self.kind != "Real":
            return name, list(values)
        unit, _ = self.in_files(0.0, preferred)
        cells = [value if value in (None, "") else self.in_files(value, preferred)[1] for value in values]
        return (name if unit in ("", "1") else f"{name} [{unit}]"), cells

    def _boolean(self, value):
        words = {"true": True, "false": False}
        if isinstance(value, str) and value.lower() in words:
            return words[value.lower()]
        if isinstance(value, (bool, int, np.bool_)):
            if value in (0, 1):
                return bool(value)
        raise DifferentialError(f"{self.name} = {value!r}: it is true or false")

    def _literal(self, value):
        if isinstance(value, str) and value in self.literals:
            return self.literals[value]
        if not isinstance(value, (str, bool)) and value in self.literals.values():
            return int(value)
        words = ", ".join(f"{name} ({number})" for name, number in self.literals.items())
        raise DifferentialError(f"{self.name} = {value!r}: it is one of {words}{suggestion(str(value), self.literals)}")

    def _parsed(self, text):
        match = _NUMBER_AND_UNIT.match(text)
        if not match:
            raise DifferentialError(f"{self.name} = {text!r}: write a number, or a number and a unit, such as \"4.5 mm\"")
        return self._si(match[1], match[2], text)

    def _si(self, number, unit, written):
        number = self._float(number, written)
        unit = unit and spelled(unit)
        if unit is None or unit == self.unit:
            return number
        if unit not in self.units:
            known = ", ".join(self.units) or "no unit"
            raise DifferentialError(f"{self.name} = {written!r}: unit {unit!r} is not one of {known}")
        factor, offset = self.units[unit]
        return (number - offset) / factor

    def _float(self, value, written):
        try:
            if isinstance(value, (bool, np.bool_)):
                raise TypeError
            number = float(value)
        except (TypeError, ValueError):
            raise DifferentialError(f"{self.name} = {written!r}: it is a number{self._in_unit()}") from None
        if not math.isfinite(number):
            raise DifferentialError(f"{self.name} = {written!r}: it is a finite number{self._in_unit()}")
        return number

    def _whole(self, number):
        if self.kind != "Integer":
            return number
        if number != int(number):
            raise DifferentialError(f"{self.name} = {number!r}: it is a whole number")
        if not -2**31 <= number < 2**31:
            raise DifferentialError(f"{self.name} = {number:.15g}: it is a whole number from {-2**31} to {2**31 - 1}")
        return int(number)

    def _declared(self, text):
        """Value from the model description, in the form of the FMU."""
        if text is None:
            return None
        return {"Real": float, "Boolean": "true".__eq__}.get(self.kind, int)(text)

    def _in_unit(self):
        return f" in {self.unit}" if self.unit not in (None, "", "1") else ""


class Variables(Protocol):
    """Look-up of variables by name, such as an `Fmu`."""

    def variable(self, name: str) -> Variable:
        """Variable `name`. Raises `DifferentialError` for an unknown name."""

    def output(self, name: str) -> Variable:
        """Variable `name` for a record. Raises `DifferentialError` for an unknown name."""


def suggestion(word: str, known: Iterable[str]) -> str:
    """Text " (did you mean …?)", or nothing."""
    return _near(word, known)[0]


def variable_suggestion(name: str, known: Iterable[str]) -> str:
    """Suggestion for the name of a variable. If no name is similar, it explains how to find one."""
    near, find = _near(name, known)
    return near or find


def _near(word, known):
    """Words that were probably meant, if any, and advice on how to find a variable."""
    try:
        found = reply({"ask": "near", "word": word, "known": list(known)})["answer"]
    except OSError:
        # the message is valid without a suggestion
        return "", ""
    near = f" (did you mean {' or '.join(found['near'])}?)" if found["near"] else ""
    return found["removed"] or near, f"; {found['find']}"
