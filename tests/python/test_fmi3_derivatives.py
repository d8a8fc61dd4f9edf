"""Directional derivatives of the unit of FMI 3.0 against differences of its outputs, and adjoint derivatives against directional
ones: all inputs and states, all outputs and derivatives, ten scenes, co-simulation and model exchange."""

import ctypes
from pathlib import Path

import numpy as np
import pytest
from bevel_differential import Scene, shipped_scenes
from fmi3 import Unit3
from fmpy.fmi1 import FMICallException

# both depend on |T_left - T_right| and on which wheel is faster: they have a kink where the wheels are equal
KINKED = {"locking_value", "torque_bias_ratio"}
FIRST, STEPS = 1e-2, 9


@pytest.fixture(params=["ModelExchange", "CoSimulation"])
def kind(request):
    return request.param


@pytest.fixture(params=shipped_scenes())
def unit(request, fmu, fmu_file, kind):
    """Unit of FMI 3.0 in a scene: at its start in model exchange, after a step in co-simulation."""
    scene = Scene.load(request.param, fmu=fmu)
    with Unit3(Path(fmu_file).with_name("BevelDifferential3.fmu"), kind) as unit:
        unit.initialise(scene.values)
        if kind == "ModelExchange":
            unit.raw.updateDiscreteStates()
            unit.raw.enterContinuousTimeMode()
        else:
            unit.step(0.0, 1e-3)
        # brakes, locks and commands at the end of their range are moved into the range
        for name in inputs(unit):
            [value], variable = unit.reals([name]), unit.variables[name]
            if value in (_number(variable.min), _number(variable.max)):
                unit.set({name: 0.3})
        yield unit


def _number(bound):
    return None if bound is None else float(bound)


def inputs(unit):
    return [name for name, variable in unit.variables.items() if variable.causality == "input"]


def states(unit):
    return [unit.variables[unknown.variable.name].derivative.name for unknown in unit.description.derivatives]


def unknowns(unit):
    """Continuous outputs and derivatives of states."""
    outputs = [name for name, variable in unit.variables.items()
               if variable.causality == "output" and variable.type == "Float64" and not variable.dimensions
               and not name.startswith(("event.", "held.", "solver."))]
    return outputs + [unknown.variable.name for unknown in unit.description.derivatives]


def movers(unit, kind):
    """Yields for each known its name, a function that moves it by a distance, and its natural magnitude."""
    for name in inputs(unit):
        [value] = unit.reals([name])
        yield name, lambda distance, name=name, value=value: unit.set({name: value + distance}), 1 + abs(value)
    if kind == "ModelExchange":
        values = unit.reals(states(unit))
        for i, name in enumerate(states(unit)):
            def move(distance, i=i):
                moved = values.copy()
                moved[i] += distance
                numbers = (ctypes.c_double * len(moved))(*moved)
                unit.raw.fmi3SetContinuousStates(unit.raw.component, numbers, len(moved))

            yield name, move, 1 + abs(values[i]) if name.endswith("speed") else 1e-2


def differences(read, move, size):
    """Central difference of order 4 that changes least with its step, and the size of this change: the difference of the slopes on both
    sides, if it does not fall with the step, because the point is a kink."""
    here, found, bends = read(), [], []
    for step in size * FIRST * 10.0 ** (-0.5 * np.arange(STEPS)):
        points = []
        for place in (-2, -1, 1, 2):
            move(place * step)
            points.append(read())
        a, b, c, d = points
        found.append((a - 8 * b + 8 * c - d) / (12 * step))
        bends.append(np.abs(c - 2.0 * here + b) / step)
    move(0.0)
    changes = np.abs(np.diff(found, axis=0))
    best, column = changes.argmin(axis=0), np.arange(changes.shape[1])
    # over a hundredth of the step
    kink = np.where(bends[6] > 0.5 * bends[2], bends[6], 0.0)
    return np.array(found)[best + 1, column], np.maximum(changes[best, column], kink)


def have_kinks(unit):
    """True if wheels are so nearly equal that KINKED have no slope, or another one nearby."""
    torque, speed = unit.reals(["left.shaft_torque", "right.shaft_torque"]), unit.reals(["left.speed", "right.speed"])
    return np.ptp(torque) < 1e-2 * abs(torque.sum()) or np.abs(torque).min() < 1e-6 or np.ptp(speed) < 1e-2


def test_directional_derivatives_are_differences(unit, kind):
    names = [name for name in unknowns(unit) if name not in KINKED or not have_kinks(unit)]
    compared = 0
    for known, move, size in movers(unit, kind):
        slope = unit.sensitivity(names, [known], [1.0])
        difference, uncertain = differences(lambda: unit.reals(names), move, size)
        # a change below 1e-9 of the value, relative to the natural magnitude of the known, is rounding
        allowed = 1e-6 * np.abs(difference) + 1e-9 * (1 + np.abs(unit.reals(names))) / min(size, 1)
        for i in np.flatnonzero(np.abs(slope - difference) > allowed + 3 * uncertain):
            raise AssertionError((names[i], known, slope[i], difference[i], uncertain[i]))
        compared += np.count_nonzero((np.abs(difference) > allowed) & (uncertain < allowed))
    assert compared >= 5, compared


def test_the_adjoint_is_the_transpose(unit):
    names, knowns = unknowns(unit), inputs(unit) + states(unit)
    columns = np.array([unit.sensitivity(names, [known], [1.0]) for known in knowns])
    seed = np.random.default_rng(7).standard_normal(len(names))
    adjoint = unit.sensitivity(names, knowns, seed, adjoint=True)
    # the largest of many terms determines the rounding error of their sum
    size = np.abs(columns * seed).sum(axis=1).max(initial=1e-300)
    assert np.max(np.abs(columns @ seed - adjoint)) <= 1e-12 * size
    assert np.count_nonzero(adjoint) >= 5


def test_an_adjoint_that_is_not_a_finite_number_is_refused(unit):
    names, knowns = unknowns(unit), inputs(unit)
    slopes = unit.sensitivity(names, knowns, np.ones(len(names)), adjoint=True)
    assert np.abs(slopes).max() > 1e-3
    with pytest.raises(FMICallException):
        unit.sensitivity(names, knowns, np.full(len(names), 1.7e308), adjoint=True)
