"""Coefficients of the physics; each change makes one of them 2 % larger.

A coefficient is a decimal number of a formula: a summand, a factor or divisor, the exponent of a power, or a constant of `CONSTANTS`.
The numbers 0.5, 1 and 2 are excluded because they are algebra, and powers of ten because they are units or tolerances. Also excluded
are limits in comparisons, arguments of min, max and clamp, bounds of ranges, start values and ranges of parameters (which a scene
sets), numbers in messages, and the mathematics in `METHODS`."""

from pathlib import Path

from changes import CLOSED, Change, is_const, is_tests, tree

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


def opened(root: Path) -> None:
    """Turns `CONSTANTS` into functions, so that a running program can choose their values."""
    for file, names in CONSTANTS.items():
        text = (root / file).read_bytes()
        edits = []
        _open(tree(text), text, names, edits)
        for begin, end, new in sorted(edits, reverse=True):
            text = text[:begin] + new + text[end:]
        (root / file).write_bytes(text)


def _open(node, text, names, edits):
    name = node.child_by_field_name("name") if node.type == "const_item" else None
    if name is not None and text[name.start_byte:name.end_byte].decode() in names:
        kind, value = (text[each.start_byte:each.end_byte] for each in map(node.child_by_field_name, ("type", "value")))
        edits.append((node.start_byte, node.end_byte, b"fn %s() -> %s { %s }" % (text[name.start_byte:name.end_byte], kind, value)))
    elif node.type == "identifier" and text[node.start_byte:node.end_byte].decode() in names:
        edits.append((node.end_byte, node.end_byte, b"()"))
    else:
        for child in node.children:
            _open(child, text, names, edits)


def coefficients(root: Path, file: str) -> list[Change]:
    """Changes of a file whose constants are functions."""
    found: list[Change] = []
    if Path(file).name not in METHODS:
        text = (root / file).read_bytes()
        _walk(tree(text), text, file, False, found)
    return found


def _walk(node, text, file, inside, found):
    """Collects changes below a node; `inside` is True if the node is part of a formula."""
    if node.type in CLOSED or node.type == "range_expression" or is_const(node, text) or is_tests(node, text):
        return
    if node.type == "function_item":
        name = text[node.child_by_field_name("name").start_byte:node.child_by_field_name("name").end_byte].decode()
        if name in METHODS:
            return
        inside = name in CONSTANTS.get(file, ())
    elif node.type == "binary_expression":
        operator = node.child_by_field_name("operator").type
        if operator in COMPARISON:
            return
        inside = operator in ARITHMETIC
    elif node.type == "call_expression":
        function = node.child_by_field_name("function")
        name = text[function.start_byte:function.end_byte]
        inside = name.endswith((b"pow", b"powf"))
        if name.endswith((b".min", b".max", b".clamp")):
            _walk(function, text, file, False, found)
            return
    elif node.type == "float_literal":
        before = text[node.start_byte:node.end_byte].decode()
        value = float(before.removesuffix("f64").replace("_", ""))
        if inside and value not in ALGEBRA and not _is_power_of_ten(value):
            after = f"{before} * {LARGER}" if not before.endswith("f64") else f"{before} * {LARGER}f64"
            found.append(Change(file, node.start_byte, node.end_byte, before, f"({after})", node.start_point[0] + 1))
    elif node.type not in ("unary_expression", "parenthesized_expression", "arguments", "array_expression", "block", "-"):
        inside = False
    for child in node.children:
        _walk(child, text, file, inside, found)


def _is_power_of_ten(value):
    return f"{value:e}".rstrip("0123456789+-").rstrip("e").rstrip("0").rstrip(".") == "1"
