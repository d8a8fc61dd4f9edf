"""Texts of numbers and units in the report."""

from collections.abc import Iterable

from ..readable import time_scale, unit_text
from ..values import Number, Variable

DIGITS = 4


def number(value: float, digits: int = DIGITS) -> str:
    """Text of a number with `digits` significant digits. Below 1e7, all digits before the point are kept, without an exponent."""
    text = f"{value:.{digits}g}"
    if "e" in text and 1e-4 <= abs(value) < 1e7:
        text = f"{value:.0f}"
    return text.replace("-", "−") if text != "-0" else "0"


def quantity(value: float, unit: str, digits: int = DIGITS) -> str:
    """Text of a number with its unit."""
    return f"{number(value, digits)} {unit_text(unit)}".strip()


def moment(time: float, duration: float) -> str:
    """A time of a run [s], in the unit of the time axes of a run of this duration [s]."""
    factor, unit = time_scale(duration)
    return quantity(factor * time, unit)


def mm(length: float) -> str:
    """Text of a length, m, in millimetres."""
    return quantity(1e3 * length, "mm")


def shown(variable: Variable, value: Number, digits: int = DIGITS) -> str:
    """Text of a variable's value in its display unit, or of a literal by its name."""
    if variable.kind == "Boolean":
        return str(bool(value)).lower()
    if variable.literals:
        return str(variable.written(value))
    unit, given = variable.shown(float(value))
    return quantity(given, unit, digits)


def percent(part: float, digits: int = 3) -> str:
    """Text of a fraction in per cent."""
    return f"{number(100.0 * part, digits)} %"


def signed(value: float, digits: int = 3) -> str:
    """Text of a number with its sign."""
    return f"{'+' if value > 0.0 else ''}{number(value, digits)}"


def listed(words: Iterable[str], last: str = "and") -> str:
    """Joined words, such as "a, b and c"."""
    words = list(words)
    return f"{', '.join(words[:-1])} {last} {words[-1]}" if len(words) > 1 else "".join(words)
