"""Inputs over time."""

from collections.abc import Iterable, Mapping, Sequence
from typing import Any, Self, TypeAlias

import numpy as np

from .fmu import Fmu
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
        times, values, points = self.times, self.values, self._within_period(points)
        after = np.searchsorted(times, points, side="right")
        found = values[np.maximum(after - 1, 0)]
        if self.variable.kind == "Real":
            inner = (after > 0) & (after < len(times))
            after, before = after[inner], after[inner] - 1
            share = (points[inner] - times[before]) / (times[after] - times[before])
            found[inner] = values[before] + share * (values[after] - values[before])
        return found

    def slopes(self, begins: np.ndarray, ends: np.ndarray) -> np.ndarray:
        """Slopes over steps from just after `begins` to just before `ends`, s, per second; shape (steps,). A value that jumps within a
        step, or begins its period anew, is held."""
        first, last = self._within_period(begins), self._within_period(ends)
        sizes, jumps = ends - begins, self.jumps()
        held = (last < first) | (np.searchsorted(jumps, first, side="right") != np.searchsorted(jumps, last, side="right"))
        if self.period is not None:
            held |= sizes >= self.period
        return np.where(held, 0.0, (self.along(ends) - self.along(begins)) / np.where(held, 1.0, sizes))

    def _within_period(self, points: np.ndarray) -> np.ndarray:
        return points if self.period is None else np.fmod(points, self.period)

    def jumps(self) -> np.ndarray:
        """Times at which the value jumps, s."""
        return self.times[1:][self.times[1:] == self.times[:-1]]


class Signals:
    """Inputs and tunable parameters of a run: constant, or changing with time.

    `constants`: [(variable, value)]; `tables`: [Table]; `changes`: [(time, [(variable, value)])], rising in time; `slopes`: whether
    tables, then of inputs alone, go on straight within steps."""

    def __init__(self, constants: Iterable[tuple[Variable, Number]] = (), tables: Iterable[Table] = (),
                 changes: Iterable[tuple[float, list[tuple[Variable, Number]]]] = (), slopes: bool = False):
        self.constants, self.tables, self.slopes = list(constants), list(tables), slopes
        self.changes = sorted(changes, key=lambda change: change[0])
        times = [time for table in self.tables for time in table.jumps().tolist()] + [time for time, _ in self.changes]
        self.jumps = tuple(sorted(set(times)))

    @classmethod
    def of(cls, fmu: Fmu, inputs: Inputs | None) -> Self:
        """From a mapping from name to a value or to a pair of arrays (times in s, values of shape (points,)), or from a
        structured array with a field "time", as fmpy takes it. Names are those of inputs and tunable parameters."""
        constants, tables = [], []
        for name, given in _pairs(inputs):
            variable = changing_variable(fmu, name)
            if isinstance(given, tuple) and len(given) == 2 and np.ndim(given[0]) == 1:
                tables.append(Table(variable, *given))
            else:
                constants.append((variable, variable.number(given)))
        return cls(constants, tables)

    def start(self) -> list[tuple[Variable, Number]]:
        """Values at the start: [(variable, value)]."""
        return self.constants + [(table.variable, table.at(0.0)) for table in self.tables]

    def along(self, begins: np.ndarray, ends: np.ndarray) -> tuple[list[np.ndarray], list[np.ndarray]]:
        """Values of all tables just after the beginnings of steps, and their slopes to just before the ends, if they have any;
        each of shape (steps,)."""
        slopes = [table.slopes(begins, ends) for table in self.tables] if self.slopes else []
        return [table.along(begins) for table in self.tables], slopes


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
