"""Inputs over time."""

from collections.abc import Iterable, Iterator, Mapping, Sequence
from typing import Any, Self, TypeAlias

import numpy as np

from .library import schedule
from .values import DifferentialError, Number, Value, Variable, Variables

# times, s, and values at these times, shape (points,)
Times: TypeAlias = Sequence[float] | np.ndarray
Values: TypeAlias = Sequence[Value] | np.ndarray
# inputs in the form that users write, by name: values, or pairs (times, values); or a structured array with a field "time"
Inputs: TypeAlias = Mapping[str, Value | tuple[Times, Values]] | np.ndarray


# rules for the values of a table in a question for a schedule
LINEAR, HELD, SAMPLED = 0, 1, 2
# rounding of values, relative to the largest of a table, or absolute if all are below 1
ROUNDING = 1e-9


class Table:
    """Input or tunable parameter over time. Real values are interpolated linearly, others are held. Before the first point and after the
    last one the value is constant, unless the table repeats after `period` (s). Two points at the same time are a jump."""

    def __init__(self, variable: Variable, times: Times, values: Values, period: float | None = None):
        self.variable, self.period = variable, period
        self.times = np.asarray(times, float)
        self.values = np.array([variable.number(value) for value in values])
        if len(self.times) != len(self.values):
            raise DifferentialError(f"{variable.name}: {len(self.times)} times for {len(self.values)} values")
        if len(self.times) == 0:
            raise DifferentialError(f"{variable.name}: its table has no points; give at least one time with a value")
        falls = np.flatnonzero(~np.isfinite(self.times) | (np.diff(self.times, prepend=-np.inf) < 0.0))
        if len(falls):
            raise DifferentialError(f"{variable.name}: times must be finite and must not fall; time {falls[0] + 1} of its table is "
                                    f"{self.times[falls[0]]:g} s")
        low, high = (limit if limit is not None else other for limit, other in ((variable.minimum, -np.inf), (variable.maximum, np.inf)))
        # the FMU sets what exceeds a range by rounding to its limit
        rounding = ROUNDING * max(1.0, np.max(np.abs(self.values)))
        for k in np.flatnonzero((self.values < low - rounding) | (self.values > high + rounding))[:1]:
            variable.check_range(self.values[k].item(), values[k], f"; its table has this value at {self.times[k]:g} s")

    def numbers(self, is_straight: bool) -> np.ndarray:
        """Numbers of the table in a question for a schedule; `is_straight`: true if the input follows the table within steps."""
        rule = HELD if self.variable.kind != "Real" else LINEAR if is_straight else SAMPLED
        return np.concatenate([[len(self.times), self.period or 0.0, rule], self.times, self.values])

    @property
    def is_piecewise_constant(self) -> bool:
        """True if the value changes only in jumps."""
        return self.variable.kind != "Real" or not np.any((np.diff(self.times) > 0.0) & (np.diff(self.values) != 0.0))


class Signals:
    """Inputs and tunable parameters of a run: constant or variable over time.

    `constants`: [(variable, value)]; `tables`: [Table]; `changes`: [(time, [(variable, value)])], in order of time; `slopes`: true if
    tables of inputs are linear within steps, false if their values are held. Values of parameters are always held."""

    def __init__(self, constants: Iterable[tuple[Variable, Number]] = (), tables: Iterable[Table] = (),
                 changes: Iterable[tuple[float, list[tuple[Variable, Number]]]] = (), slopes: bool = True):
        if not isinstance(slopes, bool):
            raise DifferentialError(f"input_slopes = {slopes!r}: it is True or False")
        self.constants, self.tables = list(constants), list(tables)
        self.changes = sorted(changes, key=lambda change: change[0])
        # indices of the tables that are linear within steps
        self.straight = [index for index, table in enumerate(self.tables) if slopes and table.variable.causality == "input"]
        self._cache: Any = None, None

    def steps(self, stop: float, step: float | None) -> np.ndarray:
        """Steps to `stop`. They end at multiples of `step`, at changes, at jumps of tables, and at points of tables between which an input
        is linear; without `step` at changes and at points of tables. See `library.schedule`. The last steps are cached, because the designs of a sweep share them."""
        cached = self._cache
        if cached[0] != (stop, step):
            cached = self._cache = (stop, step), self._scheduled(stop, step)
        return cached[1]

    def _scheduled(self, stop, step):
        for index, table in enumerate(self.tables):
            if step is None and index not in self.straight and not table.is_piecewise_constant:
                why = "a parameter is held" if table.variable.causality == "parameter" else "without input_slopes an input is held"
                raise DifferentialError(f"{table.variable.name}: its table changes between its points, but {why} within a step; give a step")
        times, tables = [time for time, _ in self.changes], [table.numbers(index in self.straight) for index, table in enumerate(self.tables)]
        try:
            count, steps = schedule(np.concatenate([[stop, step or 0.0, len(times)], times, *tables]), len(tables))
        except OSError as missing:
            raise DifferentialError(str(missing), kind="failed") from None
        if count == -1:
            raise DifferentialError(f"{stop:g} s in steps of {step:g} s are more than 1e+08 steps: end earlier, or take longer steps")
        if count < -1:
            table = self.tables[-2 - count]
            raise DifferentialError(f"{table.variable.name} jumps more than 1e+08 times in {stop:g} s; its period is {table.period:g} s: "
                                    "give a longer one, or end earlier")
        return steps

    @classmethod
    def of(cls, fmu: Variables, inputs: Inputs | None, slopes: bool = True) -> Self:
        """Reads a mapping from name to a value or to a pair of arrays (times in s, values of shape (points,)), or a structured array with
        a field "time", as fmpy accepts it. Names are those of inputs and tunable parameters."""
        constants, tables = [], []
        for name, given in _pairs(inputs):
            variable = changing_variable(fmu, name)
            if isinstance(given, tuple) and len(given) == 2 and np.ndim(given[0]) == 1:
                tables.append(Table(variable, *given))
            else:
                constants.append((variable, variable.number(given)))
        return cls(constants, tables, slopes=slopes)

    def courses(self) -> Iterator[tuple[str, Number]]:
        """All values that variables have in a run: pairs (name, value)."""
        yield from ((variable.name, value) for variable, value in self.constants)
        for table in self.tables:
            yield from ((table.variable.name, value) for value in (table.values.min().item(), table.values.max().item()))
        yield from ((variable.name, value) for _, pairs in self.changes for variable, value in pairs)

    def start(self, steps: np.ndarray) -> list[tuple[Variable, Number]]:
        """Values at the start: [(variable, value)]."""
        return self.constants + [(table.variable, value) for table, value in zip(self.tables, steps["values"][0].tolist())]


def times_of_rows(steps: np.ndarray) -> np.ndarray:
    """Times of the rows of a record, s: the start, the recorded ends of steps, and second rows at jumps."""
    ends = np.column_stack([np.roll(steps["end"], 1), steps["end"]])
    return ends[np.column_stack([steps["jumps"], steps["recorded"]]) != 0.0]


def prolonged(steps: np.ndarray) -> list[str]:
    """Warning of a run that points of tables make much longer."""
    points = int(steps["begin"][0])
    return [f"the run ends a step at each of {points} points of tables between its communication points, which makes it much longer; "
            "tables with fewer points make it shorter"] if points else []


def input_variable(fmu: Variables, name: str) -> Variable:
    """Input `name`."""
    variable = fmu.variable(name)
    if variable.causality != "input":
        article = "an" if variable.causality[0] in "aeio" else "a"
        raise DifferentialError(f"{name}: it is {article} {variable.causality}, not an input")
    return variable


def changing_variable(fmu: Variables, name: str) -> Variable:
    """Input or tunable parameter `name`."""
    variable = fmu.variable(name)
    if variable.causality == "parameter" and variable.variability == "fixed":
        raise DifferentialError(f"{name}: it is a fixed parameter; give it by `set` or `values`, as only inputs and tunable "
                                "parameters change during a run")
    return variable if variable.causality == "parameter" else input_variable(fmu, name)


def _pairs(inputs):
    names = getattr(getattr(inputs, "dtype", None), "names", None)
    if names is not None:
        if "time" not in names:
            raise DifferentialError("inputs: a structured array needs a field \"time\"")
        return [(name, (inputs["time"], inputs[name])) for name in names if name != "time"]
    return list((inputs or {}).items())
