"""Scenes: settings, inputs over time, and outputs to record."""

from collections.abc import Iterable, Mapping, Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any, Literal, Self, overload

import numpy as np

from .differential import Runner, as_frame
from .extras import needed, require
from .fmu import Fmu
from .inputs import Signals, Table, Values, input_variable
from .off_outputs import OffOutputs, largest
from .output_file import checked
from .plot import plot
from .points import TimeValue, duration, seconds, span
from .records import write
from .quantities import QUANTITIES
from .scene_file import find, read_scene
from .start_values import Accepted
from .text import aligned
from .values import NOBODY_SET, DifferentialError, FileName, Number, Value
from .want import mean_over_time
from .warned import warn
from .writing import whole

if TYPE_CHECKING:
    import pandas
    from matplotlib.figure import Figure


class Scene(Runner):
    """Scene with the same meaning as its TOML file has for the library: the same steps and the same bits.

    `set`: parameters and inputs at the start by name. `changes`: [(time, {name: value})], later values of inputs and tunable
    parameters. `tables`: [(input, times, values, period or None)], linear from point to point. Without `input_slopes`, values are held
    within steps. All times are in s or with a unit. Values are written as for `Differential`. `display_units`, such as ["rpm", "kN"],
    replace the usual units of tables, pictures and files. `accept_start_values`: True, or names of values that nobody sets and of which
    no warning is wanted."""

    def __init__(self, name: str = "scene", *, description: str = "", stop: TimeValue = 0.5, step: TimeValue = 1e-3,
                 outputs: Sequence[str] = (), set: Mapping[str, Value] | None = None,
                 changes: Sequence[tuple[TimeValue, Mapping[str, Value]]] = (),
                 tables: Sequence[tuple[str, Sequence[TimeValue], Values, TimeValue | None]] = (), input_slopes: bool = True,
                 display_units: Sequence[str] = (), accept_start_values: Accepted = False, fmu: FileName | Fmu | None = None):
        super().__init__(Fmu.of(fmu).displaying(display_units), accept_start_values)
        self.name, self.description = name, description
        self.stop, self.step = duration("stop_time", stop), span("step", step)
        if self.step > self.stop > 0.0:
            raise DifferentialError(f"step = {self.step:g} s is longer than stop_time = {self.stop:g} s")
        self.outputs = [self.fmu.output(output).name for output in outputs]
        self.changes = [(seconds("time", time), dict(values)) for time, values in changes]
        self.tables = list(tables)
        self.input_slopes = input_slopes
        super().set(set)
        self._signals = self._checked_signals()

    @classmethod
    def load(cls, what: FileName, fmu: FileName | Fmu | None = None, stop: str | None = None,
             display_units: Sequence[str] = (), step: str | None = None) -> Self:
        """Reads the scene from the TOML file `what`, or the shipped scene of that name; `stop`: another end, after which nothing changes;
        `step`: another communication step.
        All errors in a file are reported together. `display_units`, and those of `fmu`, take precedence over those of the file."""
        given, fmu = read_scene(find(what), stop, step), Fmu.of(fmu)
        for preferred in (given.pop("display_units"), list(fmu.display_units.values()), display_units):
            fmu = fmu.displaying(preferred)
        return cls(fmu=fmu, **given)

    def set(self, values: Mapping[str, Value] | None = None, **keywords: Value) -> Self:
        """Changes parameters and inputs at the start."""
        self.check_settable({**(values or {}), **{name.replace("__", "."): None for name in keywords}})
        return super().set(values, **keywords)

    def value(self, name: str) -> Number:
        """Value of a parameter, or of an input at the start, in SI: the scene's value, or else that of the FMU."""
        variable = self.fmu.variable(name)
        return self.values.get(variable.name, 0.0 if variable.start is None else variable.start)

    def check_settable(self, names: Iterable[str]) -> None:
        """Refuses names of inputs that follow a table, because a value for them would have no effect."""
        driven = {table.variable.name for table in self._signals.tables}
        for name in names:
            if name in driven:
                raise DifferentialError(f"{name} follows a table in the scene, which overrides a value; change the table")

    @overload
    def run(self, outputs: Sequence[str] | None = None, values: Mapping[str, Value] | None = None, stop: TimeValue | None = None,
            frame: Literal[False] = False) -> np.ndarray: ...

    @overload
    def run(self, outputs: Sequence[str] | None = None, values: Mapping[str, Value] | None = None, stop: TimeValue | None = None,
            *, frame: Literal[True]) -> "pandas.DataFrame": ...

    def run(self, outputs: Sequence[str] | None = None, values: Mapping[str, Value] | None = None, stop: TimeValue | None = None,
            frame: bool = False) -> "np.ndarray | pandas.DataFrame":
        """Simulates; `values` change parameters for this run, `stop` changes the end.

        Returns a structured array in SI, shape (points,), with a field "time" (s) and a field for each output. A jump of inputs has two
        rows at its time, before and after it. With `frame`, the result is a pandas DataFrame, by time."""
        if frame:
            needed("pandas", "sweep")
        with self._warns_when_stopped():
            record = self._record(outputs, values, stop)
        warn([*self.warnings, *self.off_outputs(outputs, values).texts])
        return as_frame(record) if frame else record

    def final(self, outputs: Sequence[str] | None = None, values: Mapping[str, Value] | None = None) -> dict[str, Number]:
        """Values at the end, in as few steps as the scene allows: one if no input follows a table."""
        found = self._final(outputs, values)
        warn([*self.warnings, *self.off_outputs(outputs, values).texts])
        return found

    def plan_text(self, values: Mapping[str, Value] | None = None) -> str:
        """Description by the FMU of the model that it simulates at the start of the scene."""
        with self.fmu.open() as instance:
            instance.log(["logEvents"])
            self._initialise(instance, values)
            return " ".join(text for text in instance.events if not text.startswith(NOBODY_SET))

    def off_outputs(self, outputs: Sequence[str] | None = None, values: Mapping[str, Value] | None = None) -> OffOutputs:
        """Outputs that no effect computes in the scene, because all effects with these outputs are off."""
        return self._off(self._named(outputs), self._signals, values)

    def all_values(self) -> dict[str, Number]:
        """Values of the scene by name, SI; an input that changes has its value of the largest magnitude."""
        return {**self.values, **largest(self.values.items(), self._signals.courses())}

    def unfelt_of(self, values: Mapping[str, Value] | None = None) -> dict[str, str]:
        """Variables whose values at the start have no effect in the scene, by name, with the FMU's reason."""
        with self.fmu.open() as instance:
            self._initialise(instance, values)
            return instance.unfelt

    def summary(self, record: np.ndarray, display_units: Sequence[str] = ()) -> str:
        """Smallest value, mean over time, largest and last value of each output of a record, in the usual units or in `display_units`."""
        fmu = self.fmu.displaying(display_units)
        lines: list[tuple[str, ...]] = [("output", "unit", "min", "mean", "max", "end")]
        for name in _outputs(record):
            unit, values = fmu.variable(name).shown(record[name])
            mean = mean_over_time(values, record["time"])
            lines.append((name, unit, *(f"{number:.6g}" for number in (values.min(), mean, values.max(), values[-1]))))
        return "\n".join(aligned(lines))

    def to_csv(self, record: np.ndarray, file: FileName, display_units: Sequence[str] = ()) -> Path:
        """Writes a record in SI under the names of the FMU; numbers are read back to the same bits. The file can be an input of scenes and of
        fmpy. With `display_units`, of this call or of the scene, quantities of their dimensions have these units, and names of columns
        contain units, "left.speed [rpm]", which fmpy does not accept."""
        head, _, columns = self.columns(record, display_units)
        return write(file, head, zip(*(column.tolist() for column in columns)))

    def columns(self, record: np.ndarray, display_units: Sequence[str] = ()) -> tuple[list[str], list[str], list[np.ndarray]]:
        """Names, units and values of the columns of a record in a file; see `to_csv`."""
        fmu = self.fmu.displaying(display_units)
        units, columns = ["s"], [record["time"]]
        for name in _outputs(record):
            unit, values = fmu.variable(name).in_files(record[name], fmu.display_units)
            units.append(unit or "1")
            columns.append(values)
        names = record.dtype.names or ()
        # columns in SI keep their plain names
        head = list(names) if not fmu.display_units else [name if unit == "1" else f"{name} [{unit}]" for name, unit in zip(names, units)]
        return head, units, columns

    def to_parquet(self, record: np.ndarray, file: FileName, display_units: Sequence[str] = ()) -> Path:
        """Writes a record as Parquet, in the units of `to_csv`; the fields contain their units, the table name and description of the scene."""
        checked(file, "Parquet file")
        pa = require("pyarrow", "sweep")
        head, units, columns = self.columns(record, display_units)
        fields = [pa.field(name, pa.from_numpy_dtype(column.dtype), metadata={"unit": unit})
                  for name, unit, column in zip(head, units, columns)]
        about = {"scene": self.name, "description": self.description}
        table = pa.table([np.ascontiguousarray(column) for column in columns], pa.schema(fields, metadata=about))
        with whole(file) as part:
            require("pyarrow.parquet", "sweep").write_table(table, part)
        return Path(file)

    def plot(self, record: np.ndarray, file: FileName | None = None, display_units: Sequence[str] = ()) -> "Figure":
        """Draws a record; see `plot.plot`."""
        return plot(self.fmu.displaying(display_units), record, self.name, self.description, file)

    def contents(self, values: Mapping[str, Value] | None = None) -> dict[str, Any]:
        """Contents of a scene file with the same meaning; `values` at the start replace those of the scene."""
        def plain(values):
            return {name: self.fmu.variable(name).written(value) for name, value in values.items()}

        tables = [{"input": name, "time": [seconds("time", time) for time in times],
                   "value": [self.fmu.variable(name).number(value) for value in values], **({"period": period} if period else {})}
                  for name, times, values, period in self.tables]
        return {"description": self.description, "stop_time": self.stop, "step": self.step, "outputs": self.outputs,
                "set": plain(self.values if values is None else values),
                "at": [{"time": time, **plain(changes)} for time, changes in self.changes], "table": tables,
                **({"display_units": list(units)} if (units := self.fmu.display_units.values()) else {}),
                **({"accept_start_values": self.accept_start_values} if self.accept_start_values else {}),
                **({"input_slopes": self.input_slopes} if tables else {})}

    def __getstate__(self) -> dict[str, Any]:
        return {"name": self.name, "description": self.description, "stop": self.stop, "step": self.step,
                "outputs": self.outputs, "set": self.values, "changes": self.changes, "tables": self.tables,
                "input_slopes": self.input_slopes, "accept_start_values": self.accept_start_values, "fmu": self.fmu}

    def __setstate__(self, state: Mapping[str, Any]) -> None:
        Scene.__init__(self, **state)

    def _record(self, outputs=None, values=None, stop=None, step=None):
        """`run` without Python warnings; `step`, s, replaces the scene's step."""
        self.check_settable(values or ())
        stop = self.stop if stop is None else duration("stop", stop)
        return self._simulate(self._signals.steps(stop, step or self.step), self._signals, self._named(outputs), values)

    def _final(self, outputs=None, values=None):
        """`final` without Python warnings."""
        self.check_settable(values or ())
        names = self._named(outputs)
        # the largest load in a run may be before its end
        is_long = any(name in QUANTITIES and QUANTITIES[name].loads for name in names)
        steps = self._signals.steps(self.stop, self.step if self._signals.tables or is_long else None)
        last = self._simulate(steps, self._signals, names, values)[-1]
        return {name: last[name].item() for name in names}

    def _initialise(self, instance, values):
        self.check_settable(values or ())
        at_start = self._signals.start(self._signals.steps(0.0, self.step))
        start = {**self.values, **{variable.name: value for variable, value in (*self.fmu.numbers(values), *at_start)}}
        instance.initialise(start, self.stop)

    def _named(self, outputs):
        names = self.outputs if outputs is None else list(outputs)
        if not names:
            raise DifferentialError(f"scene {self.name} records nothing: name outputs")
        return names

    def _checked_signals(self):
        tables = [Table(input_variable(self.fmu, name), [seconds("time", time) for time in times], values,
                        None if period is None else span("period", period)) for name, times, values, period in self.tables]
        driven = {table.variable for table in tables}
        changes = []
        for time, values in self.changes:
            if not 0.0 <= time <= self.stop:
                raise DifferentialError(f"a change at {time:g} s is outside the scene's 0 to {self.stop:g} s")
            changes.append((time, self.fmu.numbers(values)))
            for variable, _ in changes[-1][1]:
                if variable in driven:
                    raise DifferentialError(f"the change at {time:g} s: {variable.name} follows a table, which overrides a value; "
                                            "remove one")
                if variable.variability == "fixed":
                    raise DifferentialError(f"{variable.name} is fixed: only inputs and tunable parameters change during a run")
        return Signals((), tables, changes, self.input_slopes)


def _outputs(record: np.ndarray) -> tuple[str, ...]:
    """Names of the outputs in a record."""
    return (record.dtype.names or ())[1:]
