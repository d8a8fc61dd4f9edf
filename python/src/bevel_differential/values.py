"""Values in the form that users write, and in the form of the FMU."""

import copy
import math
import os
import re
from collections.abc import Iterable, Mapping, Sequence, Set
from functools import cache
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

_Number = TypeVar("_Number", float, np.ndarray)

# kinds of FMI 3.0 by the names of FMI 2.0
_KINDS = {"Float64": "Real", "Int32": "Integer", "UInt64": "Integer"}
# separator between the middle of a band and its half width
BAND = re.compile(r"\+-|\+/-|±")


def split(text: str) -> tuple[float, str] | None:
    """Number and unit of a text, with or without a blank between, or None if the text does not begin with a number."""
    found = _reply({"ask": "split", "text": text})
    return (found["answer"]["number"], found["answer"]["unit"]) if "answer" in found else None


@cache
def units_of(unit: str) -> dict[str, tuple[float, float]]:
    """Units in which values of an SI unit may be written: their number in one SI unit, and their value for 0 in SI, by name."""
    return {name: (factor, offset) for name, (factor, offset) in _reply({"ask": "units", "unit": unit})["answer"]["units"].items()}


def _reply(question):
    """Reply of the library, which reads all values."""
    try:
        return reply(question)
    except OSError as missing:
        raise DifferentialError(str(missing), kind="failed") from None


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

        `value` may be a number, a pair (number, unit), text such as "4.5 mm", true or false, or a literal's name or number."""
        if self.kind == "Real" and isinstance(value, float) and math.isfinite(value):
            return float(value)
        question = {"ask": "value", "kind": self.kind, "unit": self.unit or "1", "is_relative": self.is_relative,
                    "literals": list(self.literals.items()), "value": self._plain(value)}
        found = _reply(question)
        if "answer" not in found:
            raise DifferentialError(f"{self.name} = {value!r}: {found['problems'][0]['message']}")
        number = found["answer"]["value"]
        # JSON has neither NaN nor infinity
        return self._finite(math.nan, value) if number is None else number

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
        read = [split(part) for part in parts]
        if any(found and found[1] for found in read) and re.search(r"\d,\d", written):
            raise DifferentialError(f"{self.name} = {written}: write decimal points, and a unit at each number; the comma separates numbers")
        bare = [part for part, found in zip(parts, read) if found and not found[1] and found[0] != 0.0]
        if bare and any(found and found[1] for found in read):
            raise DifferentialError(f"{self.name} = {written}: {bare[0]} has no unit, but others have one; write it at each "
                                    "number")
        second = self.differences() if written.startswith("normal(") or BAND.search(written) else self
        return tuple((second if index == 1 else self).number(part) for index, part in enumerate(parts))

    def has_unit(self, value: Value) -> bool:
        """True if `value` is written with its unit."""
        if self.kind != "Real":
            return False
        found = split(value) if isinstance(value, str) else None
        return bool(found and found[1]) or (isinstance(value, tuple) and value[1] is not None)

    def check_range(self, number: Number, written: Value, where: str = "") -> None:
        """Refuses an SI number outside the range of the model description. The message shows values in the usual unit and ends with
        `where`."""
        low, high = self.minimum, self.maximum
        if (low is None or number >= low) and (high is None or number <= high):
            return
        text = " ".join(map(str, written)) if isinstance(written, tuple) else written
        unit, ends = self.shown(np.array([-math.inf if low is None else low, math.inf if high is None else high]))
        low, high = (f"{end:.6g}" for end in ends)
        if low == high:
            raise DifferentialError(f"{self.name}: {text} is not {low} {unit}, the only possible value. {self.description}{where}")
        raise DifferentialError(f"{self.name}: {text} is outside [{low}, {high}] {unit}".rstrip() + where)

    def shown_in(self, unit: str | None) -> Self:
        """Copy of this variable with `unit`, one of `units`, as its usual unit. Differences are never shown in a unit with an offset: 5 K,
        not 5 degC."""
        found = copy.copy(self)
        if unit is not None and unit not in self.units:
            more = units_of(self.unit or "1")
            found._with_offset = {*self._with_offset, *(name for name, (_, offset) in more.items() if offset)}
            found.units = {name: (factor, 0.0 if self.is_relative else offset) for name, (factor, offset) in more.items()} | self.units
        if unit is not None and not (self.is_relative and unit in found._with_offset):
            found._usual = unit
        return found

    def shown(self, values: _Number) -> tuple[str, _Number]:
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

    def in_files(self, values: _Number, preferred: Mapping[str, str]) -> tuple[str, _Number]:
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

    def _plain(self, value):
        """Value for the reader: text, true or false, or a finite number."""
        is_digit = self.kind == "Boolean" and isinstance(value, (int, np.integer)) and value in (0, 1)
        if is_digit or isinstance(value, (bool, np.bool_)):
            return bool(value)
        if isinstance(value, tuple) and len(value) == 2:
            number, unit = value
            # the reader explains a decimal comma
            has_comma = isinstance(number, str) and "," in number
            return f"{number if has_comma else repr(self._finite(number, value))} {unit or ''}".strip()
        return value if isinstance(value, str) else self._finite(value, value)

    def _finite(self, value, written):
        try:
            number = math.nan if isinstance(value, (bool, np.bool_)) else float(value)
        except (TypeError, ValueError):
            raise DifferentialError(f"{self.name} = {written!r}: it is a number{self._in_unit()}") from None
        if not math.isfinite(number):
            raise DifferentialError(f"{self.name} = {written!r}: it is a finite number{self._in_unit()}")
        return number

    def _declared(self, text):
        """Value from the model description, in the form of the FMU."""
        if text is None:
            return None
        return {"Real": float, "Boolean": "true".__eq__}.get(self.kind, int)(text)

    def _in_unit(self):
        return f" in {self.unit}" if self.unit not in (None, "", "1") else ""


class Quantity(Variable):
    """Quantity other than the variables of the FMU, in the SI unit `unit`. Its values are read like those of variables."""

    def __init__(self, name: str, unit: str):
        self.name, self.kind, self.causality, self.literals, self.unit = name, "Real", "input", {}, unit
        self.minimum = self.maximum = None
        self.units = {unit: (1.0, 0.0)}


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
    return near, f"; {found['find']}"
