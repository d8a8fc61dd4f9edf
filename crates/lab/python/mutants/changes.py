"""Possible changes of the source, in which one expression replaces another, and the source with several of them built in, each inactive
until it is selected."""

import random
from dataclasses import dataclass
from pathlib import Path

import tree_sitter_rust
from tree_sitter import Language, Node, Parser

BINARY = {"+": "-", "-": "+", "*": "/", "/": "*", "<": ">", "<=": ">=", ">": "<", ">=": "<=", "==": "!=", "!=": "==", "&&": "||",
          "||": "&&", "+=": "-=", "-=": "+=", "*=": "/=", "/=": "*="}
NAMES = {"min": "max", "max": "min", "sin": "cos", "cos": "sin"}
# factor by which a literal is enlarged
LARGER = 1.2
# nodes that are not calculated at run time, or in which an expression with a branch is not allowed
CLOSED = {"const_item", "static_item", "attribute_item", "inner_attribute_item", "macro_invocation", "macro_definition", "array_type",
          "type_arguments", "const_block", "match_pattern", "range_pattern", "tuple_struct_pattern", "or_pattern", "const_parameter",
          "enum_variant", "let_chain"}


@dataclass(frozen=True)
class Change:
    """A change: bytes `begin` to `end` of `file` become `after`; `before` is their present text, `line` their line number from 1."""

    file: str
    begin: int
    end: int
    before: str
    after: str
    line: int

    @property
    def name(self) -> str:
        """Description of the change, independent of line numbers."""
        return f"{' '.join(self.before.split())} → {' '.join(self.after.split())}"

    @property
    def module(self) -> str:
        """Folder of the file; in the model, the folder within it."""
        parts = self.file.split("/")
        return "/".join(parts[:3 if parts[1] == "model" else 2])


def drawn(root: Path, modules: list[str], count: int, seed: int, without: set[Change] = frozenset(), kind=None) -> list[Change]:
    """Draws `count` changes of the files in `modules` by a seed, without overlaps and without those in `without`. `kind` returns all
    changes of a file; `possible` is the default."""
    files = sorted(file.relative_to(root).as_posix() for module in modules for file in (root / module).rglob("*.rs")
                   if not file.stem.endswith("tests") and "tests" not in file.parts)
    everything = [change for file in files for change in (kind or possible)(root, file)]
    random.Random(seed).shuffle(everything)
    taken: list[Change] = []
    for change in everything:
        apart = all(change.file != other.file or change.end <= other.begin or other.end <= change.begin for other in taken)
        if len(taken) < count and apart and change not in without:
            taken.append(change)
    return sorted(taken, key=lambda change: (change.file, change.begin))


def possible(root: Path, file: str) -> list[Change]:
    """All changes of a file except those in its tests."""
    text = (root / file).read_bytes()
    found: list[Change] = []
    _walk(tree(text), text, file, found)
    return found


def tree(text: bytes) -> Node:
    """Syntax tree of a source text."""
    return Parser(Language(tree_sitter_rust.language())).parse(text).root_node


def _walk(node, text, file, found):
    if node.type in CLOSED or is_const(node, text) or is_tests(node, text):
        return
    after = _changed(node, text)
    if after is not None:
        before = text[node.start_byte:node.end_byte].decode()
        found.append(Change(file, node.start_byte, node.end_byte, before, after, node.start_point[0] + 1))
    for child in node.children:
        _walk(child, text, file, found)


def _changed(node, text):
    """Replacement of an expression, or None if the expression is not changed."""
    def piece(begin, end):
        return text[begin:end].decode()

    if node.type in ("binary_expression", "compound_assignment_expr"):
        operator = node.child_by_field_name("operator")
        other = BINARY.get(operator.type)
        return other and piece(node.start_byte, operator.start_byte) + other + piece(operator.end_byte, node.end_byte)
    if node.type == "unary_expression" and node.children[0].type == "-":
        return piece(node.children[1].start_byte, node.end_byte)
    if node.type == "float_literal":
        number = piece(node.start_byte, node.end_byte)
        value = float(number.removesuffix("f64").replace("_", ""))
        return (repr(value * LARGER) + ("f64" if number.endswith("f64") else "")) if value else None
    if node.type == "call_expression":
        function = node.child_by_field_name("function")
        name = function.child_by_field_name("field") if function.type == "field_expression" else function
        other = NAMES.get(piece(name.start_byte, name.end_byte))
        return other and piece(node.start_byte, name.start_byte) + other + piece(name.end_byte, node.end_byte)
    return None


def is_const(node, text):
    return node.type == "function_item" and any(child.type == "function_modifiers" and b"const" in text[child.start_byte:child.end_byte]
                                                for child in node.children)


def is_tests(node, text):
    return node.type == "mod_item" and text[node.start_byte:node.end_byte].startswith(b"mod tests")


def build_in(root: Path, changes: list[Change]) -> dict[str, list[tuple[int, int, Change]]]:
    """Writes the changes into the files under `root`; number k, counted from 1, is active if `MUTANT=k`. Returns by file the written byte
    ranges with their changes."""
    places: dict[str, list[tuple[int, int, Change]]] = {}
    for file in {change.file for change in changes}:
        text, out, at = (root / file).read_bytes(), b"", 0
        for number, change in enumerate(changes, 1):
            if change.file == file:
                out += text[at:change.begin]
                written = f"(if crate::mutants::on({number}) {{ {change.after} }} else {{ {change.before} }})".encode()
                places.setdefault(file, []).append((len(out), len(out) + len(written), change))
                out, at = out + written, change.end
        (root / file).write_bytes(out + text[at:])
    return places
