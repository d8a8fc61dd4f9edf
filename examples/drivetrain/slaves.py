"""System of FMUs for a master: parts that step over time, return outputs, and save and restore their state."""

import numpy as np
from bevel_differential import Fmu
from bevel_differential.batches import Batches

from parameters import CONNECTIONS, PARTS, settings


class FmuPart:
    """One FMU, call by call."""

    def __init__(self, name, fmu, inputs, outputs, values):
        self.name, fmu = name, Fmu.of(fmu)
        self.interpolates = fmu.description.coSimulation.canInterpolateInputs
        self.instance, self.inputs = fmu.open(name=name), inputs
        self.fed, self.given = self.variables(inputs), self.variables(outputs)
        slopes = [f"der({each})" for each in inputs]
        self.slopes = Batches([fmu.variable(each) for each in slopes]) if all(each in fmu.variables for each in slopes) else None
        self.sloping = False
        # everything is at rest
        self.instance.initialise(values | dict.fromkeys(inputs, 0.0))

    def variables(self, names):
        """Variables to read or set together."""
        return Batches([self.instance.fmu.variable(name) for name in names])

    @property
    def follows_lines(self):
        """True if inputs can be lines within a step, by FMI's call or by separate inputs."""
        return self.interpolates or self.slopes is not None

    def step(self, time, size, u, slope=None):
        """Advances by one communication step with inputs `u` held or, with a slope, on the line u + slope (t − time). A part
        that does not support lines gets the value at the middle of the line: its mean, which is also of second order."""
        if slope is not None and not self.follows_lines:
            u, slope = u + 0.5 * size * slope, None
        self.put(u)
        if slope is not None and self.interpolates:
            self.instance.set_slopes(dict(zip(self.inputs, slope)))
        elif self.slopes is not None and (slope is not None or self.sloping):
            self.slopes.set(self.instance, np.zeros(len(u)) if slope is None else slope)
            self.sloping = slope is not None
        self.instance.do_step(time, size)

    def put(self, u):
        self.fed.set(self.instance, u)

    def read(self):
        return self.given.get(self.instance)

    def save(self):
        return self.instance.raw.getFMUState(), self.sloping

    def restore(self, saved):
        self.instance.raw.setFMUState(saved[0])
        self.sloping = saved[1]

    def drop(self, saved):
        self.instance.raw.freeFMUState(saved[0])

    def close(self):
        self.instance.close()


class System:
    """Parts and the sources of their inputs; y is the vector of all outputs, `signals` contains their names."""

    def __init__(self, make_part):
        """Creates each part by `make_part(name, inputs, outputs)`."""
        outputs = {part: list(dict.fromkeys(o for source, o in CONNECTIONS.values() if source == part)) for part in PARTS}
        self.signals = [(part, output) for part in PARTS for output in outputs[part]]
        place = {signal: i for i, signal in enumerate(self.signals)}
        self.parts, self.feeds, self.gives = [], [], []
        for part in PARTS:
            inputs = [name for owner, name in CONNECTIONS if owner == part]
            self.parts.append(make_part(part, inputs, outputs[part]))
            self.feeds.append([place[CONNECTIONS[part, name]] for name in inputs])
            self.gives.append([place[part, output] for output in outputs[part]])

    @classmethod
    def of_fmus(cls, fmus, contact, changes=None):
        """The system that the SSP describes; `changes` are further settings, by part and variable."""
        values = settings(contact) | (changes or {})

        def make_part(part, inputs, outputs):
            own = {variable: value for (owner, variable), value in values.items() if owner == part}
            return FmuPart(part, str(fmus[PARTS[part]]), inputs, outputs, own)

        return cls(make_part)

    def part(self, name):
        return next(part for part in self.parts if part.name == name)

    def read(self):
        y = np.empty(len(self.signals))
        for part, gives in zip(self.parts, self.gives):
            y[gives] = part.read()
        return y

    def put(self, y):
        for part, feeds in zip(self.parts, self.feeds):
            part.put(y[feeds])

    def save(self):
        return [part.save() for part in self.parts]

    def restore(self, saved):
        for part, state in zip(self.parts, saved):
            part.restore(state)

    def drop(self, saved):
        for part, state in zip(self.parts, saved):
            part.drop(state)

    def __enter__(self):
        return self

    def __exit__(self, *_):
        for part in self.parts:
            part.close()
