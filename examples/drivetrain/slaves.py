"""A system of FMUs as a master sees it: parts that step over time, give outputs and take their state back."""

import shutil

import numpy as np
from fmpy import extract, read_model_description
from fmpy.fmi2 import FMU2Slave

from parameters import CONNECTIONS, PARTS, settings

INTEGERS = ("Integer", "Enumeration")


class FmuPart:
    """One FMU through FMPy's calls of the C interface."""

    def __init__(self, name, fmu, inputs, outputs, values):
        description = read_model_description(fmu)
        known = {variable.name: variable for variable in description.modelVariables}
        self.name, self.folder = name, extract(fmu)
        self.interpolates = description.coSimulation.canInterpolateInputs
        self.fmu = FMU2Slave(guid=description.guid, unzipDirectory=self.folder, instanceName=name,
                             modelIdentifier=description.coSimulation.modelIdentifier)
        self.fmu.instantiate()
        for variable, value in values.items():
            write = self.fmu.setInteger if known[variable].type in INTEGERS else self.fmu.setReal
            write([known[variable].valueReference], [value])
        self.inputs = [known[variable].valueReference for variable in inputs]
        self.outputs = [known[variable].valueReference for variable in outputs]
        slopes = [known.get(f"der({variable})") for variable in inputs]
        self.slopes = [slope.valueReference for slope in slopes] if all(slopes) else None
        self.sloping = False
        self.fmu.setupExperiment(startTime=0.0)
        self.fmu.enterInitializationMode()
        # everything is at rest
        self.fmu.setReal(self.inputs, [0.0] * len(self.inputs))
        self.fmu.exitInitializationMode()

    @property
    def follows_lines(self):
        """Whether inputs can be lines within a step, by FMI's call or by separate inputs."""
        return self.interpolates or self.slopes is not None

    def step(self, time, size, u, slope=None):
        """One communication step with inputs `u` held, or, with a slope, on the line u + slope (t − time). A part that
        does not support lines gets the middle of the line: its mean, which has the same second order."""
        if slope is not None and not self.follows_lines:
            u, slope = u + 0.5 * size * slope, None
        self.put(u)
        if slope is not None and self.interpolates:
            self.fmu.setRealInputDerivatives(self.inputs, [1] * len(slope), list(slope))
        elif self.slopes is not None and (slope is not None or self.sloping):
            self.fmu.setReal(self.slopes, [0.0] * len(u) if slope is None else list(slope))
            self.sloping = slope is not None
        self.fmu.doStep(currentCommunicationPoint=time, communicationStepSize=size)

    def put(self, u):
        self.fmu.setReal(self.inputs, list(u))

    def read(self):
        return self.fmu.getReal(self.outputs)

    def save(self):
        return self.fmu.getFMUState(), self.sloping

    def restore(self, saved):
        self.fmu.setFMUState(saved[0])
        self.sloping = saved[1]

    def drop(self, saved):
        self.fmu.freeFMUState(saved[0])

    def close(self):
        self.fmu.terminate()
        self.fmu.freeInstance()
        shutil.rmtree(self.folder, ignore_errors=True)


class System:
    """Parts and what feeds each of their inputs; y is the vector of all outputs, `signals` their names."""

    def __init__(self, make_part):
        """`make_part(name, inputs, outputs)` makes each part."""
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
        """The system that the SSP describes; `changes` are more settings, by part and variable."""
        values = settings(contact) | (changes or {})

        def make_part(part, inputs, outputs):
            own = {variable: value for (owner, variable), value in values.items() if owner == part}
            return FmuPart(part, str(fmus[PARTS[part]]), inputs, outputs, own)

        return cls(make_part)

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
