"""Rated stresses with their strengths (docs/inside/theory.md, section 10), and safety. Warns if safety and damage belong to the start, when
unloaded teeth met their load with an impact."""

import math
from dataclasses import dataclass

import numpy as np

from ..panel import Axis, Mark, Panel, curve
from . import words
from .blocks import Section, Table
from .simulated import Simulated
from .svg_style import BLUE, OCHRE, RED, picture

MPA = 1e6
LABELS = {"stress.contact_rated": ("flanks: rated contact pressure", BLUE),
          "stress.root_planet_max": ("roots of the planets", OCHRE),
          "stress.root_side_max": ("roots of the side gears", RED)}
RATED = (("safety.root_min", "safety factor of the roots S_F, smallest so far"),
         ("safety.flank_min", "safety factor of the flanks S_H, smallest so far"),
         ("damage.planet", "Miner sum of the roots, worst tooth of the planets"), ("damage.side", "Miner sum of the roots, worst tooth of the side gears"),
         ("damage.planet_flank", "Miner sum of pitting, worst flank of the planets"),
         ("damage.side_flank", "Miner sum of pitting, worst flank of the side gears"))
# prefix of the FMU's message if ratings count a start out of equilibrium
MESSAGE = "strength.rate_from: "
# the start counts as the worst part if the factor of the remaining run is better by at least this ratio
BETTER = 1.1


@dataclass(frozen=True)
class Limited:
    """Stress over time and its limit, Pa; `output`: name of the stress."""

    output: str
    stress: np.ndarray
    limit: np.ndarray

    def worst(self) -> int:
        """Index of the point at which stress over limit is largest."""
        return int(np.argmax(self.stress / self.limit))


def limits(run: Simulated) -> tuple[Limited, ...]:
    """Stresses and limits of the flanks, the roots of the planets, and the roots of the side gears."""
    bending, contact = (np.full(len(run.time), float(run.value(f"strength.{kind}_strength"))) for kind in ("bending", "contact"))
    # teeth of planets that roll are loaded on both flanks
    planets = np.where(bend_both_ways(run), float(run.value("strength.idler_factor")), 1.0) * bending
    return tuple(Limited(name, run.series(name), limit) for name, limit in zip(LABELS, (contact, planets, bending)))


def bend_both_ways(run: Simulated) -> np.ndarray:
    """True for each point from which on a planet has rolled over half a revolution, so that its teeth have met both side gears."""
    found = np.zeros(len(run.time), dtype=bool)
    for planet in range(1, int(run.value("geometry.planet_count")) + 1):
        angle = run.series(f"planet[{planet}].spin_angle")
        found |= np.maximum.accumulate(angle) - np.minimum.accumulate(angle) >= math.pi
    return found


def section(run: Simulated) -> Section:
    """Section with the picture and the ratings."""
    found = Section("strength", "Stresses and safety")
    reason = run.refused.get("effects.strength")
    if reason:
        found.say(f"Stresses are not available, as the FMU says: {reason}.")
        return found
    stresses = limits(run)
    if all(np.max(limited.stress) <= 0.0 for limited in stresses):
        found.say("No tooth was loaded at any communication point, so that there is no stress to show.")
    else:
        time = run.time_axis
        panels = [_panel(run, time, stresses[:1], "contact"), _panel(run, time, stresses[1:], "bending")]
        found.add(picture("stress", [[panel] for panel in panels], _caption(run, stresses)))
    rows = [(name, what, words.number(float(run.record[name][-1]))) for name, what in RATED]
    factor = words.number(float(run.value("strength.application_factor")))
    found.add(Table(("output", "meaning", "at the end"), rows,
                    f"Ratings of the whole run by effects.strength, with the application factor {factor}. They see every step "
                    "of the solver, the picture only the communication points; "
                    "1000 is the most that a safety factor shows.", left=2))
    if text := advice(run):
        found.say(text)
    return found


def _panel(run, time, stresses: tuple[Limited, ...], title):
    marks = []
    for limited in stresses:
        label, colour = LABELS[limited.output]
        # the limit at a point describes the step that ends there
        marks += [curve(run.time, limited.stress, label, colour),
                  Mark("step", run.time, limited.limit, where="pre", color=colour, ls="--", lw=1.1, label=f"its limit {_limit(limited)}")]
    top = max(float(np.max([limited.stress, limited.limit])) for limited in stresses) / MPA
    return Panel(time, Axis("stress, MPa", lambda stress: stress / MPA), marks, title, legend="right", ylim=(0.0, 1.12 * top))


def _limit(limited):
    low, high = float(np.min(limited.limit[1:])) / MPA, float(np.max(limited.limit[1:])) / MPA
    return words.quantity(low, "MPa") if low == high else f"{words.number(low)} or {words.quantity(high, 'MPa')}"


def _caption(run, stresses):
    parts = []
    for limited in stresses:
        k = limited.worst()
        parts.append(f"{LABELS[limited.output][0]} {words.quantity(limited.stress[k] / MPA, 'MPa')} at "
                     f"{words.moment(run.time[k], run.time[-1])}, {words.percent(limited.stress[k] / limited.limit[k])} of the limit of {words.quantity(limited.limit[k] / MPA, 'MPa')}")
    highest = float(np.max(run.series("stress.contact_max"))) / MPA
    return (f"Stresses of all teeth that are rated, each with its own limit, at the points at which they come nearest to it: "
            f"{'; '.join(parts)}. Limits are strengths at the knee; teeth of planets that roll over half a revolution bend both ways and "
            "keep "
            f"{words.number(float(run.value('strength.idler_factor')))} of their bending strength (strength.idler_factor). Flanks are "
            "rated as one pair at the inner point of single contact. Where pairs touch nearer to a base circle Hertz's formula gives up "
            f"to {words.quantity(highest, 'MPa')} (stress.contact_max), for which there is no strength.")


def notes(run: Simulated) -> list[str]:
    """Sentences about the roots and the flanks if their smallest safety factor belongs to the start; otherwise none."""
    if not any(warning.startswith(MESSAGE) for warning in run.warnings):
        return []
    bending, contact = (float(run.value(f"strength.{kind}_strength")) for kind in ("bending", "contact"))
    planet = float(run.value("strength.idler_factor")) * bending
    found = []
    for what, name, stresses in (("roots", "safety.root_min", {"stress.root_planet_max": planet, "stress.root_side_max": bending}),
                                 ("flanks", "safety.flank_min", {"stress.contact_rated": contact})):
        factor, half = run.series(name), len(run.time) // 2
        least = factor[-1]
        # the factor never rises, so it has its smallest value from here on
        moment = int(np.argmax(factor <= least * (1.0 + 1e-6)))
        largest = max(float(np.max(run.series(stress)[half:])) / strength for stress, strength in stresses.items())
        if moment < half and largest > 0.0 and 1.0 / largest > BETTER * least:
            found.append(f"The smallest safety factor of the {what}, {words.number(float(least), 3)}, is in the start, before "
                         f"{words.quantity(1e3 * float(run.time[moment]), 'ms', 3)}; from the middle of the run on the communication "
                         f"points have {words.number(1.0 / largest, 3)} or more.")
    return found


def advice(run: Simulated) -> str:
    """Text of `notes` with the remedy; empty if the start is not the worst part of the run."""
    found = notes(run)
    if not found:
        return ""
    return " ".join([*found, "This start is not in equilibrium, and damage counts its blow as well: strength.rate_from lets "
                             "ratings begin after the run-in, scene.start = equilibrium has none."])


def where(run: Simulated) -> str:
    """Addition to values of the whole run that belong to the start."""
    return " (in the start, see stresses and safety)" if notes(run) else ""
