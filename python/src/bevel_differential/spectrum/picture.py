"""Picture of a duty cycle: damage by event, and the load spectrum of the critical mode with its S–N curve. A `result` is a
`SpectrumResult`."""

from pathlib import Path
from typing import Any

import numpy as np

from ..panel import BLUE, OCHRE, Axis, Mark, Panel, curve as drawn_curve, picture
from ..readable import plain
from ..values import FileName
from .slow import SnCurve

MPA = 1e6
# maximum number of events with separate bars, and their smallest share of the damage; all others share a bar
MOST_BARS, LEAST_SHARE = 15, 1e-3


def draw(result: Any, file: FileName) -> Path:
    """Draws a `SpectrumResult` into `file`; returns its path."""
    picture([[_events(result), _spectrum(result)]], _caption(result), file, 6.0)
    return Path(file)


def _events(result):
    """Bars of the damage by event, the worst event at the top, and the cumulative damage."""
    table = result.table()
    named = max(1, min(MOST_BARS, np.count_nonzero(table["share"] >= LEAST_SHARE)))
    names, shares = list(table["event"][:named]), 100.0 * table["share"][:named]
    if named < len(table):
        names.append(f"{len(table) - named} others")
        shares = np.append(shares, 100.0 * table["share"][named:].sum())
    heights = np.arange(len(names))
    return Panel("share of the damage per duty cycle, %", "", [
        Mark("barh", heights, shares, color=BLUE, label="of the event"),
        drawn_curve(np.cumsum(shares), heights, "cumulative", "black", "o-", markersize=3, linewidth=1),
        Mark("set_yticks", heights, names), Mark("invert_yaxis")],
        f"Damage by event: {result.critical_name}", legend="center", grid="x", xlim=(0.0, 105.0))


def _spectrum(result):
    """Stress over the number of load cycles in one life that reach it, with the S–N curve."""
    duty_cycles = result.cycles_to_failure if np.isfinite(result.cycles_to_failure) else 1.0
    parts = [("of rolling teeth", BLUE, rolling_spectrum(result)), ("of standing teeth", OCHRE, standing_spectrum(result))]
    parts = [part for part in parts if len(part[2][0])]
    highest = max((part[2][0].max() for part in parts), default=1e9)
    stresses = np.linspace(0.02, 1.3, 300) * highest
    marks = []
    for label, colour, (stress, count) in parts:
        order = np.argsort(-stress)
        reached = np.cumsum(count[order]) * duty_cycles
        # a last point at 0 draws the edge of the last step
        marks.append(Mark("step", [0.1, *reached, reached[-1]], [stress.max(), *stress[order], 0.0], where="pre", color=colour, label=label))
    marks.append(drawn_curve(curve(result).life(stresses), stresses, "S–N curve", "black", "--", linewidth=1))
    quantity = "rated contact pressure" if result.is_flank else "root stress of a pulsating cycle"
    return Panel("cycles at this stress or above, in one life", Axis(f"{quantity}, MPa", lambda stress: stress / MPA), marks,
                 f"Load spectrum: {result.critical_name}", xscale="log", xlim=(1.0, 1e13), ylim=(0.0, 1.3 * highest / MPA))


def _caption(result):
    if not np.isfinite(result.cycles_to_failure):
        return "No event does any damage."
    if not result.rolls:
        return "No event rolls the planets, so only changes of torque damage the roots, and no life follows from durations."
    worst = result.table()[0]
    km = f" or {plain(result.life_km)} km" if np.isfinite(result.life_km) else ""
    return (f"By Miner's rule, the {result.critical_name} fails after {plain(result.cycles_to_failure)} duty cycles: "
            f"{plain(result.life_hours)} h{km}. \"{worst['event']}\" does {100.0 * worst['share']:.0f} % of the damage. "
            "The stress nearest to its S–N curve does most of the damage.")


def curve(result: Any) -> SnCurve:
    """S–N curve of the critical mode."""
    return result.strength.pitting if result.is_flank else result.strength.bending


def rolling_spectrum(result: Any) -> tuple[np.ndarray, np.ndarray]:
    """Stresses [Pa] of rolling teeth and their numbers of load cycles on the worst tooth of the critical gear in a duty cycle; shapes
    (cycles,). The stress is the pulsating root stress of equal damage or, for flanks, the rated contact pressure. Each event that is not
    steady has one stress, its largest, with the number of cycles that does its damage."""
    gear, teeth = result.critical % 2, result.worst_teeth
    if result.is_flank:
        stresses, counts = teeth.pressures[gear].ravel(), teeth.counts[gear].ravel()
    else:
        stresses, counts = teeth.rolling[gear].pulsating(result.strength), teeth.rolling[gear].count
    damage = np.array([one.event.count * one.meshing[result.critical] for one in result.events])
    others = [one for one, sum_ in zip(result.events, damage) if sum_ > 0.0]
    if result.is_flank:
        largest = np.array([result.strength.pitting.strength / one.safety_flank for one in others])
    else:
        largest = np.array([one.root_stress[gear] for one in others])
    stresses = np.concatenate([stresses, largest])
    counts = np.concatenate([counts, damage[damage > 0.0] / curve(result).damage(largest)])
    is_loaded = (counts > 0.0) & (stresses > 0.0)
    return stresses[is_loaded], counts[is_loaded]


def standing_spectrum(result: Any) -> tuple[np.ndarray, np.ndarray]:
    """Pulsating root stress [Pa] of the slow cycles at the worse fillet of the critical gear, and their counts in a duty cycle.
    Both are empty for flanks, because slow cycles do not damage flanks."""
    if result.is_flank:
        return np.empty(0), np.empty(0)
    slow = result.worst_teeth.slow[result.critical % 2]
    return slow.pulsating(result.strength), slow.count
