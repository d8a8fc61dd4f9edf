"""CSV files: comment lines with a #, then a header and rows."""

import csv
from collections.abc import Iterable, Sequence
from pathlib import Path
from typing import Any

from .values import FileName


def write(file: FileName, head: Sequence[str], rows: Iterable[Iterable[Any]], *comments: str) -> Path:
    """Writes a file; numbers read back to the same bits."""
    with open(file, "w", newline="", encoding="utf-8") as out:
        out.writelines(f"# {comment}\n" for comment in comments)
        writer = csv.writer(out, lineterminator="\n")
        writer.writerow(head)
        writer.writerows(rows)
    return Path(file)


def read(path):
    """Machine, which a comment of the measuring commands names, and rows; numbers as such."""
    lines = path.read_text(encoding="utf-8").splitlines()
    machine = next((line.split(":", 1)[1].strip() for line in lines if line.startswith("# machine:")), "")
    rows = csv.DictReader(line for line in lines if not line.startswith("#"))
    return machine, [{key: number(value) for key, value in row.items()} for row in rows]


def number(text):
    try:
        return float(text)
    except ValueError:
        return text
