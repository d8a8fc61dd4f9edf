"""Files of the library use each other one way: there is no cycle of direct `use` between them. Names that a `mod.rs` exports from
its files are not followed."""

import re
from pathlib import Path

import pytest

SOURCES = Path(__file__).resolve().parents[2] / "src"
USE = re.compile(r"^\s*(?:pub(?:\([^)]*\))? )?use ([^;]+);", re.M)


def paths(tree):
    """Paths of a `use` tree."""
    head, brace, rest = tree.partition("{")
    if not brace:
        return [tree.strip()]
    parts, depth, part = [], 0, ""
    for letter in rest.rpartition("}")[0] + ",":
        depth += (letter == "{") - (letter == "}")
        if letter == "," and depth == 0:
            parts.append(part.strip())
            part = ""
        else:
            part += letter
    return [head.strip() + one for part in filter(None, parts) for one in paths(part)]


def absolute(module, path, modules):
    """Names of a path from the root; nothing for other crates."""
    names, at = path.split("::"), list(module)
    if names[0] == "crate":
        return tuple(names[1:])
    while names[0] == "super":
        at.pop()
        names.pop(0)
        if names[0] != "super":
            return (*at, *names)
    return (*at, *names) if (*at, names[0]) in modules else ()


def graph(texts):
    """Files that each file uses, by module. Tests within a file are not counted."""
    found = {}
    for module, text in texts.items():
        code = re.sub(r"//[^\n]*", "", text.partition("#[cfg(test)]\nmod tests {")[0])
        used = (absolute(module, path, texts) for use in USE.findall(code) for path in paths(" ".join(use.split())))
        homes = (next((path[:k] for k in range(len(path), 0, -1) if path[:k] in texts), None) for path in used)
        found[module] = {home for home in homes if home not in (None, module)}
    folders = {module[:-1] for module in texts if module}
    return {module: used - folders for module, used in found.items() if module not in folders}


def circles(used):
    """Groups of files that reach each other."""
    reached = {}
    for start in used:
        seen, left = set(), [start]
        while left:
            for other in used[left.pop()] - seen:
                seen.add(other)
                left.append(other)
        reached[start] = seen
    groups = {frozenset(other for other in reached[one] if one in reached[other]) for one in used}
    return sorted(sorted("::".join(module) for module in group) for group in groups if group)


def module_of(file):
    parts = file.relative_to(SOURCES).with_suffix("").parts
    return parts[:-1] if parts[-1] in ("mod", "lib") else parts


def test_no_files_of_the_library_use_each_other_in_a_circle():
    texts = {module_of(file): file.read_text(encoding="utf-8") for file in SOURCES.rglob("*.rs") if "tests" not in file.parts}
    used = graph(texts)
    assert sum(map(len, used.values())) > 300
    assert circles(used) == []


@pytest.mark.parametrize("first", ["use super::b::B;", "use crate::{a::C, b::{self, B}};", "pub(crate) use crate::d::e::E;"])
def test_a_circle_is_found(first):
    texts = {(): "mod a;", ("a",): f"{first}\nstruct A;", ("b",): "use super::d::e;", ("d",): "mod e;", ("d", "e"): "use super::super::a::A;\nstruct E;"}
    assert [("a" in group and "d::e" in group) for group in circles(graph(texts))] == [True]
    assert not circles(graph({**texts, ("d", "e"): "struct E;"}))
