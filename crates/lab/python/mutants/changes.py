"""Changes of the source, in which one expression replaces another, and the source with several of them built in, each inactive until it is
selected."""

import random
from dataclasses import dataclass

import tree_sitter_rust
from tree_sitter import Language, Parser

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
    def name(self):
        """Description of the change, independent of line numbers."""
        return f"{' '.join(self.before.split())} → {' '.join(self.after.split())}"

    @property
    def module(self):
        """Folder of the file; in the model, the folder within it."""
        parts = self.file.split("/")
        return "/".join(parts[:3 if parts[1] == "model" else 2])


def drawn(root, judge, count, seed, without=frozenset()):
    """Draws `count` changes of the files in the judge's `modules` by a seed, without overlaps and without those in `without`.
    `judge.replacement(file, node)` returns the text that replaces a node, or None; `judge.is_closed(node)` excludes a node and all below."""
    files = sorted(file.relative_to(root).as_posix() for module in judge.modules for file in (root / module).rglob("*.rs")
                   if not file.stem.endswith("tests") and "tests" not in file.parts)
    everything = [Change(file, node.start_byte, node.end_byte, text_of(node), after, node.start_point[0] + 1)
                  for file in files for node in nodes(parsed((root / file).read_bytes()), judge.is_closed)
                  if (after := judge.replacement(file, node))]
    random.Random(seed).shuffle(everything)
    taken = []
    for change in everything:
        apart = all(change.file != other.file or change.end <= other.begin or other.end <= change.begin for other in taken)
        if len(taken) < count and apart and change not in without:
            taken.append(change)
    return sorted(taken, key=lambda change: (change.file, change.begin))


def parsed(text):
    """Root of the syntax tree of a source text."""
    return Parser(Language(tree_sitter_rust.language())).parse(text).root_node


def nodes(node, is_closed):
    """A node and all nodes below it, except closed ones."""
    if not is_closed(node):
        yield node
        for child in node.children:
            yield from nodes(child, is_closed)


def is_closed(node):
    """True if an expression in the node cannot be chosen at run time, or belongs to a test."""
    return (node.type in CLOSED or node.type == "mod_item" and node.text.startswith(b"mod tests")
            or node.type == "function_item" and any(child.type == "function_modifiers" and b"const" in child.text for child in node.children))


def text_of(node):
    """Text of a node."""
    return node.text.decode()


def value_of(literal):
    """Value of a decimal literal."""
    return float(text_of(literal).removesuffix("f64").replace("_", ""))


def replacement(node):
    """Expression that replaces another one, or None if it is not changed."""
    part, new = None, None
    if node.type in ("binary_expression", "compound_assignment_expr"):
        part = node.child_by_field_name("operator")
        new = BINARY.get(part.type)
    elif node.type == "unary_expression" and node.children[0].type == "-":
        part, new = node.children[0], ""
    elif node.type == "float_literal" and value_of(node):
        part, new = node, repr(value_of(node) * LARGER) + "f64" * node.text.endswith(b"f64")
    elif node.type == "call_expression":
        function = node.child_by_field_name("function")
        part = function.child_by_field_name("field") if function.type == "field_expression" else function
        new = NAMES.get(text_of(part))
    if new is None:
        return None
    begin, end = part.start_byte - node.start_byte, part.end_byte - node.start_byte
    return (node.text[:begin] + new.encode() + node.text[end:]).decode()


def build_in(root, changes):
    """Writes the changes into the files under `root`; number k, counted from 1, is active if `MUTANT=k`. Returns by file the written byte
    ranges with their changes."""
    places = {}
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
