"""Curves of the teeth as texts, for the command "curve through XYZ points" of a CAD program."""

import numpy as np

# micrometres to the sixth digit
DIGITS = 12


def curves(shape, part):
    """Texts by the names of curves: a line per point, x y z in millimetres, no header."""
    return {curve["name"]: _text(np.array(curve["points"])) for curve in shape["curves"] if curve["name"].startswith(part)}


def _text(points):
    units = points * 1e3 * 10.0**DIGITS
    # adding zero makes a negative zero positive
    rounded = np.trunc(units + np.copysign(0.5, units)) / 10.0**DIGITS + 0.0
    return "".join(f"{x:.12f} {y:.12f} {z:.12f}\n" for x, y, z in rounded).encode()
