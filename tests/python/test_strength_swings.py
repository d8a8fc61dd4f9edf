"""Damage of load swings while the gears roll slowly, against a count that follows each tooth through each of its passages.

A tooth carries the load of its mesh over one pitch. It enters and leaves without load, so that all cycles of its passage close. All
except the largest add to its damage. The passage itself counts as the mean damage of a cycle. For a planet's tooth, both roots are
followed through both meshes, which load opposite flanks; a side gear's tooth meets each planet. The S–N curve and the mean stress
rule of docs/inside/theory.md, section 10, are those of `test_strength_fatigue`."""

from math import ceil, pi

import numpy as np
import pytest
import rainflow
from bevel_differential import Differential
from test_strength_fatigue import CYCLES, SLOPE, STRENGTH, pulsating

PLANET_TEETH, SIDE_TEETH, PLANETS, IDLER = 10, 16, 2, 0.7
PITCH = 2.0 * pi / PLANET_TEETH
SCENE = {"scene.gear_contact": "lumped", "effects.strength": True, "scene.planet_spin": "imposed", "carrier.speed_command": 50.0,
         "inertia.side_gear": 1e-5, "inertia.planet": 1e-6, "inertia.from_geometry": False}
OUTPUTS = ["damage.planet", "damage.side", "stress.root_planet_max", "stress.root_side_max"]
# mean and amplitude of both loads [N·m], frequency [Hz], spin of the planets [rad/s]
CASES = [
    (835.0, 835.0, 10.0, 0.15),
    (0.0, 835.0, 15.0, 0.5),
    (0.0, 1100.0, 33.0, 2.6),
    (-700.0, 500.0, 7.0, 0.31),
    (1200.0, 300.0, 21.0, 1.7),
    (450.0, 900.0, 38.0, 4.4),
    (-300.0, 950.0, 27.0, -0.8),
    (600.0, 600.0, 3.0, 0.2),
    (950.0, 700.0, 13.0, 6.5),
    (835.0, 400.0, 4.0, 17.0),
    (-850.0, 850.0, 40.0, 19.0),
    (200.0, 1000.0, 29.0, -11.0),
]


def duration(frequency, spin):
    """Time for 60 swings and 8 rad, at most 150 swings."""
    return min(max(60.0 / frequency, 8.0 / abs(spin)), 150.0 / frequency)


def load(mean, amplitude, frequency, time):
    return mean + amplitude * np.sin(2.0 * pi * frequency * time)


def simulated(fmu, mean, amplitude, frequency, spin, stop, points=60, values=None):
    """Damage of planet and side gear by the FMU, and both stresses at 1 N·m."""
    step = 1.0 / (points * frequency)
    time = np.arange(ceil(stop / step) + 1) * step
    torque = load(mean, amplitude, frequency, time)
    sides = dict.fromkeys(["left.load_torque", "right.load_torque"], (time, torque))
    scene = {**SCENE, "spin.command": spin, "left.load_torque": torque[0], "right.load_torque": torque[0]}
    with Differential({**scene, **(values or {})}, fmu=fmu) as differential:
        record = differential.run(sides, OUTPUTS, stop, step)
    largest = np.max(abs(load(mean, amplitude, frequency, np.linspace(0.0, stop, 1 << 16))))
    return [record[name][-1] for name in OUTPUTS[:2]], [np.max(record[name]) / largest for name in OUTPUTS[2:]]


def swings(stress):
    """Damage of the swings in a passage: at the root of the flank that a positive stress bends, and at the other root."""
    history = np.concatenate([[0.0], stress, [0.0]])
    # a closed history starts at its peak
    history = np.roll(history, -np.argmax(abs(history)))
    cycles = sorted((span, mean, count) for span, mean, count, *_ in rainflow.extract_cycles(np.append(history, history[0])))
    # both halves of the largest cycle
    while cycles and cycles[-1][2] == 0.5:
        cycles.pop()
    cycles = [cycle for cycle in cycles if cycle[0] > 0.01 * STRENGTH]
    return np.array([sum(count * (pulsating(span, sign * mean) / STRENGTH) ** SLOPE / CYCLES for span, mean, count in cycles)
                     for sign in (1.0, -1.0)])


def counted(mean, amplitude, frequency, spin, stop, per_torque):
    """Damage of the worst teeth of planet and side gear by this count."""
    time = np.linspace(0.0, stop, ceil(200.0 * frequency * stop))
    torque, angle = load(mean, amplitude, frequency, time), spin * time / PITCH
    passed = np.floor(angle + 0.5).astype(int)
    revolutions = max(abs(angle[-1]) - 0.5, 0.0) / PLANET_TEETH
    planet, side = np.zeros((PLANET_TEETH, 2)), np.zeros((SIDE_TEETH, 2))
    for number in np.unique(passed):
        within = torque[passed == number]
        of_planet, of_side = swings(within * per_torque[0]), swings(within * per_torque[1])
        planet[number % PLANET_TEETH] += of_planet
        planet[(number + PLANET_TEETH // 2) % PLANET_TEETH] += of_planet[::-1]
        for other in range(PLANETS):
            side[(number + other * SIDE_TEETH // PLANETS) % SIDE_TEETH] += of_side
    passes = [[np.mean((np.maximum(sign * torque, 0.0) * stress / strength) ** SLOPE) / CYCLES for sign in (1.0, -1.0)]
              for stress, strength in zip(per_torque, (IDLER * STRENGTH, STRENGTH))]
    of_side = np.array(passes[1]) * PLANETS * revolutions * PLANET_TEETH / SIDE_TEETH
    return [np.max(planet) + sum(passes[0]) * revolutions, np.max(side + of_side)]


@pytest.mark.parametrize("case", CASES, ids=lambda case: "{:g}±{:g} N·m, {:g} Hz, {:g} rad/s".format(*case))
def test_damage_is_that_of_a_count_tooth_by_tooth(fmu_file, case):
    stop = duration(*case[2:])
    ours, per_torque = simulated(fmu_file, *case, stop)
    assert ours == pytest.approx(counted(*case, stop, per_torque), rel=0.1)


def swung(unit, pieces, steps):
    """Advances by 10 ms for each load in `pieces`, divided into `steps` steps; returns the damage."""
    for torque in pieces:
        unit.set(dict.fromkeys(["left.load_torque", "right.load_torque"], torque))
        for _ in range(steps):
            unit.step(0.01 / steps)
    return unit.read(OUTPUTS[:2])


def pieces(count):
    """Loads that change sign and size from piece to piece, N·m."""
    return [900.0 * np.sin(2.1 * k) + 300.0 * np.sin(0.7 * k) for k in range(count)]


@pytest.mark.parametrize("spin", [0.4, -3.0])
def test_damage_does_not_depend_on_communication_steps(fmu, spin):
    damages = []
    for steps in [1, 3, 10]:
        with fmu.open() as unit:
            unit.initialise({**SCENE, "spin.command": spin})
            damages.append(swung(unit, pieces(400), steps))
    # stresses follow the solver's tolerance of 1e-6, and damage follows their ninth power
    assert min(damages[0]) > 0.0
    assert damages[1:] == [pytest.approx(damages[0], rel=1e-4)] * 2


def test_a_restored_state_counts_the_same_swings_here_and_in_another_instance(fmu):
    with fmu.open() as unit, fmu.open() as other:
        for each in (unit, other):
            each.initialise({**SCENE, "spin.command": 1.3})
        swung(unit, pieces(150), 1)
        saved = unit.save()
        expected = swung(unit, pieces(250)[150:], 1)
        for each in (unit, other):
            each.restore(saved)
            assert swung(each, pieces(250)[150:], 1) == expected
