"""The picture of a comparison: a panel for each output, with a curve for each scene."""

from typing import TYPE_CHECKING

import numpy as np

from .. import style
from ..points import at_times
from ..readable import time_scale
from ..report import words
from ..values import FileName

if TYPE_CHECKING:
    from matplotlib.figure import Figure

    from . import Comparison

# heights of a panel and of everything else, inches
PANEL, REST = 2.2, 1.5
# more panels than this are drawn in two columns
ONE_COLUMN = 4
# characters of the caption per inch: names are wider than words
DENSITY = 11.0
DASHES = ("-", "--", "-.", ":")
# differences below this fraction of an output's size are invisible
UNSEEN = 1e-3
# number of differing values that the caption names
NAMED = 3


def draw(found: "Comparison", file: FileName | None) -> "Figure":
    """Draws the comparison, and writes `file` if it is given."""
    outputs = found.outputs
    columns = 1 if len(outputs) <= ONE_COLUMN else 2
    rows = -(-len(outputs) // columns)
    with style.styled():
        figure, axes = style.panels(rows, columns, PANEL * rows + REST, sharex=True, squeeze=False)
        panels, (factor, unit) = axes.ravel(), time_scale(found.end)
        for panel, output in zip(panels, outputs):
            _draw(panel, found, output, factor)
        # unused panels at the end
        for panel in panels[len(outputs):]:
            panel.remove()
        for index in range(max(0, len(outputs) - columns), len(outputs)):
            panels[index].tick_params(labelbottom=True)
            if index >= columns * (rows - 1):
                panels[index].set_xlabel(f"time, {unit}")
        figure.align_ylabels(panels[:len(outputs)])
        figure.legend(*panels[0].get_legend_handles_labels(), loc="outside upper center", ncols=len(found.names))
        style.caption(figure, _caption(found), density=DENSITY)
        if file is not None:
            style.save(figure, file)
    return figure


def _draw(panel, found, output, factor):
    unit, curves = found.shown(output)
    kind = found.fmu.variable(output).kind
    for index, (name, values) in enumerate(curves.items()):
        # the first curve is the widest, so that it remains visible below equal curves; integers keep their value until the next one
        panel.plot(factor * found.records[name]["time"], values, DASHES[index % len(DASHES)], label=name,
                   linewidth=1.3 + 2.0 * (len(curves) - 1 - index) / len(curves), drawstyle="default" if kind == "Real" else "steps-post")
    panel.set_title(output, loc="left", fontsize=style.SMALL)
    panel.set_ylabel(words.unit_text(unit))
    panel.ticklabel_format(axis="y", useOffset=False)
    panel.margins(x=0.0)


def _caption(found):
    parts = [f"Outputs of {words.listed(found.names)} from 0 to {found.end:g} s; where curves cover each other, scenes agree."]
    apart = {output: _apart(found, output) for output in found.outputs}
    same = [output for output, (share, _) in apart.items() if share <= UNSEEN]
    if same:
        parts.append(f"The same within 0.1 % of the largest value: {words.listed(same)}.")
    if len(same) < len(apart):
        output = max(apart, key=lambda output: apart[output][0])
        parts.append(f"Relative to its size, {output} differs most: {apart[output][1]}.")
    rows = found.differing[1:]
    if rows:
        values = "; ".join(f"{name} ({' | '.join(cells)})" for name, *cells in rows[:NAMED])
        rest = len(rows) - NAMED
        more = f"; and {rest} more value{'s' * (rest > 1)}" if rest > 0 else ""
        parts.append(f"The scenes differ in {values}{more}.")
    else:
        parts.append("The scenes set the same values.")
    return " ".join(parts)


def _apart(found, output):
    """Largest difference from the first scene relative to the largest value, and its time and values in words."""
    first, *others = found.names
    unit, curves = found.shown(output)
    records = found.records
    time = records[first]["time"]
    size = max(float(np.max(np.abs(record[output].astype(float)))) for record in records.values()) or 1.0
    best = (0.0, "")
    for name in others:
        at = at_times(time, records[name]["time"], records[name][output].astype(float))
        away = np.abs(at - records[first][output].astype(float))
        index = int(np.argmax(away))
        if away[index] / size > best[0]:
            shown = [float(at_times(time, records[each]["time"], curves[each])[index]) for each in (first, name)]
            best = (float(away[index]) / size, f"at {words.moment(time[index], found.end)} it is "
                    f"{words.quantity(shown[0], unit)} in {first} and {words.quantity(shown[1], unit)} in {name}")
    return best
