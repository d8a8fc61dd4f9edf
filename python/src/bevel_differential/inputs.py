"""Inputs over time."""

import numpy as np

from .values import DifferentialError


class Signals:
    """Inputs as functions of time: Reals straight between their points, others held; before the first point and after the last
    one they are constant. Two points at one time are a jump."""

    def __init__(self, fmu, inputs):
        """`inputs`: a mapping from name to a value or to a pair of arrays (times in s, values of shape (points,)), or a structured
        array with a field "time", as fmpy takes it."""
        self.constants, self.tables = [], []
        for name, given in _pairs(inputs):
            variable = fmu.variable(name)
            if variable.causality != "input":
                raise DifferentialError(f"{name}: it is no input but {_article(variable.causality)}")
            if _is_table(given):
                self.tables.append((variable, *_table(variable, *given)))
            else:
                self.constants.append((variable, variable.number(given)))
        jumps = [times[1:][times[1:] == times[:-1]] for _, times, _ in self.tables]
        self.jumps = np.unique(np.concatenate(jumps)) if jumps else np.empty(0)

    def at(self, time):
        """Values of all tables after a time."""
        return [_value(variable, times, values, time) for variable, times, values in self.tables]


def _pairs(inputs):
    names = getattr(getattr(inputs, "dtype", None), "names", None)
    if names is not None:
        if "time" not in names:
            raise DifferentialError("inputs: a structured array needs a field \"time\"")
        return [(name, (inputs["time"], inputs[name])) for name in names if name != "time"]
    return list((inputs or {}).items())


def _is_table(given):
    return isinstance(given, tuple) and len(given) == 2 and np.ndim(given[0]) == 1


def _table(variable, times, values):
    times = np.asarray(times, float)
    numbers = np.array([variable.number(value) for value in values])
    if len(times) != len(numbers) or len(times) == 0:
        raise DifferentialError(f"{variable.name}: {len(times)} times for {len(numbers)} values")
    if not np.all(np.isfinite(times)) or np.any(np.diff(times) < 0.0):
        raise DifferentialError(f"{variable.name}: times must be finite and must not fall")
    return times, numbers


def _value(variable, times, values, time):
    after = int(np.searchsorted(times, time, side="right"))
    if after in (0, len(times)):
        return values[min(after, len(times) - 1)]
    if variable.kind != "Real":
        return values[after - 1]
    share = (time - times[after - 1]) / (times[after] - times[after - 1])
    return values[after - 1] + share * (values[after] - values[after - 1])


def _article(causality):
    return f"{'an' if causality[0] in 'aeio' else 'a'} {causality}"
