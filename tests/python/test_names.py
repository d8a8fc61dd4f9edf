"""Names of variables form a tree, which tools need for buses or records."""

import re

import pytest
from fmpy import read_model_description


class Node:
    """Node of the tree: kinds by its uses, members and elements."""

    def __init__(self):
        self.kinds, self.below = set(), {}

    def add(self, parts):
        """Adds the rest of a name: [("", "left"), ("[", "1"), ...]."""
        if not parts:
            self.kinds.add("leaf")
            return
        (kind, word), *rest = parts
        self.kinds.add("array" if kind == "[" else "record")
        self.below.setdefault(word, Node()).add(rest)

    def shape(self):
        """All variables below this node."""
        return frozenset((word, node.shape()) for word, node in self.below.items())

    def faults(self, name):
        """Yields faults that a tree of records and arrays cannot have."""
        if len(self.kinds) > 1:
            yield f"{name} is {' and '.join(sorted(self.kinds))}"
        if "array" in self.kinds and len({node.shape() for node in self.below.values()}) > 1:
            yield f"elements of {name} differ"
        for word, node in self.below.items():
            yield from node.faults(f"{name}.{word}")


def faults(names):
    """Faults of the tree of all names; derivatives have a separate tree."""
    trees = {"": Node(), "der": Node()}
    for name in names:
        inner = re.fullmatch(r"der\((.*)\)", name)
        parts = re.findall(r"(^|\.|\[)([^.\[\]]+)\]?", inner[1] if inner else name)
        assert "".join(f"{kind}{word}{']' if kind == '[' else ''}" for kind, word in parts) == (inner[1] if inner else name)
        trees["der" if inner else ""].add(parts)
    return [fault for name, tree in trees.items() for fault in tree.faults(name)]


def test_the_tree_of_names_finds_conflicts():
    for names, fault in [(["a.b", "a[1]"], ".a is array and record"), (["a", "a.b"], ".a is leaf and record"),
                         (["a", "a[1]"], ".a is array and leaf"), (["a[1].b", "a[2].c"], "elements of .a differ"),
                         (["a[1].b[1].c", "a[2].b[1].d"], "elements of .a differ")]:
        assert faults(names) == [fault]
    assert faults(["a.b[1].c", "a.b[2].c", "a.d", "der(a.d)", "e"]) == []


@pytest.mark.parametrize("version", [2, 3])
def test_names_make_a_tree_of_records_and_arrays(fmu_file, fmu3, version):
    names = [variable.name for variable in read_model_description(fmu_file if version == 2 else fmu3).modelVariables]
    if version == 3:
        assert {f"mesh.pairs_{part}" for part in ("tooth", "force", "height")} < {*names}
    assert faults(names) == []
