"""The differential, as a user has it."""

import threading

import numpy as np

from .fmu import Fmu
from .inputs import Signals
from .instance import Batches, Instance
from .values import DifferentialError

# what `run` records if nothing is said
USUAL_OUTPUTS = ("carrier.speed", "left.speed", "right.speed", "left.shaft_torque", "right.shaft_torque")
# a stop time within so many steps of a point is that point
SLACK = 1e-9


class Differential:
    """A bevel gear differential with its parameters.

    Parameters are given by their names in the FMU, in a mapping or as keywords with two underscores for the dot:
    `Differential({"geometry.module": "4.5 mm"}, contact__law="line_weber")`. Values are SI numbers, pairs (number, unit), text with
    a unit, literals by name. What is not given has its start value. An instance is kept for all runs and reset in between; each
    thread has its own."""

    def __init__(self, parameters=None, *, fmu=None, **keywords):
        self.fmu = Fmu.of(fmu)
        self._values = {}
        self._instances = threading.local()
        self._all = []
        self.set(parameters, **keywords)

    def set(self, parameters=None, **keywords):
        """Changes parameters and start values of inputs."""
        named = {name.replace("__", "."): value for name, value in keywords.items()}
        for name, value in {**(parameters or {}), **named}.items():
            variable = self.fmu.variable(name)
            if variable.causality not in ("parameter", "input"):
                raise DifferentialError(f"{name}: it is calculated and cannot be set")
            self._values[name] = (variable, variable.number(value))
        return self

    def run(self, inputs=None, outputs=USUAL_OUTPUTS, stop=0.5, step=0.001):
        """Simulates from 0 to `stop` and records `outputs` every `step` (both s, or text such as "5 ms").

        Returns a structured array: field "time" (s) and one of each output, in SI; shape (points,). `step=None` takes one step to the
        end and gives two points, at 0 and at `stop`. `inputs`: see `Signals`. Raises `DifferentialError` with the FMU's message."""
        stop, step = _seconds("stop", stop), None if step is None else _seconds("step", step)
        variables = [self.fmu.variable(name) for name in outputs]
        signals = Signals(self.fmu, inputs)
        points = _points(stop, step, signals.jumps)
        instance = self._instance()
        first = signals.at(0.0)
        tables = [variable for variable, *_ in signals.tables]
        start = {**self._values, **{variable.name: (variable, value) for variable, value in
                                    [*signals.constants, *zip(tables, first)]}}
        instance.start(list(start.values()), stop)
        batches = Batches(variables)
        record = batches.record(len(points))
        _advance(instance, batches, record, points, signals)
        return _structured(points, variables, batches, record)

    def final(self, outputs, inputs=None, stop=0.5):
        """Values of `outputs` at `stop`, after one long step: the cheapest way where only the end counts. A dict by name."""
        last = self.run(inputs, outputs, stop, None)[-1]
        return {name: last[name].item() for name in outputs}

    @property
    def values(self):
        """What has been set, by name, as the FMU takes it: SI numbers, numbers of literals."""
        return {name: value for name, (_, value) in self._values.items()}

    @property
    def warnings(self):
        """What the FMU warned of in the last run of this thread."""
        return list(self._instance().messages)

    def close(self):
        """Frees all instances."""
        while self._all:
            self._all.pop().close()
        self._instances = threading.local()

    def _instance(self):
        if not hasattr(self._instances, "own"):
            self._instances.own = Instance(self.fmu)
            self._all.append(self._instances.own)
        return self._instances.own

    def __enter__(self):
        return self

    def __exit__(self, *_):
        self.close()

    def __getstate__(self):
        # to other processes go the values alone
        return {"file": str(self.fmu.file), "values": self.values}

    def __setstate__(self, state):
        self.__init__(state["values"], fmu=state["file"])


def _advance(instance, batches, record, points, signals):
    """Steps through all points and records; sets inputs that change before each step."""
    readers = batches.readers(instance, record)
    driven = Batches([variable for variable, *_ in signals.tables])
    times = points.tolist()
    for row, time in enumerate(times):
        if row:
            begin = times[row - 1]
            if signals.tables:
                driven.set(instance, signals.at(begin))
            instance.do_step(begin, time - begin)
        for get, component, references, count, address, width in readers:
            get(component, references, count, address + row * width)


def _points(stop, step, jumps):
    """Communication points: multiples of the step, jumps of inputs, and the end."""
    if not stop > 0.0:
        raise DifferentialError(f"stop = {stop!r}: it is a time after 0, s")
    if step is None:
        regular = np.array([0.0])
    elif not step > 0.0:
        raise DifferentialError(f"step = {step!r}: it is more than 0, s")
    else:
        regular = np.arange(int(stop / step * (1.0 + SLACK)) + 1) * step
        regular = regular[regular < stop - SLACK * step]
    regular = np.append(regular, stop)
    inner = jumps[(jumps > 0.0) & (jumps < stop)]
    near = np.abs(inner[:, None] - regular).min(axis=1, initial=np.inf) < SLACK * (step or stop)
    return np.union1d(regular, inner[~near])


def _seconds(what, time):
    if isinstance(time, str):
        number, _, unit = time.strip().partition(" ")
        factors = {"": 1.0, "s": 1.0, "ms": 1e-3, "us": 1e-6, "min": 60.0, "h": 3600.0}
        try:
            return float(number) * factors[unit.strip()]
        except (KeyError, ValueError):
            raise DifferentialError(f"{what} = {time!r}: write seconds, or a number and one of s, ms, us, min, h") from None
    if not np.isfinite(time):
        raise DifferentialError(f"{what} = {time!r}: it is a finite time, s")
    return float(time)


def _structured(points, variables, batches, record):
    kinds = {"Real": np.float64, "Integer": np.int32, "Enumeration": np.int32, "Boolean": np.bool_}
    fields = [("time", np.float64)] + [(variable.name, kinds[variable.kind]) for variable in variables]
    result = np.empty(len(points), fields)
    result["time"] = points
    for (_, places, _, _), block in zip(batches.groups, record):
        for column, place in enumerate(places):
            result[variables[place].name] = block[:, column]
    return result
