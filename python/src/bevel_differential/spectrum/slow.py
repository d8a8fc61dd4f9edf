"""Slow cycles: damage of torque changes to the roots of teeth that stay in mesh, counted by rainflow (ASTM E1049).

Every occurrence of an event is a history of root stress [Pa], which is positive on the drive flank. It begins and ends without
load. Cycles are counted for a duty cycle that repeats, so that all of them close.

S–N curves of the gears and the effect of mean stress are those of the FMU (docs/inside/theory.md, section 10):

```text
N_f = N_ref (S/σ)^k,   k = ln(N_ref/N_static)/ln Y_N            ISO 6336-2, -3, -5; the same slope below the knee
D   = Σ n_i/N_f(σ_i)                                            Palmgren and Miner
σ   = 2σ_a/((1 + M) K(σ_m/σ_a)),   M = 2 Y_M − 1                FKM guideline; Y_M idler factor
```"""

from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from math import log
from typing import Self

import numpy as np

from ..extras import require
from ..values import DifferentialError

ORDERS = ("unknown", "written")
# number of cycles up to which the standards keep the strength constant: bending (ISO 6336-3), pitting (ISO 6336-2)
STATIC_BENDING, STATIC_PITTING = 1e3, 1e5
# upper limit of M, as in the FMU
MOST_SENSITIVE = 0.99


@dataclass(frozen=True)
class SnCurve:
    """S–N curve, cycles to failure over stress: `strength` [Pa] at the knee of `cycles`, with `slope`."""

    strength: float
    cycles: float
    slope: float

    @classmethod
    def through(cls, strength: float, cycles: float, life_factor: float, static_cycles: float) -> Self:
        """Curve through `strength` at `cycles`, and through `life_factor` times `strength` at `static_cycles`."""
        return cls(strength, cycles, log(cycles / static_cycles) / log(life_factor))

    def damage(self, stress: np.ndarray) -> np.ndarray:
        """Damage of one cycle from 0 to each `stress` [Pa]: 1/N_f, at most 1; 0 without stress. Same shape."""
        ratio = np.maximum(np.asarray(stress, float), 0.0) / self.strength
        return np.minimum(ratio ** self.slope / self.cycles, 1.0)

    def stress(self, damage: float) -> float:
        """Peak [Pa] of the cycle from 0 that does this `damage`."""
        return self.strength * (damage * self.cycles) ** (1.0 / self.slope)

    def life(self, stress: np.ndarray) -> np.ndarray:
        """Cycles to failure at each `stress` > 0 [Pa]. Same shape."""
        return self.cycles * (self.strength / np.asarray(stress, float)) ** self.slope


@dataclass(frozen=True)
class Strength:
    """Strength of the gears: curves of `bending`, `idler` bending and `pitting`, and the `sensitivity` to mean stress M."""

    bending: SnCurve
    idler: SnCurve
    pitting: SnCurve
    sensitivity: float

    PARAMETERS = tuple(f"strength.{name}" for name in (
        "bending_strength", "bending_cycles", "bending_life_factor", "contact_strength", "contact_cycles",
        "contact_life_factor", "idler_factor"))

    @classmethod
    def of(cls, values: Mapping[str, float]) -> Self:
        """Reads the FMU's parameters `PARAMETERS` from a mapping from name to number, SI."""
        bending, cycles, factor, contact, contact_cycles, contact_factor, idler = (values[name] for name in cls.PARAMETERS)
        return cls(SnCurve.through(bending, cycles, factor, STATIC_BENDING),
                   SnCurve.through(bending * idler, cycles, factor, STATIC_BENDING),
                   SnCurve.through(contact, contact_cycles, contact_factor, STATIC_PITTING),
                   min(max(2.0 * idler - 1.0, 0.0), MOST_SENSITIVE))

    def pulsating(self, span: np.ndarray, mean: np.ndarray) -> np.ndarray:
        """Peak of the cycle from 0 that does the same damage as a cycle of the range `span` > 0 about `mean` [Pa], tension positive. Same
        shape."""
        m, ratio = self.sensitivity, 2.0 * np.asarray(mean) / np.asarray(span)
        permissible = np.select(
            [ratio <= 1.0, ratio < 3.0],
            [1.0 / (1.0 + m * np.maximum(np.minimum(ratio, 1.0), -1.0)), (1.0 + m / 3.0) / ((1.0 + m) * (1.0 + m * ratio / 3.0))],
            (1.0 + m / 3.0) / (1.0 + m) ** 2)
        return span / ((1.0 + m) * permissible)


@dataclass(frozen=True)
class SlowCycles:
    """Cycles of root stress of a tooth in one duty cycle; all arrays have the shape (cycles,).

    `low`, `high` [Pa]: both ends; `count`: number of cycles; `low_event`, `high_event`: numbers of the events at the ends."""

    low: np.ndarray
    high: np.ndarray
    count: np.ndarray
    low_event: np.ndarray
    high_event: np.ndarray

    @classmethod
    def of(cls, rows: Iterable[tuple], least: float = 0.0) -> Self:
        """Cycles of the rows (low, high, count, low_event, high_event) with a range above `least` [Pa]."""
        rows = [row for row in rows if row[1] - row[0] > least and row[2] > 0.0]
        low, high, count, low_event, high_event = zip(*rows) if rows else ((),) * 5
        return cls(np.array(low, float), np.array(high, float), np.array(count, float), np.array(low_event, int),
                   np.array(high_event, int))

    @property
    def span(self) -> np.ndarray:
        """Peak minus valley [Pa]."""
        return self.high - self.low

    @property
    def mean(self) -> np.ndarray:
        """Mean of peak and valley [Pa]."""
        return 0.5 * (self.high + self.low)

    def pulsating(self, strength: Strength) -> np.ndarray:
        """Peaks of cycles from 0 [Pa] that do the same damage to the root of the worse flank. At the other flank the mean has the opposite
        sign."""
        both = [strength.pulsating(self.span, sign * self.mean) for sign in (1.0, -1.0)]
        return max(both, key=lambda stress: np.sum(self.count * strength.bending.damage(stress)))

    def chosen(self, chosen: np.ndarray) -> "SlowCycles":
        """Cycles for which `chosen`, shape (cycles,), is true."""
        return SlowCycles(*(values[chosen] for values in (self.low, self.high, self.count, self.low_event, self.high_event)))

    def total(self, strength: Strength) -> float:
        """Damage to the root of the worse flank."""
        return float(np.sum(self.count * strength.bending.damage(self.pulsating(strength))))

    def damage_by_event(self, strength: Strength, events: int) -> np.ndarray:
        """Damage to the root of the worse flank, shape (`events`,). The damage of each cycle is divided in proportion to the stresses of
        the events at its ends."""
        damage = self.count * strength.bending.damage(self.pulsating(strength))
        found = np.zeros(events)
        share = abs(self.low) / (abs(self.low) + abs(self.high))
        np.add.at(found, self.low_event, damage * share)
        np.add.at(found, self.high_event, damage * (1.0 - share))
        return found

    def matrix(self, bins: int = 10) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
        """Rainflow matrix: (edges of range, edges of mean [Pa], counts of shape (bins, bins))."""
        counts, spans, means = np.histogram2d(self.span, self.mean, bins, weights=self.count)
        return spans, means, counts


def count_slow_cycles(histories: Sequence[np.ndarray], counts: Sequence[float], order: str, least: float = 0.0,
                      loads: Sequence[tuple[float, float, int]] = (), has_both_signs: bool = False) -> SlowCycles:
    """Slow cycles of events with `histories` (arrays of stress [Pa], empty if no teeth stay in mesh) that occur `counts` times. Ranges
    up to `least` [Pa] are left out.

    `order` "unknown": every occurrence begins and ends without load, and the largest peaks meet the deepest valleys, which is the
    worst order. They also meet `loads` of rolling teeth: rows (stress [Pa], number, event). If `has_both_signs` is true, the tooth may
    have each history with either sign. "written": events follow each other as listed, without unloading in between, and so do the
    occurrences of an event: a count of n has the same cycles as n equal events in a row. `loads` meet each other."""
    if order == "unknown":
        rows = _in_the_worst_order(histories, counts, loads, has_both_signs)
    elif order == "written":
        rows = [*_as_written(histories, counts), *worst_pairs(loads)]
    else:
        raise DifferentialError(f"order = {order!r}: it is one of {', '.join(ORDERS)}")
    return SlowCycles.of(rows, least)


def worst_pairs(loads: Sequence[Sequence]) -> list[tuple]:
    """Rows (valley, peak, count, event of the valley, event of the peak) of a tooth under `loads`, rows (stress, number, event): the
    highest peaks meet the deepest valleys. Between two loads of one sign, the tooth is without load."""
    peaks, valleys = (sorted((list(load) for load in loads if sign * load[0] > 0.0), key=lambda load: -abs(load[0]))
                      for sign in (1.0, -1.0))
    above, below = (sum(load[1] for load in found) for found in (peaks, valleys))
    return _pairs([*peaks, [0.0, below, 0]], [*valleys, [0.0, above, 0]])


def closed_cycles(stress: np.ndarray) -> Iterator[tuple[float, float, float, int, int]]:
    """Cycles (low, high, count, index of low, index of high) of a history that repeats; all of them close."""
    rainflow = require("rainflow", "design")
    begin = int(np.argmax(stress))
    around = [*range(begin, len(stress)), *range(begin + 1)]
    for _, _, count, first, last in rainflow.extract_cycles([stress[index] for index in around]):
        low, high = sorted((around[first], around[last]), key=lambda index: stress[index])
        yield stress[low], stress[high], count, low, high


def _occurrence(history):
    return np.concatenate([[0.0], history, [0.0]])


def _in_the_worst_order(histories, counts, loads, has_both_signs):
    rows, ends = [], []
    for event, (history, count) in enumerate(zip(histories, counts)):
        block = _occurrence(history)
        low, high = block.min(), block.max()
        inner = list(closed_cycles(block))
        # the widest cycle opens: its ends pair with those of other occurrences
        widest = [row for row in inner if (row[0], row[1]) == (low, high)]
        once = sum(row[2] for row in widest) - 1.0
        rows += [(row[0], row[1], row[2] * count, event, event) for row in inner if (row[0], row[1]) != (low, high)]
        rows.append((low, high, max(once, 0.0) * count, event, event))
        ends += [(high, count, event), (low, count, event)]
    if has_both_signs:
        ends += [(-stress, count, event) for stress, count, event in ends]
    return rows + worst_pairs([*ends, *loads])


def _pairs(peaks, valleys):
    """Pairs the highest peaks with the deepest valleys, as often as they occur."""
    rows, index = [], 0
    for high, count, high_event in peaks:
        while count > 0.0 and index < len(valleys):
            low, left, low_event = valleys[index]
            taken = min(count, left)
            rows.append((low, high, taken, low_event, high_event))
            count -= taken
            valleys[index][1] -= taken
            index += valleys[index][1] <= 0.0
    return rows


def _as_written(histories, counts):
    rows, stress, events = [], [], []
    for event, (history, count) in enumerate(zip(histories, counts)):
        if count != int(count):
            raise DifferentialError(f"count = {count:g}: events in a written order occur a whole number of times; make it whole, "
                                    "or take the order \"unknown\"")
        if count == 0:
            continue
        # teeth that roll out of mesh are unloaded
        block = history if len(history) else np.zeros(1)
        # each further occurrence starts where the one before it ended, so it adds the cycles of a history that repeats
        rows += [(low, high, n * (count - 1), event, event) for low, high, n, *_ in closed_cycles(block)]
        stress += list(block)
        events += [event] * len(block)
    if stress:
        rows += [(low, high, n, events[i], events[j]) for low, high, n, i, j in closed_cycles(np.array(stress))]
    return rows
