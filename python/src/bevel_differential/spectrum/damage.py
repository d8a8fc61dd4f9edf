"""Events of a duty cycle, and the damage of an event from a short simulation by the FMU."""

from dataclasses import dataclass, field
from math import ceil, isfinite, nan, pi

import numpy as np

from ..differential import Differential
from ..values import DifferentialError, Value

# outputs of damage, in the order of all arrays of modes
MODES = ("damage.planet", "damage.side", "damage.planet_flank", "damage.side_flank")
OUTPUTS = (*MODES, "safety.root_min", "safety.flank_min", "stress.root_planet_max", "stress.root_side_max",
           "left.tangential_force", "right.tangential_force", "planet[1].spin_angle")
# duration of settling, which does not count, and of the first run including it [s]
SETTLING, LOOK = 0.1, 0.5
POINTS = 50
# mesh cycles of the steady state: the first number, doubled until both halves agree to STEADY or the maximum is reached
FEWEST_CYCLES, MOST_CYCLES, STEADY = 4, 64, 0.01
# in a time history: rows of a halt that does not end rolling, and smallest roll, in pitches
HALT, LEAST_ROLL = 5, 0.05


@dataclass(frozen=True)
class Event:
    """Event of a duty cycle.

    `count`: number of occurrences in a cycle, 0 or more; `duration` [s] and `distance` [m, NaN if not known] of one occurrence;
    `values`: inputs and parameters of the FMU that it sets, as for `Differential`; `signals`: inputs over time
    {name: (times [s], values)} of an event that is a time history, from 0 to `duration`; `step`: communication step of its
    simulation [s]."""

    name: str
    count: float
    duration: float
    distance: float = nan
    values: dict[str, Value] = field(default_factory=dict)
    signals: dict[str, tuple[np.ndarray, np.ndarray]] = field(default_factory=dict)
    step: float = 0.01

    def __post_init__(self) -> None:
        if not (isfinite(self.count) and self.count >= 0.0):
            raise DifferentialError(f"count = {self.count!r}: event {self.name!r} occurs 0 times or more")
        if not (isfinite(self.duration) and self.duration > 0.0):
            raise DifferentialError(f"duration = {self.duration!r}: event {self.name!r} takes more than 0 s")
        if self.distance < 0.0:
            raise DifferentialError(f"distance = {self.distance!r}: event {self.name!r} covers 0 m or more")


@dataclass(frozen=True)
class EventDamage:
    """Damage of one occurrence of an event to the gears.

    `meshing`: Miner sums of the FMU, shape (4,), in the order of `MODES`; `standing`: root stress of the planets [Pa] while the same
    teeth stay in mesh, signed by the flank, shape (points,), empty if teeth roll all the time; `side_ratio`: root stress of the side
    gears over that of the planets, NaN without load; `turns`: revolutions of a planet relative to the carrier that load new teeth;
    `root_stress`: largest root stress of the planets [Pa]; `safety_root`, `safety_flank`: smallest factors of all gears;
    `warnings` of the FMU."""

    event: Event
    meshing: np.ndarray
    standing: np.ndarray
    side_ratio: float
    turns: float
    root_stress: float
    safety_root: float
    safety_flank: float
    warnings: tuple[str, ...]


def evaluate(event: Event, differential: Differential, teeth: tuple[int, int]) -> EventDamage:
    """Damage of one occurrence of `event` to a `differential` with `teeth` of planet and side gear. The function changes nothing; it and
    its arguments can be sent to other processes."""
    found = _history(differential, event, teeth) if event.signals else _steady(differential, event, teeth)
    # the FMU accepts values that have no effect in this event without an error; a constant signal has its value from the start
    changing = {name for name, (_, values) in event.signals.items() if np.ptp(values) > 0.0}
    for name, why in differential.unfelt.items():
        if name in event.values or name in changing:
            raise DifferentialError(f"{name}: {why}")
    return found


def _steady(differential, event, teeth):
    """Damage rate in the steady state times the duration."""
    look = differential._record(None, OUTPUTS, LOOK, LOOK / POINTS, event.values)
    settled = look[round(POINTS * SETTLING / LOOK):]
    span = settled["time"][-1] - settled["time"][0]
    frequency = abs(settled["planet[1].spin_angle"][-1] - settled["planet[1].spin_angle"][0]) / span * teeth[0] / (2.0 * pi)
    pitches, warnings = frequency * event.duration, tuple(differential.warnings)
    if pitches <= 1.0:
        # within a pitch, no new tooth comes into mesh; the FMU itself counts the damage of a swinging load to teeth in mesh
        rate = (_damage(settled)[-1] - _damage(settled)[0]) / span
        stress = _signed_stress(settled)
        return _result(event, settled, rate * event.duration, stress[np.argmax(abs(stress))][None], 0.0, warnings)
    cycles, period, steady = FEWEST_CYCLES, 1.0 / frequency, False
    while not steady and cycles <= MOST_CYCLES:
        before = max(1, ceil(SETTLING * frequency))
        record = differential._record(None, OUTPUTS, (before + cycles) * period, period, event.values)
        damage = _damage(record)[[before, before + cycles // 2, before + cycles]]
        rate = (damage[2] - damage[0]) / (cycles * period)
        halves = np.diff(damage, axis=0)
        steady = np.all(abs(halves[1] - halves[0]) <= STEADY * np.max(halves, axis=0))
        cycles *= 2
    warnings = tuple(differential.warnings)
    if not steady:
        warnings += (f"damage of two times {cycles // 4} mesh cycles differs by more than {STEADY:.0%}; their mean is taken",)
    return _result(event, record[before:], rate * event.duration, np.empty(0), pitches / teeth[0], warnings)


def _history(differential, event, teeth):
    """Damage of a time history: Miner sums while teeth roll, and the stress while the same teeth stay in mesh."""
    record = differential._record(event.signals, OUTPUTS, event.duration, min(event.step, event.duration), event.values)
    # planets, because they stay in place when bending teeth let the side gears turn
    angle, pitch = record["planet[1].spin_angle"], 2.0 * pi / teeth[0]
    pushed = pushed_along(angle, pitch)
    rolls = _rolls(pushed, pitch)
    meshing = np.sum(np.diff(_damage(record), axis=0) * rolls[:, None], axis=0)
    moves = _with_approach(np.diff(angle), rolls)
    # a tooth that rolls out of mesh is unloaded
    standing = np.where(np.append(moves[0], moves), 0.0, _signed_stress(record)) if not np.all(moves) else np.empty(0)
    return _result(event, record, meshing, standing, float(np.sum(pushed * rolls)) / (2.0 * pi), tuple(differential.warnings))


def pushed_along(angle: np.ndarray, pitch: float) -> np.ndarray:
    """Angles by which a gear pushes a window of one pitch along, from row to row. The FMU counts this motion as rolling."""
    place, found = 0.0, []
    for step in np.diff(angle):
        wanted = place + step
        place = min(max(wanted, -pitch / 2.0), pitch / 2.0)
        found.append(abs(wanted - place))
    return np.array(found)


def _rolls(pushed, pitch):
    """Rows in which a gear rolls: intervals, with short halts in them, that push the window along by more than the bending of teeth or
    the crossing of their backlash can do."""
    places = np.flatnonzero(pushed > 0.0)
    found = np.zeros(len(pushed), bool)
    for stretch in np.split(places, np.flatnonzero(np.diff(places) > HALT) + 1):
        if len(stretch) and np.sum(pushed[stretch]) > LEAST_ROLL * pitch:
            found[stretch[0]:stretch[-1] + 1] = True
    return found


def _with_approach(steps, rolls):
    """Rows in which a gear rolls, or moves to the edge of its window just before it rolls: no tooth stays in mesh there."""
    found = rolls.copy()
    for i in range(len(steps) - 2, -1, -1):
        found[i] |= found[i + 1] and steps[i] * steps[i + 1] > 0.0
    return found


def _damage(record):
    return np.stack([record[name] for name in MODES], axis=1)


def _signed_stress(record):
    """Root stress of the planets [Pa], positive while the drive flanks of the more loaded side are loaded."""
    left, right = record["left.tangential_force"], record["right.tangential_force"]
    return record["stress.root_planet_max"] * np.sign(np.where(abs(left) >= abs(right), left, right))


def _result(event, record, meshing, standing, turns, warnings):
    planet, side = record["stress.root_planet_max"], record["stress.root_side_max"]
    worst = int(np.argmax(planet))
    ratio = float(side[worst] / planet[worst]) if planet[worst] > 0.0 else nan
    return EventDamage(event, meshing, standing, ratio, turns, float(planet[worst]), float(record["safety.root_min"][-1]),
                       float(record["safety.flank_min"][-1]), warnings)
