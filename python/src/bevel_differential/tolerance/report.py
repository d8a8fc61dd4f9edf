"""Results as text, as tables and as a picture: spread of figures, its causes, and the effects of the alternatives."""

import math
import textwrap
from collections import Counter
from pathlib import Path

import numpy as np

from ..panel import BLUE, GREY, PALE_BLUE, RED, Mark, Panel, picture
from ..readable import axis_label, in_words
from ..records import write
from ..text import aligned
from ..values import FileName
from ..want import Condition, Want
from .figures import Estimate, Spread, proportion, verdicts
from .plan import Plan
from .study import Indices, Result

# heights in inches: of a row of panels, and of each factor or alternative in it
ROW, LINE = 1.6, 0.16


# half width of the interval of a Sobol index above which the index is uncertain
WIDE = 0.3


def text(plan: Plan, result: Result) -> str:
    """Text of a result: tolerances, spread of the figures, yield, indices and alternatives."""
    tolerances = [("factor", "tolerance"), *((name, factor.text) for name, factor in plan.study.factors.items())]
    parts = [f"{plan.name}: {plan.description}", _table(tolerances), _table(_spreads(plan, result)), _yields(plan, result)]
    parts += [_indices(plan, result), _alternatives(plan, result)]
    before, messages = float(result.base.good.mean()), Counter(row.message for row in result.rows if row.message)
    parts.append("\n".join(verdict.line(before) for verdict in verdicts(plan.study, result)))
    parts.append("\n".join(f"{count} of {len(result.rows)} runs failed: {message}" for message, count in messages.most_common(5)))
    parts += [f"note: {note}" for note in plan.notes]
    return "\n\n".join(part for part in parts if part)


def write_runs(plan: Plan, result: Result, file: FileName) -> Path:
    """Writes all runs: number, factors, figures, message; in SI, or in the display units of the scene."""
    fmu, rows = plan.scene.fmu, result.rows
    columns = [("run", [row.run for row in rows])]
    columns += [fmu.variable(name).column(name, [row.values[name] for row in rows], fmu.display_units) for name in plan.study.factors]
    columns += [want.quantity(fmu).column(str(want), [row.figures.get(str(want), "") for row in rows], fmu.display_units)
                for want in plan.study.wants]
    columns += [("message", [row.message for row in rows])]
    return write(file, [head for head, _ in columns], zip(*(cells for _, cells in columns)))


def shown(plan: Plan, want: Want, estimate: Estimate) -> tuple[str, Estimate]:
    """Display unit of a wanted figure, and the estimate in this unit."""
    return _shown(want.quantity(plan.scene.fmu), estimate)


def _shown(variable, estimate):
    unit, _ = variable.shown(0.0)
    return unit, Estimate(*(variable.shown(value)[1] for value in (estimate.value, estimate.low, estimate.high)))


def _spreads(plan, result):
    heads = ("figure", "unit", "mean", "standard deviation", "5 %", "50 %", "95 %", "99 %")
    lines = [heads]
    for want in plan.study.wants:
        spread = Spread.of(result.base.figures[str(want)], plan.study.seed)
        if spread is None:
            lines.append((str(want), "", *["no runs"] * 6))
            continue
        unit, mean = shown(plan, want, spread.mean)
        quantiles = [_interval(shown(plan, want, each)[1]) for each in spread.quantiles.values()]
        lines.append((str(want), unit or "1", _interval(mean), _interval(_shown(want.quantity(plan.scene.fmu).differences(), spread.deviation)[1]), *quantiles))
    return lines


def _yields(plan, result):
    base = result.base
    runs = len(base.good)
    drawn = f"{runs} differentials drawn, {len(base.failures)} of them failed"
    if not plan.study.limits:
        return f"{drawn}; no limits"
    lines = [("limit", "kept by")]
    for limit in plan.study.limits:
        kept = [math.isfinite(figure) and limit.holds(figure) for figure in base.figures[str(limit.want)]]
        lines.append((limit_text(plan, limit), _interval(proportion(kept))))
    lines.append(("all: yield", _interval(proportion(base.good))))
    return f"{drawn}; those count as out of limits\n\n{_table(lines)}"


def limit_text(plan: Plan, limit: Condition) -> str:
    """Text of a limit in the display unit."""
    return f"{limit.want} {limit.relation} {limit.want.quantity(plan.scene.fmu).text(limit.limit)}"


def _indices(plan, result):
    found = {want: indices for want, indices in result.indices.items() if isinstance(indices, Indices)}
    blocks = []
    if found:
        lines = [("part of the variance: by itself | with others", *found)]
        for i, name in enumerate(result.names):
            lines.append((name, *(f"{each.first[i]:.2f} ± {each.first_half[i]:.2f} | {each.total[i]:.2f} ± "
                                  f"{each.total_half[i]:.2f}" for each in found.values())))
        blocks.append(_table(lines))
        widest = max(float(np.max([each.first_half, each.total_half])) for each in found.values())
        if widest > WIDE:
            blocks.append(f"The intervals are as wide as ± {widest:.2f}: {plan.study.runs} draws say little about indices. Take more by --runs.")
    blocks += [f"Sobol indices of {want}: {why}" for want, why in result.indices.items() if isinstance(why, str)]
    return "\n".join(blocks)


def _alternatives(plan, result):
    if not plan.study.alternatives:
        return ""
    wants = [str(want) for want in plan.study.wants]
    lines = [("alternative", "yield", "failed", *(f"95 % of {want}" for want in wants))]
    for name, draws in [("as it is", result.base), *zip((one.name for one in plan.study.alternatives), result.others)]:
        cells = [_interval(proportion(draws.good)) if plan.study.limits else "", str(len(draws.failures))]
        for want in plan.study.wants:
            spread = Spread.of(draws.figures[str(want)], plan.study.seed)
            unit, high = shown(plan, want, spread.quantiles[0.95]) if spread else ("", None)
            cells.append(f"{high.value:.4g} {unit}".strip() if high else "no runs")
        lines.append((name, *cells))
    return _table(lines)


def _interval(estimate):
    ends = (f"{end:.4g}" if math.isfinite(end) else "?" for end in (estimate.low, estimate.high))
    return f"{estimate.value:.4g} [{', '.join(ends)}]"


def _table(lines):
    return "\n".join(aligned(lines, len(lines[0])))


def draw(plan: Plan, result: Result, file: FileName) -> Path:
    """Draws the result: for each figure a histogram with its limits and bars of its Sobol indices, then yields, then a caption."""
    found = verdicts(plan.study, result)
    rows = [[_histogram(plan, result, want), _bars(result, want, i == 0)] for i, want in enumerate(plan.study.wants)]
    heights = [len(rows) * (ROW + LINE * len(result.names)), ROW + LINE * len(found)]
    blocks = [rows, [[_yields_panel(result, found)]]][:1 + bool(found)]
    picture(blocks, _caption(plan, result, found), file, sum(heights[:len(blocks)]) + 1.2, height_ratios=heights[:len(blocks)])
    return Path(file)


def _histogram(plan, result, want):
    variable = want.quantity(plan.scene.fmu)
    figures = result.base.figures[str(want)]
    marks = [Mark("hist", variable.shown(figures[np.isfinite(figures)])[1], bins="auto", color=PALE_BLUE, edgecolor=BLUE, linewidth=0.6)]
    for limit in plan.study.limits:
        if limit.want == want:
            label = limit_text(plan, limit).removeprefix(f"{want} ").replace("<=", "≤").replace(">=", "≥")
            marks.append(Mark("axvline", variable.shown(limit.limit)[1], color=RED, label=f"limit {label}"))
    unit, _ = variable.shown(0.0)
    return Panel(axis_label(in_words(want), unit), "differentials", [*marks, Mark("locator_params", axis="x", nbins=6)])


def _bars(result, want, with_legend):
    indices = result.indices[str(want)]
    if not isinstance(indices, Indices):
        return Panel("", "", [Mark("text", 0.5, 0.5, textwrap.fill(indices, 60), ha="center", va="center", color=GREY), Mark("set_axis_off")])
    heights = np.arange(len(result.names))[::-1]
    bars = [Mark("barh", heights + up, 100.0 * share, xerr=100.0 * half, color=colour, label=label, height=0.4,
                 error_kw={"ecolor": GREY, "elinewidth": 1.0})
            for up, share, half, colour, label in ((0.2, indices.first, indices.first_half, BLUE, "by itself"),
                                                   (-0.2, indices.total, indices.total_half, PALE_BLUE, "with others"))]
    return Panel("share of the variance of the quantity at the left, %", "", [*bars, Mark("set_yticks", heights, result.names)],
                 legend="lower right" if with_legend else "", xlim=(0.0, 105.0))


def _yields_panel(result, found):
    base = proportion(result.base.good)
    rows = [("as it is", base, GREY)]
    rows += [(textwrap.shorten(verdict.alternative.name, 60), verdict.yield_,
              BLUE if verdict.gain.low > 0.0 else RED if verdict.gain.high < 0.0 else GREY) for verdict in found]
    marks = [Mark("axvline", 100.0 * base.value, color=GREY, linestyle="--", linewidth=1.0)]
    marks += [Mark("errorbar", 100.0 * each.value, -y, xerr=[[100.0 * (each.value - each.low)], [100.0 * (each.high - each.value)]], fmt="o",
                   color=colour, capsize=3) for y, (_, each, colour) in enumerate(rows)]
    return Panel("yield: share of the differentials within all limits, %", "",
                 [*marks, Mark("set_yticks", -np.arange(len(rows)), [name for name, *_ in rows])], ylim=(0.3 - len(rows), 0.7))


def _caption(plan, result, found):
    what = (f"{len(result.base.good)} differentials drawn: {plan.description}. Left: scatter of each quantity, with its limits. "
            "Right: Sobol indices with 95 % intervals: the share of the variance that a factor causes by itself, and "
            "its share together with others.")
    best = next((verdict for verdict in found if verdict.gain.low > 0.0), None)
    if found:
        answer = best.line(float(result.base.good.mean())) if best else "none is surely better"
        what += (" Bottom: yield with 95 % intervals (Wilson) of the same draws with another tolerance; a good differential "
                 f"becomes cheaper (blue), more expensive (red), or the runs do not tell (grey). Best: {answer}.")
    return what
