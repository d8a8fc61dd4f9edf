"""Figures of a map's report, with captions that describe what they show."""

from collections.abc import Iterator

import numpy as np

from ..panel import Axis, Mark, Panel, curve, scaled_axis, shades
from ..report import words
from ..report.blocks import Picture
from ..report.svg_style import BLUE, CYCLE, GREY, RED, TEXT_COLOUR, picture
from . import MeasuredMap
from .axes import SLIP_AXIS, SPEED_AXIS, TEMPERATURE_AXIS, TORQUE_AXIS, axes as axes_of
from .cuts import POINTS, along, some
from .loss_map import MAPPED, SIGNS
from .tables import bias

# maximum number of temperatures, and of panels of other axes
TEMPERATURES, PANELS = 4, 3
# number of lines of equal loss; a loss below this fraction of the largest is treated as zero
LEVELS, NOTHING = 10, 1e-9
# temperatures whose values differ by less than this fraction of the largest are equal
SAME = 1e-6
# a ratio with a larger range than this has a logarithmic axis
DECADE = 4.0
ERRED = ("left torque", "right torque", "loss")
SIDES = ("left wheel faster", "right wheel faster")


def warmth_text(result: MeasuredMap, temperature: float) -> str:
    """Text of a temperature, K, in the unit of its axis."""
    return axes_of(result.scene)[TEMPERATURE_AXIS].text(temperature, 3)


def label(result: MeasuredMap, index: int) -> str:
    """Text of the temperature of a line, or of both ends if all lines are equal."""
    line = result.lines[TEMPERATURE_AXIS]
    if len(line) == 1 or not alike(result):
        return warmth_text(result, line[index])
    first = axes_of(result.scene)[TEMPERATURE_AXIS].values(float(line[0]))
    return f"{words.number(first, 3)} to {warmth_text(result, line[-1])}"


def alike(result: MeasuredMap) -> bool:
    """True if temperature has no effect."""
    return all(np.all(np.ptp(values, axis=-2) <= SAME * np.abs(values).max(axis=tuple(range(values.ndim - 1))))
               for values in (result.slipping[..., :MAPPED], result.stuck))


def largest(line: np.ndarray) -> int:
    """Position of the line farthest from 0."""
    return int(np.argmax(np.abs(line)))


def temperatures(result: MeasuredMap) -> np.ndarray:
    """Positions of the displayed temperatures: only the first if all are equal."""
    return np.zeros(1, int) if alike(result) else some(result.lines[TEMPERATURE_AXIS], TEMPERATURES)


def _looks(result):
    """Displayed temperatures: their positions, colours and texts."""
    return [(warmth, colour, label(result, warmth)) for warmth, colour in zip(temperatures(result), CYCLE)]


def loss_map(result: MeasuredMap) -> Picture | None:
    """Loss over torque and speed at each temperature; None if torque or speed has a single value."""
    if min(len(result.lines[TORQUE_AXIS]), len(result.lines[SPEED_AXIS])) < 2:
        return None
    sheets = list(_sheets(result))
    top = f"{axes_of(result.scene)[SLIP_AXIS].text(result.lines[SLIP_AXIS][-1])}, left wheel faster"
    rest = ("Lower row: without a difference, where only drag is lost." if len(sheets) > 1 else
            "Without a difference nothing is lost: the scene has no drag.")
    most = [f"{words.quantity(float(loss.max()), 'W')} at {label(result, index)}"
            for index, loss in zip(temperatures(result), sheets[0][1])]
    _, speed, *_ = axes_of(result.scene)
    return picture("loss_map", [_loss_panels(result, speed, *sheet) for sheet in sheets],
                   "Power loss over carrier torque and speed, a panel for each oil temperature, with lines "
                   f"of equal loss. {'Upper row: at' if len(sheets) > 1 else 'At'} a difference of {top}; at most "
                   f"{words.listed(most)}. {rest} Where lines are level, the loss does not depend on the speed; "
                   "where they are upright, not on the torque.", 3.1 * len(sheets) + 0.4)


def _sheets(result) -> Iterator[tuple[str, list[np.ndarray]]]:
    """Rows of panels: a title, and the loss in each panel over (speed, torque)."""
    torque, speed = _grid(result)
    slip = result.lines[SLIP_AXIS][-1]
    slipping, stuck = [], []
    for temperature in result.lines[TEMPERATURE_AXIS][temperatures(result)]:
        points = np.stack(np.broadcast_arrays(torque, speed[:, None], slip, temperature), axis=-1).reshape(-1, 4)
        slipping.append(result.at(points)[:, 2].reshape(POINTS, POINTS))
        stuck.append(result.at(points * [1.0, 1.0, 0.0, 1.0])[:, 2].reshape(POINTS, POINTS))
    yield f"difference {axes_of(result.scene)[SLIP_AXIS].text(slip)}", slipping
    if np.max(stuck) > NOTHING * np.max(slipping):
        yield "no difference", stuck


def _grid(result):
    return (np.linspace(result.lines[axis][0], result.lines[axis][-1], POINTS) for axis in (TORQUE_AXIS, SPEED_AXIS))


def _loss_panels(result, of_speed, title, losses):
    of_torque = axes_of(result.scene)[TORQUE_AXIS]
    torque, speed = (axis.values(grid) for axis, grid in zip((of_torque, of_speed), _grid(result)))
    up, power = Axis(f"{title}\n{of_torque.label}"), scaled_axis("power loss", "W", losses)
    losses = [power.values(loss.T) for loss in losses]
    low, top = float(np.min(losses)), float(np.max(losses))
    colours = {"cmap": shades((RED, 0.03), (RED, 0.75)), "vmin": low, "vmax": top}
    for loss, (warmth, *_, text) in zip(losses, _looks(result)):
        # all panels of a row share a colour bar
        bar = {"label": power.label} if warmth == temperatures(result)[-1] else None
        yield Panel(of_speed, up, [
            Mark("imshow", loss, extent=(speed[0], speed[-1], torque[0], torque[-1]), origin="lower", aspect="auto", interpolation="bilinear",
                 bar=bar, **colours),
            Mark(_contours, speed, torque, loss, _round_levels(low, top))], text, grid="")


def _contours(axes, speed, torque, loss, levels):
    curves = axes.contour(speed, torque, loss, levels=levels, colors=TEXT_COLOUR, linewidths=0.8)
    axes.clabel(curves, fontsize=8.0, fmt=words.number, manual=_label_positions(curves, speed, torque))


def _round_levels(low, top):
    """About LEVELS round levels in a range. Its ends are excluded, because labels have no room there."""
    from matplotlib.ticker import MaxNLocator

    edge = 0.02 * (top - low)
    return [level for level in MaxNLocator(LEVELS).tick_values(low, top) if low + edge < level < top - edge]


def _label_positions(curves, speed, torque):
    """Position of each level's label: where its line crosses the diagonal, away from the borders."""
    start, size = np.array([speed[0], torque[0]]), np.array([np.ptp(speed), np.ptp(torque)])
    for pieces in curves.allsegs:
        points = np.concatenate([np.empty((0, 2)), *pieces])
        if len(points):
            across = (points - start) / size - 0.5
            off = np.abs(across[:, 0] - 0.8 * across[:, 1]) + 10.0 * np.maximum(np.abs(across) - 0.38, 0.0).sum(axis=1)
            yield points[np.argmin(off)]


def over_difference(result: MeasuredMap) -> Picture:
    """Loss and locking torque over the signed difference, with the stuck interval at 0."""
    slip = result.lines[SLIP_AXIS]
    at = _levels(result)
    first, last = (result.slipping[0][at[0], at[1], index, -1, :2] for index in (0, -1))
    of_torque, _, of_slip, _ = axes_of(result.scene)
    falls = [abs(float(left - right)) for left, right in (first, last)]
    varied = SPEED_AXIS if len(result.lines[TORQUE_AXIS]) == 1 else TORQUE_AXIS
    shown = some(result.lines[varied], PANELS)
    across = Axis(of_slip.label.replace(" (", "\n("), of_slip.values)
    columns = [_over_difference(result, [index if axis == varied else k for axis, k in enumerate(at)], across, index == shown[0], index == shown[-1])
               for index in shown]
    return picture("over_difference", zip(*columns),
                   "Above: power loss; circles are the loss without a difference. Below: T_left − T_right, which locks the wheels; the "
                   "bar at 0 is the interval in which the differential stays stuck. A torque that falls with the difference may judder: "
                   f"with the left wheel faster it is {of_torque.text(falls[0])} at {of_slip.text(slip[0])} and "
                   f"{of_torque.text(falls[1])} at {of_slip.text(slip[-1])} ({_point(result)}, "
                   f"{warmth_text(result, result.lines[TEMPERATURE_AXIS][-1])}). Points are lines of the map.", 5.4)


def _levels(result):
    """Lines of the axes that represent them when others vary: the largest torque, the middle of the others."""
    return [largest(line) if axis == TORQUE_AXIS else len(line) // 2 for axis, line in enumerate(result.lines)]


def _point(result):
    torque, speed = (line[k] for line, k in zip(result.lines, _levels(result)[:SLIP_AXIS]))
    of_torque, of_speed, *_ = axes_of(result.scene)
    return f"{of_torque.text(torque)} and {of_speed.text(speed)}"


def _over_difference(result, at, across, is_first, is_last):
    """Panels of loss and locking torque at the lines `at` of torque and speed."""
    of_torque, of_speed, *_ = axes_of(result.scene)
    losses, lockings = [], []
    for number, (warmth, colour, text) in enumerate(_looks(result)):
        at[TEMPERATURE_AXIS] = warmth
        for sign, values in zip(SIGNS, result.slipping):
            lines = along(result, SLIP_AXIS, [line[k] for line, k in zip(result.lines, at)], sign)
            dots = result.lines[SLIP_AXIS], values[at[0], at[1], :, at[3]]
            for (slip, figures), name, form in ((lines, text if sign > 0.0 else None, "-"), (dots, None, ".")):
                losses.append(curve(sign * slip, figures[:, 2], name, colour, form, ms=4))
                lockings.append(curve(sign * slip, figures[:, 0] - figures[:, 1], None, colour, form, ms=4))
        stuck = result.stuck[at[0], at[1], 0, at[3]]
        losses.append(curve(0.0, stuck[2], None, colour, "o", mfc="none"))
        lockings.append(curve([0.0, 0.0], 2.0 * stuck[3:5] - stuck[0] - stuck[1], None, colour, "_-", lw=4.0 - 0.8 * number, solid_capstyle="butt"))
    torque, speed = (result.lines[axis][at[axis]] for axis in (TORQUE_AXIS, SPEED_AXIS))
    locking = of_torque.named("T_left − T_right")
    return (Panel(across, "power loss, W" if is_first else "", losses, f"{of_torque.text(torque)}, {of_speed.text(speed)}",
                  legend="right" if is_last else ""),
            Panel(across, locking if is_first else Axis("", locking.values), lockings))


def ratio(result: MeasuredMap) -> Picture:
    """Torque bias ratio over torque for both signs of the difference, during slip and at breakaway."""
    slip, at = result.lines[SLIP_AXIS], _levels(result)[SPEED_AXIS]
    _, of_speed, of_slip, _ = axes_of(result.scene)
    ends = []
    for sign, side in zip(SIGNS, SIDES):
        found = [one for one in (_ratio(result.slipping[SIGNS.index(sign)][k, at, -1, warmth, :2])
                                 for k in range(len(result.lines[TORQUE_AXIS])) for warmth in temperatures(result)) if np.isfinite(one)]
        ends.append(f"{side} {words.number(min(found))} to {words.number(max(found))}" if found else
                    f"{side} none, as the torques oppose each other")
    return picture("ratio", [_ratio_panels(result)],
                   f"Torque bias ratio T_high/T_low at {of_speed.text(result.lines[SPEED_AXIS][at])}. Solid: at the "
                   f"largest difference, {of_slip.text(slip[-1])} ({'; '.join(ends)}); dashed: at the smallest, "
                   f"{of_slip.text(slip[0])}; dotted with crosses: where the stuck differential breaks loose. Where a curve "
                   "ends, the torques of the wheels oppose each other or one vanishes, and there is no ratio.", 3.8)


def _ratio(torques):
    return bias(*torques)[0] or np.nan


def _ratio_panels(result):
    speed, torque, of_torque = _levels(result)[SPEED_AXIS], result.lines[TORQUE_AXIS], axes_of(result.scene)[TORQUE_AXIS]
    sides, seen = [], []
    for sign, values, loose in zip(SIGNS, result.slipping, (3, 4)):
        marks = []
        for warmth, colour, text in _looks(result):
            for slip, form in ((-1, "-"), (0, "--")):
                fixed = [torque[0], result.lines[SPEED_AXIS][speed], result.lines[SLIP_AXIS][slip], result.lines[TEMPERATURE_AXIS][warmth]]
                at, figures = along(result, TORQUE_AXIS, fixed, sign)
                dots = [_ratio(each) for each in values[:, speed, slip, warmth, :2]]
                marks += [curve(at, [_ratio(each[:2]) for each in figures], text if slip else None, colour, form),
                          curve(torque, dots, None, colour, ".", ms=4)]
                seen += dots
            dots = [_ratio((each[loose], each[0] + each[1] - each[loose])) for each in result.stuck[:, speed, 0, warmth]]
            marks.append(curve(torque, dots, None, colour, "x:", ms=4, lw=1.0))
            seen += dots
        sides.append(marks)
    is_wide = np.any(np.isfinite(seen)) and np.nanmax(seen) > DECADE * np.nanmin(seen)
    axis = Axis("torque bias ratio T_high/T_low")
    return [Panel(of_torque, axis, marks, side, legend=legend, yscale="log" if is_wide else "linear")
            for marks, side, legend in zip(sides, SIDES, ("", "right"))]


def stuck(result: MeasuredMap) -> Picture:
    """Interval in which the differential stays stuck, over torque or speed."""
    at = _levels(result)
    of_torque, _, of_slip, _ = axes_of(result.scene)
    ends = [f"{words.number(of_torque.values(low))} to {of_torque.text(high)} at {label(result, warmth)}"
            for warmth in temperatures(result) for low, high in [result.stuck[at[0], at[1], 0, warmth, 3:5]]]
    return picture("stuck", [_stuck_panels(result)],
                   f"Shaded: differences of the wheels' torques at which both wheels keep the same speed. At {_point(result)} the left "
                   f"torque is then {words.listed(ends)}. Below the band the left wheel breaks loose ahead, above it the right wheel. "
                   f"Lines: T_left − T_right at a slip of {of_slip.text(result.lines[SLIP_AXIS][0])}; a line within the band: "
                   "less torque holds this slip than starts it.", 3.6, legend="upper center")


def _stuck_panels(result):
    axis = SPEED_AXIS if len(result.lines[TORQUE_AXIS]) == 1 < len(result.lines[SPEED_AXIS]) else TORQUE_AXIS
    of_axis, locking = axes_of(result.scene)[axis], axes_of(result.scene)[TORQUE_AXIS].named("T_left − T_right")
    over = result.lines[axis]
    for warmth, _, text in _looks(result):
        at = _levels(result)[:SLIP_AXIS]
        at[axis] = slice(None)
        left, right, _, *ends = result.stuck[(*at, 0, warmth)].T
        low, high = (2.0 * end - left - right for end in ends)
        slipping = [values[(*at, 0, warmth)] for values in result.slipping]
        yield Panel(of_axis, locking, [
            Mark("fill_between", over, low, high, color=GREY, alpha=0.3, lw=0, label="stuck"), Mark("vlines", over, low, high, color=GREY, lw=0.8),
            *(curve(over, values[:, 0] - values[:, 1], side, colour, ".-", ms=5) for values, colour, side in zip(slipping, (BLUE, RED), SIDES))],
            text, legend="")


def shares(result: MeasuredMap) -> list[Mark]:
    """Shares of the unseen points, %, up to each error over the bound, which is a red line."""
    curves = [curve(np.sort(column), 100.0 * np.arange(1, len(column) + 1) / max(len(column), 1), name, drawstyle="steps-post")
              for column, name in zip(result.errors.T, ERRED)]
    return [*curves, Mark("axvline", 1.0, color=RED, ls="--")]


def error(result: MeasuredMap) -> Picture:
    """Distribution of the error at the unseen points, and the error over the difference of speeds."""
    worst = result.errors.max(axis=1)
    index, half = int(np.argmax(worst)), float(np.median(worst))
    of_slip = axes_of(result.scene)[SLIP_AXIS]
    return picture("error", [[
        Panel(f"error over {result.bound}", "share of the points, %", shares(result), legend="upper left",
              xscale="log"),
        Panel(of_slip, "largest error over the bound", [curve(result.unseen[:, SLIP_AXIS], worst, None, BLUE, "."),
                                                        Mark("axhline", 1.0, color=RED, ls="--")], ylim=(0.0, None))]],
                   f"Errors at {len(result.unseen)} random points that were not used for the map, over the bound; beyond the red line they "
                   f"are larger than it. Left: share of the points whose error is at most this large; half have "
                   f"{words.number(half, 2)} or less. Right: the largest error of each point over its difference of speeds; the worst, "
                   f"{words.number(float(worst[index]), 2)}, is at {of_slip.text(result.unseen[index, SLIP_AXIS], 3)}.", 3.4)
