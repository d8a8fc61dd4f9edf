"""Damage of load swings while the gears roll slowly, against a count that follows each tooth through all of its passages.

A tooth carries the load of its mesh over one pitch, and none outside. For a planet's tooth, the passages through both meshes follow each
other on opposite flanks; a side gear's tooth meets each planet. The S–N curve and the mean stress rule of docs/inside/theory.md, section
10, are those of `test_strength_fatigue`."""

from math import ceil, pi

import numpy as np
import pytest
from test_strength_fatigue import miner

PLANET_TEETH, SIDE_TEETH, PLANETS = 10, 16, 2
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


def simulated(run, mean, amplitude, frequency, spin, stop, points=60):
    """Damage of planet and side gear by the FMU, and both stresses at 1 N·m."""
    step = 1.0 / (points * frequency)
    time = np.arange(ceil(stop / step) + 1) * step
    torque = load(mean, amplitude, frequency, time)
    sides = dict.fromkeys(["left.load_torque", "right.load_torque"], (time, torque))
    scene = {**SCENE, "spin.command": spin, "left.load_torque": torque[0], "right.load_torque": torque[0]}
    record = run(scene, stop, step, OUTPUTS, sides)
    largest = np.max(abs(load(mean, amplitude, frequency, np.linspace(0.0, stop, 1 << 16))))
    return [record[name][-1] for name in OUTPUTS[:2]], [np.max(record[name]) / largest for name in OUTPUTS[2:]]


def worst(histories):
    """Damage of the worst fillet of teeth with these histories of stress."""
    return max(max(miner(history), miner(-history)) for history in histories)


def counted(mean, amplitude, frequency, spin, stop, per_torque):
    """Damage of the worst teeth of planet and side gear by this count."""
    time = np.linspace(0.0, stop, ceil(200.0 * frequency * stop))
    torque, passed = load(mean, amplitude, frequency, time), np.floor(spin * time / PITCH + 0.5).astype(int)
    # teeth in mesh at the start are loaded from there on, the others begin without load
    planet, side = [[[] for _ in range(teeth)] for teeth in (PLANET_TEETH, SIDE_TEETH)]
    for number in sorted(np.unique(passed), key=abs):
        within = torque[passed == number]
        for tooth, sign in ((number, 1.0), (number + PLANET_TEETH // 2, -1.0)):
            planet[tooth % PLANET_TEETH] += [*([0.0] if number else []), *(sign * within), 0.0]
        for other in range(PLANETS):
            side[(number + other * SIDE_TEETH // PLANETS) % SIDE_TEETH] += [*([0.0] if number else []), *within, 0.0]
    # the teeth in mesh at the end are still loaded
    for tooth in {passed[-1] % PLANET_TEETH, (passed[-1] + PLANET_TEETH // 2) % PLANET_TEETH}:
        planet[tooth].pop()
    for other in range(PLANETS):
        side[(passed[-1] + other * SIDE_TEETH // PLANETS) % SIDE_TEETH].pop()
    return [worst([stress * np.array(history or [0.0]) for history in gear]) for gear, stress in zip((planet, side), per_torque)]


@pytest.mark.parametrize("case", CASES, ids=lambda case: "{:g}±{:g} N·m, {:g} Hz, {:g} rad/s".format(*case))
def test_damage_is_that_of_a_count_tooth_by_tooth(run, case):
    stop = duration(*case[2:])
    ours, per_torque = simulated(run, *case, stop)
    assert ours == pytest.approx(counted(*case, stop, per_torque), rel=0.05)


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
def test_damage_does_not_depend_on_communication_steps(started, spin):
    damages = []
    for steps in [1, 3, 10]:
        unit = started({**SCENE, "spin.command": spin})
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
