"""Derivatives of the states and their Jacobian at points of a scene, by FMPy, call by call: what hosts that evaluate the equations in
model exchange are compared with. The script of such a host takes its points and its columns from here."""

import math
import shutil
from contextlib import contextmanager
from dataclasses import dataclass

import common
import with_fmpy

load = with_fmpy.load
# points of a scene: the start, and states around it
POINTS = 5
# largest distance of a state from the start, in nominal values
AWAY = 0.05


@dataclass(frozen=True)
class Point:
    """Values by name, SI, at which derivatives are evaluated."""

    states: dict[str, float]
    inputs: dict[str, float]


class Equations:
    """Names of the states in the order of the model description, of their derivatives and of the inputs; `nominal` values of states and
    inputs by name, SI."""

    def __init__(self, fmu):
        described = common.described(fmu)
        rates = [unknown.variable for unknown in described.derivatives]
        self.states, self.rates = [rate.derivative.name for rate in rates], [rate.name for rate in rates]
        self.inputs = [variable.name for variable in described.modelVariables if variable.causality == "input"]
        self.nominal = {variable.name: float(variable.nominal or 1.0) for variable in described.modelVariables}

    def columns(self):
        """Names of the recorded values: derivatives, and their changes by a nominal change of a state or an input."""
        return [*self.rates, *(f"{rate} by {name}" for rate in self.rates for name in (*self.states, *self.inputs))]

    def row(self, rates, slopes):
        """The recorded values; `rates` by name of their state, `slopes` by names of that state and of what is changed, SI."""
        return [*(rates[state] for state in self.states),
                *(slopes[state, name] * self.nominal[name] for state in self.states for name in (*self.states, *self.inputs))]

    def points(self, start, scene):
        """The points around the states `start`, with the inputs that the scene has meanwhile."""
        for k in range(POINTS):
            away = {name: AWAY * self.nominal[name] * math.sin(k * (j + 1.0)) for j, name in enumerate(self.states)}
            time = scene.stop * k / POINTS
            inputs = {name: next(value for at, value in reversed(series) if at <= time) for name, series in scene.series.items()}
            yield Point({name: start[name] + away[name] for name in self.states}, inputs)


def run(fmu, scene):
    """{point: values}"""
    equations, known = Equations(fmu), common.variables(fmu)
    scene.outputs = equations.columns()
    of_states, of_rates, of_inputs = ([known[name].reference for name in names]
                                      for names in (equations.states, equations.rates, equations.inputs))
    rows = {}
    with started(fmu, scene) as (model, start):
        for k, point in enumerate(equations.points(start, scene)):
            model.setReal([known[name].reference for name in point.inputs], [*point.inputs.values()])
            set_states(model, [point.states[name] for name in equations.states])
            rates = dict(zip(equations.states, of(model.getDerivatives, len(of_states))))
            slopes = {}
            for name, reference in zip((*equations.states, *equations.inputs), (*of_states, *of_inputs)):
                column = model.getDirectionalDerivative(of_rates, [reference], [1.0])
                slopes.update({(state, name): slope for state, slope in zip(equations.states, column)})
            rows[k] = equations.row(rates, slopes)
    return rows


@contextmanager
def started(fmu, scene):
    """An instance for model exchange in continuous-time mode, and its states at the start by name."""
    import fmpy
    from fmpy.fmi2 import FMU2Model

    folder = fmpy.extract(fmu)
    described, equations = common.described(fmu), Equations(fmu)
    model = FMU2Model(guid=described.guid, unzipDirectory=folder, modelIdentifier=described.modelExchange.modelIdentifier,
                      instanceName="differential")
    try:
        with_fmpy.begun(model, scene, common.variables(fmu))
        model.newDiscreteStates()
        model.enterContinuousTimeMode()
        yield model, dict(zip(equations.states, of(model.getContinuousStates, len(equations.states))))
        model.terminate()
        model.freeInstance()
    finally:
        shutil.rmtree(folder, ignore_errors=True)


def of(get, count):
    """Values that a function of FMI writes into an array."""
    from ctypes import c_double

    values = (c_double * count)()
    get(values, count)
    return list(values)


def set_states(model, values):
    """Sets all states together."""
    from ctypes import c_double

    model.setContinuousStates((c_double * len(values))(*values), len(values))


if __name__ == "__main__":
    common.main(load, run)
