"""Whether safety and damage of a run are those of its start, where teeth that carried nothing met their load with a blow."""

import numpy as np

from . import words
from .simulated import Simulated

# what the FMU's message begins with where ratings count a start out of equilibrium
MESSAGE = "strength.rate_from: "
# by how much the rest of the run must be better for the start to be the worst of it
BETTER = 1.1


def notes(run: Simulated) -> list[str]:
    """A sentence for each of roots and flanks whose smallest safety factor is in the start; none where none is."""
    if not any(warning.startswith(MESSAGE) for warning in run.warnings):
        return []
    bending, contact = (float(run.value(f"strength.{kind}_strength")) for kind in ("bending", "contact"))
    planet = float(run.value("strength.idler_factor")) * bending
    found = []
    for what, name, stresses in (("roots", "safety.root_min", {"stress.root_planet_max": planet, "stress.root_side_max": bending}),
                                 ("flanks", "safety.flank_min", {"stress.contact_rated": contact})):
        factor, half = run.series(name), len(run.time) // 2
        least = factor[-1]
        # the factor only falls: it is the smallest from here on
        moment = int(np.argmax(factor <= least * (1.0 + 1e-6)))
        largest = max(float(np.max(run.series(stress)[half:])) / strength for stress, strength in stresses.items())
        if moment < half and largest > 0.0 and 1.0 / largest > BETTER * least:
            found.append(f"The smallest safety factor of the {what}, {words.number(float(least), 3)}, is in the start, before "
                         f"{words.quantity(1e3 * float(run.time[moment]), 'ms', 3)}; from the middle of the run on the communication "
                         f"points have {words.number(1.0 / largest, 3)} or more.")
    return found


def advice(run: Simulated) -> str:
    """The same with what helps; empty where the start is not the worst of the run."""
    found = notes(run)
    if not found:
        return ""
    return " ".join([*found, "This start is not in equilibrium, and damage counts its blow as well: strength.rate_from lets "
                             "ratings begin after the run-in, scene.start = equilibrium has none."])


def where(run: Simulated) -> str:
    """What to add to figures of the whole run."""
    return " (in the start, see stresses and safety)" if notes(run) else ""
