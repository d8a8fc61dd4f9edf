"""Writes a table into docs/design.md, between the marks of its name."""

import re
from pathlib import Path

PAGE = Path(__file__).resolve().parents[4] / "docs" / "design.md"


def write(name: str, rows) -> None:
    """Renews the table `name` of the page; the first of the rows is the header."""
    header, *others = [[cell.strip() for cell in row] for row in rows]
    lines = [header, ["---", *["---:"] * (len(header) - 1)], *others]
    table = "\n".join(f"| {' | '.join(line)} |" for line in lines)
    begin, end = f"<!-- {name} begin -->", f"<!-- {name} end -->"
    text, found = re.subn(f"{begin}.*?{end}", lambda _: f"{begin}\n{table}\n{end}", PAGE.read_text(encoding="utf-8"), flags=re.DOTALL)
    assert found == 1, f"{PAGE} has no table {name}"
    PAGE.write_text(text, encoding="utf-8")
