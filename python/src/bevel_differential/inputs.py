"""Inputs over time."""

from collections.abc import Iterable, Mapping, Sequence
from typing import Any, Self, TypeAlias

import numpy as np

from .fmu import Fmu
from .points import Recurring
from .values import DifferentialError, Number, Value, Variable

# times, s, and values at them, shape (points,)
Times: TypeAlias = Sequence[float] | np.ndarray
Values: TypeAlias = Sequence[Value] | np.ndarray
# inputs as a user writes them, by name: values, or pairs (times, values); or a structured array with a field "time"
Inputs: TypeAlias = Mapping[str, Value | tuple[Times, Values]] | np.ndarray


class Table:
    """An input or a tunable parameter over time. Reals are interpolated linearly, others held. The value is constant before the first
    point and after the last, or repeated after `period` (s). Two points at one time are a jump."""

    def __init__(self, variable: Variable, times: Times, values: Values, period: float | None = None):
        self.variable, self.period = variable, period
        self.times = np.asarray(times, float)
        self.values = np.array([variable.number(value) for value in values])
        if len(self.times) != len(self.values) or len(self.times) == 0:
            raise DifferentialError(f"{variable.name}: {len(self.times)} times for {len(self.values)} values")
        if not np.all(np.isfinite(self.times)) or np.any(np.diff(self.times) < 0.0):
            raise DifferentialError(f"{variable.name}: times must be finite and must not fall")

    def at(self, time: float) -> Any:
        """Value just after a time."""
        return self.along(np.array([time]))[0]

    def along(self, points: np.ndarray) -> np.ndarray:
        """Values just after times `points`, s, shape (points,)."""
        return self._between(points if self.period is None else np.fmod(points, self.period), "right")

    def before(self, points: np.ndarray) -> np.ndarray:
        """Values just before times `points`, s, shape (points,)."""
        if self.period is not None:
            within = np.fmod(points, self.period)
            # the end of a period, not the start of the next one
            points = np.where((within == 0.0) & (points > 0.0), self.period, within)
        return self._between(points, "left")

    def _between(self, points, side):
        times, values = self.times, self.values
        after = np.searchsorted(times, points, side=side)
        found = values[np.maximum(after - 1, 0)]
        if self.variable.kind == "Real":
            inner = (after > 0) & (after < len(times))
            after, before, points = after[inner], after[inner] - 1, points[inner]
            share = (points - times[before]) / (times[after] - times[before])
            straight = values[before] + share * (values[after] - values[before])
            found[inner] = np.where(points == times[after], values[after], straight)
        return found

    def slopes(self, begins: np.ndarray, ends: np.ndarray) -> np.ndarray:
        """Slopes over steps without jumps, from just after `begins` to just before `ends`, s, per second; shape (steps,)."""
        return (self.before(ends) - self.along(begins)) / (ends - begins)

    def jumps(self) -> list[Recurring]:
        """Times at which the value jumps: two points of one time, and the end of a period whose next one begins with another value."""
        times = self.times[1:][self.times[1:] == self.times[:-1]].tolist()
        if self.period is not None and self.before(np.array([self.period]))[0] != self.at(0.0):
            times.append(0.0)
        return self._recurring(times)

    def corners(self) -> list[Recurring]:
        """Times between which the value is straight."""
        return self._recurring([*self.times.tolist(), *([] if self.period is None else [0.0])])

    @property
    def is_piecewise_constant(self) -> bool:
        """True if the value changes only in jumps."""
        return self.variable.kind != "Real" or not np.any((np.diff(self.times) > 0.0) & (np.diff(self.values) != 0.0))

    def _recurring(self, times):
        return [(time, self.period) for time in sorted(set(times)) if self.period is None or time < self.period]


class Signals:
    """Inputs and tunable parameters of a run: constant, or changing with time.

    `constants`: [(variable, value)]; `tables`: [Table]; `changes`: [(time, [(variable, value)])], rising in time; `slopes`: True if
    tables of inputs continue straight within steps, False if their values are held. Those of parameters are always held."""

    def __init__(self, constants: Iterable[tuple[Variable, Number]] = (), tables: Iterable[Table] = (),
                 changes: Iterable[tuple[float, list[tuple[Variable, Number]]]] = (), slopes: bool = True):
        if not isinstance(slopes, bool):
            raise DifferentialError(f"input_slopes = {slopes!r}: it is True or False")
        self.constants, self.tables, self.slopes = list(constants), list(tables), slopes
        self.changes = sorted(changes, key=lambda change: change[0])
        self.jumps = self._stops(Table.jumps)

    def corners(self) -> tuple[Recurring, ...]:
        """Times between which all inputs are straight. Refuses tables that steps between them cannot follow."""
        for table in self.tables:
            if table not in self.sloping and not table.is_piecewise_constant:
                why = "a parameter is held" if table.variable.causality == "parameter" else "without input_slopes an input is held"
                raise DifferentialError(f"{table.variable.name}: its table changes between its points, but {why} within a step; give a step")
        return self._stops(Table.corners)

    @property
    def sloping(self) -> list[Table]:
        """Tables that continue straight within steps."""
        return [table for table in self.tables if table.variable.causality == "input"] if self.slopes else []

    def _stops(self, of):
        times = {time for table in self.tables for time in of(table)} | {(time, None) for time, _ in self.changes}
        return tuple(sorted(times, key=lambda stop: (stop[0], stop[1] or 0.0)))

    @classmethod
    def of(cls, fmu: Fmu, inputs: Inputs | None, slopes: bool = True) -> Self:
        """From a mapping from name to a value or to a pair of arrays (times in s, values of shape (points,)), or from a
        structured array with a field "time", as fmpy takes it. Names are those of inputs and tunable parameters."""
        constants, tables = [], []
        for name, given in _pairs(inputs):
            variable = changing_variable(fmu, name)
            if any(variable is known for known in [*(table.variable for table in tables), *(other for other, _ in constants)]):
                raise DifferentialError(f"{variable.name}: it is given twice, once by its former name; leave one of them out")
            if isinstance(given, tuple) and len(given) == 2 and np.ndim(given[0]) == 1:
                tables.append(Table(variable, *given))
            else:
                constants.append((variable, variable.number(given)))
        return cls(constants, tables, slopes=slopes)

    def start(self) -> list[tuple[Variable, Number]]:
        """Values at the start: [(variable, value)]."""
        return self.constants + [(table.variable, table.at(0.0)) for table in self.tables]

    def along(self, begins: np.ndarray, ends: np.ndarray) -> tuple[list[np.ndarray], list[np.ndarray]]:
        """Values of all tables just after the beginnings of steps, and slopes to just before the ends of those that have slopes;
        each of shape (steps,)."""
        return [table.along(begins) for table in self.tables], [table.slopes(begins, ends) for table in self.sloping]


def input_variable(fmu: Fmu, name: str) -> Variable:
    """The input `name`."""
    variable = fmu.variable(name)
    if variable.causality != "input":
        article = "an" if variable.causality[0] in "aeio" else "a"
        raise DifferentialError(f"{name}: it is no input but {article} {variable.causality}")
    return variable


def changing_variable(fmu: Fmu, name: str) -> Variable:
    """The input or tunable parameter `name`."""
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
