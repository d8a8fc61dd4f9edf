"""Pictures of a record: a panel for each unit."""

import re
from collections.abc import Iterable
from typing import TYPE_CHECKING, TypeAlias

import numpy as np

from .extras import matplotlib
from .fmu import Fmu
from .readable import time_scale
from .values import DifferentialError, FileName

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

# (unit, kind): [(name, values in this unit)]
Panels: TypeAlias = dict[tuple[str, str], list[tuple[str, np.ndarray]]]

# heights of a panel and of everything else, inches
PANEL, REST = 2.3, 1.2


def plot(fmu: Fmu, record: np.ndarray, title: str = "", caption: str = "", file: FileName | None = None) -> "Figure":
    """Draws all outputs of a record (structured array with a field "time") over time, in display units.

    Writes `file` (PNG, SVG or PDF) if it is given. Returns the matplotlib figure. It does not belong to pyplot, so it need not be
    closed."""
    matplotlib("plot")
    from . import style

    names = tuple(name for name in getattr(record, "dtype", np.dtype(float)).names or () if name != "time")
    if not names or "time" not in record.dtype.names:
        raise DifferentialError("the record needs a structured array with the time and named outputs, such as `run` returns")
    panels = by_unit(fmu, record, names)
    with style.styled():
        figure, axes = style.panels(len(panels), 1, PANEL * len(panels) + REST, sharex=True, squeeze=False)
        axes = axes[:, 0]
        times, label = shown_times(record["time"])
        for panel, ((unit, kind), curves) in zip(axes, panels.items()):
            draw_panel(panel, times, unit, kind, curves)
        axes[-1].set_xlabel(label)
        figure.align_ylabels(axes)
        if title:
            figure.suptitle(title, fontweight="bold")
        figure.supxlabel(caption or _caption(record), fontsize=style.SMALL, color=style.TEXT)
        if file is not None:
            style.save(figure, file)
    return figure


def by_unit(fmu: Fmu, record: np.ndarray, names: Iterable[str]) -> Panels:
    """Outputs of a record as curves, grouped into panels with one unit and kind."""
    panels: Panels = {}
    for name in names:
        variable = fmu.variable(name)
        unit, values = variable.shown(record[name].astype(float))
        panels.setdefault((unit, variable.kind), []).append((name, values))
    return panels


def draw_panel(panel: "Axes", times: np.ndarray, unit: str, kind: str, curves: list[tuple[str, np.ndarray]]) -> None:
    """Draws the curves of a panel, with a legend next to it."""
    for index, (name, values) in enumerate(curves):
        # the first curve is the widest, so that it remains visible below equal curves; integers keep their value until the next one
        panel.plot(times, values, label=name, linewidth=1.2 + 1.6 * (len(curves) - 1 - index) / len(curves),
                   drawstyle="default" if kind == "Real" else "steps-post")
    panel.set_ylabel(_quantity([name for name, _ in curves], unit))
    if times[-1] > times[0]:
        panel.set_xlim(times[0], times[-1])
    panel.ticklabel_format(axis="y", useOffset=False)
    if kind != "Real":
        panel.locator_params(axis="y", integer=True)
    panel.legend(loc="center left", bbox_to_anchor=(1.0, 0.5), frameon=False, fontsize=9)


def shown_times(times: np.ndarray) -> tuple[np.ndarray, str]:
    """Times [s] in the unit that suits their span, and the label of their axis."""
    factor, unit = time_scale(float(times[-1] - times[0]))
    return factor * times, f"time, {unit}"


def _quantity(names, unit):
    """Last words that all names share, and the unit."""
    shared = []
    for words in zip(*(reversed(re.split(r"[._]", name)) for name in names)):
        if len(set(words)) > 1 or words[0] in ("left", "right"):
            break
        shared.insert(0, words[0])
    return ", ".join(filter(None, [" ".join(shared), unit.replace(".", "·")])) or "values without unit"


def _caption(record):
    return f"{len(np.unique(record['time']))} communication points from {record['time'][0]:g} s to {record['time'][-1]:g} s; one panel for each unit"
