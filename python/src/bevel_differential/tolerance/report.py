"""Results in words and tables."""

import math
from collections import Counter
from pathlib import Path

import numpy as np

from ..records import write
from ..text import aligned
from ..values import FileName
from ..want import Condition
from .figures import Estimate, Spread, proportion, verdicts
from .plan import Plan
from .study import Indices, Result


# half of an interval of a Sobol index from which on it says little
WIDE = 0.3


def text(plan: Plan, result: Result) -> str:
    """All of a result: tolerances, spread of the figures, yield, indices and what each alternative gives."""
    parts = [f"{plan.name}: {plan.description}", _table(_tolerances(plan)), _table(_spreads(plan, result)), _yields(plan, result)]
    parts += [_indices(plan, result), _alternatives(plan, result), _answers(plan, result), _failures(result)]
    parts += [f"note: {note}" for note in plan.notes]
    return "\n\n".join(part for part in parts if part)


def write_runs(plan: Plan, result: Result, file: FileName) -> Path:
    """Writes all runs in SI: number, factors, figures, message."""
    names, wants = list(plan.study.factors), [str(want) for want in plan.study.wants]
    rows = ([row.run, *(row.values[name] for name in names), *(row.figures.get(want, "") for want in wants), row.message]
            for row in result.rows)
    return write(file, ["run", *names, *wants, "message"], rows)


def shown(plan: Plan, name: str, estimate: Estimate) -> tuple[str, Estimate]:
    """Unit in which a figure of the output `name` is usually shown, and the estimate in it."""
    variable = plan.scene.fmu.variable(name)
    unit, _ = variable.shown(0.0)
    return unit, Estimate(*(variable.shown(value)[1] for value in (estimate.value, estimate.low, estimate.high)))


def _tolerances(plan):
    return [("factor", "tolerance"), *((name, factor.text) for name, factor in plan.study.factors.items())]


def _spreads(plan, result):
    heads = ("figure", "unit", "mean", "standard deviation", "5 %", "50 %", "95 %", "99 %")
    lines = [heads]
    for want in plan.study.wants:
        spread = Spread.of(result.base.figures[str(want)], plan.study.seed)
        if spread is None:
            lines.append((str(want), "", *["no runs"] * 6))
            continue
        unit, mean = shown(plan, want.name, spread.mean)
        quantiles = [_interval(shown(plan, want.name, each)[1]) for each in spread.quantiles.values()]
        lines.append((str(want), unit or "1", _interval(mean), _interval(_scaled(plan, want.name, spread.deviation)), *quantiles))
    return lines


def _scaled(plan, name, estimate):
    """A difference in the usual unit: without the unit's offset."""
    _, zero = plan.scene.fmu.variable(name).shown(0.0)
    found = shown(plan, name, estimate)[1]
    return Estimate(found.value - zero, found.low - zero, found.high - zero)


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
    """A limit in the usual unit."""
    unit, value = plan.scene.fmu.variable(limit.want.name).shown(limit.limit)
    return f"{limit.want} {limit.relation} {value:.6g} {unit}".strip()


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
            unit, high = shown(plan, want.name, spread.quantiles[0.95]) if spread else ("", None)
            cells.append(f"{high.value:.4g} {unit}".strip() if high else "no runs")
        lines.append((name, *cells))
    return _table(lines)


def _answers(plan, result):
    before = float(result.base.good.mean())
    return "\n".join(verdict.line(before) for verdict in verdicts(plan.study, result))


def _failures(result):
    messages = Counter(row.message for row in result.rows if row.message)
    return "\n".join(f"{count} of {len(result.rows)} runs failed: {message}" for message, count in messages.most_common(5))


def _interval(estimate):
    ends = (f"{end:.4g}" if math.isfinite(end) else "?" for end in (estimate.low, estimate.high))
    return f"{estimate.value:.4g} [{', '.join(ends)}]"


def _table(lines):
    return "\n".join(aligned(lines, len(lines[0])))
