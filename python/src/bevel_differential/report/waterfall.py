"""Waterfall of a run-up: orders of the transmission error against speed, with the orders that theory predicts.

Order tracking resamples a signal from time to an angle, so its spectra count periods per turn."""

from dataclasses import dataclass

import numpy as np

from ..answers import Progress
from ..panel import Axis, Mark, Panel, curve
from ..progress import silent
from ..values import DifferentialError
from . import words
from .blocks import Section, Table
from .runup import ANGLE, FASTEST, JOINT, MULTIPLES, PINION, RING, RUNOUT, SIGNAL, SLOWEST, RunUp, run_up, theory
from .simulated import Simulated, reason_of
from .svg_style import BLUE, GREEN, RED, picture

# turns of a planet in a window: spectral lines are 1/8 of an order apart
WINDOW = 8
# maximum number of listed lines, and their smallest amplitude relative to the strongest
STRONGEST, FLOOR = 8, 2e-3
# decades of amplitude in the colour scale
DECADES = 3.0
UM, RPM = 1e6, 30.0 / np.pi
TURN = 2.0 * np.pi
# points in a period of the highest order: minimum of a record, and of the signal over the angle. The second number is large, so
# that content above the orders of interest is not aliased to them
PER_PERIOD, FINER = 4, 16
# prefixes of the orders of the final drive, and their meaning in the caption
MEANINGS = {RING: "teeth of the ring gear", PINION: "turns of the pinion", RUNOUT: "turns of the ring gear",
            JOINT: "half turns of the joint"}
FINAL = tuple(MEANINGS)
# smallest distance of two labels above the picture, relative to its width
APART = 0.06
# overlap of neighbouring windows
OVERLAP = 0.75


@dataclass(frozen=True)
class Waterfall:
    """Spectra of windows along an angle.

    `orders`: periods per turn, shape (orders,). `speeds`: mean speed in each window, shape (windows,). `amplitudes`: amplitudes of the
    signal, shape (windows, orders). `resolution`: distance of two lines, periods per turn."""

    orders: np.ndarray
    speeds: np.ndarray
    amplitudes: np.ndarray
    resolution: float

    @property
    def mean(self) -> np.ndarray:
        """Root mean square of the amplitudes over all windows, shape (orders,)."""
        return np.sqrt(np.mean(np.square(self.amplitudes), axis=0))

    def strongest(self, count: int, floor: float) -> list[tuple[float, float]]:
        """(order, amplitude) of the strongest peaks above `floor` times the highest, the strongest first. A peak is higher than all lines
        within two lines of it, because the window spreads a pure tone this far."""
        mean = self.mean
        peaks = [k for k in range(2, len(mean) - 2) if mean[k] == max(mean[k - 2:k + 3]) and mean[k] > floor * mean.max()]
        found = sorted(((self._place(k), float(mean[k])) for k in peaks), key=lambda peak: -peak[1])
        return found[:count]

    def _place(self, k):
        """Order of a peak, by a parabola through the logarithms of the peak and its neighbours."""
        low, middle, high = np.log(np.maximum(self.mean[k - 1:k + 2], 1e-300))
        bend = low - 2.0 * middle + high
        return float(self.orders[k] + (0.5 * (low - high) / bend if bend < 0.0 else 0.0) * self.resolution)


def section(run: Simulated, progress: Progress = silent) -> Section:
    """Section with the picture and the table of orders, or with the reason why there are none."""
    found = Section("waterfall", "Waterfall of a run-up")
    if not run.has_pairs:
        found.say(f"With scene.gear_contact = {run.literal('scene.gear_contact')} there are no single tooth pairs, so that "
                  "nothing is excited at mesh orders, at any speed.")
        return found
    progress(0.0, "the run-up")
    try:
        up = run_up(run, progress)
        expected = theory(run, up.ratio)
        spectra = waterfall(up.record[ANGLE], up.record[SIGNAL], np.abs(up.record["carrier.speed"]), WINDOW,
                            1.06 * max(expected.values()))
    except DifferentialError as reason:
        found.say(f"The run-up failed: {reason_of(reason)}.")
        return found
    found.say(_how(up))
    found.add(picture("waterfall", [[panel] for panel in _panels(run, spectra, expected)], _caption(up, spectra, expected), 5.2,
                      height_ratios=[2.4, 1]))
    found.add(_table(run, spectra, expected))
    return found


def _how(up: RunUp):
    unlike_scene = f" Unlike in the scene, {words.listed(up.changed)}." if up.changed else ""
    return (f"A second simulation of the same gears, law and effects. The carrier turns from {words.number(SLOWEST * RPM)} "
            f"to {words.quantity(FASTEST * RPM, 'rpm')} in {words.quantity(up.seconds, 's', 3)}, and the planets spin at "
            f"{words.number(up.ratio, 3)} of its speed. {_drives(up)} Half-shafts "
            f"carry {words.number(up.loads[0])} (left) and "
            f"{words.quantity(up.loads[1], 'N·m')} (right) on the mean.{unlike_scene} The signal is the transmission error of planet 1 "
            "with the left side gear: loads are imposed, which leaves little to see in the forces of the mesh, while the deflection "
            "shows every change of stiffness. It is resampled over the planet's angle, so that orders are vertical lines.")


def _drives(up):
    imposed = f"Imposed are {words.listed(up.imposed)}{'' if up.is_driven_otherwise else ', as in the scene'}."
    return f"{imposed} The planets are free." if up.spins_freely else (
        f"{imposed} The planets then turn in step, so that mesh orders in which they are out of phase cancel.")


def _panels(run, spectra: Waterfall, expected):
    from matplotlib.colors import LogNorm

    orders, teeth = spectra.orders, float(run.value("geometry.planet_teeth"))
    top, highest = UM * float(spectra.amplitudes.max()), UM * spectra.mean.max()
    edges = np.append(orders, orders[-1] + spectra.resolution) - 0.5 * spectra.resolution
    names = _labels(expected, teeth, APART * orders[-1])
    axis = Axis("order: periods per turn of a planet")
    yield Panel(axis, Axis("carrier speed, rpm", lambda speed: speed * RPM), [
        Mark("pcolormesh", edges, _edges(spectra.speeds), np.maximum(UM * spectra.amplitudes, 1e-12), cmap="magma_r",
             norm=LogNorm(10.0 ** -DECADES * top, top), rasterized=True, bar={"label": "amplitude, µm", "extend": "min"}),
        Mark(lambda axes: axes.secondary_xaxis("top").set_xticks(list(expected.values()), names, fontsize=8.5))], grid="")
    yield Panel(axis, Axis("rms over speeds, µm", lambda size: UM * size), [
        curve(orders, spectra.mean, None, BLUE),
        *(Mark("axvline", order, color=GREEN if name.startswith(FINAL) else RED, lw=0.9, ls="--") for name, order in expected.items())],
        yscale="log", xlim=(0.0, orders[-1]), ylim=(10.0 ** -(DECADES + 0.5) * highest, 2.0 * highest))


def _labels(expected, teeth, apart):
    """Labels of the orders of theory; empty for an order that is less than `apart` from a labelled one. The final drive comes first."""
    labels, placed = dict.fromkeys(expected, ""), list[float]()
    for name, order in sorted(expected.items(), key=lambda pair: not pair[0].startswith(FINAL)):
        if all(abs(order - other) >= apart for other in placed):
            labels[name] = name.partition(" ")[0] if name.startswith(FINAL) else f"{order / teeth:.0f} × {teeth:.0f}"
            placed.append(order)
    return list(labels.values())


def _edges(centres):
    middles = 0.5 * (centres[1:] + centres[:-1])
    return np.concatenate([[2.0 * centres[0] - middles[0]], middles, [2.0 * centres[-1] - middles[-1]]])


def _caption(up, spectra, expected):
    order, size = spectra.strongest(1, FLOOR)[0]
    nearest, theirs = min(expected.items(), key=lambda pair: abs(pair[1] - order))
    named = f" ({nearest})" if abs(order - theirs) <= spectra.resolution else ""
    at = int(np.argmin(np.abs(spectra.orders - order)))
    course = UM * spectra.amplitudes[:, at]
    k = int(np.argmax(course))
    green = words.listed(meaning for prefix, meaning in MEANINGS.items() if any(name.startswith(prefix) for name in expected))
    marks = f"on top and red, multiples of the mesh order{f'; green, {green}' if green else ''}"
    return (f"{len(spectra.speeds)} spectra (Hann) of {WINDOW} turns of the planet each, out of {words.number(up.turns)}; "
            f"lines are {words.number(spectra.resolution)} apart. The strongest line is order {words.number(order)}{named}, "
            f"{words.quantity(UM * size, 'µm', 3)} in the mean square over all speeds: from {words.number(course.min(), 3)} to "
            f"{words.quantity(course[k], 'µm', 3)}, the most at {words.quantity(spectra.speeds[k] * RPM, 'rpm', 3)}."
            f"{' It hardly changes with the speed: there is no critical speed in this range.' if course[k] < 1.2 * course.min() else ''} "
            f"Theory has no free constant: {marks}.")


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
    """Orders of theory near an order, with names. If teeth differ, turns of single gears are added to the mesh orders."""
    teeth = int(run.value("geometry.planet_teeth"))
    nearest = max(1, round(order / teeth))
    named = [*expected.items(), (f"mesh {nearest} × {teeth}", float(nearest * teeth))]
    for name, theirs in expected.items():
        if name.startswith(FINAL):
            named += [(f"mesh {k} × {teeth} {'+' if sign > 0 else '−'} {name.partition(' per ')[0]}", abs(k * teeth + sign * theirs))
                      for k in range(1, 2 * MULTIPLES) for sign in (1, -1)]
    if run.value("effects.tooth_errors") or run.value("effects.tooth_fault"):
        for gear, unit in (("planet", 1.0), ("side gear", side)):
            count = round(order / unit)
            named.append((f"{count} turn{'s' if count != 1 else ''} of the {gear}", count * unit))
    return named


def over_angle(angle: np.ndarray, values: np.ndarray, per_turn: int) -> tuple[np.ndarray, np.ndarray]:
    """Resamples `values` at equal steps of a monotone `angle` (rad): (angles, values), `per_turn` points in a turn.

    A point is the mean over its step, which avoids aliasing: orders at multiples of `per_turn`, which would be aliased to the lowest
    orders, vanish in the mean. The amplitudes of other orders are multiplied by sin x / x with x = π order / per_turn."""
    angle, values = (angle, values) if angle[-1] > angle[0] else (-angle, values)
    if np.any(np.diff(angle) <= 0.0):
        raise DifferentialError("orders are counted by an angle that turns one way")
    step = TURN / per_turn
    edges = angle[0] + np.arange(int((angle[-1] - angle[0]) / step) + 1) * step
    # the integral over the angle by cubic pieces, whose slopes are the values
    slopes = np.gradient(values, angle)
    widths = np.diff(angle)
    pieces = 0.5 * widths * (values[1:] + values[:-1]) + widths**2 / 12.0 * (slopes[:-1] - slopes[1:])
    total = np.concatenate([[0.0], np.cumsum(pieces)])
    index = np.clip(np.searchsorted(angle, edges, side="right") - 1, 0, len(angle) - 2)
    width = widths[index]
    share = (edges - angle[index]) / width
    low, high, rise, fall = total[index], total[index + 1], width * values[index], width * values[index + 1]
    integral = low + share * (rise + share * (3.0 * (high - low) - 2.0 * rise - fall + share * (2.0 * (low - high) + rise + fall)))
    return 0.5 * (edges[1:] + edges[:-1]), np.diff(integral) / step


def waterfall(angle: np.ndarray, values: np.ndarray, speed: np.ndarray, turns: int, highest: float) -> Waterfall:
    """Spectra up to the order `highest` over overlapping windows (Hann) of `turns` turns of `angle` (rad); `speed` labels them."""
    coarsest = float(np.abs(np.diff(angle)).max()) / TURN
    if coarsest * highest * PER_PERIOD > 1.0:
        raise DifferentialError(f"a period of order {highest:.4g} has only {1.0 / (coarsest * highest):.2g} points of the "
                                f"record, and needs {PER_PERIOD}: use shorter steps")
    per_turn = int(2 ** np.ceil(np.log2(FINER * highest)))
    even, resampled = over_angle(angle, values, per_turn)
    ordered = np.argsort(angle)
    labels = np.interp(even * np.sign(angle[-1] - angle[0]), angle[ordered], speed[ordered])
    size = turns * per_turn
    hop = max(1, round(size * (1.0 - OVERLAP)))
    begins = range(0, len(even) - size + 1, hop)
    if len(begins) < 2:
        raise DifferentialError(f"{len(even) / per_turn:.3g} turns are too few for windows of {turns} turns")
    window = np.hanning(size + 1)[:-1]
    spectra = []
    for begin in begins:
        part = resampled[begin:begin + size]
        # a linear trend is not an order
        swing = part - np.polynomial.Polynomial.fit(np.arange(size), part, 1)(np.arange(size))
        spectra.append(2.0 * np.abs(np.fft.rfft(window * swing)) / window.sum())
    speeds = np.array([labels[begin:begin + size].mean() for begin in begins])
    orders = np.arange(size // 2 + 1) / turns
    shown = orders <= highest
    # corrects the attenuation by the mean over a step
    amplitudes = np.array(spectra)[:, shown] / np.sinc(orders[shown] / per_turn)
    return Waterfall(orders[shown], speeds, amplitudes, 1.0 / turns)
