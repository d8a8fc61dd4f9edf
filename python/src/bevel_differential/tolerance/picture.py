"""A picture of a result: how figures are spread, what spreads them, and what the alternatives give."""

import textwrap
from pathlib import Path

import numpy as np

from .figures import proportion
from .plan import Plan
from .report import limit_text
from .study import Indices, Result
from .verdict import verdicts

BLUE, PALE, RED, GREY = "#1f6fb4", "#9bbfe0", "#d1495b", "#6b7280"
WIDTH, ROW, CAPTION = 12.0, 2.5, 0.75
STYLE = {"font.size": 10, "axes.grid": True, "grid.alpha": 0.3, "axes.axisbelow": True, "axes.spines.top": False,
         "axes.spines.right": False, "legend.frameon": False}


def draw(plan: Plan, result: Result, file) -> Path:
    """Writes a PNG: for each figure a histogram with its limits and bars of its Sobol indices, then yields."""
    import matplotlib
    from matplotlib.figure import Figure

    found = verdicts(plan.study, result)
    rows = len(plan.study.wants) + bool(found)
    with matplotlib.rc_context(STYLE):
        height = ROW * rows + CAPTION + 0.12 * len(result.names)
        picture = Figure(figsize=(WIDTH, height), layout="constrained")
        grid = picture.add_gridspec(rows, 2)
        for i, want in enumerate(plan.study.wants):
            _histogram(picture.add_subplot(grid[i, 0]), plan, result, want)
            _bars(picture.add_subplot(grid[i, 1]), result, want, i == 0)
        if found:
            _yields(picture.add_subplot(grid[-1, :]), result, found)
        picture.get_layout_engine().set(rect=(0.0, CAPTION / height, 1.0, 1.0 - CAPTION / height))
        picture.text(0.01, 0.01, "\n".join(textwrap.wrap(_caption(plan, result, found), 165)), va="bottom", color="#333333")
        picture.savefig(file, dpi=90)
    return Path(file)


def _histogram(axes, plan, result, want):
    variable = plan.scene.fmu.variable(want.name)
    figures = result.base.figures[str(want)]
    unit, values = variable.shown(figures[np.isfinite(figures)])
    if len(values):
        axes.hist(values, bins="auto", color=PALE, edgecolor=BLUE, linewidth=0.6)
    for limit in plan.study.limits:
        if limit.want == want:
            axes.axvline(variable.shown(limit.limit)[1], color=RED, label=limit_text(plan, limit).removeprefix(f"{want} "))
    if axes.get_legend_handles_labels()[0]:
        axes.legend(title="limit", loc="upper right")
    axes.set(xlabel=f"{want}, {unit}" if unit else str(want), ylabel="differentials")


def _bars(axes, result, want, with_legend):
    indices = result.indices[str(want)]
    if not isinstance(indices, Indices):
        axes.text(0.5, 0.5, textwrap.fill(indices, 60), ha="center", va="center", transform=axes.transAxes, color=GREY)
        axes.set_axis_off()
        return
    place = np.arange(len(result.names))[::-1]
    error = {"error_kw": {"ecolor": GREY, "elinewidth": 1.0}, "height": 0.4}
    axes.barh(place + 0.2, indices.first, xerr=indices.first_half, color=BLUE, label="by itself", **error)
    axes.barh(place - 0.2, indices.total, xerr=indices.total_half, color=PALE, label="with others", **error)
    axes.set_yticks(place, result.names)
    axes.set(xlim=(0.0, 1.05), xlabel=f"part of the variance of {want}")
    if with_legend:
        axes.legend(loc="best")


def _yields(axes, result, found):
    base = proportion(result.base.good)
    names = ["as it is", *(textwrap.shorten(verdict.alternative.name, 60) for verdict in found)]
    yields = [base, *(verdict.yield_ for verdict in found)]
    place = np.arange(len(names))[::-1]
    value = np.array([each.value for each in yields])
    ends = np.array([[each.value - each.low, each.high - each.value] for each in yields]).T
    colours = [BLUE if verdict.gain.low > 0.0 else RED if verdict.gain.high < 0.0 else GREY for verdict in found]
    axes.axvline(base.value, color=GREY, linestyle="--", linewidth=1.0)
    for y, x, end, colour in zip(place, value, ends.T, [GREY, *colours]):
        axes.errorbar(x, y, xerr=end[:, None], fmt="o", color=colour, capsize=3)
    axes.set_yticks(place, names)
    axes.set(xlabel="yield: part of the differentials within all limits", ylim=(-0.7, len(names) - 0.3))


def _caption(plan, result, found):
    what = (f"{len(result.base.good)} differentials drawn from the tolerances of {plan.name}. Left: how each figure is spread, "
            "with its limits. Right: Sobol indices with 95 % intervals: the part of the variance that a factor causes by itself, and "
            "the part it takes part in together with others.")
    best = next((verdict for verdict in found if verdict.gain.low > 0.0), None)
    if found:
        answer = best.line(float(result.base.good.mean())) if best else "no alternative is"
        what += (" Bottom: yield with 95 % intervals (Wilson) of the same draws with another tolerance; blue raises it by more "
                 f"than it costs, red does not, grey is undecided. First of them: {answer}.")
    return what
