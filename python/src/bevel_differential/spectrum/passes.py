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
from math import ceil, inf
from typing import Any, Self

import numpy as np

from .slow import SlowCycles, Strength, pairs

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
        unit = root_cycles([(loads[0], 1.0, 0), (-loads[1], 1.0, 0)])
        bent = np.sum(unit.count * unit.pulsating(strength) ** bending.slope)
        squeezed = np.sort(abs(loads) ** (pitting.slope / 2.0))
        # meshes of which only one drives load the same flank of a planet
        passes = np.sum(squeezed) if loads[0] * loads[1] < 0.0 else squeezed[-1]
        return cls(pitches, loads, np.array([bending.stress(damage[0] / bent), bending.stress(damage[1] / planets)]),
                   np.array([pitting.stress(damage[2] / passes), pitting.stress(damage[3] / planets)]))


@dataclass(frozen=True)
class Passes:
    """Load cycles of the worst teeth by passes in one duty cycle, of planet and side gear each.

    `roots`: cycles of root stress; `pressures` [Pa], `counts`: rated contact pressure and number of passes of the worst flank, shape
    (meshes, events); `damage`: Miner sums by event, shape (events, 4)."""

    roots: tuple[SlowCycles, SlowCycles]
    pressures: tuple[np.ndarray, np.ndarray]
    counts: tuple[np.ndarray, np.ndarray]
    damage: np.ndarray


def count_passes(events: Sequence[Any], order: str, teeth: tuple[int, int], planets: int, strength: Strength) -> Passes:
    """Passes of `events` (`EventDamage`) with gears of these `teeth` (planet, side gear), with `planets` planets, in an `order` of
    `slow.ORDERS`."""
    rolls = [one.roll or Roll(0.0, np.ones(2), np.zeros(2), np.zeros(2)) for one in events]
    counts = np.array([one.event.count for one in events])
    if order == "written":
        of_roots = of_flanks = _passes_by_tooth(np.array([one.advance for one in events]) * counts, teeth, planets)
    else:
        of_roots, of_flanks = (_most_passes(rolls, counts, teeth, planets, longer) for longer in (MESH, 0.0))
    # signs of the flank that a mesh loads: (gear, mesh)
    loads = np.array([roll.loads for roll in rolls]).T
    signed = np.stack([loads * [[1.0], [-1.0]], loads])
    roots, pressures, flank_counts, damage = [], [], [], np.zeros((len(events), 4))
    for gear in (0, 1):
        stress = signed[gear] * [roll.root[gear] for roll in rolls]
        root = _worst_root(of_roots[gear], stress, strength)
        pressure = np.sqrt(abs(loads)) * [roll.pressure[gear] for roll in rolls]
        passed = _worst_flank(of_flanks[gear], signed[gear] > 0.0, strength.pitting.damage(pressure))
        damage[:, gear] = root.damage_by_event(strength, len(events))
        damage[:, 2 + gear] = np.sum(passed * strength.pitting.damage(pressure), axis=0)
        roots.append(root)
        pressures.append(pressure)
        flank_counts.append(passed)
    return Passes(tuple(roots), tuple(pressures), tuple(flank_counts), damage)


def root_cycles(loads: Sequence[tuple[float, float, int]]) -> SlowCycles:
    """Cycles of a root under `loads`: rows (stress [Pa], number, event). The largest peaks meet the deepest valleys."""
    peaks, valleys = ([list(load) for load in loads if sign * load[0] > 0.0 and load[1] > 0.0] for sign in (1.0, -1.0))
    above, below = (sum(load[1] for load in found) for found in (peaks, valleys))
    # the root is without load between two loads
    peaks, valleys = [*peaks, [0.0, below, 0]], [*valleys, [0.0, above, 0]]
    return SlowCycles.of(pairs(sorted(peaks, key=lambda peak: -peak[0]), sorted(valleys, key=lambda valley: valley[0])))


def passes_between(begin: float, end: float, at: np.ndarray, period: float) -> np.ndarray:
    """Numbers of passes over positions `at` + i `period` on the way from `begin`, which does not count, to `end`, which does."""
    way = 1.0 if end >= begin else -1.0
    last, first = (np.floor(np.round(way * (place - at) / period, DECIMALS)) for place in (end, begin))
    return last - first


def _passes_by_tooth(rolls, teeth, planets):
    """Passes of each tooth in events that follow each other: arrays (teeth, meshes, events) of planet and side gears. A tooth of a side
    gear is in one mesh."""
    ends = np.concatenate([[0.0], np.cumsum(rolls)])
    half = teeth[0] / 2.0
    planet, side = np.zeros((teeth[0], 2, len(rolls))), np.zeros((2, teeth[1], 2, len(rolls)))
    for event, (begin, end) in enumerate(zip(ends, ends[1:])):
        for mesh in (0, 1):
            planet[:, mesh, event] = passes_between(begin, end, np.arange(teeth[0]) + mesh * half, teeth[0])
            for number in range(planets):
                at = np.arange(teeth[1]) - number * teeth[1] / planets + mesh * half
                side[mesh, :, mesh, event] += passes_between(begin, end, at, teeth[1])
    return planet, side.reshape(-1, 2, len(rolls))


def _most_passes(rolls, counts, teeth, planets, longer):
    """Largest numbers of passes of a tooth in rolls that are longer by `longer` pitches, of planet and side gears, like
    `_passes_by_tooth`."""
    def most(pitches_between):
        return counts * [ceil((abs(roll.pitches) + longer) / pitches_between) if abs(roll.pitches) > LEAST_ROLL else 0 for roll in rolls]

    planet, side = most(teeth[0]), most(teeth[1] / planets)
    none = np.zeros(len(rolls))
    return np.array([[planet, planet]]), np.array([[side, none], [none, side]])


def _worst_root(passes, stress, strength):
    """Cycles of the tooth with the largest damage; `passes` (teeth, meshes, events), `stress` (meshes, events)."""
    events = np.broadcast_to(np.arange(stress.shape[1]), stress.shape)
    worst, largest = root_cycles(()), -inf
    for tooth in np.unique(passes, axis=0):
        cycles = root_cycles(list(zip(stress.ravel(), tooth.ravel(), events.ravel())))
        damage = np.sum(cycles.count * strength.bending.damage(cycles.pulsating(strength)))
        if damage > largest:
            worst, largest = cycles, damage
    return worst


def _worst_flank(passes, is_first, damage):
    """Passes of the flank with the largest damage, shape (meshes, events). `is_first`: true for loads on flank 0; `damage` of a pass."""
    flanks = np.stack([passes * is_first, passes * ~is_first])
    sums = np.sum(flanks * damage, axis=(2, 3))
    flank, tooth = np.unravel_index(np.argmax(sums), sums.shape)
    return flanks[flank, tooth]
