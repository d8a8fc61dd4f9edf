"""The picture of a comparison: a panel for each output, with a curve for each scene."""

from typing import TYPE_CHECKING

import numpy as np

from ..panel import Panel, layered, picture, time_axis
from ..points import at_times
from ..report import words
from ..values import FileName

if TYPE_CHECKING:
    from matplotlib.figure import Figure

    from . import Comparison

# heights of a panel and of everything else, inches
PANEL, REST = 2.2, 1.5
# more panels than this are drawn in two columns
ONE_COLUMN = 4
DASHES = ("-", "--", "-.", ":")
# differences below this fraction of an output's size are invisible
UNSEEN = 1e-3
# number of differing values that the caption names
NAMED = 3


def draw(found: "Comparison", file: FileName | None) -> "Figure":
    """Draws the comparison, and writes `file` if it is given."""
    columns = 1 if len(found.outputs) <= ONE_COLUMN else 2
    time = time_axis(found.end)
    panels = [_panel(found, output, time) for output in found.outputs]
    # unused panels at the end
    panels += [None] * (-len(panels) % columns)
    rows = [panels[index:index + columns] for index in range(0, len(panels), columns)]
    return picture(rows, _caption(found), file, PANEL * len(rows) + REST, legend="upper center")


def _panel(found, output, time):
    unit, curves = found.shown(output)
    curves = {name: (found.records[name]["time"], values) for name, values in curves.items()}
    return Panel(time, words.unit_text(unit), layered(curves, found.fmu.variable(output).kind, 1.3, DASHES), output, legend="", xmargin=0.0)


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
