"""The folder of an optimisation's results: all designs that were evaluated, so that a search can go on."""

import json
from pathlib import Path

import pandas as pd

from ..designs.space import Space
from ..values import DifferentialError, FileName, Number
from .design_task import DesignRow
from .problem import Problem

EVALUATIONS, PROBLEM = "evaluations.parquet", "problem.json"


class Store:
    """Rows of a problem in a folder. `rows`: by the values of a design, in order of run."""

    def __init__(self, folder: FileName, problem: Problem, resume: bool = False):
        self.folder, self.problem = Path(folder), problem
        self.rows: dict[tuple[Number, ...], DesignRow] = {}
        if resume:
            self._read()
        elif (self.folder / EVALUATIONS).exists():
            raise DifferentialError(f"{self.folder} has results already: go on by --resume, or name another folder by --out")
        try:
            self.folder.mkdir(parents=True, exist_ok=True)
        except OSError as error:
            raise DifferentialError(f"{self.folder}: {error.strerror}; name another folder by --out") from None
        (self.folder / PROBLEM).write_text(json.dumps({"key": problem.key, "description": problem.description}, indent=1) + "\n",
                                           encoding="utf-8")

    def save(self) -> None:
        """Writes all rows. A file is replaced as a whole, so that an interruption leaves the one before."""
        table = pd.DataFrame([row.flat() for row in self.rows.values()])
        part = self.folder / f"{EVALUATIONS}.part"
        table.to_parquet(part, index=False)
        part.replace(self.folder / EVALUATIONS)

    def _read(self):
        try:
            key = json.loads((self.folder / PROBLEM).read_text(encoding="utf-8"))["key"]
            table = pd.read_parquet(self.folder / EVALUATIONS)
        except (OSError, ValueError, KeyError, TypeError) as error:
            raise DifferentialError(f"{self.folder} has no results to go on from ({error}); leave out --resume") from None
        if key != self.problem.key:
            raise DifferentialError(f"{self.folder} has the results of another problem, scene, seed or FMU; name another "
                                    "folder by --out")
        for row in rows_of(table, self.problem.space):
            self.rows[tuple(row.values.values())] = row


def rows_of(table: pd.DataFrame, space: Space) -> list[DesignRow]:
    """Rows from a table as `save` writes it."""
    figures = [name for name in table.columns if ":" in name]
    rows = []
    for entry in table.to_dict("records"):
        rows.append(DesignRow(entry["run"], {name: entry[name] for name in space.names},
                              {name: entry[name] for name in figures if pd.notna(entry[name])}, entry["feasible"],
                              entry["message"], entry["seconds"], entry["violation"],
                              tuple(entry["refused"].split("; ")) if entry["refused"] else ()))
    return rows
