"""The packaged FMU against independent solutions: plain.py, integrated by scipy."""

from math import atan2, cos, sin

import make_reference
import numpy as np
import pytest
from make_reference import CASES
from plain import MATE, Gears
from scipy.optimize import brentq

# Requirements at the default tolerance: speeds relative to the fastest, forces relative to the mean. A transient of damped
# teeth has ended after SETTLED, thousands of their time constants.
SPEED_ERROR, FORCE_ERROR, SETTLED = 1e-6, 1e-3, 0.01
# Interval of the files that the tests integrate again [s]; it contains the impacts of a rolling start and of the clunk.
STRETCH = 3e-3


@pytest.fixture
def errors(fmu):
    """errors(case, tolerance, at): times, and the errors of the FMU at these times by the name of the output. Communication
    points are the rows `at` of the file, by default all."""

    def compared(name, tolerance=None, at=slice(None)):
        case = CASES[name]
        times, columns = make_reference.read(name)
        np.testing.assert_array_equal(times, case.times)
        values = np.array([columns[output] for output in case.outputs]).T
        scales = make_reference.scales(case, values)
        times, values = times[at], values[at]
        with fmu.open() as opened:
            finer = {} if tolerance is None else {"solver.relative_tolerance": tolerance}
            opened.initialise(case.fmu | {"scene.start": case.start} | finer)
            opened.set(case.then)
            rows = [opened.read(case.outputs)]
            for begin, end in zip(times[:-1], times[1:]):
                opened.do_step(begin, end - begin)
                rows.append(opened.read(case.outputs))
        return times, dict(zip(case.outputs, (np.abs(np.array(rows) - values) / scales).T))

    return compared


def largest(errors, kind, late=slice(None)):
    """Largest error of all outputs of a kind, and its output."""
    return max((np.max(error[late]), name) for name, error in errors.items() if name.endswith(kind))


def assert_follows(errors, late=slice(None), factor=1.0):
    """Asserts the errors of all outputs; `factor`: on the allowed error of speeds."""
    assert largest(errors, "speed", late) <= (factor * SPEED_ERROR, "")
    assert largest(errors, ("force", "torque", "error"), late) <= (FORCE_ERROR, "")


@pytest.mark.parametrize("case", ["straight_equilibrium", "turn_equilibrium"])
def test_the_study_follows_the_reference_from_the_first_instant(errors, case):
    assert_follows(errors(case)[1])


@pytest.mark.parametrize("every", [2, 5, 10, 20])
def test_the_turn_follows_the_reference_whatever_the_communication_step(errors, every):
    # with any first row, so that pairs enter and leave contact at different places of the integrator's steps
    rows = len(CASES["turn_equilibrium"].times)
    for first in range(1, every + 1):
        assert_follows(errors("turn_equilibrium", at=[0, *range(first, rows, every)])[1])


@pytest.mark.parametrize("case", ["straight_rolling", "turn_rolling"])
def test_the_study_follows_the_reference_through_and_after_the_blows_of_a_rolling_start(errors, case):
    times, found = errors(case)
    assert_follows(found, times > SETTLED)
    # speeds pass through several times the settled ones within microseconds
    assert_follows(found, factor=10.0)


def test_the_clunk_follows_the_reference(errors):
    # gears without mass chatter between undamped teeth and shafts; the outputs here are those that a vehicle transmits
    _, found = errors("clunk")
    assert found["carrier.speed"].max() <= SPEED_ERROR
    assert largest(found, "shaft_torque") <= (FORCE_ERROR, "")


@pytest.mark.parametrize("case", ["straight_rolling", "turn_equilibrium", "turn_rolling"])
def test_the_fmu_draws_near_the_reference_as_its_tolerance_is_tightened(errors, case):
    # two solutions with different methods, laws and authors: at 1e-10 the difference is a few local errors
    worst = [max(np.max(error) for error in errors(case, tolerance)[1].values()) for tolerance in [1e-6, 1e-8, 1e-10]]
    assert worst[2] < 1e-9 and worst[2] < 0.1 * worst[1] and worst[1] < worst[0], worst


@pytest.mark.parametrize("case", [*CASES])
def test_files_agree_with_the_plain_model(case):
    """The first interval, integrated again by another method."""
    case, columns = CASES[case], make_reference.read(case)[1]
    count = max(11, np.count_nonzero(case.times <= STRETCH))
    rows = make_reference.table(case, make_reference.solve(case, case.times[:count], "Radau", 1e-9))
    values = np.array([columns[output] for output in case.outputs]).T
    error = np.abs(rows - values[:count]) / make_reference.scales(case, values)
    assert np.max(error) < 1e-7


@pytest.mark.parametrize("gear", ["planet", "side"])
def test_the_gap_of_a_tip_corner_is_that_of_two_flanks_in_space(gear):
    gears, mate = Gears(), MATE[gear]

    def flank(of, unwound):
        """Polar angle and azimuth of the end of an arc unwound from the base circle, which begins at azimuth 0."""
        lever, length = gears.lever[of], unwound * gears.lever[of]
        height = cos(gears.base[of])
        foot, tangent = (lever * cos(unwound), lever * sin(unwound)), (-sin(unwound), cos(unwound))
        x, y = (cos(length) * f - sin(length) * t for f, t in zip(foot, tangent))
        return np.arccos(height * cos(length)), atan2(y, x)

    def azimuth(of, polar):
        unwound = brentq(lambda unwound: flank(of, unwound)[0] - polar, 1e-9, 2.0, xtol=1e-16, rtol=1e-15)
        return flank(of, unwound)[1]

    def corner(past):
        """Angle about the gear's axis z, then polar angle and azimuth about the mate's axis x; teeth meet between both."""
        turned = (gears.end[gear] + past) / gears.lever[gear]
        around = turned - azimuth(gear, gears.tip[gear]) + azimuth(gear, gears.pitch[gear])
        tip = gears.tip[gear]
        x, y, z = sin(tip) * cos(around), sin(tip) * sin(around), cos(tip)
        return np.arccos(x), atan2(y, z)

    for past, golden in [(0.01, {"planet": 1.993971e-4, "side": 3.893746e-4}),
                         (0.02, {"planet": 7.971583e-4, "side": 1.324971e-3}),
                         (0.03, {"planet": 1.794029e-3, "side": 2.728913e-3})]:
        polar, across = corner(past)
        mate_turned = across - azimuth(mate, polar) + azimuth(mate, gears.pitch[mate])
        left = gears.end[gear] + past - gears.lever[mate] * mate_turned
        clear, slope = gears.gap(gear, past)
        assert clear == pytest.approx(left, abs=1e-13) and clear == pytest.approx(golden[gear], rel=1e-6)
        step = 1e-5
        difference = (gears.gap(gear, past + step)[0] - gears.gap(gear, past - step)[0]) / (2.0 * step)
        assert slope == pytest.approx(difference, abs=1e-8)
