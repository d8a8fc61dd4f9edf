"""The damage of a duty cycle: its events one by one, and the slow cycles between them."""

from collections.abc import Callable, Iterable, Mapping, Sequence
from functools import partial
from pathlib import Path

import numpy as np

from ..differential import Differential
from ..fmu import Fmu
from ..scene import Scene
from ..values import DifferentialError, FileName, Value, suggestion
from .cycle import DRIVES, QUANTITIES, read_cycle
from .damage import Event, EventDamage, evaluate
from .result import SpectrumResult
from .slow import ORDERS, Strength, count_slow_cycles

TEETH = ("geometry.planet_teeth", "geometry.side_teeth")
PLANETS = "geometry.planet_count"
# ranges of stress up to this part of the strength are no cycles, as in the FMU
GATE = 0.01


def spectrum(cycle: str | Path | Sequence[Event], parameters: Mapping[str, Value] | None = None, scene: FileName | None = None, *,
             order: str = "unknown", fmu: FileName | Fmu | None = None,
             mapper: Callable[..., Iterable[EventDamage]] = map) -> SpectrumResult:
    """Damage and life of the gears over a duty cycle, a `SpectrumResult`.

    `cycle`: a CSV file (docs/spectrum.md), or a sequence of `Event`. `parameters`: {name: value} for all events, of the FMU as
    `Differential` takes them, and quantities of the vehicle such as "wheel_radius": "334 mm". `scene`: name or file of a scene
    whose `[set]` comes before. `order`: of the events, see `slow.count_slow_cycles`. `fmu`: its file. `mapper`: evaluates events,
    as `map` does; that of a pool evaluates them in parallel. Raises `DifferentialError`."""
    if order not in ORDERS:
        raise DifferentialError(f"order = {order!r}: it is one of {', '.join(ORDERS)}")
    given = {**_of_scene(scene, fmu), **(parameters or {})}
    vehicle = {name: QUANTITIES[name].number(value) for name, value in given.items() if name in QUANTITIES}
    values = {name: value for name, value in given.items() if name not in QUANTITIES}
    variables = Fmu.of(fmu).variables
    for name in values.keys() - variables.keys():
        raise DifferentialError(f"{name}: there is no such variable or quantity{suggestion(name, [*QUANTITIES, *variables])}")
    with Differential({**values, "effects.strength": True}, fmu=fmu) as differential:
        facts = differential.final([*Strength.PARAMETERS, *TEETH, PLANETS, *DRIVES], stop=1e-3)
        teeth = int(facts[TEETH[0]]), int(facts[TEETH[1]])
        events = read_cycle(cycle, differential.fmu, vehicle, teeth, facts) if isinstance(cycle, (str, Path)) else list(cycle)
        if not any(event.count > 0.0 for event in events):
            raise DifferentialError("count: no event of the cycle occurs; give one a count above 0")
        damages = tuple(mapper(partial(_evaluated, differential=differential, teeth=teeth), events))
    # both roots follow one force, so that the ratio is the same in all events under load
    ratio = next((damage.side_ratio for damage in damages if np.isfinite(damage.side_ratio)), 1.0)
    strength = Strength.of(facts)
    histories, counts = [damage.standing for damage in damages], [event.count for event in events]
    slow = count_slow_cycles(histories, counts, order, GATE * strength.bending.strength)
    by_event = np.stack([_slow_by_event(cycles, strength, len(events)) for cycles in (slow, slow.scaled(ratio))], axis=1)
    return SpectrumResult(damages, slow, by_event, strength, teeth, int(facts[PLANETS]), ratio, order)


def _evaluated(event, differential, teeth):
    try:
        return evaluate(event, differential, teeth)
    except DifferentialError as failure:
        raise DifferentialError(f"event {event.name!r}: {failure}") from None


def _slow_by_event(cycles, strength, events):
    """Damage of slow cycles at the root of the worse flank, shape (events,): that of each cycle is shared in proportion to the
    stresses of the events at its ends."""
    damage = cycles.count * strength.bending.damage(cycles.pulsating(strength))
    found = np.zeros(events)
    share = abs(cycles.low) / (abs(cycles.low) + abs(cycles.high))
    np.add.at(found, cycles.low_event, damage * share)
    np.add.at(found, cycles.high_event, damage * (1.0 - share))
    return found


def _of_scene(scene, fmu):
    if scene is None:
        return {}
    # events begin in their steady state, not as the scene does
    return {name: value for name, value in Scene.load(scene, fmu).values.items() if name != "scene.start"}
