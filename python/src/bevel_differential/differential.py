"""Class `Differential`: runs the FMU with given parameters."""

import threading
from collections.abc import Iterator, Mapping, Sequence
from contextlib import contextmanager
from typing import TYPE_CHECKING, Any, Literal, Self, overload

import numpy as np

from .batches import Batches
from .extras import needed, require
from .fmu import Fmu
from .inputs import Inputs, Signals, prolonged, times_of_rows
from .instance import LOGGED, Closing, Instance
from .off_outputs import OffOutputs, largest
from .plot import plot
from .quantities import QUANTITIES, outputs_of, series
from .points import TimeValue, duration, span
from .start_values import Accepted, checked, in_short, unaccepted
from .values import DISCARD, DifferentialError, FileName, Number, Value, Variable
from .warned import warn

if TYPE_CHECKING:
    import pandas
    from matplotlib.figure import Figure

# outputs that `run` records by default
DEFAULT_OUTPUTS = ("carrier.speed", "left.speed", "right.speed", "left.shaft_torque", "right.shaft_torque")


class Runner(Closing):
    """Runs the FMU with the values that have been set. Each thread has its own instance, which is reset between runs."""

    def __init__(self, fmu: FileName | Fmu | None, accept_start_values: Accepted = False):
        self.fmu = Fmu.of(fmu)
        self.accept_start_values = checked(self.fmu, accept_start_values)
        self._values: dict[Variable, Number] = {}
        self._instances = threading.local()
        self._all: list[Instance] = []

    def set(self, parameters: Mapping[str, Value] | None = None, **keywords: Value) -> Self:
        """Changes parameters and start values of inputs."""
        self._values.update(self.fmu.numbers(parameters, **keywords))
        return self

    @property
    def values(self) -> dict[str, Number]:
        """Values that have been set, by name, in the form of the FMU: SI numbers; a choice is the number of its literal."""
        return {variable.name: value for variable, value in self._values.items()}

    @property
    def warnings(self) -> list[str]:
        """Warnings of the FMU in the last run of this thread, and of a run that points of tables make much longer. One line states the number
        of start values that nobody set or accepted; `nobody_set` lists them."""
        return [*getattr(self._instances, "notes", ()), *in_short(self._instance().messages, self.accept_start_values)]

    @contextmanager
    def _warns_when_stopped(self) -> Iterator[None]:
        """Passes on the warnings of a run that Ctrl-C stops, because they often contain the reason for its duration."""
        try:
            yield
        except KeyboardInterrupt:
            warn(self.warnings)
            raise

    @property
    def unfelt(self) -> dict[str, str]:
        """Variables whose values had no effect in the last run of this thread, by name, with the FMU's reason."""
        return self._instance().unfelt

    def nobody_set(self, values: Mapping[str, Value] | None = None) -> str:
        """Values that take effect and that nobody set or accepted, by effect, as the FMU lists them; empty if there are none."""
        with self.fmu.open() as instance:
            instance.log([*LOGGED, "logEvents"])
            self._initialise(instance, values)
            return unaccepted(instance.nobody_set, self.accept_start_values)

    def close(self) -> None:
        """Frees all instances."""
        while self._all:
            self._all.pop().close()
        self._instances = threading.local()

    def _simulate(self, steps, signals, outputs, values=None):
        """Initialises an instance, steps from point to point, and records. A jump of inputs has two rows, before and after it."""
        if isinstance(outputs, str) or not any(name in QUANTITIES for name in outputs):
            return self._recorded_outputs(steps, signals, outputs, values)
        for name in outputs:
            self.fmu.output(name)
        names = dict.fromkeys(other for name in outputs for other in outputs_of(name)) or ["geometry.planet_count"]
        record = self._recorded_outputs(steps, signals, list(names), values)
        parameters = {**self.fmu.starts(), **self.values, **{variable.name: value for variable, value in self.fmu.numbers(values)}}
        columns = [series(name, parameters, record) if name in QUANTITIES else record[name] for name in outputs]
        found = np.empty(len(record), [("time", np.float64), *((name, column.dtype) for name, column in zip(outputs, columns))])
        for name, column in zip(["time", *outputs], [record["time"], *columns]):
            found[name] = column
        return found

    def _recorded_outputs(self, steps, signals, outputs, values):
        """`_simulate` of outputs of the FMU."""
        if not isinstance(outputs, str):
            outputs = [self.fmu.output(name).name if name not in self.fmu.variables else name for name in outputs]
        variables = self.fmu.named(outputs)
        if len(set(variables)) < len(variables):
            twice = next(variable.name for variable in variables if variables.count(variable) > 1)
            raise DifferentialError(f"{twice}: it is recorded twice; name each output once")
        start = self._values | dict(self.fmu.numbers(values)) | dict(signals.start(steps))
        instance = self._instance()
        instance.start(list(start.items()), steps["end"][-1])
        self._instances.notes = prolonged(steps)
        batches, times = Batches.of(variables), times_of_rows(steps)
        record = batches.record(len(times))
        _advance(instance, batches, record, steps, signals)
        return _structured(times, variables, batches, record)

    def _initialise(self, instance, values):
        instance.initialise({**self.values, **(values or {})})

    def _off(self, outputs, signals, values=None):
        """Outputs of a run with these signals that no effect computes."""
        start = [(variable.name, value) for variable, value in (self._values | dict(self.fmu.numbers(values))).items()]
        return OffOutputs.of(self.fmu, outputs, {**dict(start), **largest(start, signals.courses())})

    def _instance(self):
        if not hasattr(self._instances, "own"):
            self._instances.own = Instance(self.fmu)
            self._all.append(self._instances.own)
        return self._instances.own


class Differential(Runner):
    """Bevel gear differential with its parameters.

    Parameters are given by their names in the FMU, in a mapping or as keywords with two underscores for the dot:
    `Differential({"geometry.module": "4.5 mm"}, contact__law="line_weber")`. Values are SI numbers, pairs (number, unit), text with
    a unit, or literals by name. Parameters that are not given have their start values. `display_units`, such as ["rpm", "kN"],
    replace the usual units of pictures; records are always in SI. `accept_start_values`: True, or names of values that nobody sets and
    of which no warning is wanted."""

    def __init__(self, parameters: Mapping[str, Value] | None = None, *, fmu: FileName | Fmu | None = None,
                 display_units: Sequence[str] = (), accept_start_values: Accepted = False, **keywords: Value):
        super().__init__(Fmu.of(fmu).displaying(display_units), accept_start_values)
        self.set(parameters, **keywords)

    @overload
    def run(self, inputs: Inputs | None = None, outputs: Sequence[str] = DEFAULT_OUTPUTS, stop: TimeValue = 0.5,
            step: TimeValue | None = 0.001, values: Mapping[str, Value] | None = None,
            frame: Literal[False] = False, *, input_slopes: bool = True) -> np.ndarray: ...

    @overload
    def run(self, inputs: Inputs | None = None, outputs: Sequence[str] = DEFAULT_OUTPUTS, stop: TimeValue = 0.5,
            step: TimeValue | None = 0.001, values: Mapping[str, Value] | None = None, *,
            frame: Literal[True], input_slopes: bool = True) -> "pandas.DataFrame": ...

    def run(self, inputs: Inputs | None = None, outputs: Sequence[str] = DEFAULT_OUTPUTS, stop: TimeValue = 0.5,
            step: TimeValue | None = 0.001, values: Mapping[str, Value] | None = None,
            frame: bool = False, *, input_slopes: bool = True) -> "np.ndarray | pandas.DataFrame":
        """Simulates from 0 to `stop` and records `outputs` every `step` (both s, or text such as "5 ms"). With `stop=0` the record is
        the state at the start.

        `inputs` by name: values, or pairs of arrays (times, values); see `Signals.of`. Tables have the same meaning as in scenes: inputs
        are linear between points, where the FMU stops without a record. A jump is recorded twice, before and after it. With
        `input_slopes=False` inputs are held within a step; parameters always are. `values`: parameters for this run only. Returns a
        structured array in SI, shape (points,), with a field "time" (s) and a field for each output. `step=None` takes one step to the
        end, or from point to point of the tables, and records these points.
        With `frame`, the result is a pandas DataFrame, by time. Raises `DifferentialError` with the FMU's message. Warnings of the FMU
        become Python warnings, `DifferentialWarning`; `warnings` contains their texts."""
        if frame:
            needed("pandas", "sweep")
        with self._warns_when_stopped():
            record = self._record(inputs, outputs, stop, step, values, input_slopes)
        warn([*self.warnings, *self._off(outputs, Signals.of(self.fmu, inputs, input_slopes), values).texts])
        return as_frame(record) if frame else record

    def final(self, outputs: Sequence[str], inputs: Inputs | None = None, stop: TimeValue = 0.5,
              values: Mapping[str, Value] | None = None) -> dict[str, Number]:
        """Values of `outputs` at `stop`, by name. Steps are as long as inputs are linear: the cheapest way if only the end counts."""
        last = self.run(inputs, outputs, stop, None, values)[-1]
        return {name: last[name].item() for name in outputs}

    def plot(self, record: np.ndarray, file: FileName | None = None, display_units: Sequence[str] = ()) -> "Figure":
        """Draws a record; see `plot.plot`."""
        return plot(self.fmu.displaying(display_units), record, file=file)

    def _record(self, inputs, outputs, stop, step, values=None, input_slopes=True):
        """`run` without Python warnings."""
        stop, step = duration("stop", stop), None if step is None else span("step", step)
        signals = Signals.of(self.fmu, inputs, input_slopes)
        return self._simulate(signals.steps(stop, step), signals, outputs, values)

    def __getstate__(self) -> dict[str, Any]:
        # only the values go to other processes
        return {"fmu": self.fmu, "values": self.values, "accept_start_values": self.accept_start_values}

    def __setstate__(self, state: Mapping[str, Any]) -> None:
        Differential.__init__(self, state["values"], fmu=state["fmu"], accept_start_values=state["accept_start_values"])


def as_frame(record: np.ndarray) -> "pandas.DataFrame":
    """Record as a pandas DataFrame, by time."""
    return require("pandas", "sweep").DataFrame(record).set_index("time")


def _advance(instance, batches, record, steps, signals):
    """Steps through all points and records. Sets changed values before each step, and records again if they jump."""
    readers = batches.readers(instance, record)
    variables = [table.variable for table in signals.tables]
    driven, straight = Batches.of(tuple(variables)), Batches.of(tuple(variables[index] for index in signals.straight))
    # writers store only addresses, so the blocks must stay alive here
    blocks, slope_blocks = driven.blocks(steps["values"].T), straight.blocks(steps["slopes"].T[signals.straight])
    writers = driven.writers(instance, blocks) + straight.slope_writers(instance, slope_blocks)
    applied = read_rows = 0

    def read(time):
        nonlocal read_rows
        for get, component, references, count, address, width in readers:
            if get(component, references, count, address + read_rows * width) >= DISCARD:
                instance.check(DISCARD, f"reading outputs at {time:g} s", "failed")
        read_rows += 1

    columns = (steps[name].tolist() for name in ("begin", "size", "end", "due", "jumps", "recorded"))
    for row, (begin, size, end, due, jumps, recorded) in enumerate(zip(*columns)):
        if row:
            while applied < due:
                changed = dict(signals.changes[applied][1])
                Batches.of(tuple(changed)).set(instance, list(changed.values()))
                applied += 1
            for write, component, references, count, address, width in writers:
                status = write(component, references, count, address + row * width)
                if status >= DISCARD:
                    instance.check(status, f"setting inputs at {begin:g} s")
            if jumps:
                read(begin)
            instance.do_step(begin, size)
        if recorded:
            read(end)


def _structured(points, variables, batches, record):
    kinds = {"Real": np.float64, "Integer": np.int32, "Enumeration": np.int32, "Boolean": np.bool_}
    fields = [("time", np.float64)] + [(variable.name, kinds[variable.kind]) for variable in variables]
    result = np.empty(len(points), fields)
    result["time"] = points
    for (_, indices, _, _), block in zip(batches.groups, record):
        for column, index in enumerate(indices):
            result[variables[index].name] = block[:, column]
    return result
