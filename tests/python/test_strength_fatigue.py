"""Fatigue of teeth in mesh that do not roll, against another rainflow count: the package rainflow (ASTM E1049). The S–N curve and
the mean stress rule of docs/inside/theory.md, section 10, are written here a second time."""

from math import log, pi, sin

import numpy as np
import pytest
import rainflow

PULSES = 6
STRENGTH, CYCLES, LIFE_FACTOR, STATIC = 1000e6, 3e6, 2.5, 1e3
SLOPE = log(CYCLES / STATIC) / log(LIFE_FACTOR)
# Y_M = 0.7 at the stress ratio −1
SENSITIVITY = 2.0 * 0.7 - 1.0


def pulsating(span, mean):
    """Range of the cycle from 0 that does the same damage as one of the range `span` about `mean` (FKM guideline)."""
    m, ratio = SENSITIVITY, mean / (0.5 * span)
    if ratio <= 1.0:
        permissible = 1.0 / (1.0 + m * max(ratio, -1.0))
    elif ratio < 3.0:
        permissible = (1.0 + m / 3.0) / ((1.0 + m) * (1.0 + m * ratio / 3.0))
    else:
        permissible = (1.0 + m / 3.0) / (1.0 + m) ** 2
    return span / ((1.0 + m) * permissible)


def miner(stress):
    """Damage of a history of stress, tension positive; the residue counts in half cycles."""
    cycles = [(span, mean, count) for span, mean, count, *_ in rainflow.extract_cycles(stress) if span > 0.01 * STRENGTH]
    return sum(count * (pulsating(span, mean) / STRENGTH) ** SLOPE / CYCLES for span, mean, count in cycles)


def smooth(phase):
    """A pulse too slow for impacts, whose peaks could be missed between two readings."""
    return sin(pi * phase) ** 2


def pulses(drive, low, high, values=None):
    """Damage of the planets and of the side gears by the FMU, and by this count, after pulses of both loads."""
    length, step = 0.02, 1e-4
    scene = drive({"effects.strength": True, "left.load_torque": low, "right.load_torque": low, **(values or {})})
    names = ["planet[1].left_transmission_error", "stress.root_planet_max", "stress.root_side_max"]
    history = []
    for i in range(round(PULSES * length / step)):
        scene.load(low + (high - low) * smooth(i * step / length))
        scene.step(step)
        approach, *stresses = scene.read(names)
        history.append(np.copysign(stresses, approach))
    ours = [scene["damage.planet"], scene["damage.side"]]
    # tension at the root of the drive flank is compression at that of the coast flank
    return ours, [max(miner(stress), miner(-stress)) for stress in np.transpose(history)]


def test_damage_of_teeth_at_rest_agrees_with_another_rainflow_count_on_either_flank(drive):
    # the largest stress of all pairs is always that of one tooth if one spring represents them, and nearly so under the law impact
    values, held = {"contact.law": "impact"}, {"scene.planet_spin": "imposed", "scene.gear_contact": "lumped"}
    planet = {}
    for low, high, scene in [(50.0, 900.0, values), (-50.0, -900.0, values), (-400.0, 900.0, held), (400.0, -900.0, held)]:
        ours, theirs = pulses(drive, low, high, scene)
        assert ours == pytest.approx(theirs, rel=0.03), (low, high)
        assert min(ours) > 1e-8
        planet[low, high] = ours[0]
    assert planet[-50.0, -900.0] == pytest.approx(planet[50.0, 900.0], rel=0.03)
    assert planet[400.0, -900.0] == pytest.approx(planet[-400.0, 900.0], rel=0.03)


def test_teeth_at_rest_with_uneven_load_are_damaged_by_the_largest_stress_over_the_face(drive):
    line = {"contact.law": "line", "effects.tooth_errors": True}
    # crowned teeth under a small load are in balance away from the middle, and free planets would roll to and fro
    line["scene.planet_spin"] = "imposed"
    even, _ = pulses(drive, 50.0, 900.0, line)
    for errors in [{"tooth_errors.crowning": 60e-6}, {"tooth_errors.side_axial_offset": 1e-4}]:
        for sign in (1.0, -1.0):
            ours, theirs = pulses(drive, 50.0 * sign, 900.0 * sign, line | errors)
            assert ours == pytest.approx(theirs, rel=0.03)
            assert min(np.divide(ours, even)) > 1.2, errors
