"""Numbers and texts for pictures."""

import re
import textwrap

import numpy as np


def unit_text(unit):
    """Printed form of a unit: N·m, kg·m², µm, N/mm^1.5."""
    return re.sub(r"\.(?!\d)", "·", unit).replace("um", "µm").replace("2", "²").replace("3", "³")


def printed(text):
    """Text with printed forms of its units. Points in names of variables remain."""
    return re.sub(r"N\.m(\.s)?|kg\.m2|m/s2", lambda unit: unit_text(unit[0]), text)


def axis_label(quantity, unit):
    """Label of an axis: quantity and unit, of which one may be empty."""
    return ", ".join(filter(None, (quantity, unit_text(unit))))


def spaced(value):
    """Large number with grouped digits: 16 078."""
    return f"{value:,.0f}".replace(",", " ")


def plain(value):
    """A number with three digits and without an exponent: 0.001, 25, 10 000."""
    return spaced(float(f"{value:.3g}")) if value >= 1e4 else np.format_float_positional(value, 3, fractional=False, trim="-")


def time_scale(duration):
    """Factor and unit that suit times within a `duration` [s]: ms or µs for short ones."""
    # a duration is the last communication point, which is rounded
    for shortest, factor, unit in [(0.1, 1.0, "s"), (1e-4, 1e3, "ms")]:
        if duration > shortest * (1.0 - 1e-9):
            return factor, unit
    return 1e6, "µs"


def percent(error):
    """Short text of a relative error in percent."""
    value = 100.0 * error
    if not np.isfinite(value):
        return "–"
    if value < 1e-3:
        return "0 %" if value < 1e-9 else "< 0.001 %"
    return f"{value:.2g} %" if value < 99.5 else f"{value:.0f} %"


def with_unit(value, unit):
    """Text of a value with its unit; small values have a smaller unit, and speeds in rad/s are shown in rpm."""
    if unit == 1.0:
        return f"{100.0 * value:.3g} %"
    if unit == "rad/s":
        value, unit = value * 30.0 / np.pi, "rpm"
    for whole, factor, part in [("m", 1e6, "µm"), ("s", 1e3, "ms"), ("J", 1e3, "mJ")]:
        if unit == whole and abs(value) < 0.1:
            return f"{factor * value:.4g} {part}"
    unit = unit_text(unit)
    return f"{spaced(value)} {unit}" if abs(value) >= 1e3 else f"{value:.4g} {unit}"


def ratio(value):
    """Text of a ratio with two digits."""
    return f"{value:.2g}" if value < 100.0 else spaced(float(f"{value:.2g}"))


def wrapped(text, width):
    return "\n".join(textwrap.wrap(text, width, break_on_hyphens=False))


# groups of variables whose name is a quantity instead of a body
QUANTITIES = ("safety", "heat", "stress", "damage", "power", "life")
STATISTICS = {"peak_to_peak": "{}, peak to peak", "min": "least {}", "max": "largest {}"}


def in_words(name):
    """Name of a variable, or of a statistic of it, in words: "planet[1].left_force_max:mean" is "largest force, planet 1 left, mean"."""
    name, _, statistic = str(name).partition(":")
    group, _, last = name.rpartition(".")
    body = group.replace("[", " ").replace("]", "")
    for side in ("left", "right"):
        if last.startswith(f"{side}_"):
            body, last = f"{body} {side}".strip(), last.removeprefix(f"{side}_")
    pattern = "{}"
    for ending, words in STATISTICS.items():
        if last.endswith(f"_{ending}"):
            pattern, last = words, last.removesuffix(f"_{ending}")
    last = last.replace("_", " ")
    if group in QUANTITIES:
        last, body = f"{last} {group}", ""
    elif " " not in body:
        last, body = f"{body} {last}".strip(), ""
    return ", ".join(filter(None, [pattern.format(last), body, "" if statistic == "final" else statistic.replace("_", " ")]))
