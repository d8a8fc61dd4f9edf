"""Damage of a duty cycle to the gears: that of its events, and that of the slow cycles between them."""

from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import dataclass
from functools import partial
from math import inf, isfinite, nan
from pathlib import Path

import numpy as np

from ..curve import expanded
from ..differential import Differential
from ..drive_port import PARAMETERS
from ..extras import needed
from ..fmu import Fmu
from ..records import write
from ..scene import Scene
from ..text import aligned
from ..values import DifferentialError, FileName, Value, variable_suggestion
from ..warned import by_owner, silenced, warn
from .cycle import QUANTITIES, read_cycle
from .damage import MODES, Event, EventDamage
from .driven import DRIVES, check_commands, drives_of, open_loads
from .history import history
from .passes import WorstTeeth, worst_teeth
from .slow import ORDERS, SlowCycles, Strength
from .steady import steady

HOUR, KM = 3600.0, 1000.0
NAMES = ("planet root", "side root", "planet flank", "side flank")
TEETH = ("geometry.planet_teeth", "geometry.side_teeth")
PLANETS = "geometry.planet_count"
# ranges of stress up to this fraction of the strength do not count as cycles, as in the FMU
GATE = 0.01
# warning of a duty cycle in which each tooth keeps its place in the mesh
STANDS = ("no event rolls the planets: flanks are not damaged, duration has no influence, and only changes of torque damage the roots; "
          "add turn_radius or speed_difference")
# relative difference of equal sums by rounding
EQUAL = 1e-9


@dataclass(frozen=True)
class SpectrumResult:
    """Damage and life over a duty cycle.

    `events`: `EventDamage` of one occurrence of each; `worst_teeth`: their load cycles in steady rolling, and slow cycles; `strength`:
    the S–N curves; `order`: order of the events; `loads`: lines with values and sources of loads that the duty cycle leaves open."""

    events: tuple[EventDamage, ...]
    worst_teeth: WorstTeeth
    strength: Strength
    order: str
    loads: tuple[str, ...] = ()

    @property
    def slow(self) -> SlowCycles:
        """Slow cycles at the root of the worst tooth of a planet."""
        return self.worst_teeth.slow[0]

    @property
    def slow_damage(self) -> np.ndarray:
        """Miner sums of slow cycles per duty cycle, at the roots of planet and side gear, by event, shape (events, 2)."""
        return self.worst_teeth.slow_damage

    @property
    def by_event(self) -> np.ndarray:
        """Miner sums of the worst teeth per duty cycle, shape (events, 4): roots of planet and side gear, then their flanks. Slow cycles
        are included."""
        found = self.worst_teeth.damage + [one.event.count * one.meshing for one in self.events]
        found[:, :2] += self.slow_damage
        return found

    @property
    def damage(self) -> dict[str, float]:
        """Miner sums per duty cycle by the FMU's names of damage outputs."""
        return dict(zip(MODES, self.by_event.sum(axis=0).tolist()))

    @property
    def rolls(self) -> bool:
        """True if planets roll in an event that occurs. Otherwise, each tooth keeps its place in the mesh."""
        return any(one.rolls and one.event.count > 0.0 for one in self.events)

    @property
    def critical(self) -> int:
        """Index in `MODES` of the largest damage."""
        return _largest(self.by_event.sum(axis=0))

    @property
    def critical_name(self) -> str:
        """Name of the largest damage, such as "planet root"."""
        return NAMES[self.critical]

    @property
    def is_flank(self) -> bool:
        """True if a flank has the largest damage."""
        return self.critical >= 2

    @property
    def hours(self) -> float:
        """Duration of a cycle, h."""
        return sum(one.event.count * one.event.duration for one in self.events) / HOUR

    @property
    def km(self) -> float:
        """Length of a cycle, km; NaN if an event that occurs has no distance."""
        return sum(one.event.count * one.event.distance for one in self.events if one.event.count > 0.0) / KM

    @property
    def cycles_to_failure(self) -> float:
        """Cycles until the Miner sum of the critical mode is 1; infinite without damage."""
        worst = max(self.damage.values())
        return 1.0 / worst if worst > 0.0 else inf

    @property
    def life_hours(self) -> float:
        """Life, h; NaN if no event rolls, because durations then have no influence."""
        return self.cycles_to_failure * self.hours if self.rolls or self.cycles_to_failure == inf else nan

    @property
    def life_km(self) -> float:
        """Life, km; NaN if an event that occurs has no distance, or if no event rolls."""
        return self.cycles_to_failure * self.km if self.rolls or self.cycles_to_failure == inf else nan

    @property
    def how_summed(self) -> str:
        """Sentence that says if the sums follow the teeth or are upper bounds."""
        if self.order == "unknown":
            return "sums are upper bounds: as many passes of one tooth as any start position allows"
        if any(one.event.signals and one.event.count > 0.0 and np.any(one.meshing) for one in self.events):
            return "sums are those of the worst tooth, tooth by tooth; histories that roll are upper bounds"
        return "sums are those of the worst tooth, tooth by tooth"

    @property
    def worst(self) -> EventDamage:
        """Event with the largest damage of the critical mode in a cycle."""
        return self.events[int(np.argmax(self.by_event[:, self.critical]))]

    @property
    def warnings(self) -> list[str]:
        """Warnings of the FMU, each once, with the name of its event or with the number of its events, and one if no event rolls."""
        found = by_owner(((one.event.name, one.warnings) for one in self.events), "events")
        return found if self.rolls else [*found, STANDS]

    def table(self) -> np.ndarray:
        """A row for each event, the worst first: a structured array that pandas can read.

        Fields: event, count, hours and km per cycle, Miner sums per cycle by the FMU's names of damage outputs, "slow.planet" and
        "slow.side" that are contained in them, share (of the critical mode), worst_mode, root_stress (of the planets, Pa),
        safety.root_min and safety.flank_min of the event."""
        damages, critical = self.by_event, self.critical
        total = max(damages[:, critical].sum(), np.finfo(float).tiny)
        rows = []
        for event_damage, damage, slow in zip(self.events, damages, self.slow_damage):
            mode = NAMES[_largest(damage)] if damage.max() > 0.0 else ""
            event = event_damage.event
            rows.append((event.name, event.count, event.count * event.duration / HOUR, event.count * event.distance / KM, *damage,
                         *slow, damage[critical] / total, mode, event_damage.root_stress[0], event_damage.safety_root,
                         event_damage.safety_flank))
        fields = ["event", "count", "hours", "km", *MODES, "slow.planet", "slow.side", "share", "worst_mode", "root_stress",
                  "safety.root_min", "safety.flank_min"]
        width = max(len(event_damage.event.name) for event_damage in self.events)
        texts = {"event": f"U{width}", "worst_mode": f"U{max(map(len, NAMES))}"}
        found = np.array(rows, [(name, texts.get(name, float)) for name in fields])
        return found[np.argsort(-found["share"], kind="stable")]

    def save(self, file: FileName) -> Path:
        """Writes the table, as CSV or Parquet by the file's ending."""
        table = self.table()
        return write(file, table.dtype.names or (), table.tolist(),
                     "Miner sums per duty cycle; hours and km per duty cycle; root_stress in Pa")

    def plot(self, file: FileName) -> Path:
        """Draws damage by event and the load spectrum into a picture, in the format of the file's ending."""
        from .picture import draw
        return draw(self, file)

    def summary(self) -> str:
        """Life, damage by mode and by event, and safety factors, as text."""
        km = f", {self.km:.4g} km" if isfinite(self.km) else ""
        lines = [f"duty cycle: {len(self.events)} events, {self.hours:.4g} h{km}; order of events: {self.order}",
                 self.how_summed,
                 *self.loads,
                 "damage per cycle: " + ", ".join(f"{name} {value:.3g}" for name, value in zip(NAMES, self.damage.values()))]
        if isfinite(self.cycles_to_failure) and not self.rolls:
            lines.append("life: none, because no event rolls the planets")
        elif isfinite(self.cycles_to_failure):
            km = f", {self.life_km:.4g} km" if isfinite(self.life_km) else ""
            lines.append(f"life by the {self.critical_name}: {self.cycles_to_failure:.4g} cycles, {self.life_hours:.4g} h{km}")
            worst = self.worst
            lines.append(f"worst event: {worst.event.name}: S_F = {worst.safety_root:.3g}, S_H = {worst.safety_flank:.3g}")
        else:
            lines.append("life: no event does any damage")
        return "\n".join([*lines, "", *aligned(self.cells(), 1)])

    def markdown(self) -> list[str]:
        """The table as lines of Markdown."""
        lines = [f"| {' | '.join(row)} |" for row in self.cells()]
        return [lines[0], f"|---{7 * '|--:'}|---|--:|--:|", *lines[1:]]

    def cells(self) -> list[tuple[str, ...]]:
        """Most important columns of the table as text, its head first."""
        rows = [("event", "count", "km", "planet root", "side root", "planet flank", "side flank", "share", "worst mode", "S_F", "S_H")]
        for row in self.table():
            km = f"{row['km']:.3g}" if isfinite(row["km"]) else "–"
            damages = [f"{row[mode]:.2e}" if row[mode] > 0.0 else "0" for mode in MODES]
            rows.append((str(row["event"]), f"{row['count']:g}", km, *damages, f"{row['share']:.1%}", str(row["worst_mode"] or "–"),
                         f"{row['safety.root_min']:.2f}", f"{row['safety.flank_min']:.2f}"))
        return rows


def spectrum(cycle: str | Path | Sequence[Event], parameters: Mapping[str, Value] | None = None, scene: FileName | None = None, *,
             order: str = "unknown", fmu: FileName | Fmu | None = None,
             mapper: Callable[..., Iterable[EventDamage]] = map) -> SpectrumResult:
    """Calculates damage and life of the gears over a duty cycle.

    `cycle`: a CSV file (docs/design.md), or a sequence of `Event`. `parameters`: {name: value} for all events: of the FMU, as for
    `Differential`, and quantities of the vehicle such as "wheel_radius": "334 mm". `scene`: name or file of a scene whose `[set]`
    `parameters` override. `order`: order of the events, see `slow.count_slow_cycles`. `fmu`: its file. `mapper`: function like `map`
    that evaluates events; that of a pool evaluates them in parallel. Raises `DifferentialError`."""
    if order not in ORDERS:
        raise DifferentialError(f"order = {order!r}: it is one of {', '.join(ORDERS)}")
    needed("rainflow", "design")
    parameters = expanded(parameters or {})
    # events start in their steady state, unlike the scene
    of_scene = Scene.load(scene, fmu).values if scene is not None else {}
    of_scene.pop("scene.start", None)
    sources = {**dict.fromkeys(of_scene, f"scene {scene}"), **dict.fromkeys(parameters, "the parameters (--set)")}
    given = {**of_scene, **parameters}
    vehicle = {name: QUANTITIES[name].number(value) for name, value in given.items() if name in QUANTITIES}
    values = {name: value for name, value in given.items() if name not in QUANTITIES}
    variables = Fmu.of(fmu).variables
    for name in values.keys() - variables.keys():
        raise DifferentialError(f"{name}: there is no such variable or quantity{variable_suggestion(name, [*QUANTITIES, *variables])}")
    with Differential({**values, "effects.strength": True}, fmu=fmu) as differential:
        # no event has the loads of this run, so its warnings do not matter
        with silenced():
            facts = differential.final([*Strength.PARAMETERS, *TEETH, PLANETS, *DRIVES, *PARAMETERS], stop=1e-3)
        teeth = int(facts[TEETH[0]]), int(facts[TEETH[1]])
        read = isinstance(cycle, (str, Path))
        events = read_cycle(cycle, differential.fmu, vehicle, teeth, facts, values) if read else list(cycle)
        for event in events:
            check_commands(event, drives_of(event.values, facts, differential.fmu), values)
        if not any(event.count > 0.0 for event in events):
            raise DifferentialError("count: no event of the cycle occurs; give one a count above 0")
        strength, planets = Strength.of(facts), int(facts[PLANETS])
        one = partial(_evaluated, differential=differential, teeth=teeth, planets=planets, strength=strength)
        damages = tuple(mapper(one, events))
    worst = worst_teeth(damages, order, (teeth, planets), strength, GATE * strength.bending.strength)
    result = SpectrumResult(damages, worst, strength, order, open_loads(events, facts, differential, sources))
    warn(result.warnings)
    return result


def _largest(damages):
    """Index of the largest of `damages`, the first one if several are equal."""
    return int(np.argmax(damages >= (1.0 - EQUAL) * np.max(damages)))


def _evaluated(event, differential, teeth, planets, strength):
    """Damage of one occurrence of `event`. The function changes nothing; it and its arguments can be sent to other processes."""
    try:
        found = (history if event.signals else steady)(differential, event, teeth, planets, strength)
        # the FMU accepts values that have no effect in this event without an error; a constant signal has its value from the start
        changing = {name for name, (_, values) in event.signals.items() if np.ptp(values) > 0.0}
        for name, why in differential.unfelt.items():
            if name in event.values or name in changing:
                raise DifferentialError(f"{name}: {why}")
        return found
    except DifferentialError as failure:
        raise DifferentialError(f"event {event.name!r}: {failure}", kind=failure.kind) from None
