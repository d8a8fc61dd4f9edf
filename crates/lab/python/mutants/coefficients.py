"""Coefficients of the physics; each change makes one of them 2 % larger.

A coefficient is a decimal number of a formula: a summand, a factor or divisor, the exponent of a power, or a constant of `CONSTANTS`.
The numbers 0.5, 1 and 2 are excluded because they are algebra, and powers of ten because they are units or tolerances. Also excluded
are limits in comparisons, arguments of min, max and clamp, bounds of ranges, start values and ranges of parameters (which a scene
sets), numbers in messages, and the mathematics in `METHODS`."""

import re
from pathlib import Path

import changes

MODULES = ["src/contact", "src/friction", "src/geometry", "src/model/dynamics", "src/model/effects", "src/strength"]
LARGER = 1.02
# named constants of formulas; others are limits, steps, roundings and units
CONSTANTS = {
    "src/contact/solid/mesh.rs": {"SOFTNESS"},
    "src/friction/xu_kahraman.rs": {"B", "RMS"},
    "src/geometry/addendum.rs": {"GLEASON_CLEARANCE"},
    "src/model/effects/thrust_friction.rs": {"PIN_IN_ROOT"},
}
# files and functions with series, quadrature, differences, splines, iterations and searches; checks and warnings
METHODS = {"checks.rs", "corner.rs", "exponential.rs", "kinks.rs", "ledger_rates.rs", "material.rs", "pairs.rs", "past_end.rs", "points.rs",
           "quadrature.rs", "spline.rs", "table.rs", "angle_of_tangent", "compliance_ratio", "least_alone", "outside", "rough_ln",
           "along_step.rs", "interval.rs", "smooth.rs"}
ALGEBRA = (0.0, 0.5, 1.0, 2.0)
ARITHMETIC, COMPARISON = {"+", "-", "*", "/"}, {"<", "<=", ">", ">=", "==", "!="}
# nodes whose parent decides if a number in them is a coefficient
TRANSPARENT = ("unary_expression", "parenthesized_expression", "arguments", "array_expression", "block")


def opened(root):
    """Turns `CONSTANTS` into functions, so that a running program can choose their values."""
    for file, names in CONSTANTS.items():
        text = (root / file).read_text(encoding="utf-8")
        for name in names:
            text = re.sub(rf"\bconst {name}: ([^=]+) = ([^;]+);", rf"fn {name}@ -> \1 {{ \2 }}", text)
            text = re.sub(rf"\b{name}\b@?", f"{name}()", text)
        (root / file).write_text(text, encoding="utf-8")


def is_closed(node):
    """True if no number in the node is a coefficient."""
    if node.type == "arguments" and node.parent.type == "call_expression":
        return field(node.parent, "function").endswith((".min", ".max", ".clamp"))
    return (changes.is_closed(node) or node.type == "range_expression" or node.type == "function_item" and field(node, "name") in METHODS
            or node.type == "binary_expression" and field(node, "operator") in COMPARISON)


def replacement(file, node):
    """A coefficient that is larger, or None if the node is not a coefficient."""
    if Path(file).name in METHODS or node.type != "float_literal":
        return None
    # a power of ten begins with 1.000000e
    if changes.value_of(node) in ALGEBRA or f"{changes.value_of(node):e}".startswith("1.000000e") or not is_in_formula(file, node.parent):
        return None
    return f"({changes.text_of(node)} * {LARGER}{'f64' * node.text.endswith(b'f64')})"


def is_in_formula(file, node):
    """True if a number in the node is part of a formula."""
    while node.type in TRANSPARENT:
        node = node.parent
    return (node.type == "binary_expression" and field(node, "operator") in ARITHMETIC
            or node.type == "call_expression" and field(node, "function").endswith(("pow", "powf"))
            or node.type == "function_item" and field(node, "name") in CONSTANTS.get(file, ()))


def field(node, name):
    """Text of a field of a node."""
    return changes.text_of(node.child_by_field_name(name))
