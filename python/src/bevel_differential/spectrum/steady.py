"""Damage of an event with constant loads and speeds: a short simulation of its steady state.

Each tooth is loaded once or more per revolution. Damage is therefore measured over whole revolutions of each gear."""

from math import ceil, lcm, pi

import numpy as np

from ..differential import Differential
from .damage import OUTPUTS, Event, EventDamage, damage_of, root_stress
from .passes import LEAST_ROLL, Roll
from .slow import Strength

# duration of settling, which does not count, and of the first run including it [s]
SETTLING, LOOK = 0.1, 0.5
POINTS = 50
# relative difference of two successive revolutions that counts as steady
STEADY = 0.01
# otherwise: maximum number of mesh cycles until all teeth have met, or revolutions of each gear instead
MOST_CYCLES, MOST_REVOLUTIONS = 320, 4
# points per mesh cycle: the median of revolutions that begin at these points does not depend on where a pass counts
POINTS_PER_CYCLE = 8


def steady(differential: Differential, event: Event, teeth: tuple[int, int], planets: int, strength: Strength) -> EventDamage:
    """Damage of one occurrence of `event` to gears with `teeth` of planet and side gear."""
    look = differential._record(None, OUTPUTS, LOOK, LOOK / POINTS, event.values)
    settled = look[round(POINTS * SETTLING / LOOK):]
    frequency = _frequency(settled, teeth)
    pitches, warnings = frequency * event.duration, tuple(differential.warnings)
    forces = _forces(settled)
    if LEAST_ROLL < abs(pitches) <= 1.0:
        # the load of a tooth changes while it rolls through the mesh
        cycle = 1.0 / abs(frequency)
        record = differential._record(None, OUTPUTS, SETTLING + cycle, cycle / POINTS, event.values)
        settled, warnings = record[record["time"] >= SETTLING], tuple(differential.warnings)
    if abs(pitches) <= 1.0:
        return _within_a_pitch(event, settled, pitches, strength, warnings)
    record, damage, agrees = _revolutions(differential, event, abs(frequency), teeth)
    warnings = tuple(differential.warnings)
    if not agrees:
        warnings += (f"damage differs from one revolution to the next by more than {STEADY:.0%}; a mean is taken",)
    pitches, forces = _frequency(record, teeth) * event.duration, _forces(record)
    roll = Roll.of_revolutions(pitches, forces, damage, strength, planets)
    return EventDamage.of(event, record, warnings, roll=roll, rolls=True, advance=pitches, meshing=np.zeros(4), standing=np.empty((2, 2, 0)))


def _within_a_pitch(event, settled, pitches, strength, warnings):
    """Damage if no tooth rolls through the whole mesh: slow cycles load the roots, and the FMU counts swings of the load. The contact may
    still pass the rated points of the flanks."""
    span = settled["time"][-1] - settled["time"][0]
    swings = (damage_of(settled)[-1] - damage_of(settled)[0]) / span * event.duration
    stress, forces, roll = np.max(root_stress(settled), axis=1), _forces(settled), None
    loads = forces / max(np.max(abs(forces)), np.finfo(float).tiny)
    if abs(pitches) > LEAST_ROLL:
        pressure, swings[2:] = np.max(settled["stress.contact_rated"]), 0.0
        roll = Roll(pitches, loads, stress, np.array([pressure, pressure]))
    return EventDamage.of(event, settled, warnings, roll=roll, rolls=roll is not None, advance=pitches, meshing=swings,
                          standing=np.outer(stress, loads)[:, :, None])


def _revolutions(differential, event, frequency, teeth):
    """Record of the steady state, growth of damage in one revolution of each gear, shape (4,), and true if successive values agree."""
    revolution = np.array([teeth[0], teeth[1], teeth[0], teeth[1]])
    # with tooth errors, teeth meet again after the least common multiple
    common = lcm(*teeth)
    longer = np.full(4, common) if common <= MOST_CYCLES else MOST_REVOLUTIONS * revolution
    settling = max(1, ceil(SETTLING * frequency))
    # the worst tooth has the largest sum only after some time
    for cycles, before in ((revolution, settling), (longer, settling + 2 * max(longer))):
        length = before + 2 * max(cycles) + 1
        record = differential._record(None, OUTPUTS, length / frequency, 1.0 / (POINTS_PER_CYCLE * frequency), event.values)
        record = record[before * POINTS_PER_CYCLE:]
        damage = damage_of(record)
        halves = np.array([_growths(damage[:, mode], cycles[mode] * POINTS_PER_CYCLE) for mode in range(4)])
        agrees = bool(np.all(abs(halves[:, 1] - halves[:, 0]) <= STEADY * np.max(halves, axis=1)))
        if agrees:
            break
    return record, np.mean(halves, axis=1) * revolution / cycles, agrees


def _growths(damage, points):
    """Growth of a damage in two successive spans of this many `points`."""
    starts = np.arange(POINTS_PER_CYCLE)
    return [np.median(damage[starts + i * points + points] - damage[starts + i * points]) for i in (0, 1)]


def _frequency(record, teeth):
    """Mean mesh frequency [Hz], positive if the planets turn forward."""
    angle, time = record["planet[1].spin_angle"], record["time"]
    return (angle[-1] - angle[0]) / (time[-1] - time[0]) * teeth[0] / (2.0 * pi)


def _forces(record):
    """Mean tangential forces on left and right [N]."""
    return np.array([np.mean(record[f"{side}.tangential_force"]) for side in ("left", "right")])
