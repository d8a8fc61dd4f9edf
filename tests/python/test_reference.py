"""The packaged FMU against solutions that the program did not make: plain.py, integrated by scipy (make_reference.py)."""

from math import atan2, cos, sin, tan

import make_reference
import numpy as np
import pytest
from make_reference import CASES
from plain import MATE, Gears
from scipy.optimize import brentq

# Asked of the default tolerance: speeds relative to the fastest, forces to the mean. A transient of damped teeth is over
# by SETTLED, thousands of their time constants.
SPEED_ERROR, FORCE_ERROR, SETTLED = 1e-6, 1e-3, 0.01


@pytest.fixture
def errors(open_fmu):
    """errors(case, tolerance): times, and by name of the output the error of the FMU at each of them."""

    def compared(name, tolerance=None):
        case = CASES[name]
        times, columns = make_reference.read(name)
        np.testing.assert_array_equal(times, case.times)
        values = np.array([columns[output] for output in case.outputs]).T
        with open_fmu() as opened:
            for variable, value in (case.fmu | {"scene.start": case.start}).items():
                opened.set(variable, value)
            if tolerance is not None:
                opened.set("solver.relative_tolerance", tolerance)
            opened.initialise()
            for variable, value in case.then.items():
                opened.set(variable, value)
            rows = [[opened.get(output) for output in case.outputs]]
            for begin, end in zip(times[:-1], times[1:]):
                opened.fmu.doStep(begin, end - begin)
                rows.append([opened.get(output) for output in case.outputs])
        scales = make_reference.scales(case, values)
        return times, dict(zip(case.outputs, (np.abs(np.array(rows) - values) / scales).T))

    return compared


def largest(errors, kind, late=slice(None)):
    """Of all outputs of a kind, and where."""
    return max((np.max(error[late]), name) for name, error in errors.items() if name.endswith(kind))


@pytest.mark.parametrize("case", ["straight_equilibrium", "turn_equilibrium"])
def test_the_study_follows_the_reference_from_the_first_instant(errors, case):
    _, found = errors(case)
    assert largest(found, "speed") <= (SPEED_ERROR, "")
    assert largest(found, ("force", "torque", "error")) <= (FORCE_ERROR, "")


@pytest.mark.parametrize("case", ["straight_rolling", "turn_rolling"])
def test_the_study_follows_the_reference_once_the_blows_of_a_rolling_start_are_over(errors, case):
    times, found = errors(case)
    late = times > SETTLED
    assert largest(found, "speed", late) <= (SPEED_ERROR, "")
    assert largest(found, ("force", "torque", "error"), late) <= (FORCE_ERROR, "")
