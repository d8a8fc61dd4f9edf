"""Figures of a map's report, with captions that describe what they show."""

from collections.abc import Iterator

import numpy as np

from ..report import svg_style, words
from ..report.blocks import Picture
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
    return Picture("loss_map", _loss_map(result, sheets),
                   "Power loss over carrier torque and speed, a panel for each oil temperature, with lines "
                   f"of equal loss. {'Upper row: at' if len(sheets) > 1 else 'At'} a difference of {top}; at most "
                   f"{words.listed(most)}. {rest} Where lines are level, the loss does not depend on the speed; "
                   "where they are upright, not on the torque.")


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


@svg_style.drawn("loss_map")
def _loss_map(picture, result, sheets):
    from matplotlib.colors import LinearSegmentedColormap, to_rgba

    colours = LinearSegmentedColormap.from_list("loss", [to_rgba(svg_style.RED, 0.03), to_rgba(svg_style.RED, 0.75)])
    picture.set_figheight(3.1 * len(sheets) + 0.4)
    of_torque, of_speed, *_ = axes_of(result.scene)
    shown, torque, speed = temperatures(result), *(axis.values(grid) for axis, grid in zip((of_torque, of_speed), _grid(result)))
    rows = picture.subplots(len(sheets), len(shown), sharex=True, sharey=True, squeeze=False)
    for row, (title, losses) in zip(rows, sheets):
        factor, kilo = svg_style.unit_prefix(losses)
        low, top = (float(end(losses)) / factor for end in (np.min, np.max))
        for panel, index, loss in zip(row, shown, losses):
            drawn = panel.imshow(loss.T / factor, extent=(speed[0], speed[-1], torque[0], torque[-1]), origin="lower", aspect="auto",
                                 interpolation="bilinear", cmap=colours, vmin=low, vmax=top)
            curves = panel.contour(speed, torque, loss.T / factor, levels=_round_levels(low, top), colors=svg_style.TEXT_COLOUR,
                                   linewidths=0.8)
            panel.clabel(curves, fontsize=8.0, fmt=words.number, manual=_label_positions(curves, speed, torque))
            panel.set_title(label(result, index))
            panel.grid(False)
        row[0].set_ylabel(f"{title}\n{of_torque.label}")
        picture.colorbar(drawn, ax=row, pad=0.01, aspect=25).set_label(f"power loss, {kilo}W")
    for panel in rows[-1]:
        panel.set_xlabel(of_speed.label)


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
    at = [_level(result, index) for index in range(4)]
    first, last = (result.slipping[0][at[0], at[1], index, -1, :2] for index in (0, -1))
    of_torque, _, of_slip, _ = axes_of(result.scene)
    falls = [abs(float(left - right)) for left, right in (first, last)]
    return Picture("over_difference", _over_difference(result),
                   "Above: power loss; circles are the loss without a difference. Below: T_left − T_right, which locks the wheels; the "
                   "bar at 0 is the interval in which the differential stays stuck. A torque that falls with the difference may judder: "
                   f"with the left wheel faster it is {of_torque.text(falls[0])} at {of_slip.text(slip[0])} and "
                   f"{of_torque.text(falls[1])} at {of_slip.text(slip[-1])} ({_point(result)}, "
                   f"{warmth_text(result, result.lines[TEMPERATURE_AXIS][-1])}). Points are lines of the map.")


def _level(result, axis):
    """Line of an axis that represents it when others vary: the largest torque, the middle of the others."""
    line = result.lines[axis]
    return largest(line) if axis == TORQUE_AXIS else len(line) // 2


def _point(result):
    torque, speed = (result.lines[axis][_level(result, axis)] for axis in (TORQUE_AXIS, SPEED_AXIS))
    of_torque, of_speed, *_ = axes_of(result.scene)
    return f"{of_torque.text(torque)} and {of_speed.text(speed)}"


@svg_style.drawn("over_difference", 5.4)
def _over_difference(picture, result):
    varied = SPEED_AXIS if len(result.lines[TORQUE_AXIS]) == 1 else TORQUE_AXIS
    shown = some(result.lines[varied], PANELS)
    rows = picture.subplots(2, len(shown), sharex=True, squeeze=False)
    of_torque, of_speed, of_slip, _ = axes_of(result.scene)
    for index, (loss, locking) in zip(shown, rows.T):
        at = [_level(result, axis) for axis in range(4)]
        at[varied] = index
        for number, warmth in enumerate(temperatures(result)):
            at[TEMPERATURE_AXIS], colour = warmth, svg_style.CYCLE[number]
            name = label(result, warmth)
            for sign, values in zip(SIGNS, result.slipping):
                slip, figures = along(result, SLIP_AXIS, [line[k] for line, k in zip(result.lines, at)], sign)
                dots = values[at[0], at[1], :, at[3]]
                for panel, curve, marks in ((loss, figures[:, 2], dots[:, 2]),
                                            (locking, *(of_torque.values(each[:, 0] - each[:, 1]) for each in (figures, dots)))):
                    panel.plot(sign * of_slip.values(slip), curve, color=colour, label=name if sign > 0.0 else None)
                    panel.plot(sign * of_slip.values(result.lines[SLIP_AXIS]), marks, ".", color=colour, ms=4)
            stuck = result.stuck[at[0], at[1], 0, at[3]]
            loss.plot(0.0, stuck[2], "o", mfc="none", color=colour)
            total = stuck[0] + stuck[1]
            locking.plot([0.0, 0.0], of_torque.values(2.0 * stuck[3:5] - total), "_-", color=colour, lw=4.0 - 0.8 * number, solid_capstyle="butt")
        torque, speed = (result.lines[axis][at[axis]] for axis in (TORQUE_AXIS, SPEED_AXIS))
        loss.set_title(f"{of_torque.text(torque)}, {of_speed.text(speed)}")
        locking.set_xlabel(of_slip.label.replace(" (", "\n("))
    rows[0][0].set_ylabel("power loss, W")
    rows[1][0].set_ylabel(f"T_left − T_right, {of_torque.unit}")
    rows[0][-1].legend(loc="center left", bbox_to_anchor=(1.0, 0.5))


def ratio(result: MeasuredMap) -> Picture:
    """Torque bias ratio over torque for both signs of the difference, during slip and at breakaway."""
    slip, speed = result.lines[SLIP_AXIS], result.lines[SPEED_AXIS][_level(result, SPEED_AXIS)]
    _, of_speed, of_slip, _ = axes_of(result.scene)
    ends = []
    for sign, side in zip(SIGNS, SIDES):
        found = [one for one in (_ratio(result.slipping[SIGNS.index(sign)][k, _level(result, SPEED_AXIS), -1, warmth, :2])
                                 for k in range(len(result.lines[TORQUE_AXIS])) for warmth in temperatures(result)) if np.isfinite(one)]
        ends.append(f"{side} {words.number(min(found))} to {words.number(max(found))}" if found else
                    f"{side} none, as the torques oppose each other")
    return Picture("ratio", _drawn_ratio(result),
                   f"Torque bias ratio T_high/T_low at {of_speed.text(speed)}. Solid: at the "
                   f"largest difference, {of_slip.text(slip[-1])} ({'; '.join(ends)}); dashed: at the smallest, "
                   f"{of_slip.text(slip[0])}; dotted with crosses: where the stuck differential breaks loose. Where a curve "
                   "ends, the torques of the wheels oppose each other or one vanishes, and there is no ratio.")


def _ratio(torques):
    return bias(*torques)[0] or np.nan


@svg_style.drawn("ratio", 3.8)
def _drawn_ratio(picture, result):
    panels = picture.subplots(1, 2, sharey=True)
    speed, torque, of_torque = _level(result, SPEED_AXIS), result.lines[TORQUE_AXIS], axes_of(result.scene)[TORQUE_AXIS]
    seen = []
    for panel, sign, values, side, loose in zip(panels, SIGNS, result.slipping, SIDES, (3, 4)):
        for number, warmth in enumerate(temperatures(result)):
            colour, name = svg_style.CYCLE[number], label(result, warmth)
            for slip, style in ((-1, "-"), (0, "--")):
                fixed = [torque[0], result.lines[SPEED_AXIS][speed], result.lines[SLIP_AXIS][slip], result.lines[TEMPERATURE_AXIS][warmth]]
                at, figures = along(result, TORQUE_AXIS, fixed, sign)
                panel.plot(of_torque.values(at), [_ratio(each[:2]) for each in figures], style, color=colour, label=name if slip else None)
                dots = [_ratio(each) for each in values[:, speed, slip, warmth, :2]]
                panel.plot(of_torque.values(torque), dots, ".", color=colour, ms=4)
                seen += dots
            stuck = result.stuck[:, speed, 0, warmth]
            dots = [_ratio((each[loose], each[0] + each[1] - each[loose])) for each in stuck]
            panel.plot(of_torque.values(torque), dots, "x:", color=colour, ms=4, lw=1.0)
            seen += dots
        panel.set(title=side, xlabel=of_torque.label)
    if np.any(np.isfinite(seen)) and np.nanmax(seen) > DECADE * np.nanmin(seen):
        from matplotlib.ticker import LogLocator, NullFormatter

        panels[0].set_yscale("log")
        panels[0].yaxis.set_major_locator(LogLocator(subs=(1.0, 2.0, 5.0)))
        panels[0].yaxis.set_major_formatter(lambda value, _: words.number(value))
        panels[0].yaxis.set_minor_formatter(NullFormatter())
    panels[0].set_ylabel("torque bias ratio T_high/T_low")
    panels[1].legend(loc="center left", bbox_to_anchor=(1.0, 0.5))


def stuck(result: MeasuredMap) -> Picture:
    """Interval in which the differential stays stuck, over torque or speed."""
    at = [_level(result, axis) for axis in range(4)]
    of_torque, _, of_slip, _ = axes_of(result.scene)
    ends = [f"{words.number(of_torque.values(low))} to {of_torque.text(high)} at {label(result, warmth)}"
            for warmth in temperatures(result) for low, high in [result.stuck[at[0], at[1], 0, warmth, 3:5]]]
    return Picture("stuck", _drawn_stuck(result),
                   f"Shaded: differences of the wheels' torques at which both wheels keep the same speed. At {_point(result)} the left "
                   f"torque is then {words.listed(ends)}. Below the band the left wheel breaks loose ahead, above it the right wheel. "
                   f"Lines: T_left − T_right at a slip of {of_slip.text(result.lines[SLIP_AXIS][0])}; a line within the band: "
                   "less torque holds this slip than starts it.")


@svg_style.drawn("stuck", 3.6)
def _drawn_stuck(picture, result):
    axis = SPEED_AXIS if len(result.lines[TORQUE_AXIS]) == 1 < len(result.lines[SPEED_AXIS]) else TORQUE_AXIS
    of_torque, of_axis = axes_of(result.scene)[TORQUE_AXIS], axes_of(result.scene)[axis]
    over, shown = of_axis.values(result.lines[axis]), temperatures(result)
    panels = picture.subplots(1, len(shown), sharey=True, squeeze=False)[0]
    for panel, warmth in zip(panels, shown):
        at = [slice(None) if index == axis else _level(result, index) for index in (TORQUE_AXIS, SPEED_AXIS)]
        left, right, _, *ends = result.stuck[(*at, 0, warmth)].T
        low, high = (of_torque.values(2.0 * end - left - right) for end in ends)
        panel.fill_between(over, low, high, color=svg_style.GREY, alpha=0.3, lw=0, label="stuck")
        panel.vlines(over, low, high, color=svg_style.GREY, lw=0.8)
        for values, colour, side in zip(result.slipping, (svg_style.BLUE, svg_style.RED), SIDES):
            slipping = values[(*at, 0, warmth)]
            panel.plot(over, of_torque.values(slipping[:, 0] - slipping[:, 1]), ".-", color=colour, ms=5, label=side)
        panel.set(title=label(result, warmth), xlabel=of_axis.label)
    panels[0].set_ylabel(f"T_left − T_right, {of_torque.unit}")
    handles, labels = panels[0].get_legend_handles_labels()
    picture.legend(handles, labels, loc="outside upper center", ncols=len(labels))


def error(result: MeasuredMap) -> Picture:
    """Distribution of the error at the unseen points, and the error over the difference of speeds."""
    worst = result.errors.max(axis=1)
    index, half = int(np.argmax(worst)), float(np.median(worst))
    return Picture("error", _error(result),
                   f"Errors at {len(result.unseen)} random points that were not used for the map, over the bound; beyond the red line they "
                   f"are larger than it. Left: share of the points whose error is at most this large; half have "
                   f"{words.number(half, 2)} or less. Right: the largest error of each point over its difference of speeds; the worst, "
                   f"{words.number(float(worst[index]), 2)}, is at {axes_of(result.scene)[SLIP_AXIS].text(result.unseen[index, SLIP_AXIS], 3)}.")


@svg_style.drawn("error", 3.4)
def _error(picture, result):
    from .. import style

    share, where = picture.subplots(1, 2)
    for column, name in zip(result.errors.T, ("left torque", "right torque", "loss")):
        share.step(np.sort(column), 100.0 * np.arange(1, len(column) + 1) / len(column), where="post", label=name)
    share.axvline(1.0, color=svg_style.RED, ls="--")
    share.set(xscale="log", xlabel=f"error over {str(result.bound).replace('.m', '·m')}", ylabel="share of the points, %")
    style.plain_decades(share.xaxis)
    share.legend(loc="upper left")
    of_slip = axes_of(result.scene)[SLIP_AXIS]
    where.plot(of_slip.values(result.unseen[:, SLIP_AXIS]), result.errors.max(axis=1), ".", color=svg_style.BLUE)
    where.axhline(1.0, color=svg_style.RED, ls="--")
    where.set(ylim=(0.0, None), xlabel=of_slip.label, ylabel="largest error over the bound")
