"""Rows of designs as a table: columns with types, units and literals."""

import hashlib
import json
from collections.abc import Sequence
from typing import Any

import pyarrow as pa

from .space import Space
from .task import Row, Task

TYPES = {"Real": pa.float64(), "Integer": pa.int64(), "Boolean": pa.bool_(), "Enumeration": pa.string()}
# of the schema's metadata
KEY = b"bevel_differential"


class Columns:
    """Columns of a table: run, what varies, what is wanted, feasible, message, seconds. Each names its SI unit."""

    def __init__(self, task: Task, space: Space):
        fmu = task.scene.fmu
        self._variables = [fmu.variable(name) for name in space.names]
        self._literals = {variable.name: {number: word for word, number in variable.literals.items()}
                          for variable in self._variables if variable.literals}
        self._figures = [(str(want), want.unit(fmu)) for want in task.figures]
        fields = [pa.field("run", pa.int64())]
        fields += [_field(variable.name, TYPES[variable.kind], variable.unit or "1") for variable in self._variables]
        fields += [_field(name, pa.float64(), unit) for name, unit in self._figures]
        fields += [pa.field("feasible", pa.bool_()), pa.field("message", pa.string()), _field("seconds", pa.float64(), "s")]
        self.schema = pa.schema(fields)

    def table(self, rows: Sequence[Row]) -> pa.Table:
        """The table of rows, in order of run. Figures of designs that failed are null."""
        rows = sorted(rows, key=lambda row: row.run)
        columns: list[list] = [[row.run for row in rows]]
        columns += [self._values(variable.name, rows) for variable in self._variables]
        columns += [[row.figures.get(name) for row in rows] for name, _ in self._figures]
        columns += [[row.feasible for row in rows], [row.message for row in rows], [row.seconds for row in rows]]
        arrays = [pa.array(column, field.type) for column, field in zip(columns, self.schema)]
        return pa.Table.from_arrays(arrays, schema=self.schema)

    def _values(self, name, rows):
        words = self._literals.get(name)
        return [words[row.values[name]] if words else row.values[name] for row in rows]


def _field(name, kind, unit):
    return pa.field(name, kind, metadata={"unit": unit})


def with_metadata(table: pa.Table, metadata: dict[str, Any]) -> pa.Table:
    """The table with metadata as JSON."""
    return table.replace_schema_metadata({KEY: json.dumps(metadata)})


def metadata_of(schema: pa.Schema) -> dict[str, Any] | None:
    """The metadata of a table of this package; None for others."""
    text = (schema.metadata or {}).get(KEY)
    return None if text is None else json.loads(text)


def digest(table: pa.Table) -> str:
    """A hash of all rows without what they took: the same for the same results."""
    rows = table.drop_columns(["seconds"]).sort_by("run").to_pylist()
    return hashlib.sha256(json.dumps(rows).encode()).hexdigest()
