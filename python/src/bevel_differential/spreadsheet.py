"""Tables from spreadsheets (.xlsx), as text of a CSV file. They need the package openpyxl or python-calamine."""

import csv
import importlib
import io
from collections.abc import Iterable
from pathlib import Path
from typing import Any

from .values import DifferentialError, FileName

ENDINGS = (".xlsx", ".xlsm")


def is_spreadsheet(file: FileName) -> bool:
    """True if the ending of a file is one of a spreadsheet."""
    return Path(file).suffix.lower() in ENDINGS


def csv_text(file: FileName) -> str:
    """First sheet of a spreadsheet as CSV, with decimal points and without empty rows and columns at the end."""
    if not Path(file).is_file():
        raise DifferentialError(f"{file}: there is no such file")
    rows = [["" if cell is None else cell for cell in row] for row in _rows(file)]
    width = 1 + max((index for row in rows for index, cell in enumerate(row) if cell != ""), default=-1)
    out = io.StringIO()
    # an empty row keeps its line, so that messages name the lines of the sheet
    csv.writer(out, lineterminator="\n").writerows([*row, *[""] * width][:width] if any(cell != "" for cell in row) else [] for row in rows)
    return out.getvalue()


def _rows(file: FileName) -> Iterable[Iterable[Any]]:
    """Cells of the first sheet. Formulas have their last results."""
    try:
        if openpyxl := _module("openpyxl"):
            sheet = openpyxl.load_workbook(file, read_only=True, data_only=True).worksheets[0]
            return [list(row) for row in sheet.iter_rows(values_only=True)]
        if calamine := _module("python_calamine"):
            return calamine.CalamineWorkbook.from_path(str(file)).get_sheet_by_index(0).to_python(skip_empty_area=False)
    except Exception as error:
        raise DifferentialError(f"{file}: it cannot be read as a spreadsheet ({error}); save it as CSV") from None
    raise DifferentialError(f"{file}: a spreadsheet needs the package openpyxl or python-calamine (pip install openpyxl); or save it as CSV",
                            kind="failed")


def _module(name):
    """Module `name` if it is installed."""
    try:
        return importlib.import_module(name)
    except ModuleNotFoundError:
        return None
