"""Figure of error against time: this program's default method and solvers by other authors, on the same equations."""

import numpy as np
from matplotlib.ticker import LogLocator, NullFormatter

from bevel_differential import style
from cost_figures.work_precision import FLOOR
from bevel_differential.records import read

OURS = "this program"
# titles of the panels, by case of the comparison
CASES = {"turn_equilibrium": "Turn, 0.5 s, law impact", "turn, force along a line": "Turn, 0.5 s, law line",
         "clunk": "Clunk: lash crossed, 20 ms, law impact"}
ERRORS = {"speed_error": "error in speed of the side gears", "force_error": "error in normal force of the meshes"}


def other_solvers(folder):
    """Draws other_solvers.png from foreign.csv, the measurements of `compare-solvers`. Draws nothing without that file."""
    path = folder / "foreign.csv"
    if not path.is_file():
        return
    cases = by_case(read(path)[1])
    shown = [case for case in CASES if case in cases]
    figure, grid = style.panels(len(ERRORS), len(shown), 10.4, squeeze=False, sharex=True, sharey=True)
    names = sorted({name for case in shown for name in cases[case]}, key=lambda name: (name != OURS, name))
    look = dict(zip(names, zip(style.CYCLE, style.MARKERS)))
    for i, (column, ylabel) in enumerate(ERRORS.items()):
        for axes, case in zip(grid[i], shown):
            for name in filter(cases[case].get, names):
                rows, (color, marker), own = cases[case][name], look[name], name == OURS
                axes.plot([row["cost"] for row in rows], [max(row[column], FLOOR) for row in rows], color=color,
                          marker=marker, ms=6 if own else 4.5, lw=2.6 if own else 1.3, zorder=4 if own else 3, label=name)
            axes.set(xscale="log", yscale="log")
            axes.yaxis.set_major_locator(LogLocator(numticks=8))
            axes.yaxis.set_minor_formatter(NullFormatter())
            style.plain_decades(axes.xaxis)
        grid[i][0].set_ylabel(ylabel)
    for axes, case in zip(grid[0], shown):
        axes.set_title(CASES[case])
    for axes in grid[-1]:
        axes.set_xlabel("time on the processor, × this program's at 1e-6")
    handles, labels = grid[0][0].get_legend_handles_labels()
    figure.legend(handles, labels, loc="outside upper center", ncols=4)
    style.caption(figure, "Solvers that others wrote, on exactly the equations of this program: further down and further left is better. "
                  "Each line runs from loose to tight tolerances; each solver is shown with its first setting, with the exact "
                  "Jacobian if it accepts one. Names without scipy or scikit-SUNDAE are compiled; the others call the "
                  "right-hand side from Python, which is most of their time. Set-up before the first step is not counted.")
    style.save(figure, folder / "other_solvers.png")


def by_case(rows):
    """Rows by case and solver, each with its time divided by that of this program's default at 1e-6.

    A solver is named by the part before the comma. Only the first of several variants of a solver is kept."""
    found = {}
    for row in rows:
        if row["status"] in (0.0, "ok"):
            found.setdefault(row["case"], {}).setdefault(row["solver"], []).append(row)
    for solvers in found.values():
        default = next((row for row in solvers.get(OURS, []) if np.isclose(row["tolerance"], 1e-6)), None)
        for own in solvers.values():
            for row in own:
                row["cost"] = row["cpu_s"] / default["cpu_s"] if default else np.nan
    # work_precision.py draws this program's other methods
    kept = lambda name: name == OURS or not name.startswith(OURS)  # noqa: E731
    return {case: {name.split(",")[0]: own for name, own in reversed(solvers.items()) if kept(name)}
            for case, solvers in found.items()}
