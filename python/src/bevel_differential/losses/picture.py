"""Picture of a map: bias and loss over its axes, and its measured error."""

from pathlib import Path

import numpy as np

from ..panel import CYCLE, Axis, Panel, curve, picture
from ..values import FileName
from . import MeasuredMap
from .axes import axes as axes_of
from .cuts import along, some
from .figures import shares
from .loss_map import SIGNS
from .tables import bias

# maximum number of temperatures with curves
MOST_CURVES = 4
# ratio from which its axis is logarithmic
DECADE = 10.0
# smallest error of interest, as a fraction of the bound
SMALLEST = 1e-4


def draw(result: MeasuredMap, file: FileName) -> Path:
    """Draws a map into `file`; returns its path."""
    of_torque, of_speed, of_slip, of_warmth = axes_of(result.scene)
    middle = [0.5 * (line[0] + line[-1]) for line in result.lines]
    ratios, losses, highest = [], [], 1.0
    for number, temperature in enumerate(result.lines[3][some(result.lines[3], MOST_CURVES)]):
        # the first is the widest, so that it is seen below others of the same values
        fixed, look = [*middle[:3], temperature], {"lw": 4.0 - 0.8 * number}
        for sign, form, label in zip(SIGNS, ("-", "--"), (of_warmth.text(temperature, 3), None)):
            at, values = along(result, 0, fixed, sign)
            ratio = np.array([bias(*each[:2])[0] for each in values], float)
            highest = max(highest, np.nanmax(ratio, initial=1.0))
            ratios.append(curve(at, ratio, label, CYCLE[number], form, **look))
            at, values = along(result, 2, fixed, sign)
            losses.append(curve(sign * at, values[:, 2], label, CYCLE[number], **look))
    # 1 is no bias
    ends = {"yscale": "log"} if highest > DECADE else {"ylim": (1.0, 1.0 + 1.2 * max(highest - 1.0, 0.05))}
    picture([[
        Panel(of_torque, "torque bias ratio T_high/T_low", ratios,
              f"Bias at {of_speed.text(middle[1], 3)},\ndifference {of_slip.text(middle[2], 3)}", **ends),
        Panel(of_slip, Axis("power loss, kW", lambda loss: loss / 1e3), losses,
              f"Loss at {of_torque.text(middle[0])},\n{of_speed.text(middle[1], 3)}"),
        Panel(f"error over the bound, {result.bound}", "share of the unseen points, %", shares(result),
              "Measured error", xscale="log", xlim=(max(SMALLEST, 0.9 * np.min(result.errors, initial=1.0)), None)),
    ]], "Left: solid with the left wheel faster, dashed with the right wheel faster; where both meet, the differential "
        f"is symmetric. Middle: the loss is lowest where nothing slips. Right: {result.error}.", file, 5.6)
    return Path(file)
