"""Stresses with their strengths, and safety."""

import numpy as np

from . import run_in, style, words
from .blocks import Picture, Section, Table
from .simulated import Simulated

MPA = 1e6
STRESSES = (("stress.contact_max", "strength.contact_strength", "flanks: largest Hertz pressure", style.BLUE),
            ("stress.root_planet_max", "strength.bending_strength", "roots of the planets", style.OCHRE),
            ("stress.root_side_max", "strength.bending_strength", "roots of the side gears", style.RED))
RATED = (("safety.root_min", "safety factor of the roots S_F, smallest so far"),
         ("safety.flank_min", "safety factor of the flanks S_H, smallest so far"),
         ("damage.planet", "Miner sum of the roots, worst planet"), ("damage.side", "Miner sum of the roots, worse side gear"),
         ("damage.planet_flank", "Miner sum of pitting, worst planet"), ("damage.side_flank", "Miner sum of pitting, worse side "
                                                                                              "gear"))


def section(run: Simulated) -> Section:
    """The picture and the ratings."""
    found = Section("strength", "Stresses and safety")
    reason = run.refused.get("effects.strength")
    if reason:
        found.say(f"Stresses are not available, as the FMU says: {reason}.")
        return found
    if all(np.max(run.series(name)) <= 0.0 for name, *_ in STRESSES):
        found.say("No tooth was loaded at any communication point, so that there is no stress to show.")
    else:
        found.add(Picture("stress", _draw(run), _caption(run)))
    rows = [(name, what, words.number(float(run.record[name][-1]))) for name, what in RATED]
    factor = words.number(float(run.value("strength.application_factor")))
    found.add(Table(("output", "meaning", "at the end"), rows,
                    f"Ratings of the whole run by effects.strength, with the application factor {factor}. They see every step "
                    "of the "
                    "solver, the picture only the communication points; 1000 is the most that a safety factor shows.", left=2))
    if advice := run_in.advice(run):
        found.say(advice)
    return found


def _draw(run):
    with style.styled():
        picture = style.figure(4.0)
        upper, lower = picture.subplots(2, 1, sharex=True)
        for panel, rows, title in ((upper, STRESSES[:1], "contact"), (lower, STRESSES[1:], "bending")):
            top = 0.0
            for name, _, label, colour in rows:
                panel.plot(run.time, run.series(name) / MPA, color=colour, label=label)
                top = max(top, float(np.max(run.series(name))) / MPA)
            strength = float(run.value(rows[0][1])) / MPA
            panel.axhline(strength, color=style.GREY, ls="--", lw=1.1, label="strength at the knee "
                                                                             f"{words.quantity(strength, 'MPa')}")
            panel.set(ylabel="stress, MPa", title=title, ylim=(0.0, 1.12 * max(top, strength)))
            panel.legend(loc="center left", bbox_to_anchor=(1.0, 0.5))
        lower.set_xlabel("time, s")
        return style.svg(picture, "stress")


def _caption(run):
    parts = []
    for name, strength, label, _ in STRESSES:
        values = run.series(name)
        k = int(np.argmax(values))
        share = values[k] / float(run.value(strength))
        parts.append(f"{label} up to {words.quantity(values[k] / MPA, 'MPa')} at {words.quantity(run.time[k], 's')}, "
                     f"{words.percent(share)} of "
                     "the strength")
    return f"Largest stresses of all teeth: {'; '.join(parts)}."
