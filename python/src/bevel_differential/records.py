"""Tables in files: CSV with a plain header, which every program reads, or Parquet."""

import csv
import io
import re
from collections.abc import Iterable, Iterator, Sequence
from contextlib import contextmanager
from contextvars import ContextVar
from pathlib import Path
from typing import Any

from .extras import require
from .output_file import checked, is_parquet
from .values import DifferentialError, FileName
from .writing import whole


# decimal sign of the numbers in a CSV file, and separator of its columns
DECIMALS = {"point": (".", ","), "comma": (",", ";")}
_decimal = ContextVar("decimal", default="point")
_NUMBER = re.compile(r"[-+]?(\d+\.?\d*|\.\d+)(e[-+]?\d+)?", re.IGNORECASE)


@contextmanager
def decimal(sign: str) -> Iterator[None]:
    """Context in which CSV files have this decimal sign: "point", or "comma" for spreadsheets of countries that write 0,5. With decimal
    commas, semicolons separate the columns."""
    if sign not in DECIMALS:
        raise DifferentialError(f"decimal sign {sign!r}: it is {' or '.join(DECIMALS)}")
    token = _decimal.set(sign)
    try:
        yield
    finally:
        _decimal.reset(token)


def write(file: FileName, head: Sequence[str], rows: Iterable[Iterable[Any]], *comments: str) -> Path:
    """Writes a file, as Parquet if its ending says so; numbers are read back to the same bits. `comments` become metadata of Parquet."""
    checked(file, "table")
    if is_parquet(file):
        pa = require("pyarrow", "sweep")
        columns = dict(zip(head, map(list, zip(*rows))))
        table = pa.table({name: [None if cell == "" else cell for cell in cells] for name, cells in columns.items()})
        with whole(file) as part:
            require("pyarrow.parquet", "sweep").write_table(table.replace_schema_metadata({"comment": "\n".join(comments)}), part)
        return Path(file)
    with whole(file) as part, open(part, "w", newline="", encoding="utf-8") as out:
        sign, separator = DECIMALS[_decimal.get()]
        writer = csv.writer(out, delimiter=separator, lineterminator="\n")
        writer.writerow(head)
        writer.writerows(rows if sign == "." else ([_with(sign, cell) for cell in row] for row in rows))
    return Path(file)


def localised(text: str) -> str:
    """Text of a CSV file with decimal points in the decimal sign of the context."""
    sign, separator = DECIMALS[_decimal.get()]
    if sign == ".":
        return text
    out = io.StringIO()
    cells = csv.reader(io.StringIO(text, newline=""))
    csv.writer(out, delimiter=separator, lineterminator="\n").writerows([_with(sign, cell) for cell in row] for row in cells)
    return out.getvalue()


def _with(sign, cell):
    """Cell with this decimal sign, if it is a number."""
    is_number = isinstance(cell, float) or isinstance(cell, str) and _NUMBER.fullmatch(cell)
    return str(cell).replace(".", sign) if is_number else cell


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
