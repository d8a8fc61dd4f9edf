"""Sweeps: all designs of a plan, and a summary of the results as text."""

import hashlib
import json
import time
from collections import Counter
from collections.abc import Iterator, Mapping, Sequence
from contextlib import closing, contextmanager
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Any

import pyarrow as pa
import pyarrow.compute as pc
import pyarrow.parquet as pq

from ..extras import version
from ..fmu import Fmu
from ..output_file import checked
from ..points import TimeValue, seconds
from ..scene import Scene
from ..text import aligned
from ..values import DifferentialError, FileName
from ..want import Condition, Want
from ..writing import locked
from .farm import Farm
from .plan import Plan
from .space import Given, Space
from .store import Columns, Store, StoreError, digest, metadata_of, with_metadata
from .task import Task

if TYPE_CHECKING:
    import pandas

# largest number of designs whose rows are printed
MOST_ROWS = 20
# number of messages that are listed
MOST_MESSAGES = 5


class Stopped(KeyboardInterrupt):
    """Interrupt of a sweep; the message names the finished runs and the way to continue."""


@dataclass(frozen=True)
class SweepResult:
    """Results of all runs of a plan.

    `table`: run, varied variables, figures, feasible, message, seconds; in SI, with units in the fields, in order of run.
    `metadata`: scene, plan and versions. `seconds`: time for the runs of this sweep, without the start of workers; `new`: number of
    these runs, as others may come from an earlier command."""

    table: pa.Table
    metadata: dict[str, Any]
    file: Path | None = None
    seconds: float = 0.0
    new: int = 0

    @classmethod
    def load(cls, file: FileName) -> "SweepResult":
        """Reads the results from a file."""
        try:
            table = pq.read_table(file)
        except (OSError, pa.ArrowException) as error:
            raise DifferentialError(f"{file}: {error}") from None
        metadata = metadata_of(table.schema)
        if metadata is None:
            raise DifferentialError(f"{file}: it contains no sweep")
        return cls(table, metadata, Path(file))

    def frame(self) -> "pandas.DataFrame":
        """Results as a pandas DataFrame, by run."""
        return self.table.to_pandas().set_index("run")

    def digest(self) -> str:
        """Hash of all rows without their durations."""
        return digest(self.table)

    def failures(self) -> Counter[str]:
        """Number of failed designs by message."""
        return self._messages(False)

    def undefined(self) -> Counter[str]:
        """Number of designs that ran, but not all of whose figures can be formed, by reason."""
        return self._messages(True)

    def _messages(self, has_figures):
        known = zip(*(self.table[name].to_pylist() for name in self.metadata["figures"]))
        return Counter(message for message, figures in zip(self.table["message"].to_pylist(), known)
                       if message and has_figures == any(figure is not None for figure in figures))

    def displayed(self, fmu: Fmu) -> dict[str, list[Any]]:
        """Columns by name, in SI. If `fmu` has display units, quantities of their dimensions have these units, and names of columns contain
        units: "left.speed:mean [rpm]"."""
        quantities = {name: fmu.variable(name) for name in self.metadata["vary"]}
        quantities |= {name: Want.parse(fmu, name).quantity(fmu) for name in self.metadata["figures"]}
        return dict(quantities[name].column(name, values, fmu.display_units) if name in quantities else (name, values)
                    for name, values in self.table.to_pydict().items())

    def unit(self, column: str) -> str:
        """SI unit of a column."""
        return self.table.schema.field(column).metadata[b"unit"].decode()


def sweep(scene: Scene | FileName, vary: Space | Mapping[str, Given], plan: Plan | str = "random", runs: int | None = None,
          seed: int = 0, wants: Sequence[str | Want] = (), conditions: Sequence[str | Condition] = (), start: TimeValue = 0.0,
          out: FileName | None = None, resume: bool = False, force: bool = False, **farm: Any) -> SweepResult:
    """Runs a scene (a `Scene`, or an argument of `Scene.load`) for all designs of a plan.

    `vary`: values by variable, see `Dimension.parse`. `plan`, `runs`, `seed`: see `Plan`. `wants`, `conditions`, `start`: see
    `Task`. `out`: a Parquet file; see `Store`. `farm`: arguments of `Farm`. An interrupt keeps the finished runs and raises
    `Stopped`."""
    scene = scene if isinstance(scene, Scene) else Scene.load(scene)
    space = vary if isinstance(vary, Space) else Space.parse(scene.fmu, vary)
    scene.check_settable(space.names)
    task = Task(scene, wants, conditions, seconds("from", start))
    task.check_computed(space.dimensions)
    plan = plan if isinstance(plan, Plan) else Plan.parse(space, plan, runs, seed)
    columns, metadata = Columns(task, space), describe(task, plan)
    if out is None:
        with Farm(**farm) as workers:
            begun = time.perf_counter()
            table = with_metadata(columns.table(list(workers.rows(task, plan.designs()))), metadata)
            return SweepResult(table, metadata, None, time.perf_counter() - begun, plan.runs)
    with locked(checked(out)), Store(out, columns, metadata, resume, force) as store, going_on_later(store):
        done = store.runs()
        missing = [design for design in plan.designs() if design[0] not in done]
        taken = 0.0
        if missing:
            with Farm(**farm) as workers, closing(workers.rows(task, missing)) as rows:
                begun = time.perf_counter()
                for row in rows:
                    store.add(row)
                taken = time.perf_counter() - begun
        table = store.finish() if store.finished is None else store.finished
    return SweepResult(table, metadata, Path(out), taken, len(missing))


@contextmanager
def going_on_later(store: Store) -> Iterator[None]:
    """Context in which errors also report the runs that `store` has kept and the way to continue. An interrupt becomes `Stopped`."""
    try:
        yield
    except KeyboardInterrupt:
        store.flush()
        raise Stopped(f"stopped; {store.progress()}") from None
    except StoreError:
        raise
    except DifferentialError as error:
        store.flush()
        raise DifferentialError(f"{error}; {store.progress()}", kind=error.kind) from None


def describe(task: Task, plan: Plan) -> dict[str, Any]:
    """Description of a task and a plan for the metadata of their results; "hash" is the hash of all entries."""
    return hashed(task.scene, {
        "vary": {one.variable: str(one) for one in plan.space.dimensions},
        "plan": plan.kind, "runs": plan.runs, "seed": plan.seed,
        "wants": [str(want) for want in task.wants],
        "figures": [str(want) for want in task.figures],
        "conditions": [str(one) for one in task.conditions],
        "from": task.start,
    })


def hashed(scene: Scene, what: Mapping[str, Any]) -> dict[str, Any]:
    """Description of a scene and of `what` was done with it, including the hash of all entries."""
    state = {key: value for key, value in scene.__getstate__().items() if key != "fmu"}
    from_all = {"version": version() or "not installed", "fmu": scene.fmu.sha256, "scene": state, **what}
    # numbers of numpy as plain numbers
    plain = json.loads(json.dumps(from_all, default=lambda value: value.tolist()))
    return {**plain, "hash": hashlib.sha256(json.dumps(plain, sort_keys=True).encode()).hexdigest()}


def text(result: SweepResult, asked: int | None = None, fmu: Fmu | None = None, is_in_table: bool = False) -> str:
    """Summary: runs, failures by message, feasible designs, range of each quantity, rate, and the designs if there are few. `asked`:
    number of requested runs. Quantities are in SI, or in the display units of `fmu`. `is_in_table`: true if a table of all runs is
    written, too."""
    table, metadata = result.table, result.metadata
    lines = [f"runs      {table.num_rows}"]
    if asked is not None and asked != table.num_rows:
        lines[0] += f" ({asked} requested; a Sobol sequence has a power of two)"
    lines += _counted("failed    ", result.failures())
    if undefined := result.undefined():
        lines += _counted("empty     ", undefined)
    lines.append(f"feasible  {pc.sum(table['feasible']).as_py() or 0}")
    if metadata["conditions"]:
        lines[-1] += f" ({'; '.join(metadata['conditions'])})"
    lines += ["", *_ranges(result, fmu), ""]
    if fmu is not None and table.num_rows <= MOST_ROWS:
        lines += [*_rows(result, fmu), ""]
    if result.new:
        lines.append(f"{result.new} runs in {result.seconds:.1f} s: {result.new / result.seconds:.1f} designs/s")
    if result.new < table.num_rows:
        lines.append(f"{table.num_rows - result.new} runs were kept from before")
    if result.file is not None:
        lines.append(f"written: {result.file}")
    elif not is_in_table:
        lines.append("rows are not kept: name a file by --out or --csv")
    return "\n".join(lines)


def _counted(label, messages):
    """Total number of messages after a label, and the most frequent ones."""
    common = messages.most_common()
    lines = [f"{label}{messages.total()}", *(f"  {count:>6}  {' '.join(text.split())}" for text, count in common[:MOST_MESSAGES])]
    if len(common) > MOST_MESSAGES:
        lines.append(f"  {sum(count for _, count in common[MOST_MESSAGES:]):>6}  {len(common) - MOST_MESSAGES} other messages")
    return lines


def _ranges(result, fmu):
    """Smallest, mean and largest value of each quantity, aligned."""
    rows = [("quantity", "unit", "min", "mean", "max")]
    for name in result.metadata["figures"]:
        column, unit = result.table[name], result.unit(name)
        if fmu is not None:
            quantity = Want.parse(fmu, name).quantity(fmu)
            unit, _ = quantity.in_files(0.0, fmu.display_units)
            column = pa.array(quantity.column(name, column.to_pylist(), fmu.display_units)[1], pa.float64())
        found = [pc.min(column).as_py(), pc.mean(column).as_py(), pc.max(column).as_py()]
        rows.append((name, "" if unit == "1" else unit, *("-" if one is None else f"{one:.6g}" for one in found)))
    return aligned(rows)


def _rows(result, fmu):
    """Run, varied values and quantities of each design, aligned. A failed design has no quantities."""
    shown = {name: [_cell(value) for value in values] for name, values in result.displayed(fmu).items()
             if name not in ("feasible", "message", "seconds")}
    return aligned([tuple(shown), *zip(*shown.values())])


def _cell(value):
    if value is None:
        return "-"
    return f"{value:.6g}" if isinstance(value, float) else str(value)
