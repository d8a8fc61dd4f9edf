"""A picture of a result: how figures are spread, what spreads them, and what the alternatives give."""

import textwrap
from pathlib import Path

import numpy as np

from ..extras import needed
from ..values import FileName
from .figures import proportion, verdicts
from .plan import Plan
from .report import limit_text
from .study import Indices, Result

# inches: a row of panels, what a factor or an alternative adds to it
ROW, LINE = 1.6, 0.16


def draw(plan: Plan, result: Result, file: FileName) -> Path:
    """Writes a PNG: for each figure a histogram with its limits and bars of its Sobol indices, then yields, then a caption."""
    needed("matplotlib", "plot")
    from .. import style

    found = verdicts(plan.study, result)
    figures = len(plan.study.wants) * (ROW + LINE * len(result.names))
    heights = [figures, *([ROW + LINE * len(found)] if found else [])]
    with style.styled():
        picture = style.figure(sum(heights) + 1.2)
        style.caption(picture, _caption(plan, result, found))
        parts = iter(picture.subfigures(len(heights), 1, squeeze=False, height_ratios=heights)[:, 0])
        panels = next(parts).subplots(len(plan.study.wants), 2, squeeze=False)
        for i, want in enumerate(plan.study.wants):
            _histogram(style, panels[i, 0], plan, result, want)
            _bars(style, panels[i, 1], result, want, i == 0)
        if found:
            _yields(style, next(parts).subplots(), result, found)
        style.save(picture, file)
    return Path(file)


def _histogram(style, axes, plan, result, want):
    variable = plan.scene.fmu.variable(want.name)
    figures = result.base.figures[str(want)]
    unit, values = variable.shown(figures[np.isfinite(figures)])
    if len(values):
        axes.hist(values, bins="auto", color=style.PALE_BLUE, edgecolor=style.BLUE, linewidth=0.6)
    for limit in plan.study.limits:
        if limit.want == want:
            label = limit_text(plan, limit).removeprefix(f"{want} ")
            axes.axvline(variable.shown(limit.limit)[1], color=style.RED, label=f"limit {label}")
    if axes.get_legend_handles_labels()[0]:
        axes.legend(loc="best")
    axes.set(xlabel=f"{want}, {unit}" if unit else str(want), ylabel="differentials")


def _bars(style, axes, result, want, with_legend):
    indices = result.indices[str(want)]
    if not isinstance(indices, Indices):
        axes.text(0.5, 0.5, textwrap.fill(indices, 60), ha="center", va="center", transform=axes.transAxes, color=style.GREY)
        axes.set_axis_off()
        return
    place = np.arange(len(result.names))[::-1]
    error = {"error_kw": {"ecolor": style.GREY, "elinewidth": 1.0}, "height": 0.4}
    axes.barh(place + 0.2, indices.first, xerr=indices.first_half, color=style.BLUE, label="by itself", **error)
    axes.barh(place - 0.2, indices.total, xerr=indices.total_half, color=style.PALE_BLUE, label="with others", **error)
    axes.set_yticks(place, result.names)
    axes.set(xlim=(0.0, 1.05), xlabel="part of the variance of the figure at the left")
    if with_legend:
        axes.legend(loc="lower right")


def _yields(style, axes, result, found):
    base = proportion(result.base.good)
    names = ["as it is", *(textwrap.shorten(verdict.alternative.name, 60) for verdict in found)]
    yields = [base, *(verdict.yield_ for verdict in found)]
    place = np.arange(len(names))[::-1]
    value = np.array([each.value for each in yields])
    ends = np.array([[each.value - each.low, each.high - each.value] for each in yields]).T
    colours = [style.BLUE if verdict.gain.low > 0.0 else style.RED if verdict.gain.high < 0.0 else style.GREY for verdict in found]
    axes.axvline(base.value, color=style.GREY, linestyle="--", linewidth=1.0)
    for y, x, end, colour in zip(place, value, ends.T, [style.GREY, *colours]):
        axes.errorbar(x, y, xerr=end[:, None], fmt="o", color=colour, capsize=3)
    axes.set_yticks(place, names)
    axes.set(xlabel="yield: part of the differentials within all limits", ylim=(-0.7, len(names) - 0.3))


def _caption(plan, result, found):
    what = (f"{len(result.base.good)} differentials drawn: {plan.description}. Left: how each figure is spread, with its "
            "limits. Right: Sobol indices with 95 % intervals: the part of the variance that a factor causes by itself, and "
            "the part it takes part in together with others.")
    best = next((verdict for verdict in found if verdict.gain.low > 0.0), None)
    if found:
        answer = best.line(float(result.base.good.mean())) if best else "none is surely better"
        what += (" Bottom: yield with 95 % intervals (Wilson) of the same draws with another tolerance; a good differential "
                 f"becomes cheaper (blue), dearer (red), or the runs do not tell (grey). Best: {answer}.")
    return what
