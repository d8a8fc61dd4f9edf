"""Stresses that the rating uses, each with the strength that it is compared with (docs/theory.md, section 10)."""

import math
from dataclasses import dataclass

import numpy as np

from ..spectrum.damage import pushed_along
from .simulated import Simulated

BENDING, CONTACT = "strength.bending_strength", "strength.contact_strength"


@dataclass(frozen=True)
class Limited:
    """A stress over time and its limit then, Pa; `output`: its name, `limit_is`: what the limit is made of."""

    output: str
    stress: np.ndarray
    limit: np.ndarray
    limit_is: str

    def worst(self) -> int:
        """The point at which the stress is the largest part of its limit."""
        return int(np.argmax(self.stress / self.limit))


def limits(run: Simulated) -> tuple[Limited, Limited, Limited]:
    """Flanks, roots of the planets, roots of the side gears."""
    bending, contact = (np.full(len(run.time), float(run.value(name))) for name in (BENDING, CONTACT))
    idler = float(run.value("strength.idler_factor"))
    planets = np.where(rolls(run), idler, 1.0) * bending
    return (Limited("stress.contact_rated", run.series("stress.contact_rated"), contact, CONTACT),
            Limited("stress.root_planet_max", run.series("stress.root_planet_max"), planets,
                    f"{BENDING}, times strength.idler_factor while planets roll"),
            Limited("stress.root_side_max", run.series("stress.root_side_max"), bending, BENDING))


def rolls(run: Simulated) -> np.ndarray:
    """At each point, whether a planet has rolled on since the one before: a tooth pitch of play is no rolling."""
    pitch = 2.0 * math.pi / float(run.value("geometry.planet_teeth"))
    found = np.zeros(len(run.time), dtype=bool)
    for planet in range(1, int(run.value("geometry.planet_count")) + 1):
        found[1:] |= pushed_along(run.series(f"planet[{planet}].spin_angle"), pitch) > 0.0
    return found
