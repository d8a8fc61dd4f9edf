"""Passes of teeth through the meshes in steady rolling, and their damage.

Positions are in pitches that the planets have rolled relative to the carrier. At position 0, tooth 0 of a planet is in the middle of the
left mesh. The right mesh is half a revolution away, and the planets are evenly distributed over the teeth of a side gear:

```text
planet tooth n:      left mesh  x = n + i z_p            right mesh  x = n + z_p/2 + i z_p
side gear tooth n:   planet j   x = n − j z_s/N + i z_s,  and half a revolution of a planet later on the right
```

In the written order, the position is the sum of all rolls so far, so passes are counted tooth by tooth. In an unknown order, a
tooth passes a mesh at most ceil(P/z) times in a roll of P pitches. Its root is also loaded if it only enters or leaves the mesh.

In a mesh that drives, the left mesh loads flank 0 of a planet's tooth and the right mesh flank 1; a side gear's tooth has its load on
flank 0. Loads that drive backward use the other flanks. Root stress is positive under load on flank 0. The largest peaks of a tooth
meet its deepest valleys, and other loads pulsate."""

from collections.abc import Sequence
from dataclasses import dataclass
from math import ceil
from typing import Any, Self

import numpy as np

from .slow import SlowCycles, Strength, count_slow_cycles, worst_pairs

# smallest roll that counts, in pitches: bending teeth and their backlash allow less
LEAST_ROLL = 0.05
# length over which a tooth is in mesh, in pitches: more than the contact ratio of straight bevel gears
MESH = 2.0
# decimals of positions in revolutions: a roll that returns to its start does so exactly
DECIMALS = 9


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


@dataclass(frozen=True)
class Teeth:
    """What the teeth of a gear meet. `roots`, `flanks`: numbers of passes that load them, shape (teeth, meshes, events); `signs`: factor of
    the stress of standing teeth, shape (teeth, events), 0 if the tooth is not in mesh."""

    roots: np.ndarray
    flanks: np.ndarray
    signs: np.ndarray


def worst_teeth(events: Sequence[Any], order: str, numbers: tuple[int, int], planets: int, strength: Strength, least: float) -> WorstTeeth:
    """Load cycles of `events` (`EventDamage`) on gears with these `numbers` of teeth (planet, side gear) and with `planets` planets, in an
    `order` of `slow.ORDERS`. Slow cycles with a range up to `least` [Pa] are left out."""
    counts = np.array([one.event.count for one in events])
    rolls = [one.roll or Roll(0.0, np.ones(2), np.zeros(2), np.zeros(2)) for one in events]
    gears = (_by_tooth if order == "written" else _most)(events, rolls, counts, numbers, planets)
    # signs of the flank that a mesh loads: (gear, mesh)
    loads = np.array([roll.loads for roll in rolls]).T
    signed = np.stack([loads * [[1.0], [-1.0]], loads])
    # both roots follow one force, so the ratio is the same in all loaded events
    ratios = 1.0, next((one.side_ratio for one in events if np.isfinite(one.side_ratio)), 1.0)
    roots, slow, pressures, passes = [], [], [], []
    for gear, teeth in enumerate(gears):
        stress = signed[gear] * [roll.root[gear] for roll in rolls]
        histories = [ratios[gear] * one.standing for one in events]
        has_both_signs = gear == 0 and any(one.rolls and one.event.count > 0.0 for one in events)
        found = _worst_root(teeth, stress, (histories, counts, order, least), has_both_signs, strength)
        pressure = np.sqrt(abs(loads)) * [roll.pressure[gear] for roll in rolls]
        roots.append(found[0])
        slow.append(found[1])
        pressures.append(pressure)
        passes.append(_worst_flank(teeth.flanks, signed[gear] > 0.0, strength.pitting.damage(pressure)))
    by_roots = [cycles.damage_by_event(strength, len(events)) for cycles in roots]
    by_flanks = [np.sum(number * strength.pitting.damage(pressure), axis=0) for number, pressure in zip(passes, pressures)]
    slow_damage = np.stack([cycles.damage_by_event(strength, len(events)) for cycles in slow], axis=1)
    return WorstTeeth(tuple(roots), tuple(slow), tuple(pressures), tuple(passes), np.stack([*by_roots, *by_flanks], axis=1), slow_damage)


def passes_between(begin: float, end: float, at: np.ndarray, period: float) -> np.ndarray:
    """Numbers of passes over positions `at` + i `period` on the way from `begin`, which does not count, to `end`, which does."""
    way = 1.0 if end >= begin else -1.0
    last, first = (np.floor(np.round(way * (place - at) / period, DECIMALS)) for place in (end, begin))
    return last - first


def _by_tooth(events, rolls, counts, numbers, planets):
    """Teeth of planet and side gears in events that follow each other. A tooth of a side gear is in one mesh."""
    ends = np.concatenate([[0.0], np.cumsum([one.advance for one in events] * counts)])
    half = numbers[0] / 2.0
    planet, side = (np.zeros((teeth, 2, len(events))) for teeth in (numbers[0], 2 * numbers[1]))
    # histories may roll while they load standing teeth, so all teeth are loaded
    signs = [np.tile([float(one.rolls and one.roll is None) for one in events], (len(gear), 1)) for gear in (planet, side)]
    for mesh in (0, 1):
        at = np.arange(numbers[0]) + mesh * half
        of_side = slice(mesh * numbers[1], (mesh + 1) * numbers[1])
        for event, (begin, end) in enumerate(zip(ends, ends[1:])):
            planet[:, mesh, event] = passes_between(begin, end, at, numbers[0])
            signs[0][is_in_mesh(begin, at, numbers[0]), event] = 1.0 - 2.0 * mesh
            for number in range(planets):
                at_planet = np.arange(numbers[1]) - number * numbers[1] / planets + mesh * half
                side[of_side, mesh, event] += passes_between(begin, end, at_planet, numbers[1])
                signs[1][of_side, event][is_in_mesh(begin, at_planet, numbers[1])] = 1.0
    return Teeth(planet, planet, signs[0]), Teeth(side, side, signs[1])


def is_in_mesh(place: float, at: np.ndarray, period: float) -> np.ndarray:
    """True for teeth at the positions `at` + i `period` that are within half a pitch of `place`."""
    turns = (place - at) / period
    return np.round(abs(turns - np.round(turns)) * period - 0.5, DECIMALS) <= 0.0


def _most(events, rolls, counts, numbers, planets):
    """A tooth of a planet and one of each side gear with the largest numbers of passes in any order and from any position."""
    def most(between, longer):
        return counts * [ceil((abs(roll.pitches) + longer) / between) if abs(roll.pitches) > LEAST_ROLL else 0 for roll in rolls]

    none = np.zeros(len(events))
    (root, flank), (side_root, side_flank) = ([most(between, longer) for longer in (MESH, 0.0)] for between in (numbers[0], numbers[1] / planets))
    planet = Teeth(np.array([[root, root]]), np.array([[flank, flank]]), np.ones((1, len(events))))
    both = [np.array([[passes, none], [none, passes]]) for passes in (side_root, side_flank)]
    return planet, Teeth(*both, np.ones((2, len(events))))


def _worst_root(teeth, stress, standing, has_both_signs, strength):
    """Rolling and slow cycles of the tooth with the largest damage. `stress` (meshes, events) of passes; `standing`: arguments of
    `count_slow_cycles`."""
    histories, counts, order, least = standing
    events = np.broadcast_to(np.arange(stress.shape[1]), stress.shape)
    found = []
    # many teeth have the same loads
    for row in np.unique(np.concatenate([teeth.roots, teeth.signs[:, None, :]], axis=1), axis=0):
        loads = [load for load in zip(stress.ravel(), row[:2].ravel(), events.ravel()) if load[0] != 0.0 and load[1] > 0.0]
        of_tooth = [sign * history if sign else np.empty(0) for sign, history in zip(row[2], histories)]
        if order == "written":
            cycles = SlowCycles.of(worst_pairs(loads)), count_slow_cycles(of_tooth, counts, order, least)
        else:
            all_cycles = count_slow_cycles(of_tooth, counts, order, least, loads, has_both_signs)
            rolls = np.array([len(history) == 0 for history in histories])
            of_rolling = np.all([(ends == 0.0) | rolls[of] for ends, of in ((all_cycles.low, all_cycles.low_event),
                                                                            (all_cycles.high, all_cycles.high_event))], axis=0)
            cycles = all_cycles.of_events(of_rolling), all_cycles.of_events(~of_rolling)
        found.append((sum(part.total(strength) for part in cycles), cycles))
    return max(found, key=lambda pair: pair[0])[1]


def _worst_flank(passes, is_first, damage):
    """Passes of the flank with the largest damage, shape (meshes, events). `is_first`: true for loads on flank 0; `damage` of a pass."""
    flanks = np.stack([passes * is_first, passes * ~is_first])
    sums = np.sum(flanks * damage, axis=(2, 3))
    flank, tooth = np.unravel_index(np.argmax(sums), sums.shape)
    return flanks[flank, tooth]
