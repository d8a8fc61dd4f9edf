"""Damage of the worst teeth by passes through the meshes in steady rolling, and by slow cycles.

In the written order, all loads are counted tooth by tooth (`tooth`). In an unknown order, a tooth passes a mesh at most ceil(P/z) times in
a roll of P pitches. Its root is also loaded if it only enters or leaves the mesh. The largest peaks then meet the deepest valleys, and a
planet's tooth may meet either side gear.

In a mesh that drives, the left mesh loads flank 0 of a planet's tooth and the right mesh flank 1; a side gear's tooth has its load on
flank 0. Loads that drive backward use the other flanks. Root stress is positive under load on flank 0."""

from collections.abc import Sequence
from dataclasses import dataclass
from math import ceil
from typing import Any, Self

import numpy as np

from .slow import SlowCycles, Strength, count_slow_cycles, worst_pairs
from .tooth import DECIMALS, Tooth, larger, teeth_in_written_order

# smallest roll that counts, in pitches: bending teeth and their backlash allow less
LEAST_ROLL = 0.05
# length over which a tooth is in mesh, in pitches: more than the contact ratio of straight bevel gears
MESH = 2.0


@dataclass(frozen=True)
class Roll:
    """Steady rolling in one occurrence of an event.

    `pitches`: roll of the planets relative to the carrier, signed; `loads`: forces of the left and the right mesh over the larger one,
    positive if they drive, shape (2,); `root`: root stress [Pa] of planet and side gear under the larger force, which does the damage that
    the FMU counts; `pressure`: rated contact pressure [Pa] of their flanks, likewise."""

    pitches: float
    loads: np.ndarray
    root: np.ndarray
    pressure: np.ndarray

    @classmethod
    def of_revolutions(cls, pitches: float, forces: np.ndarray, damage: np.ndarray, strength: Strength, planets: int) -> Self:
        """Rolling under the tangential `forces` [N] on left and right. `damage`: Miner sums of one revolution of a planet (roots, flanks)
        and of a side gear in the order root of planet and side gear, then their flanks."""
        largest = np.max(abs(forces))
        loads = forces / largest if largest > 0.0 else np.ones(2)
        bending, pitting = strength.bending, strength.pitting
        # damage of a revolution of a planet for stresses of 1 at the larger force, without the strength
        unit = SlowCycles.of(worst_pairs([(loads[0], 1.0, 0), (-loads[1], 1.0, 0)]))
        bent = np.sum(unit.count * unit.pulsating(strength) ** bending.slope)
        squeezed = np.sort(abs(loads) ** (pitting.slope / 2.0))
        # meshes of which only one drives load the same flank of a planet
        passes = np.sum(squeezed) if loads[0] * loads[1] < 0.0 else squeezed[-1]
        return cls(pitches, loads, np.array([bending.stress(damage[0] / bent), bending.stress(damage[1] / planets)]),
                   np.array([pitting.stress(damage[2] / passes), pitting.stress(damage[3] / planets)]))


@dataclass(frozen=True)
class WorstTeeth:
    """Load cycles of the worst teeth in one duty cycle, of planet and side gear each.

    `rolling`, `slow`: cycles of root stress by rolling, and those that involve teeth that stay in mesh; `pressures` [Pa], `counts`: rated
    contact pressure and number of passes of the worst flank, shape (meshes, events); `damage`: Miner sums of rolling by event, shape
    (events, 4), in the order of the FMU's damage outputs; `slow_damage`: those of slow cycles at both roots, shape (events, 2)."""

    rolling: tuple[SlowCycles, SlowCycles]
    slow: tuple[SlowCycles, SlowCycles]
    pressures: tuple[np.ndarray, np.ndarray]
    counts: tuple[np.ndarray, np.ndarray]
    damage: np.ndarray
    slow_damage: np.ndarray


def worst_teeth(events: Sequence[Any], order: str, gears: tuple[tuple[int, int], int], strength: Strength, least: float) -> WorstTeeth:
    """Load cycles of `events` (`EventDamage`) in an `order` of `slow.ORDERS`. `gears`: numbers of teeth of planet and side gear, and
    number of planets. Cycles with a range up to `least` [Pa] are left out."""
    numbers, planets = gears
    rolls = [one.roll or Roll(0.0, np.ones(2), np.zeros(2), np.zeros(2)) for one in events]
    # signs of the flank that a mesh loads: (gear, mesh)
    loads = np.array([roll.loads for roll in rolls]).T
    signed = np.stack([loads * [[1.0], [-1.0]], loads])
    stress = [signed[gear] * [roll.root[gear] for roll in rolls] for gear in (0, 1)]
    pressures = [np.sqrt(abs(loads)) * [roll.pressure[gear] for roll in rolls] for gear in (0, 1)]
    # a planet's tooth has the opposite load in the right mesh
    standing = [[one.standing[gear] * [[1.0], [2.0 * gear - 1.0]] for one in events] for gear in (0, 1)]
    moves = any(one.rolls and one.event.count > 0.0 for one in events)
    # events whose load cycles are those of rolling
    rolls_there = np.array([one.roll is not None and (order == "written" or one.standing.size == 0) for one in events])
    loaded = teeth_in_written_order if order == "written" else _most_loaded
    rolling, slow, passes = [], [], []
    for gear, teeth in enumerate(loaded(events, stress, standing, loads, numbers, planets)):
        found = [count_slow_cycles(one.histories, one.counts, order, least, one.loads, gear == 0 and moves) for one in teeth]
        worst = max(found, key=lambda cycles: cycles.total(strength))
        is_rolling = ((worst.low == 0.0) | rolls_there[worst.low_event]) & ((worst.high == 0.0) | rolls_there[worst.high_event])
        rolling.append(worst.chosen(is_rolling))
        slow.append(worst.chosen(~is_rolling))
        passes.append(_worst_flank(np.stack([one.passes for one in teeth]), signed[gear] > 0.0, strength.pitting.damage(pressures[gear])))
    by_roots = [cycles.damage_by_event(strength, len(events)) for cycles in rolling]
    by_flanks = [np.sum(number * strength.pitting.damage(pressure), axis=0) for number, pressure in zip(passes, pressures)]
    slow_damage = np.stack([cycles.damage_by_event(strength, len(events)) for cycles in slow], axis=1)
    return WorstTeeth(tuple(rolling), tuple(slow), tuple(pressures), tuple(passes), np.stack([*by_roots, *by_flanks], axis=1), slow_damage)


def _most_loaded(events, stress, standing, loads, numbers, planets):
    """A tooth of a planet, and one of each side gear, with the largest numbers of passes in any order and from any position."""
    counts = np.array([one.event.count for one in events])

    def most(between, longer):
        pitches = [abs(one.roll.pitches) if one.roll and abs(one.roll.pitches) > LEAST_ROLL else 0.0 for one in events]
        return counts * [ceil(round((rolled + longer) / between, DECIMALS)) if rolled else 0 for rolled in pitches]

    gears = []
    moves = any(one.rolls and one.event.count > 0.0 for one in events)
    # a tooth stays in one mesh, but that of a planet meets both if it moves
    single, both = [[1, 0], [0, 1]], [[1, 1]]
    for gear, (between, meshes) in enumerate([(numbers[0], both if moves else single), (numbers[1] / planets, single)]):
        # the roots of standing teeth are in their histories
        roots = most(between, MESH) * [one.standing.size == 0 for one in events]
        teeth = []
        for of in meshes:
            loads_of = [(stress[gear][mesh, event], roots[event], event) for mesh in np.flatnonzero(of) for event in np.flatnonzero(roots)]
            histories = [larger(one[np.array(of, bool)]) for one in standing[gear]]
            teeth.append(Tooth(histories, counts, loads_of, np.outer(of, most(between, 0.0))))
        gears.append(teeth)
    return gears


def _worst_flank(passes, is_first, damage):
    """Passes of the flank with the largest damage, shape (meshes, events). `is_first`: true for loads on flank 0; `damage` of a pass."""
    flanks = np.stack([passes * is_first, passes * ~is_first])
    sums = np.sum(flanks * damage, axis=(2, 3))
    flank, tooth = np.unravel_index(np.argmax(sums), sums.shape)
    return flanks[flank, tooth]
