"""Pictures of a record: a panel for each unit."""

from pathlib import Path

import numpy as np

from .extras import needed
from .values import DifferentialError

# inches
WIDTH, PANEL, REST = 10.0, 2.3, 1.2


def plot(fmu, record: np.ndarray, title: str = "", caption: str = "", file=None):
    """Draws all outputs of a record (structured array with a field "time") over time, in the units that are usually shown.

    Writes `file` (PNG, SVG or PDF) if there is one. Returns the matplotlib figure; it is not one of pyplot's, so that nothing is
    to be closed."""
    matplotlib = needed("matplotlib", "plot")
    from matplotlib.figure import Figure

    names = record.dtype.names[1:]
    if not names:
        raise DifferentialError("the record has no outputs to draw")
    panels = {}
    for name in names:
        unit, values = fmu.variable(name).shown(record[name].astype(float))
        panels.setdefault(unit, []).append((name, values))
    with matplotlib.rc_context({"axes.grid": True, "grid.alpha": 0.3, "axes.spines.top": False, "axes.spines.right": False,
                                "axes.axisbelow": True}):
        figure = Figure(figsize=(WIDTH, PANEL * len(panels) + REST), layout="constrained")
        axes = figure.subplots(len(panels), 1, sharex=True, squeeze=False)[:, 0]
        for panel, (unit, curves) in zip(axes, panels.items()):
            _draw(panel, record["time"], unit, curves, fmu)
        axes[-1].set_xlabel("time, s")
        figure.align_ylabels(axes)
        if title:
            figure.suptitle(title, fontsize=12, fontweight="bold")
        figure.supxlabel(caption or _caption(record), fontsize=9.5, color="#444444")
        if file is not None:
            _save(figure, file)
    return figure


def _draw(panel, times, unit, curves, fmu):
    for name, values in curves:
        # numbers of literals and truths hold until the next one
        held = fmu.variable(name).kind != "Real"
        panel.plot(times, values, label=name, linewidth=1.3, drawstyle="steps-post" if held else "default")
    panel.set_ylabel(_quantity(curves, unit))
    panel.ticklabel_format(axis="y", useOffset=False)
    panel.legend(loc="center left", bbox_to_anchor=(1.0, 0.5), frameon=False, fontsize=9)


def _quantity(curves, unit):
    """The last part of the names, if all have the same, and the unit."""
    words = {name.rpartition(".")[2].removeprefix("left_").removeprefix("right_").replace("_", " ") for name, _ in curves}
    word = words.pop() if len(words) == 1 else ""
    return ", ".join(filter(None, [word, unit.replace(".", "·")])) or "value"


def _caption(record):
    return f"{len(record)} communication points from {record['time'][0]:g} s to {record['time'][-1]:g} s; one panel for each unit"


def _save(figure, file):
    try:
        figure.savefig(Path(file), dpi=130)
    except (OSError, ValueError) as error:
        raise DifferentialError(f"{file}: {error}") from None
