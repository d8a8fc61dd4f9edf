"""Force histories of the meshes, with the intervals in which teeth are in the backlash. Also the transmission error of planet 1's
left mesh, over time and by orders of the mesh."""

from itertools import pairwise

import numpy as np

from ..panel import Axis, Mark, Panel, curve, scaled_axis
from ..values import DifferentialError
from ..want import COARSEST, figures, mean_over_time
from . import words
from .blocks import Section
from .simulated import Simulated
from .svg_style import BLUE, GREEN, OCHRE, RED, picture

# height of a panel, inches
PANEL = 1.9
SIDES = ("left", "right")
SIGNAL, ANGLE = "planet[1].left_transmission_error", "planet[1].spin_angle"
HIGHEST = 12
UM = 1e6


def section(run: Simulated) -> Section:
    """Section with a panel for each planet and side."""
    found = Section("forces", "Forces of the meshes")
    if not run.has_teeth:
        found.say("Ideal gears have no teeth, so that no mesh has a force or a lash.")
        return found
    planets = range(1, int(run.value("geometry.planet_count")) + 1)
    alike = [i for i in planets if i > 1 and all(np.array_equal(run.series(_name(i, side)), run.series(_name(1, side)))
                                                 for side in SIDES)]
    drawn = [i for i in planets if i not in alike]
    rows = _panels(run, drawn)
    found.add(picture("forces", rows, _caption(run, drawn, alike), PANEL * len(rows) + 0.6))
    return found


def _name(planet, side):
    return f"planet[{planet}].{side}_normal_force"


def _panels(run, planets):
    meshes = [(planet, side, run.shown(_name(planet, side))) for planet in planets for side in SIDES]
    time, axis = run.time_axis, scaled_axis("normal force", run.unit(_name(1, "left")), [force for *_, force in meshes])
    return [[Panel(time, axis, [*(Mark("axvspan", begin, end, color=OCHRE, alpha=0.25, lw=0) for begin, end in bands(run.time, force)),
                                curve(run.time, force, None, BLUE if side == "left" else RED)],
                   f"planet {planet} with the {side} side gear", xmargin=0.0)] for planet, side, force in meshes]


def _caption(run, drawn, alike):
    parts = []
    for planet in drawn:
        for side in SIDES:
            force = run.shown(_name(planet, side))
            k = int(np.argmax(force))
            free = bands(run.time, force)
            lash = "never in the lash" if not free else (f"in the lash {words.percent(share(run.time, free), 2)} of the time, "
                                                         f"{len(free)} stretch{'es' if len(free) > 1 else ''}")
            parts.append(f"planet {planet} {side} up to {words.quantity(force[k], run.unit(_name(planet, side)))} at "
                         f"{words.moment(run.time[k], run.time[-1])}, {lash}")
    same = f" Planet{'s' if len(alike) > 1 else ''} {words.listed(map(str, alike))}: the same to the last bit." if alike else ""
    return (f"Normal force, summed over tooth pairs; shaded if neither drive nor coast flanks are loaded, at communication points every "
            f"{words.quantity(1e3 * run.scene.step, 'ms')}. {'; '.join(parts)}.{same}")


def bands(times: np.ndarray, force: np.ndarray) -> list[tuple[float, float]]:
    """Time intervals in which a mesh is unloaded, on both its drive and its coast flanks, in the unit of `times`.

    `force`: normal force of the mesh at `times`, N; in the backlash it is exactly zero. An interval ends in the middle between a point
    with and a point without load, because the record has no points between them."""
    free = force == 0.0
    edges = np.flatnonzero(np.diff(free.astype(int)))
    middles = 0.5 * (times[edges] + times[edges + 1])
    ends = np.concatenate([[times[0]] if free[0] else [], middles, [times[-1]] if free[-1] else []])
    return [(float(begin), float(end)) for begin, end in ends.reshape(-1, 2)]


def share(times: np.ndarray, found: list[tuple[float, float]]) -> float:
    """Fraction of the time in these intervals."""
    return sum(end - begin for begin, end in found) / (times[-1] - times[0])


def transmission_error(run: Simulated) -> Section:
    """Section with the picture, or with the reason for its absence."""
    found = Section("error", "Transmission error and its orders")
    if not run.has_teeth:
        found.say("Ideal gears do not deflect: there is no transmission error.")
        return found
    try:
        part = rolling(run.time, run.series(ANGLE), int(run.value("geometry.planet_teeth")))
        orders, sizes = spectrum(run, part)
    except DifferentialError as reason:
        found.add(picture("error", [_error_panels(run)], _over_time(run), 2.6))
        found.say(f"There are no orders of the mesh: {reason}.{' The run-up, which --quick leaves out, has them.' if run.has_pairs else ''}")
        return found
    found.add(picture("error", [_error_panels(run, part, orders, UM * sizes)], f"{_over_time(run)} {_by_order(run, part, orders, sizes)}", 3.0,
                      width_ratios=[1.6, 1]))
    return found


def rolling(times: np.ndarray, angle: np.ndarray, teeth: int) -> slice:
    """Longest interval in which the planet turns in one direction, by at least one pitch. Raises `DifferentialError` with the reason."""
    # the second row of a jump is not a standstill
    rows = np.flatnonzero(np.append(True, np.diff(times) > 0.0))
    sense = np.sign(np.diff(angle[rows]))
    edges = rows[np.concatenate([[0], np.flatnonzero(np.diff(sense)) + 1, [len(sense)]])]
    best, turned = slice(0, 0), 0.0
    for begin, end in pairwise(edges):
        if abs(angle[end] - angle[begin]) > turned:
            best, turned = slice(int(begin), int(end) + 1), abs(float(angle[end] - angle[begin]))
    pitches = turned * teeth / (2.0 * np.pi)
    if pitches < 1.0:
        what = ("the planets stand still on their pins" if pitches < 1e-3 else
                f"the planets turn by {words.number(pitches, 2)} of a pitch at most before they stop or turn back")
        raise DifferentialError(f"{what}, and a period of the mesh is one pitch")
    return best


def spectrum(run: Simulated, part: slice) -> tuple[np.ndarray, np.ndarray]:
    """Amplitudes (m) of whole orders of the mesh over the last whole mesh cycles of an interval: (orders, amplitudes)."""
    teeth = int(run.value("geometry.planet_teeth"))
    phase, values = run.series(ANGLE)[part] * teeth, run.series(SIGNAL)[part]
    coarsest = float(np.abs(np.diff(phase)).max())
    highest = min(HIGHEST, int(COARSEST / coarsest))
    if highest < 1:
        raise DifferentialError(f"a period of the mesh has only {2.0 * np.pi / coarsest:.1f} points of the record; the scene's "
                                "step is too long")
    orders = np.arange(1, highest + 1)
    return orders, np.array(figures([f"mesh_order_{order}" for order in orders], run.time[part], values, phase))


def _error_panels(run, part=None, orders=None, sizes=None):
    marks = [curve(run.time, run.series(SIGNAL), None, BLUE)]
    panels = [Panel(run.time_axis, Axis("transmission error, µm", lambda error: UM * error), marks, "planet 1 with the left side gear")]
    if part is not None:
        marks.append(Mark("axvspan", *run.time[part][[0, -1]], color=GREEN, alpha=0.12, lw=0))
        # a logarithmic axis within a decade has no round numbers for its labels
        look = {"yscale": "log", "ylim": (max(sizes.min(), 1e-4 * sizes.max()) * 0.5, sizes.max() * 2.0)} if sizes.max() > 10.0 * sizes.min() else {}
        panels.append(Panel("order of the mesh", "amplitude, µm", [Mark("bar", orders, sizes, color=BLUE, width=0.5)], "orders", xticks=orders,
                            **look))
    return panels


def _over_time(run):
    error = UM * run.series(SIGNAL)
    touches = error > 0.0
    lifted = (f"; below 0, {words.percent(mean_over_time(error < 0.0, run.time), 2)} of the time, the drive flanks are apart"
              if error.min() < 0.0 else "")
    if not np.any(touches):
        return f"Approach of the drive flanks: they never touch, {words.number(-error.max(), 3)} µm apart at least."
    mean = mean_over_time(error * touches, run.time) / mean_over_time(touches, run.time)
    return (f"Approach of the drive flanks at the mean cone distance: {words.quantity(mean, 'µm')} on the "
            f"mean while they touch, {words.quantity(error.max(), 'µm')} at most{lifted}.")


def _by_order(run, part, orders, sizes):
    teeth = int(run.value("geometry.planet_teeth"))
    angle = run.series(ANGLE)[part]
    cycles = int(abs(angle[-1] - angle[0]) * teeth / (2.0 * np.pi))
    mesh = abs(float((angle[-1] - angle[0]) / (run.time[part][-1] - run.time[part][0]))) * teeth / (2.0 * np.pi)
    top = int(np.argmax(sizes))
    first = "" if top == 0 else f"; order 1 has {words.quantity(UM * sizes[0], 'µm', 3)}"
    return (f"Right: amplitudes over the last {cycles} whole mesh cycles of the shaded stretch, in which the planets roll one "
            f"way ({words.quantity(mesh, 'Hz')} on the mean). The largest is order {orders[top]} with "
            f"{words.quantity(UM * sizes[top], 'µm', 3)}{first}.")
