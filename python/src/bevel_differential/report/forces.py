"""Force histories of the meshes, with the stretches in which teeth are in the lash."""

import numpy as np

from . import style, words
from .blocks import Picture, Section
from .simulated import Simulated

# inches
PANEL = 1.9
SIDES = ("left", "right")


def section(run: Simulated) -> Section:
    """A panel for each planet."""
    found = Section("forces", "Forces of the meshes")
    if not run.has_teeth:
        found.say("Ideal gears have no teeth, so that no mesh has a force or a lash.")
        return found
    planets = range(1, int(run.value("geometry.planet_count")) + 1)
    alike = [i for i in planets if i > 1 and all(np.array_equal(run.series(_name(i, side)), run.series(_name(1, side)))
                                                 for side in SIDES)]
    drawn = [i for i in planets if i not in alike]
    found.add(Picture("forces", _draw(run, drawn), _caption(run, drawn, alike)))
    return found


def _name(planet, side):
    return f"planet[{planet}].{side}_normal_force"


@style.drawn("forces")
def _draw(picture, run, planets):
    picture.set_figheight(PANEL * 2 * len(planets) + 0.6)
    scale, unit = style.kilo([run.series(_name(planet, side)) for planet in planets for side in SIDES])
    axes = picture.subplots(2 * len(planets), 1, sharex=True, sharey=True, squeeze=False)[:, 0]
    for panel, (planet, side) in zip(axes, [(planet, side) for planet in planets for side in SIDES]):
        force = run.series(_name(planet, side))
        for begin, end in bands(run.time, force):
            panel.axvspan(begin, end, color=style.OCHRE, alpha=0.25, lw=0)
        panel.plot(run.time, force / scale, color=style.BLUE if side == "left" else style.RED)
        panel.set(title=f"planet {planet} with the {side} side gear", ylabel=f"normal force, {unit}N")
    axes[0].set_xlim(run.time[0], run.time[-1])
    axes[-1].set_xlabel("time, s")


def _caption(run, drawn, alike):
    parts = []
    for planet in drawn:
        for side in SIDES:
            force = run.series(_name(planet, side))
            k = int(np.argmax(force))
            free = bands(run.time, force)
            lash = "never in the lash" if not free else (f"in the lash {words.percent(share(run.time, free), 2)} of the time, "
                                                         f"{len(free)} stretch{'es' if len(free) > 1 else ''}")
            parts.append(f"planet {planet} {side} up to {words.quantity(force[k], 'N')} at {words.quantity(run.time[k], 's')}, "
                         f"{lash}")
    same = f" Planet{'s' if len(alike) > 1 else ''} {words.listed(map(str, alike))}: the same to the last bit." if alike else ""
    return (f"Normal force, its tooth pairs summed; shaded where neither drive nor coast flanks carry, as the points of every "
            f"{words.quantity(1e3 * run.scene.step, 'ms')} tell. {'; '.join(parts)}.{same}")


def bands(times: np.ndarray, force: np.ndarray) -> list[tuple[float, float]]:
    """Stretches of time (s) in which a mesh carries nothing, neither on its drive nor on its coast flanks.

    `force`: normal force of the mesh at `times`, N; a mesh in the lash has exactly none. A stretch reaches to the middle between
    points with and without load, as more is not known."""
    free = force == 0.0
    edges = np.flatnonzero(np.diff(free.astype(int)))
    middles = 0.5 * (times[edges] + times[edges + 1])
    ends = np.concatenate([[times[0]] if free[0] else [], middles, [times[-1]] if free[-1] else []])
    return [(float(begin), float(end)) for begin, end in ends.reshape(-1, 2)]


def share(times: np.ndarray, found: list[tuple[float, float]]) -> float:
    """Part of the time that they take."""
    return sum(end - begin for begin, end in found) / (times[-1] - times[0])
