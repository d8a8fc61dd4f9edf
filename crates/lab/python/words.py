"""Finds wording that readers stumble over: in doc comments, docstrings and pages. A tool for writers; it never fails.

usage: words.py [--places] [--within PATH]

Counts openings of doc comments that do not name a thing or an action, compressed phrases, and sentences that are too long on the
README and the pages in docs/. `--places` also prints each place. PATH limits the search to a folder or a file."""

import argparse
import ast
import re
import subprocess
from collections import Counter
from pathlib import Path

from bevel_differential.text import markdown

ROOT = Path(__file__).parents[3]
OPENINGS = re.compile(r"(What|Whether|How|Where|Why|The same|Those|All that|Of|As|With|Between)\b")
PHRASES = re.compile(r"\b(is no|is none|anew|at its begin|so many|so often|in that of)\b", re.IGNORECASE)
# words of a sentence on a page
LONGEST = 30
DOC = re.compile(r"\s*//[/!] ?(.*)")


def rust_comments(text):
    """Doc comments of Rust: first line and text of each."""
    begin, lines = 0, []
    for number, line in enumerate([*text.splitlines(), ""], 1):
        if found := DOC.match(line):
            begin, lines = (begin if lines else number), [*lines, found[1]]
        elif lines:
            yield begin, " ".join(lines)
            lines = []


def docstrings(text):
    """Docstrings of Python: first line and text of each."""
    for node in ast.walk(ast.parse(text)):
        if isinstance(node, ast.Module | ast.ClassDef | ast.FunctionDef) and ast.get_docstring(node):
            yield node.body[0].lineno, ast.get_docstring(node)


def prose(text):
    """Sentences of a page: line and words. Code, tables, headings and generated sections are left out."""
    text = re.sub(r"<!-- (\w+):begin -->.*?<!-- \1:end -->|```.*?```", lambda found: "\n" * found[0].count("\n"), text, flags=re.DOTALL)
    begin, lines = 0, []
    for number, line in enumerate([*text.splitlines(), ""], 1):
        ends = not line.strip() or re.match(r"\s*([|#<]|    )", line)
        if lines and (ends or re.match(r"\s*([-*]|\d+\.) ", line)):
            yield from sentences(begin, lines)
            lines = []
        if not ends:
            begin, lines = (begin if lines else number), [*lines, line]


def sentences(begin, lines):
    """Sentences of a paragraph, each with the line where its paragraph begins. A link counts by its text, code as one word."""
    text = re.sub(r"!?\[([^]]*)\]\([^)]*\)", r"\1", re.sub(r"`[^`]*`", "code", " ".join(lines)))
    for sentence in re.split(r"(?<=[.!?:;])\s+(?=[A-Z0-9(*\[])", text):
        yield begin, re.findall(r"[^\W_][\w'’.,−-]*", sentence)


def places(within):
    """All places: file, line, kind of pattern, pattern and text."""
    names = subprocess.run(["git", "ls-files", within], cwd=ROOT, check=True, capture_output=True, text=True).stdout.split("\n")
    for name in names:
        read = {".rs": rust_comments, ".py": docstrings}.get(Path(name).suffix)
        is_page = name == "README.md" or name.startswith("docs/") and name.endswith(".md")
        if not read and not is_page:
            continue
        text = (ROOT / name).read_text(encoding="utf-8")
        for line, comment in read(text) if read else ():
            if opening := OPENINGS.match(comment):
                yield name, line, "opening", opening[1], comment
            for phrase in PHRASES.findall(comment):
                yield name, line, "phrase", phrase.lower(), comment
        for line, words in prose(text) if is_page else ():
            if len(words) > LONGEST:
                yield name, line, "sentence", f"above {LONGEST} words", " ".join(words)
            for phrase in PHRASES.findall(" ".join(words)):
                yield name, line, "phrase", phrase.lower(), " ".join(words)


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("--places", action="store_true")
    parser.add_argument("--within", default=".")
    given = parser.parse_args()
    found = list(places(given.within))
    if given.places:
        for name, line, kind, pattern, text in found:
            print(f"{name}:{line}: {kind} \"{pattern}\": {text[:120]}")
    of_kind = {"rs": "Rust", "py": "Python", "md": "pages"}
    counted = Counter((kind, pattern, of_kind[name.rpartition(".")[2]]) for name, _, kind, pattern, _ in found)
    rows = sorted({(kind, pattern) for kind, pattern, _ in counted})
    print(markdown([["kind", "pattern", *of_kind.values()],
                    *([kind, pattern, *(str(counted[kind, pattern, each]) for each in of_kind.values())] for kind, pattern in rows)]))


if __name__ == "__main__":
    main()
