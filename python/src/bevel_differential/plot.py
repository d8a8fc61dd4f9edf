"""Pictures of a record: a panel for each unit."""

import re
from collections.abc import Iterable
from typing import TYPE_CHECKING

import numpy as np

from .fmu import Fmu
from .panel import Mark, Panel, layered, picture, time_axis
from .readable import axis_label, wrapped
from .values import DifferentialError, FileName

if TYPE_CHECKING:
    from matplotlib.figure import Figure

# heights of a panel and of everything else, inches
PANEL, REST = 2.3, 1.2
# letters of a line of a panel's label
LETTERS = 20


def plot(fmu: Fmu, record: np.ndarray, title: str = "", caption: str = "", file: FileName | None = None) -> "Figure":
    """Draws all outputs of a record (structured array with a field "time") over time, in display units.

    Writes `file` (PNG, SVG or PDF) if it is given. Returns the matplotlib figure. It does not belong to pyplot, so it need not be
    closed."""
    names = [name for name in getattr(record, "dtype", np.dtype(float)).names or () if name != "time"]
    if not names or "time" not in record.dtype.names:
        raise DifferentialError("the record needs a structured array with the time and named outputs, such as `run` returns")
    rows, time = over_time(fmu, record, names), record["time"]
    caption = caption or f"{len(np.unique(time))} communication points from {time[0]:g} s to {time[-1]:g} s; one panel for each unit"
    return picture(rows, caption, file, PANEL * len(rows) + REST, title=title)


def over_time(fmu: Fmu, record: np.ndarray, names: Iterable[str], held: bool = False) -> list[list[Panel]]:
    """Panels of outputs over time below each other, one for each unit and kind. Values that are `held` between communication points are
    drawn as steps."""
    time, groups = record["time"], {}
    for name in names:
        variable = fmu.variable(name)
        unit, values = variable.shown(record[name].astype(float))
        groups.setdefault((unit, variable.kind), {})[name] = time, values
    axis = time_axis(float(time[-1] - time[0]))
    return [[Panel(axis, _quantity(curves, unit), [*layered(curves, "held" if held else kind, 1.2), *_whole_ticks(kind)], legend="right",
                   xmargin=0.0, ylim=_range(np.concatenate([values for _, values in curves.values()])))]
            for (unit, kind), curves in groups.items()]


def _whole_ticks(kind):
    return [] if kind == "Real" else [Mark("locator_params", axis="y", integer=True)]


def _range(values):
    """Limits of a constant curve, which is drawn in a wide range, so that its rounding errors do not look like noise."""
    size = np.max(np.abs(values), initial=0.0)
    return values.mean() + size * np.array([-0.05, 0.05]) if size > 0.0 and np.ptp(values) <= 1e-7 * size else (None, None)


def _quantity(names, unit):
    """Last words that all names share, and the unit."""
    shared = []
    for words in zip(*(reversed(re.split(r"[._]", name)) for name in names)):
        if len(set(words)) > 1 or words[0] in ("left", "right"):
            break
        shared.insert(0, words[0])
    return wrapped(axis_label(" ".join(shared), unit) or "values without unit", LETTERS)
