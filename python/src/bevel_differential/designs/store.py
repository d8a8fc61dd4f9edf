"""Results of designs as a table, and their storage in a Parquet file. Rows are written to parts next to that file as soon as they
arrive, so that an interrupt, a crash or a full disk loses little."""

import hashlib
import json
import os
import shutil
import time
from collections.abc import Sequence
from pathlib import Path
from typing import Any, Self

import pyarrow as pa
import pyarrow.parquet as pq

from ..output_file import checked
from ..values import DifferentialError, FileName
from ..warned import warn
from ..writing import OutputError, whole
from .space import Space
from .task import Row, Task

# shortest time between two parts, s
INTERVAL = 1.0
PLAN = "plan.json"
TYPES = {"Real": pa.float64(), "Integer": pa.int64(), "Boolean": pa.bool_(), "Enumeration": pa.string()}
# key of this package's entry in the metadata of a schema
KEY = b"bevel_differential"


class Columns:
    """Columns of a table: run, varied variables, wanted figures, feasible, message, seconds. Variables, figures and seconds have their
    SI unit in the metadata."""

    def __init__(self, task: Task, space: Space):
        fmu = task.scene.fmu
        self._variables = [fmu.variable(name) for name in space.names]
        self._figures = [(str(want), want.unit(fmu)) for want in task.figures]
        fields = [pa.field("run", pa.int64())]
        fields += [_field(variable.name, TYPES[variable.kind], variable.unit or "1") for variable in self._variables]
        fields += [_field(name, pa.float64(), unit) for name, unit in self._figures]
        fields += [pa.field("feasible", pa.bool_()), pa.field("message", pa.string()), _field("seconds", pa.float64(), "s")]
        self.schema = pa.schema(fields)

    def table(self, rows: Sequence[Row]) -> pa.Table:
        """Table of rows, in order of run. Figures of failed designs are null."""
        rows = sorted(rows, key=lambda row: row.run)
        columns: list[list] = [[row.run for row in rows]]
        columns += [[variable.written(row.values[variable.name]) for row in rows] for variable in self._variables]
        columns += [[row.figures.get(name) for row in rows] for name, _ in self._figures]
        columns += [[row.feasible for row in rows], [row.message for row in rows], [row.seconds for row in rows]]
        arrays = [pa.array(column, field.type) for column, field in zip(columns, self.schema)]
        return pa.Table.from_arrays(arrays, schema=self.schema)

def _field(name, kind, unit):
    return pa.field(name, kind, metadata={"unit": unit})


def with_metadata(table: pa.Table, metadata: dict[str, Any]) -> pa.Table:
    """Copy of the table with `metadata` as JSON."""
    return table.replace_schema_metadata({KEY: json.dumps(metadata)})


def metadata_of(schema: pa.Schema) -> dict[str, Any] | None:
    """Metadata of a table of this package; None for other tables."""
    text = (schema.metadata or {}).get(KEY)
    return None if text is None else json.loads(text)


def digest(table: pa.Table) -> str:
    """Hash of all rows without their durations: equal for equal results."""
    rows = table.drop_columns(["seconds"]).sort_by("run").to_pylist()
    return hashlib.sha256(json.dumps(rows).encode()).hexdigest()


class Store:
    """Results that will be written to `file`. `metadata` describes the task and the plan; `metadata["hash"]` identifies them.

    If an exception ends the context, the rows added so far are kept, unless the disk is not writable. `resume` continues with the
    parts of an earlier command, `force` starts over."""

    def __init__(self, file: FileName, columns: Columns, metadata: dict[str, Any], resume: bool = False, force: bool = False):
        self.file, self.columns, self.metadata = Path(file), columns, metadata
        self.folder = self.file.with_name(self.file.name + ".parts")
        self._rows: list[Row] = []
        self._flushed = time.monotonic()
        self.finished: pa.Table | None = None
        checked(self.file, "Parquet file")
        if force:
            shutil.rmtree(self.folder, ignore_errors=True)
        elif self.file.exists():
            self.finished = self._finished(resume)
        elif (self.folder / PLAN).exists():
            self._check_parts(resume)
        if self.finished is None:
            self._begin()
        self.kept = self._read_parts() if self.finished is None else self.finished
        self._count = len(self.kept)

    def runs(self) -> set[int]:
        """Numbers of the runs that an earlier command has finished."""
        return set(self.kept["run"].to_pylist())

    def add(self, row: Row) -> None:
        """Adds a row. A part is written when the last one is older than `INTERVAL`."""
        self._rows.append(row)
        if time.monotonic() - self._flushed > INTERVAL:
            self.flush()

    def flush(self) -> None:
        """Writes the rows added since the last part into a new part."""
        if self._rows:
            number = len(list(self.folder.glob("part-*.parquet")))
            self._write(self.columns.table(self._rows), self.folder / f"part-{number:06d}-{os.getpid()}.parquet")
            self._count += len(self._rows)
            self._rows = []
        self._flushed = time.monotonic()

    def finish(self) -> pa.Table:
        """Writes the file and removes the parts. Returns the table, in order of run."""
        self.flush()
        table = with_metadata(self._read_parts(), self.metadata)
        self._write(table, self.file)
        shutil.rmtree(self.folder, ignore_errors=True)
        return table

    def progress(self) -> str:
        """Sentence with the number and the folder of the finished runs, and with the way to continue."""
        return (f"{self._count} of {self.metadata['runs']} runs are kept in {self.folder}; "
                "the same command with --resume (resume=True) goes on")

    def __enter__(self) -> Self:
        return self

    def __exit__(self, kind: type[BaseException] | None, *_: object) -> None:
        # if the disk was not writable, a second attempt is useless
        if kind is not None and not issubclass(kind, StoreError):
            self.flush()

    def _finished(self, resume):
        try:
            table = pq.read_table(self.file)
            found = metadata_of(table.schema) or {}
        except (OSError, pa.ArrowException):
            found = {}
        if found.get("hash") != self.metadata["hash"]:
            raise DifferentialError(f"{self.file}: the file exists and holds other results; name another file, or overwrite it with "
                                    "--force (force=True)")
        if not resume:
            raise DifferentialError(f"{self.file}: the file exists and holds the results of this plan; --resume (resume=True) shows "
                                    "them, --force (force=True) starts over")
        # a process that was killed after writing the file leaves its parts
        shutil.rmtree(self.folder, ignore_errors=True)
        return table

    def _check_parts(self, resume):
        try:
            found = json.loads((self.folder / PLAN).read_text(encoding="utf-8"))["hash"]
        except (OSError, ValueError, KeyError):
            found = None
        if found != self.metadata["hash"]:
            raise DifferentialError(f"{self.folder}: it contains parts of another plan; name another file, or remove them with "
                                    "--force (force=True)")
        if not resume:
            raise DifferentialError(f"{self.folder}: it contains parts of this plan; continue with --resume (resume=True), or start "
                                    "over with --force (force=True)")

    def _begin(self):
        try:
            self.folder.mkdir(exist_ok=True)
            if not (self.folder / PLAN).exists():
                with whole(self.folder / PLAN, synced=True) as part:
                    part.write_text(json.dumps(self.metadata, indent=1), encoding="utf-8")
        except (OSError, OutputError) as error:
            raise StoreError(str(OutputError(self.folder, error.strerror or str(error)))) from None

    def _read_parts(self):
        """All parts as one table, in order of run. If a run occurs twice, its last row counts. Incomplete parts are left out."""
        tables = [self.columns.schema.empty_table()]
        for part in sorted(self.folder.glob("part-*.parquet")):
            try:
                tables.append(pq.read_table(part, schema=self.columns.schema))
            except pa.ArrowInvalid:
                warn([f"{part}: it is incomplete; its runs are repeated"])
        table = pa.concat_tables(tables)
        indices = {run: index for index, run in enumerate(table["run"].to_pylist())}
        return table.take(pa.array([indices[run] for run in sorted(indices)], pa.int64()))

    def _write(self, table, file):
        try:
            with whole(file, synced=True) as part:
                pq.write_table(table, part)
        except OutputError as error:
            raise StoreError(f"{file}: {error.strerror}; {self.progress()}, once there is room") from None


class StoreError(DifferentialError):
    """Error of a file that cannot be written."""

    def __init__(self, message: str):
        super().__init__(message, kind="failed")
