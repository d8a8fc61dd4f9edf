"""A tooth breaks at any time that a host may use: zero, negative, or seconds since 1970, with the bits of a run shifted in time."""

from ctypes import POINTER, c_double
from fractions import Fraction

import numpy as np
import pytest
from bevel_differential import Differential, Scene
from bevel_differential.values import UNFELT
from driving import STEADY_TURN
from fmi3 import Unit3

TOLERANCE = 1e-9
FAULT = STEADY_TURN | {"scene.planet_spin": 2, "effects.tooth_fault": True, "solver.relative_tolerance": TOLERANCE}
OUTPUTS = ["planet[1].left_normal_force", "planet[1].left_transmission_error", "heat.contact", "left.speed", "carrier.angle"]
EPOCH = 1.7e9
# start and onset of a run [s]. In [2^30, 2^31) s a time is a multiple of 2^-22 s, so differences of these times are exact
CASES = {"zero": (-0.01, 0.0), "negative": (-7.25, -7.25 + 0.01), "epoch": (EPOCH + 0.09, EPOCH + 0.1), "far below zero": (-1e5, -1e5 + 0.01)}
# steps of 2^-10 s are also exact, and no communication point is the onset
SIZE, COUNT = 2.0**-10, 30
# explicit steps that resolve the motion of teeth, and their number. The FMU treats times that differ by 8 roundings as equal. This is
# 3.0e-6 s in an epoch (8 * 2^-52 * 1.7e9); the last step before the onset ends 3.6e-6 s before it
SHORT, SHORT_STEPS, BEFORE = 2.0**-18, 100, (60.0 + 15.0 / 16.0) * 2.0**-18
# allowed error of a result, relative to its largest value: each step may err by the tolerance
ERROR = COUNT * TOLERANCE


def at(onset):
    return FAULT | {"tooth_fault.at_onset": True, "tooth_fault.onset": onset}


def begin(instance, values, start):
    """Initialises at a time other than 0 s."""
    instance.set(values)
    instance.raw.setupExperiment(startTime=start)
    instance.raw.enterInitializationMode()
    instance.raw.exitInitializationMode()


def two(fmu, values, start):
    """Outputs at all communication points of co-simulation, FMI 2.0."""
    with fmu.open() as instance:
        begin(instance, values, start)
        rows = [instance.read(OUTPUTS)]
        for k in range(COUNT):
            instance.raw.doStep(start + k * SIZE, SIZE)
            rows.append(instance.read(OUTPUTS))
    return np.array(rows, float)


def three(fmu3, values, start):
    """Record and events of FMI 3.0: in event mode, a step ends when the tooth breaks."""
    rows, events = [], []
    with Unit3(fmu3, eventModeUsed=True, earlyReturnAllowed=True) as unit:
        unit.begin(values, start=start)
        time = start
        for k in range(COUNT):
            while time < start + (k + 1) * SIZE:
                needed, _, _, time = unit.step(time, start + (k + 1) * SIZE - time)
                if needed:
                    events += unit.handle_event()
            rows.append(unit.reals(OUTPUTS))
    return np.array(rows), events


def exchanged(fmu, values, start, onset):
    """Announced time, derivatives of all states in model exchange by Euler steps until after the onset, and events."""
    with fmu.open("ModelExchange") as instance:
        begin(instance, values, start)
        raw, rows = instance.raw, []
        announced = raw.newDiscreteStates()[4:]
        raw.enterContinuousTimeMode()
        count = fmu.description.numberOfContinuousStates
        states, rates = (np.zeros(count) for _ in range(2))
        pointers = [each.ctypes.data_as(POINTER(c_double)) for each in (states, rates)]
        raw.getContinuousStates(pointers[0], count)
        points = sorted({*(start + k * SHORT for k in range(SHORT_STEPS)), onset})
        broken = []
        for time, end in zip(points, points[1:]):
            raw.getDerivatives(pointers[1], count)
            rows.append(rates.copy())
            states += (end - time) * rates
            raw.setTime(end)
            raw.setContinuousStates(pointers[0], count)
            event, _ = raw.completedIntegratorStep()
            if event or end == onset:
                before = instance.get("der(left.speed)")
                raw.enterEventMode()
                defined = raw.newDiscreteStates()[4]
                raw.enterContinuousTimeMode()
                raw.getContinuousStates(pointers[0], count)
                broken.append((end, defined, instance.get("der(left.speed)") != before))
        return announced, np.array(rows), broken


@pytest.mark.parametrize("start, onset", CASES.values(), ids=CASES)
def test_a_tooth_breaks_at_any_time_with_the_bits_of_a_run_that_begins_at_zero(fmu, start, onset):
    shifted = onset - start
    assert Fraction(shifted) == Fraction(onset) - Fraction(start), "no rounding in the shift"
    found, wanted, sound = two(fmu, at(onset), start), two(fmu, at(shifted), 0.0), two(fmu, FAULT, 0.0)
    np.testing.assert_array_equal(found, wanted)
    # until then the teeth are sound; from then on force, approach and heat differ
    ends, off = np.arange(COUNT + 1) * SIZE, np.abs(wanted - sound) / np.max(np.abs(sound), axis=0)
    assert np.all(off[ends < shifted] <= ERROR)
    assert np.all(off[ends > shifted, :3] > 1e3 * ERROR)


def test_an_epoch_time_is_rounded_by_half_a_unit_in_its_last_place():
    """Bound of the change by rounding: an onset of 0.1 s in an epoch is off by 2^-23 s, and so is the start of the run."""
    start, onset = CASES["epoch"]
    for time, meant in ((start, Fraction(9, 100)), (onset, Fraction(1, 10))):
        assert abs(Fraction(time) - (17 * 10**8 + meant)) <= Fraction(1, 2**23)


def test_the_rounding_of_an_epoch_moves_results_by_no_more_than_their_rates_times_the_rounding(fmu):
    """Together, both roundings shift the onset in the run by at most 2^-22 s, so the results of such onsets bound the change."""
    (start, onset), off = CASES["epoch"], 2.0**-22
    early, wanted, late = (two(fmu, at(0.01 + by), 0.0) for by in (-off, 0.0, off))
    bound = np.maximum(np.abs(early - wanted), np.abs(late - wanted)) + ERROR * np.max(np.abs(wanted), axis=0)
    assert np.all(np.abs(two(fmu, at(onset), start) - wanted) <= bound)


@pytest.mark.parametrize("start, onset", CASES.values(), ids=CASES)
def test_fmi_3_reports_the_event_at_its_time(fmu3, start, onset):
    found, events = three(fmu3, at(onset), start)
    wanted, others = three(fmu3, at(onset - start), 0.0)
    np.testing.assert_array_equal(found, wanted)
    assert [event[2] for event in events] == [onset] and [event[2] for event in others] == [onset - start]


@pytest.mark.parametrize("onset", [onset for _, onset in CASES.values()], ids=CASES)
def test_model_exchange_announces_the_time(fmu, onset):
    start = onset - BEFORE
    announced, found, broken = exchanged(fmu, at(onset), start, onset)
    shifted, wanted, others = exchanged(fmu, at(onset - start), 0.0, onset - start)
    assert announced == (True, onset) and shifted == (True, onset - start)
    np.testing.assert_array_equal(found, wanted)
    assert broken == [(onset, False, True)] and others == [(onset - start, False, True)]


@pytest.mark.parametrize("late", [0.0, 2.0**-20, 5.0, 1e6])
@pytest.mark.parametrize("onset", [0.0, -3.0, EPOCH])
def test_a_run_that_starts_later_starts_with_the_broken_tooth(fmu, fmu3, onset, late):
    """A late start has the results of a trigger that broke the tooth before the start."""
    wanted = two(fmu, FAULT | {"fault.trigger": 1.0}, 0.0)
    assert not np.array_equal(wanted[0], two(fmu, FAULT, 0.0)[0])
    np.testing.assert_array_equal(two(fmu, at(onset), onset + late), wanted)
    found, events = three(fmu3, at(onset), onset + late)
    assert not events
    np.testing.assert_array_equal(found, wanted[1:])


@pytest.mark.parametrize("onset", [1.7976931348623157e308, -1.7976931348623157e308, 0.0])
def test_without_at_onset_no_time_breaks_the_tooth_and_the_value_is_reported(fmu_file, fmu, onset):
    np.testing.assert_array_equal(two(fmu, FAULT | {"tooth_fault.onset": onset}, -1.0), two(fmu, FAULT, 0.0))
    with Differential(FAULT | {"tooth_fault.onset": onset or 0.01}, fmu=fmu_file) as differential:
        differential.run(stop=0.001)
        assert differential.unfelt.keys() == {"tooth_fault.onset"}
        assert "tooth_fault.at_onset = true" in differential.unfelt["tooth_fault.onset"]
    with Scene("late", set=at(0.01), outputs=["left.speed"], fmu=fmu_file, stop=0.02) as scene:
        assert UNFELT not in " ".join(scene.unfelt_of().values()) and not scene.unfelt_of()


@pytest.mark.parametrize("onset", [1.7976931348623157e308, 1e12])
def test_a_time_that_never_comes_changes_no_bit(fmu, onset):
    np.testing.assert_array_equal(two(fmu, at(onset), 0.0), two(fmu, FAULT, 0.0))
