"""Damage of an event that is a time history.

The FMU follows the teeth from its own start position, which is one of many. A tooth that starts elsewhere may pass a mesh once more in each
stroke, and at a larger load. The damage of a stroke is therefore the larger of the FMU's count and of one pass per revolution, each at the
largest load of this revolution."""

from math import ceil, pi

import numpy as np

from ..differential import Differential
from .damage import OUTPUTS, Event, EventDamage, damage_of, load_signs, mesh_stress, root_stress
from .passes import LEAST_ROLL, MESH
from .slow import Strength
from .tooth import DECIMALS

# rows of a halt that does not end rolling
HALT = 5


def history(differential: Differential, event: Event, teeth: tuple[int, int], planets: int, strength: Strength) -> EventDamage:
    """Damage of one occurrence of `event` to gears with `teeth` of planet and side gear: Miner sums while teeth roll, and the stress while
    the same teeth stay in mesh."""
    record = differential._record(event.signals, OUTPUTS, event.duration, min(event.step, event.duration), event.values)
    # planets, because they stay in place when bending teeth let the side gears turn
    position = record["planet[1].spin_angle"] * (teeth[0] / (2.0 * pi))
    found = strokes(position)
    rolls = _rolls(_advance(position, found))
    growth = np.diff(damage_of(record), axis=0)
    # slow cycles contain the roots of teeth that stay in mesh
    growth[~rolls, :2] = 0.0
    meshing = np.sum(growth, axis=0)
    for first, last in found:
        if np.any(rolls[first:last]):
            by_fmu = np.sum(growth[first:last], axis=0)
            most = _most(record[first:last + 1], position[first:last + 1], (teeth[0], teeth[1] / planets), strength)
            meshing += np.maximum(most - by_fmu, 0.0)
    # a tooth that rolls out of mesh is unloaded
    stands = ~np.append(rolls[0], rolls)
    standing = stands * mesh_stress(record) if np.any(stands) else np.empty((2, 2, 0))
    return EventDamage.of(event, record, tuple(differential.warnings), roll=None, rolls=bool(found),
                          advance=float(position[-1] - position[0]), meshing=meshing, standing=standing)


def strokes(position: np.ndarray) -> list[tuple[int, int]]:
    """First and last rows of the strokes of a motion through `position`, in pitches. Smaller returns than `LEAST_ROLL` do not end a stroke."""
    found, first, far, way = list[tuple[int, int]](), 0, 0, 0.0
    for row, here in enumerate(position):
        moved = here - position[far]
        if way == 0.0:
            if abs(moved) > LEAST_ROLL:
                far, way = row, float(np.sign(moved))
        elif way * moved > 0.0:
            far = row
        elif -way * moved > LEAST_ROLL:
            found.append((first, far))
            first, far, way = far, row, -way
    return [*found, (first, far)] if way else found


def _advance(position, found):
    """Roll from row to row that brings new teeth into mesh, in pitches."""
    advance = np.zeros(len(position) - 1)
    for first, last in found:
        rolled = abs(position[first:last + 1] - position[first])
        advance[first:last] = np.diff(np.maximum.accumulate(rolled))
    return advance


def _rolls(advance):
    """Rows in which a gear rolls: intervals, with short halts in them, of more roll than the bending of teeth or the crossing of their
    backlash can cause."""
    positions = np.flatnonzero(advance > 0.0)
    found = np.zeros(len(advance), bool)
    for stretch in np.split(positions, np.flatnonzero(np.diff(positions) > HALT) + 1):
        if len(stretch) and np.sum(advance[stretch]) > LEAST_ROLL:
            found[stretch[0]:stretch[-1] + 1] = True
    return found


def _most(record, position, between, strength):
    """Largest Miner sums of a tooth in a stroke, shape (4,). `between`: pitches between two passes of a tooth of planet and side gear."""
    way, rolled = load_signs(record), abs(position - position[0])
    reverses = np.any(way > 0.0) and np.any(way < 0.0)
    # a planet's tooth is loaded from both sides in turn, and a side gear's if the load reverses
    curves = strength.idler, strength.idler if reverses else strength.bending
    stresses = root_stress(record)
    pressure, found = record["stress.contact_rated"], np.zeros(4)
    for gear in (0, 1):
        found[gear] = np.sum(curves[gear].damage(_peaks(stresses[gear], rolled, between[gear], MESH)))
        for sense in (1.0, -1.0):
            peaks = _peaks(np.where(way == sense, pressure, 0.0), rolled, between[gear], 0.0)
            found[2 + gear] += np.sum(strength.pitting.damage(peaks))
    return found


def _peaks(values, rolled, between, longer):
    """Largest `values` at the passes of one tooth, which are `between` pitches apart in a stroke that is longer by `longer`."""
    found = []
    for number in range(ceil(round((rolled[-1] + longer) / between, DECIMALS))):
        first = max(np.searchsorted(rolled, number * between - longer, "right") - 1, 0)
        last = np.searchsorted(rolled, (number + 1) * between, "left") + 1
        found.append(np.max(values[first:last]))
    return np.array(found)
