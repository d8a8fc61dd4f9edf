"""Picture of a map: bias and loss over its axes, and its measured error."""

from pathlib import Path

import numpy as np

from ..extras import matplotlib
from ..values import FileName
from . import MeasuredMap
from .axes import axes as axes_of
from .cuts import along, some
from .loss_map import SIGNS
from .tables import bias

# maximum number of temperatures with curves
MOST_CURVES = 4
NAMES = ["left torque", "right torque", "loss"]
# ratio from which its axis is logarithmic
DECADE = 10.0
# smallest error of interest, as a fraction of the bound
SMALLEST = 1e-4


def draw(result: MeasuredMap, file: FileName) -> Path:
    """Draws a map into `file`; returns its path."""
    matplotlib("plot")
    from .. import style

    with style.styled():
        figure, (ratio, loss, error) = style.panels(1, 3, 5.6)
        of_torque, of_speed, of_slip, of_warmth = axes_of(result.scene)
        middle = [0.5 * (line[0] + line[-1]) for line in result.lines]
        for number, temperature in enumerate(result.lines[3][some(result.lines[3], MOST_CURVES)]):
            # the first is the widest, so that it is seen below others of the same values
            width = 4.0 - 0.8 * number
            fixed = [*middle[:3], temperature]
            label = of_warmth.text(temperature, 3)
            curve = [along(result, 0, fixed, sign) for sign in SIGNS]
            line, = ratio.plot(of_torque.values(curve[0][0]), [bias(*values[:2])[0] or np.nan for values in curve[0][1]], label=label,
                               lw=width)
            ratio.plot(of_torque.values(curve[1][0]), [bias(*values[:2])[0] or np.nan for values in curve[1][1]], "--", color=line.get_color(),
                       lw=width)
            for sign in SIGNS:
                at, values = along(result, 2, fixed, sign)
                loss.plot(sign * of_slip.values(at), values[:, 2] / 1e3, color=line.get_color(), lw=width, label=label if sign > 0.0 else None)
        ratio.set(xlabel=of_torque.label, ylabel="torque bias ratio T_high/T_low",
                  title=f"Bias at {of_speed.text(middle[1], 3)},\ndifference {of_slip.text(middle[2], 3)}")
        if ratio.get_ylim()[1] > DECADE:
            ratio.set_yscale("log")
            style.plain_decades(ratio.yaxis)
        else:
            # 1 is no bias
            ratio.set_ylim(1.0, 1.0 + 1.2 * max(ratio.get_ylim()[1] - 1.0, 0.05))
        loss.set(xlabel=of_slip.label, ylabel="power loss, kW",
                 title=f"Loss at {of_torque.text(middle[0])},\n{of_speed.text(middle[1], 3)}")
        for column, name in zip(result.errors.T, NAMES):
            error.plot(np.sort(column), 100.0 * np.arange(1, len(column) + 1) / max(len(column), 1), label=name)
        error.axvline(1.0, color=style.RED, ls="--")
        error.set(xscale="log", xlabel=f"error over the bound, {str(result.bound).replace('.m', '·m')}", ylabel="share of the unseen points, %",
                  title="Measured error")
        error.set_xlim(left=max(error.get_xlim()[0], SMALLEST))
        style.plain_decades(error.xaxis)
        for axes in (ratio, loss, error):
            axes.legend()
        style.caption(figure, "Left: solid with the left wheel faster, dashed with the right wheel faster; where both meet, the differential "
                      f"is symmetric. Middle: the loss is lowest where nothing slips. Right: {result.error}.")
        style.save(figure, file)
    return Path(file)
