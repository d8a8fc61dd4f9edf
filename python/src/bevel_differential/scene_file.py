"""Scenes from TOML files."""

import importlib.resources
import tomllib
from collections.abc import Mapping
from pathlib import Path
from typing import Any

from .csv_table import CsvTable, Time
from .fmu import Fmu
from .points import seconds, span
from .values import DifferentialError, FileName, Number, suggestion

# what a file may have
KEYS = {"description", "stop_time", "step", "outputs", "set", "at", "table", "inputs"}
NEEDED = ("description", "stop_time", "step", "outputs")
KINDS = {"description": (str, "a text"), "outputs": (list, "a list of names"), "set": (dict, "a table [set]"),
         "at": (list, "written as [[at]]"), "table": (list, "written as [[table]]"), "inputs": (list, "written as [[inputs]]")}


def folder() -> Path:
    """The shipped scenes: in this package, or in the repository that it is used from."""
    package = Path(str(importlib.resources.files(__package__)))
    return package / "scenes" if (package / "scenes").is_dir() else package.parents[2] / "scenes"


def shipped_scenes() -> list[str]:
    """Names of the shipped scenes."""
    return sorted(file.stem for file in folder().glob("*.toml"))


def find(what: FileName) -> Path:
    """The file `what`, or that of the shipped scene of this name."""
    for file in (Path(what), folder() / f"{what}.toml"):
        if file.is_file():
            return file
    names = shipped_scenes()
    raise DifferentialError(f"there is no scene file {str(what)!r}, and no shipped scene of that name"
                            f"{suggestion(str(what), names)}; shipped: {', '.join(names)}")


def find_beside(file: Path, what: str) -> Path:
    """The scene file `what` that a file names: beside it, or as `find` finds it."""
    near = file.parent / what
    return near if near.is_file() else find(what)


def read_toml(file: Path) -> dict[str, Any]:
    """What a TOML file holds."""
    try:
        return tomllib.loads(file.read_text(encoding="utf-8"))
    except (OSError, UnicodeDecodeError, tomllib.TOMLDecodeError) as error:
        raise DifferentialError(f"{file}: {error}") from None


def read_scene(file: Path, fmu: Fmu) -> dict[str, Any]:
    """The arguments of `Scene` that a file holds. All errors are reported at once."""
    found = read_toml(file)
    wrong = [f"{key}: it is {what}" for key, (kind, what) in KINDS.items() if not isinstance(found.get(key, kind()), kind)]
    wrong += [f"outputs: {name!r} is no name" for name in found.get("outputs", []) if not wrong and not isinstance(name, str)]
    wrong += [f"[[table]] {key}: it is a list" for entry in found.get("table", []) for key in ("time", "value")
              if not wrong and not isinstance(entry.get(key, []), list)]
    if wrong:
        raise DifferentialError("\n".join(f"{file}: {problem}" for problem in wrong))
    problems = [f"{key}: there is no such key{suggestion(key, KEYS)}" for key in found.keys() - KEYS]
    problems += [f"{key} is missing" for key in NEEDED if key not in found]
    checked = _Checked(fmu, problems)
    settings = checked.values("[set]", flat(found.get("set", {})))
    changes = [checked.change(entry) for entry in found.get("at", [])]
    tables = [checked.table(entry) for entry in found.get("table", [])]
    for entry in found.get("inputs", []):
        tables += checked.input_file(entry, file.parent)
    names = [name for name, *_ in tables]
    problems += [f"{name} has two tables; remove one of them" for name in sorted({n for n in names if names.count(n) > 1})]
    for output in found.get("outputs", []):
        checked.attempt("outputs", fmu.variable, output)
    for key in ("stop_time", "step"):
        if key in found:
            checked.attempt("", span, key, found[key])
    if problems:
        raise DifferentialError("\n".join(f"{file}: {problem}" for problem in problems))
    return {"name": file.stem, "description": found["description"], "stop": found["stop_time"], "step": found["step"],
            "outputs": found["outputs"], "set": settings, "changes": changes, "tables": tables}


class _Checked:
    """Reads entries and collects what is wrong with them."""

    def __init__(self, fmu, problems):
        self.fmu, self.problems = fmu, problems

    def attempt(self, place, function, *arguments):
        try:
            return function(*arguments)
        except DifferentialError as error:
            self.problems.append(f"{place} {error}".strip())
            return None

    def values(self, place, given):
        for name, value in given.items():
            self.attempt(place, self.number, name, value)
        return given

    def number(self, name, value):
        return self.fmu.variable(name).number(value)

    def change(self, entry):
        entry = dict(entry)
        time = self.attempt("[[at]]", seconds, "time", entry.pop("time", None))
        return time, self.values(f"[[at]] time = {time}:", flat(entry))

    def table(self, entry):
        name = entry.get("input", "")
        place = f"[[table]] input = {name!r}:"
        times = [self.attempt(place, seconds, "time", time) for time in entry.get("time", [])]
        values = [self.attempt(place, self.number, name, value) for value in entry.get("value", [])]
        if len(times) != len(values) or not times:
            self.problems.append(f"{place} has {len(times)} times and {len(values)} values")
        return name, times, values, self.period(place, entry)

    def period(self, place, entry):
        return self.attempt(place, span, "period", entry["period"]) if "period" in entry else None

    def input_file(self, entry, near):
        place = f"[[inputs]] file = {entry.get('file', '')!r}:"
        tables = self.attempt(place, read_inputs, near / entry.get("file", ""), self.fmu) or []
        period = self.period(place, entry)
        return [(name, times, values, period) for name, times, values in tables]


def read_inputs(file: Path, fmu: Fmu) -> list[tuple[str, list[float], list[Number]]]:
    """Inputs over time from a CSV file: a column of times and one for each input, with units in brackets in the header.

    Returns [(input, times in s, values in SI)]."""
    table = CsvTable(file, lambda name: Time(name) if name == "time" else fmu.variable(name), needed=["time"])
    for line, row in table.rows:
        for name in table.columns:
            if name not in row:
                raise table.problem_at(line, name, "write a value", "")
    columns = {name: [row[name] for _, row in table.rows] for name in table.columns}
    times = columns.pop("time")
    return [(name, times, values) for name, values in columns.items()]


def flat(table: Mapping[str, Any], prefix: str = "") -> dict[str, Any]:
    """Values by their dotted names."""
    values: dict[str, Any] = {}
    for key, value in table.items():
        name = f"{prefix}{key}"
        values.update(flat(value, f"{name}.") if isinstance(value, dict) else {name: value})
    return values
