"""The waterfall of a run-up: orders of the transmission error against speed, with the orders that theory expects."""

import numpy as np

from ..answers import Progress
from ..progress import silent
from ..values import DifferentialError
from . import style, words
from .blocks import Picture, Section, Table
from .orders import Waterfall, waterfall
from .runup import ANGLE, FASTEST, MULTIPLES, RING, SIGNAL, SLOWEST, RunUp, run_up, theory
from .simulated import Simulated, reason_of

# turns of a planet in a window: lines are 1/8 of an order apart
WINDOW = 8
# lines that are listed, and how far below the strongest they may be
STRONGEST, FLOOR = 8, 2e-3
# decades of amplitude that colours show
DECADES = 3.0
UM, RPM = 1e6, 30.0 / np.pi


def section(run: Simulated, progress: Progress = silent) -> Section:
    """The picture and the table of orders, or why there are none."""
    found = Section("waterfall", "Waterfall of a run-up")
    if not run.has_pairs:
        found.say(f"With scene.gear_contact = {run.literal('scene.gear_contact')} there are no single tooth pairs, so that "
                  "nothing is excited at mesh orders, at any speed.")
        return found
    progress(0.0, "the run-up")
    try:
        up = run_up(run, progress)
        expected = theory(run, up.ratio)
        spectra = waterfall(up.record[ANGLE], up.record[SIGNAL], np.abs(up.record["carrier.speed"]), WINDOW, _highest(expected))
    except DifferentialError as reason:
        found.say(f"The run-up could not be made: {reason_of(reason)}.")
        return found
    found.say(_how(up))
    found.add(Picture("waterfall", _draw(run, spectra, expected), _caption(run, up, spectra, expected)))
    found.add(_table(run, spectra, expected))
    return found


def _highest(expected):
    return 1.06 * max(expected.values())


def _how(up: RunUp):
    told = f" Unlike in the scene, {words.listed(up.changed)}." if up.changed else ""
    return (f"A second simulation of the same gears, law and effects. The carrier is driven from {words.number(SLOWEST * RPM)} "
            f"to {words.quantity(FASTEST * RPM, 'rpm')} in {words.quantity(up.seconds, 's', 3)}; planets spin at "
            f"{words.number(up.ratio, 3)} of its speed, as imposed. Half-shafts carry {words.number(up.loads[0])} (left) and "
            f"{words.quantity(up.loads[1], 'N·m')} (right).{told} The signal is the transmission error of planet 1 with the "
            "left side gear: loads are imposed, which leaves little to see in the forces of the mesh, while the deflection "
            "shows every change of stiffness. It is resampled over the planet's angle, so that orders stand upright.")


@style.drawn("waterfall", 5.2)
def _draw(picture, run, spectra: Waterfall, expected):
    from matplotlib.colors import LogNorm

    sizes = UM * spectra.amplitudes
    top = float(sizes.max())
    upper, lower = picture.subplots(2, 1, sharex=True, height_ratios=[2.4, 1])
    edges = np.append(spectra.orders, spectra.orders[-1] + spectra.resolution) - 0.5 * spectra.resolution
    mesh = upper.pcolormesh(edges, _edges(spectra.speeds * RPM), np.maximum(sizes, 1e-12), cmap="magma",
                            norm=LogNorm(10.0 ** -DECADES * top, top), rasterized=True)
    upper.set(ylabel="carrier speed, rpm")
    upper.grid(False)
    bar = picture.colorbar(mesh, ax=upper, pad=0.01, aspect=30, extend="min")
    bar.set_label("amplitude, µm")
    mean = UM * spectra.mean
    lower.semilogy(spectra.orders, mean, color=style.BLUE)
    teeth = float(run.value("geometry.planet_teeth"))
    marks = upper.secondary_xaxis("top")
    marks.set_xticks(list(expected.values()), [RING if name.startswith(RING) else f"{order / teeth:.0f} × {teeth:.0f}"
                                               for name, order in expected.items()], fontsize=8.5)
    for name, order in expected.items():
        lower.axvline(order, color=style.GREEN if name.startswith(RING) else style.RED, lw=0.9, ls="--")
    lower.set(xlabel="order: periods per turn of a planet", ylabel="rms over speeds, µm", xlim=(0.0, spectra.orders[-1]),
              ylim=(10.0 ** -(DECADES + 0.5) * mean.max(), 2.0 * mean.max()))


def _edges(centres):
    middles = 0.5 * (centres[1:] + centres[:-1])
    return np.concatenate([[2.0 * centres[0] - middles[0]], middles, [2.0 * centres[-1] - middles[-1]]])


def _caption(run, up, spectra, expected):
    order, size = spectra.strongest(1, FLOOR)[0]
    at = int(np.argmin(np.abs(spectra.orders - order)))
    course = UM * spectra.amplitudes[:, at]
    k = int(np.argmax(course))
    marks = "on top and red, multiples of the mesh order" + (
        "; green, the teeth of the ring gear" if run.value("effects.final_drive") else "")
    return (f"{len(spectra.speeds)} spectra (Hann) of {WINDOW} turns of the planet each, out of {words.number(up.turns)}; "
            f"lines are {words.number(spectra.resolution)} apart. The strongest line is order {words.number(order)}, "
            f"{words.quantity(UM * size, 'µm', 3)} in the mean square over all speeds: from {words.number(course.min(), 3)} to "
            f"{words.quantity(course[k], 'µm', 3)}, the most at {words.quantity(spectra.speeds[k] * RPM, 'rpm', 3)}. Theory "
            f"has no free constant: {marks}.")


def _table(run, spectra, expected):
    rows, farthest = [], 0.0
    side = float(run.value("geometry.planet_teeth")) / float(run.value("geometry.side_teeth"))
    for order, size in spectra.strongest(STRONGEST, FLOOR):
        name, theirs = min(_named(run, expected, side, order), key=lambda pair: abs(pair[1] - order))
        apart = abs(order - theirs)
        farthest = max(farthest, apart / spectra.resolution)
        named = name if apart <= spectra.resolution else f"no order; nearest: {name}"
        rows.append((words.number(order, 5), words.number(UM * size, 3), named, words.number(theirs, 5),
                     f"{words.number(apart / spectra.resolution, 2)} lines"))
    verdict = ("all within one line of it" if farthest <= 1.0 else
               f"not all within one line of it: the farthest is {words.number(farthest, 3)} lines away")
    return Table(("found, order", "rms, µm", "theory", "order", "apart"), rows,
                 f"The strongest lines down to {words.percent(FLOOR)} of the highest, and the nearest order of theory: "
                 f"{verdict}. A line is {words.number(spectra.resolution)} of an order wide, and the window spreads a pure "
                 "tone over two on either side.", left=0)


def _named(run, expected, side, order):
    """Orders of theory near an order, with names; turns of single gears beside those of the mesh, where teeth are not alike."""
    teeth = int(run.value("geometry.planet_teeth"))
    nearest = max(1, round(order / teeth))
    named = [*expected.items(), (f"mesh {nearest} × {teeth}", float(nearest * teeth))]
    if run.value("effects.final_drive"):
        ring = expected[next(name for name in expected if name.startswith(RING))]
        named += [(f"mesh {k} × {teeth} {'+' if sign > 0 else '−'} ring gear", abs(k * teeth + sign * ring))
                  for k in range(1, 2 * MULTIPLES) for sign in (1, -1)]
    if run.value("effects.tooth_errors") or run.value("effects.tooth_fault"):
        for gear, unit in (("planet", 1.0), ("side gear", side)):
            count = round(order / unit)
            named.append((f"{count} turn{'s' if count != 1 else ''} of the {gear}", count * unit))
    return named
