"""Numbers and units as the report writes them."""

from collections.abc import Iterable

from ..readable import time_scale
from ..values import Number, Variable

DIGITS = 4


def number(value: float, digits: int = DIGITS) -> str:
    """A number with so many significant digits; below 1e7 all digits before the point are kept, without an exponent."""
    text = f"{value:.{digits}g}"
    if "e" in text and 1e-4 <= abs(value) < 1e7:
        text = f"{value:.0f}"
    return text.replace("-", "−") if text != "-0" else "0"


def unit_text(unit: str) -> str:
    """A unit as it is printed."""
    return unit.replace(".", "·").replace("um", "µm").replace("^1·5", "^1.5")


def quantity(value: float, unit: str, digits: int = DIGITS) -> str:
    """A number with its unit."""
    return f"{number(value, digits)} {unit_text(unit)}".strip()


def moment(time: float, duration: float) -> str:
    """A time of a run [s], in the unit of the time axes of a run of this duration [s]."""
    factor, unit = time_scale(duration)
    return quantity(factor * time, unit)


def mm(length: float) -> str:
    """A length, m, in millimetres."""
    return quantity(1e3 * length, "mm")


def shown(variable: Variable, value: Number, digits: int = DIGITS) -> str:
    """A value of a variable in the unit that it is usually shown in; a literal by its name."""
    if variable.kind == "Boolean":
        return str(bool(value)).lower()
    if variable.literals:
        return str(variable.written(value))
    unit, given = variable.shown(float(value))
    return quantity(given, unit, digits)


def percent(part: float, digits: int = 3) -> str:
    """A fraction in per cent."""
    return f"{number(100.0 * part, digits)} %"


def signed(value: float, digits: int = 3) -> str:
    """A number with its sign."""
    return f"{'+' if value > 0.0 else ''}{number(value, digits)}"


def listed(words: Iterable[str], last: str = "and") -> str:
    """"a, b and c"."""
    words = list(words)
    return f"{', '.join(words[:-1])} {last} {words[-1]}" if len(words) > 1 else "".join(words)
