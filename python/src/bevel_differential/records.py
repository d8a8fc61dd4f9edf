"""Tables in files: CSV with comment lines that start with #, then a header and rows; or Parquet."""

import csv
from collections.abc import Iterable, Sequence
from pathlib import Path
from typing import Any

from .extras import require
from .output_file import checked, is_parquet
from .values import FileName
from .writing import whole


def write(file: FileName, head: Sequence[str], rows: Iterable[Iterable[Any]], *comments: str) -> Path:
    """Writes a file, as Parquet if its ending says so; numbers are read back to the same bits."""
    checked(file, "table")
    if is_parquet(file):
        pa = require("pyarrow", "sweep")
        columns = dict(zip(head, map(list, zip(*rows))))
        table = pa.table({name: [None if cell == "" else cell for cell in cells] for name, cells in columns.items()})
        with whole(file) as part:
            require("pyarrow.parquet", "sweep").write_table(table.replace_schema_metadata({"comment": "\n".join(comments)}), part)
        return Path(file)
    with whole(file) as part, open(part, "w", newline="", encoding="utf-8") as out:
        out.writelines(f"# {comment}\n" for comment in comments)
        writer = csv.writer(out, lineterminator="\n")
        writer.writerow(head)
        writer.writerows(rows)
    return Path(file)


def read(path):
    """Machine, from a comment of the measuring commands, and rows with numbers converted."""
    lines = path.read_text(encoding="utf-8").splitlines()
    machine = next((line.split(":", 1)[1].strip() for line in lines if line.startswith("# machine:")), "")
    rows = csv.DictReader(line for line in lines if not line.startswith("#"))
    return machine, [{key: number(value) for key, value in row.items()} for row in rows]


def number(text):
    try:
        return float(text)
    except ValueError:
        return text
