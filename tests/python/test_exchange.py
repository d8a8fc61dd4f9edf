"""Model exchange: fmpy's CVode integrates the state and agrees with the FMU's solver."""

import ctypes

import numpy as np
import pytest
import theory
from driving import TURN
from fmpy.fmi2 import fmi2EventInfo

WHEELS = {"inertia.left_end": 0.5, "inertia.right_end": 0.5}
SCENES = {
    "straight": {},
    "turn": TURN,
    "lumped": {**WHEELS, "scene.gear_contact": "lumped", "left.load_torque": 800.0},
    "ideal": {**WHEELS, "scene.gear_contact": "ideal", "scene.carrier_drive": "torque", "left.load_torque": 800.0},
    "half-shafts": {**WHEELS, "effects.half_shaft": True, "scene.carrier_drive": "torque", "left.load_torque": 820.0},
    "four planets": {**WHEELS, "scene.carrier_drive": "torque", "geometry.planet_count": 4},
    "pins and drag": {**WHEELS, **theory.DRAG, "effects.half_shaft": True, "effects.pin_compliance": True},
    "solid": {"scene.gear_contact": "solid"},
    "limited slip": {**WHEELS, "scene.gear_contact": "ideal", **theory.CLUTCHES, "limited_slip.torque_coefficient": 0.0,
                     "left.load_torque": 400.0},
}
OUTPUTS = ["left.speed", "right.speed", "carrier.angle", "carrier.torque", "left.shaft_torque", "left.normal_force",
           "planet[1].spin_angle", "planet[2].left_transmission_error"]


@pytest.fixture
def simulate(through_fmpy):
    return lambda kind, values, stop, tolerance, **options: through_fmpy(
        values, stop, fmi_type=kind, relative_tolerance=tolerance, output=OUTPUTS, **options)


@pytest.mark.parametrize("scene", SCENES)
def test_cvode_agrees_with_the_fmu_s_solver(simulate, scene):
    values, stop = SCENES[scene], 0.02
    own = simulate("CoSimulation", {**values, "solver.relative_tolerance": 1e-9}, stop, None)
    theirs = simulate("ModelExchange", values, stop, 1e-8, solver="CVode")
    # CVode's records may have additional rows, at events
    at = np.interp(own["time"], theirs["time"], np.arange(len(theirs)))
    rows = theirs[np.round(at).astype(int)]
    np.testing.assert_allclose(rows["time"], own["time"], atol=1e-12)
    for name in OUTPUTS:
        size = np.max(np.abs(own[name])) + 1e-12
        assert np.max(np.abs(rows[name] - own[name])) < 1e-4 * size, name


def test_cvode_converges_to_the_fmu_s_solver(simulate):
    values = SCENES["lumped"]
    own = simulate("CoSimulation", {**values, "solver.relative_tolerance": 1e-11}, 0.01, None)
    errors = []
    for tolerance in [1e-4, 1e-6, 1e-8]:
        theirs = simulate("ModelExchange", values, 0.01, tolerance, solver="CVode")
        errors.append(np.max(np.abs(theirs["left.normal_force"][-1] - own["left.normal_force"][-1])))
    assert errors[2] < 1e-2 * errors[0] and errors[2] < 0.1, errors


def test_states_and_derivatives_are_in_the_model_structure(description):
    derivatives = [unknown.variable for unknown in description.derivatives]
    assert len(derivatives) == 34
    names = [variable.derivative.name for variable in derivatives]
    assert names[0] == "left.relative_angle" and names[17] == "left.speed" and len(set(names)) == 34
    assert all(variable.derivative.nominal for variable in derivatives)
    assert description.numberOfEventIndicators == 29


def test_states_are_read_in_the_order_of_the_model_structure(fmu, description):
    with fmu.open("ModelExchange") as opened:
        opened.initialise()
        raw, info = opened.raw, fmi2EventInfo()
        raw.fmi2NewDiscreteStates(raw.component, info)
        raw.enterContinuousTimeMode()
        count = len(description.derivatives)
        states, rates = (ctypes.c_double * count)(), (ctypes.c_double * count)()
        raw.getContinuousStates(states, count)
        raw.getDerivatives(rates, count)
        by_name = {"state": [v.variable.derivative.name for v in description.derivatives],
                   "rate": [v.variable.name for v in description.derivatives]}
        for kind, values in [("state", states), ("rate", rates)]:
            assert list(values) == opened.read(by_name[kind])
        raw.terminate()
