"""State derivatives and their Jacobian at points of a scene, computed with individual FMI calls in FMPy.

They are the reference for hosts that evaluate the equations in model exchange. The script of such a host uses the points and columns of
this module."""

import math
import shutil
from contextlib import contextmanager
from dataclasses import dataclass

import common
import with_fmpy

load = with_fmpy.load
# number of points of a scene: the start and states around it
POINTS = 5
# maximum distance of a state from its start value, relative to its nominal value
AWAY = 0.05


@dataclass(frozen=True)
class Point:
    """Values by name [SI] at which derivatives are evaluated."""

    states: dict[str, float]
    inputs: dict[str, float]


class Equations:
    """Names of the states, their derivatives and the inputs, in the order of the model description. `nominal` contains the nominal values
    by name [SI]."""

    def __init__(self, fmu):
        described = common.described(fmu)
        rates = [unknown.variable for unknown in described.derivatives]
        self.states, self.rates = [rate.derivative.name for rate in rates], [rate.name for rate in rates]
        self.inputs = [variable.name for variable in described.modelVariables if variable.causality == "input"]
        self.nominal = {variable.name: float(variable.nominal or 1.0) for variable in described.modelVariables}

    def columns(self):
        """Names of the recorded values: derivatives, and their linear changes for a nominal change of a state or an input."""
        return [*self.rates, *(f"{rate} by {name}" for rate in self.rates for name in (*self.states, *self.inputs))]

    def row(self, rates, slopes):
        """Recorded values of a point. `rates` is {state: derivative} [SI]. `slopes` is {(state, name): partial derivative} [SI], the
        derivative of that state's rate with respect to the state or input `name`."""
        return [*(rates[state] for state in self.states),
                *(slopes[state, name] * self.nominal[name] for state in self.states for name in (*self.states, *self.inputs))]

    def points(self, start, scene):
        """Points around the states `start`, with the inputs of the scene at equally spaced times."""
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
    """An instance for model exchange in continuous-time mode, and its initial states by name."""
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
    """Returns `count` values that the FMI function `get` writes into an array."""
    from ctypes import c_double

    values = (c_double * count)()
    get(values, count)
    return list(values)


def set_states(model, values):
    """Sets all states in one call."""
    from ctypes import c_double

    model.setContinuousStates((c_double * len(values))(*values), len(values))


if __name__ == "__main__":
    common.main(load, run)
