"""Loads of single teeth while events follow each other in the written order.

Positions are in pitches that the planets have rolled relative to the carrier. At position 0, tooth 0 of a planet is in the middle of the
left mesh. The right mesh is half a revolution away, and the planets are evenly distributed over the teeth of a side gear:

```text
planet tooth n:      left mesh  x = n + i z_p            right mesh  x = n + z_p/2 + i z_p
side gear tooth n:   planet j   x = n − j z_s/N + i z_s,  and half a revolution of a planet later on the right
```

A tooth is in mesh within half a pitch of these positions, and its root has the load of the mesh. Its flank is rated where the contact
passes the inner point of single contact, a little less than half a pitch from the middle: before it in the left mesh and behind it in the
right one, and vice versa if the load drives backward."""

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np

# distance of the rated point from the middle of the mesh, in pitches
RATED = 0.45
# passes of an event that a history contains; the others are equal to these
MOST_PASSES = 4
# decimals of positions in revolutions: a roll that returns to its start does so exactly
DECIMALS = 9


@dataclass(frozen=True)
class Tooth:
    """Loads of a tooth in one duty cycle: arguments of `count_slow_cycles`, and the passes of its flanks.

    `histories`: root stress by event [Pa]; `counts`: their numbers; `loads`: rows (stress [Pa], number, event) of passes that are not in
    `histories`; `passes`: numbers of passes, shape (meshes, events)."""

    histories: list[np.ndarray]
    counts: np.ndarray
    loads: list[tuple[float, float, int]]
    passes: np.ndarray


def teeth_in_written_order(events: Sequence[Any], stress: Sequence[np.ndarray], standing: Sequence[list[np.ndarray]], loads: np.ndarray,
                           numbers: tuple[int, int], planets: int) -> tuple[list[Tooth], list[Tooth]]:
    """Teeth of a planet, and of both side gears. `events`: `EventDamage`; `stress`: root stress of passes by gear, each of the shape
    (meshes, events) [Pa]; `standing`: root stress of standing teeth by gear and event, each of the shape (meshes,
    points) [Pa]; `loads` of the meshes, positive if they drive, shape (meshes, events); `numbers` of teeth of planet and side gear."""
    counts = np.array([one.event.count for one in events])
    ends = np.concatenate([[0.0], np.cumsum([one.advance for one in events] * counts)])
    half, turns = numbers[0] / 2.0, np.arange(planets) / planets * numbers[1]
    planet = np.meshgrid([0, 1], np.arange(numbers[0]))
    side_mesh = np.repeat([0, 1], numbers[1])[:, None] + np.zeros(planets, int)
    side_at = np.tile(np.arange(numbers[1]), 2)[:, None] - turns + side_mesh * half
    gears = (planet[0], planet[1] + planet[0] * half), (side_mesh, side_at)
    return tuple(_teeth(events, counts, ends, teeth, (numbers[gear], stress[gear], standing[gear], loads))
                 for gear, teeth in enumerate(gears))


def _teeth(events, counts, ends, teeth, gear):
    """Teeth at these positions in the meshes: arrays `mesh` and `at` of the shape (teeth, positions)."""
    (mesh, at), (period, stress, standing, loads) = teeth, gear
    begin, end = ends[:-1, None, None], ends[1:, None, None]
    rated = RATED * np.sign(loads.T)[:, mesh] * np.where(mesh == 0, -1.0, 1.0)
    passed, passes = passes_between(begin, end, at + rated, period), np.zeros((len(at), 2, len(events)))
    for number in (0, 1):
        passes[:, number] = np.sum(passed * (mesh == number), axis=2).T
    was_in = is_in_mesh(begin, at, period)
    loaded_first, loaded_last = (np.any(in_mesh, axis=2) for in_mesh in (was_in, is_in_mesh(end, at, period)))
    way = np.where(end < begin, -1.0, 1.0)
    visits = np.sum(passes_between(begin, end, at - 0.5 * way, period) + was_in, axis=2).astype(int)
    order = np.argsort(np.where(was_in, 0.0, np.mod(way * (at - begin) - 0.5, period)), axis=2, kind="stable")
    # an event that rolls is one roll, however often it occurs
    once = np.array([min(count, 1.0) if one.roll is not None and count == int(count) else count for one, count in zip(events, counts)])
    blocks = dict[tuple, tuple]()
    found = []
    for n in range(len(at)):
        histories, more = [], []
        for event, one in enumerate(events):
            if one.roll is not None:
                in_turn = tuple(stress[mesh[n, order[event, n]], event].tolist())
                key = in_turn, int(visits[event, n]), bool(loaded_first[event, n]), bool(loaded_last[event, n])
                if key not in blocks:
                    blocks[key] = _visits(*key)
                block, left_over = blocks[key]
                histories.append(block)
                more += [(load, number, event) for load, number in left_over]
            else:
                # the FMU has followed a tooth through a history that rolls; it stands for all teeth
                meshes = mesh[n] if one.rolls else mesh[n, was_in[event, n]]
                histories.append(larger(standing[event][np.unique(meshes)]))
        found.append(Tooth(histories, once, more, passes[n]))
    return found


def larger(stresses: np.ndarray) -> np.ndarray:
    """History with the larger peak [Pa] of `stresses`, shape (meshes, points); no points without a mesh."""
    return max(stresses, key=lambda stress: np.max(abs(stress), initial=0.0), default=np.empty(0))


def _visits(loads, number, was_in, is_in):
    """Root stress during a `number` of visits to meshes with these `loads` in turn, and the loads (stress, number) of equal visits that are
    left out. The tooth is in mesh at the start if `was_in` is true, and at the end if `is_in` is true."""
    rounds = max(number - MOST_PASSES, 0) // len(loads)
    left = number - rounds * len(loads)
    found = [] if was_in and left else [0.0]
    for visit in range(left):
        found += [loads[visit % len(loads)], 0.0]
    return np.array(found[:-1] if is_in and left else found), [(load, float(rounds)) for load in loads if rounds]


def passes_between(begin: np.ndarray, end: np.ndarray, at: np.ndarray, period: float) -> np.ndarray:
    """Numbers of passes over positions `at` + i `period` on the way from `begin`, which does not count, to `end`, which does."""
    way = np.where(end < begin, -1.0, 1.0)
    last, first = (np.floor(np.round(way * (position - at) / period, DECIMALS)) for position in (end, begin))
    return last - first


def is_in_mesh(position: np.ndarray, at: np.ndarray, period: float) -> np.ndarray:
    """True for teeth at the positions `at` + i `period` that are within half a pitch of `position`."""
    turns = (position - at) / period
    return np.round(abs(turns - np.round(turns)) * period - 0.5, DECIMALS) <= 0.0
