"""CSV files of the measuring commands: comment lines with a #, one of them with the machine, then a header and rows."""

import csv


def read(path):
    """Machine and rows; numbers as such."""
    lines = path.read_text(encoding="utf-8").splitlines()
    machine = next((line.split(":", 1)[1].strip() for line in lines if line.startswith("# machine:")), "")
    rows = csv.DictReader(line for line in lines if not line.startswith("#"))
    return machine, [{key: number(value) for key, value in row.items()} for row in rows]


def number(text):
    try:
        return float(text)
    except ValueError:
        return text
