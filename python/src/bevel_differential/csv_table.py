"""CSV file with a header of names and units; errors name file, line, column and value."""

import os
import re
from collections.abc import Callable, Iterable
from pathlib import Path
from typing import Any

from .answers import ask
from .spreadsheet import csv_text, is_spreadsheet
from .values import DifferentialError, FileName, Number, Variable

_HEAD = re.compile(r"\s*(?P<name>[^\[\]]+?)\s*(?:\[(?P<unit>[^\[\]]*)\])?\s*$")


class Text:
    """Stands in for the variable of a column with words."""

    def __init__(self, name: str):
        self.name, self.kind = name, "Text"
        self.units: dict[str, tuple[float, float]] = {}

    def number(self, word: str) -> str:
        """The word itself."""
        return word


class Column:
    """A column: its `head` as written, its `variable`, and its index in a row."""

    def __init__(self, head: str, variable: Variable | Text, unit: str | None, index: int):
        self.head, self.variable, self.unit, self.index = head, variable, unit, index

    def value(self, cell: str) -> Number | str:
        """The value of a cell in SI."""
        if isinstance(self.variable, Variable) and self.variable.kind in ("Real", "Integer"):
            return self.variable.number((cell, self.unit))
        if self.unit is not None:
            raise DifferentialError(f"{self.head}: it has no unit; remove the brackets")
        return self.variable.number(cell)


class CsvTable:
    """Columns of a file by name, and its rows as pairs (line, {name: value in SI}) without empty cells."""

    def __init__(self, file: FileName, known: Callable[[str], Variable | Text], needed: Iterable[str] = (),
                 texts: Iterable[str] = ()):
        """`known`: function from a name in the header to its variable; `needed`: columns that must exist; `texts`: columns of words, in
        which digits are not numbers."""
        self.file = Path(file)
        (line, heads), *rows = lines_of(self.file, texts=texts)
        self._need(heads, needed)
        self.columns: dict[str, Column] = {}
        for index, head in enumerate(heads):
            column = self._column(line, head, index, known)
            if column.variable.name in self.columns:
                raise self.problem(line, column.head, "it appears twice; remove one of the columns")
            self.columns[column.variable.name] = column
        if not rows:
            raise DifferentialError(f"{self.file}: there is no line below the header")
        self.rows: list[tuple[int, dict[str, Any]]] = [(line, self._row(line, cells)) for line, cells in rows]

    def problem(self, line: int, head: str | None = None, text: str = "", cell: str | None = None) -> DifferentialError:
        """Error about a line, or about a cell in the column `head`."""
        where = f"{self.file}, line {line}" + (f", column {head}" if head else "")
        return DifferentialError(f"{where}{'' if cell is None else f', value {chr(34)}{cell}{chr(34)}'}: {text}")

    def problem_at(self, line: int, name: str, text: str, cell: str | None = None) -> DifferentialError:
        """Error about a cell, by the name of its column."""
        return self.problem(line, self.columns[name].head if name in self.columns else name, text, cell)

    def _need(self, heads, needed):
        names = {match["name"] for match in map(_HEAD.match, heads) if match}
        missing = [name for name in needed if name not in names]
        if missing:
            what = " and no column ".join(missing)
            raise DifferentialError(f"{self.file}: it has no column {what}; the first line names the columns")

    def _column(self, line, head, index, known):
        match = _HEAD.match(head)
        if not match:
            raise self.problem(line, head.strip() or index + 1, "write a name, and a unit in brackets")
        name, unit = match["name"], match["unit"]
        try:
            variable = known(name)
        except DifferentialError as failure:
            raise self.problem(line, head.strip(), _reason(failure)) from None
        if unit is not None:
            try:
                # converts any value, so that a wrong unit is an error of the header
                Column(head, variable, unit.strip(), index).value("0")
            except DifferentialError as failure:
                raise self.problem(line, head.strip(), _reason(failure)) from None
        return Column(head.strip(), variable, unit and unit.strip(), index)

    def _row(self, line, cells):
        values = {}
        for name, column in self.columns.items():
            cell = cells[column.index]
            if cell:
                try:
                    values[name] = column.value(cell)
                except DifferentialError as failure:
                    raise self.problem(line, column.head, _reason(failure), cell) from None
        return values


def lines_of(file: FileName, shown: str | None = None, texts: Iterable[str] = ()) -> list[tuple[int, list[str]]]:
    """Pairs (line, cells) of a CSV file or a spreadsheet, the header first. All lines have the same number of cells; numbers have decimal points.

    Columns are separated by commas, semicolons or tabs. `shown`: name of the file in errors; `texts`: names of columns with words.
    Raises `DifferentialError` with file and line if the file is ambiguous."""
    content = {"content": csv_text(file)} if is_spreadsheet(file) else {}
    found = ask({"ask": "table", "file": os.fspath(file), "shown": shown or os.fspath(file), "texts": list(texts), **content})
    return [tuple(row) for row in (found["header"], *found["rows"])]


def _reason(failure):
    """Message about a value, without the name and the value, which the caller has already named."""
    return str(failure).partition(": ")[2] or str(failure)
