"""Picture of a sweep: a matrix of quantities over varied values, and the Pareto front of two or more objectives."""

from collections.abc import Sequence
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np

from ..extras import matplotlib
from ..fmu import Fmu
from ..readable import in_words, wrapped
from ..values import DifferentialError, FileName
from ..want import Want
from .sweep import SweepResult

if TYPE_CHECKING:
    from ..optimise.problem import Objective

# maximum number of columns and rows of the matrix, and of panels of the front
MOST_COLUMNS, MOST_ROWS, MOST_FRONTS = 6, 6, 3
# height of a row of the matrix, of the front and of the legend, inches
ROW, FRONT, LEGEND = 1.9, 3.6, 0.35
# letters of a line of a label of the matrix and of the front
NARROW, WIDE = 22, 44


def draw(result: SweepResult, fmu: Fmu, file: FileName, objectives: Sequence["Objective"] = ()) -> Path:
    """Draws all designs that ran into `file`; returns its path. The front needs two or more `objectives`, which are quantities of the
    sweep."""
    matplotlib("plot")
    from .. import style

    designs = _Designs(result, fmu)
    across, up = list(result.metadata["vary"])[:MOST_COLUMNS], list(result.metadata["figures"])[:MOST_ROWS]
    # of one objective, the front would be a single design
    best = front(designs.costs(objectives)) if len(objectives) > 1 else np.zeros(len(designs.feasible), bool)
    heights = [ROW * len(up), FRONT][:1 + (len(objectives) > 1)]
    with style.styled():
        figure = style.figure(sum(heights) + 1.6)
        grid = figure.add_gridspec(len(heights), 1, height_ratios=heights)
        panels = grid[0].subgridspec(len(up), len(across)).subplots(squeeze=False, sharex="col", sharey="row")
        for row, y in zip(panels, up):
            for panel, x in zip(row, across):
                designs.scatter(panel, x, y, best, style)
            row[0].set_ylabel(designs.label(y, NARROW))
        for panel, x in zip(panels[-1], across):
            panel.set_xlabel(designs.label(x, NARROW))
        if len(objectives) > 1:
            first, *others = objectives
            fronts = grid[1].subgridspec(1, min(len(others), MOST_FRONTS)).subplots(squeeze=False)[0]
            for index, (panel, other) in enumerate(zip(fronts, others)):
                designs.scatter(panel, str(first.want), str(other.want), best, style)
                panel.set(xlabel=_aim(designs, first), ylabel=_aim(designs, other), title="" if index else "Pareto front")
        handles, labels = panels[0][0].get_legend_handles_labels()
        figure.legend(handles, labels, loc="upper center", ncols=3, bbox_to_anchor=(0.5, 1.0))
        style.caption(figure, _caption(designs, across, up, objectives, best), LEGEND)
        style.save(figure, file)
    return Path(file)


def front(costs: np.ndarray) -> np.ndarray:
    """True for each row that no other row dominates, which means that no other row is nowhere worse and somewhere better. `costs`:
    smaller is better, shape (rows, objectives); a row with NaN is not on the front."""
    known = ~np.isnan(costs).any(axis=1)
    return np.array([complete and not np.any(np.all(costs <= own, axis=1) & np.any(costs < own, axis=1))
                     for own, complete in zip(costs, known)], bool)


class _Designs:
    """Designs that ran, in the usual units."""

    def __init__(self, result, fmu):
        self.result, self.fmu = result, fmu
        table = result.table.to_pydict()
        figures = result.metadata["figures"]
        ran = [any(table[name][run] is not None for name in figures) for run in range(result.table.num_rows)]
        if not any(ran):
            raise DifferentialError("no design ran, so there is nothing to draw", kind="failed")
        self.columns = {name: [value for value, kept in zip(values, ran) if kept] for name, values in table.items()}
        self.feasible = np.array(self.columns["feasible"], bool)
        self.failed = len(ran) - sum(ran)
        self.quantities = {name: fmu.variable(name) for name in result.metadata["vary"]}
        self.quantities |= {name: Want.parse(fmu, name).quantity(fmu) for name in figures}

    def costs(self, objectives):
        """Figures of objectives with signs such that smaller values are better, shape (designs, objectives); NaN for a design that misses
        a condition."""
        return np.array([[each.sign * value if value is not None and feasible else np.nan
                          for value, feasible in zip(self.columns[str(each.want)], self.feasible)] for each in objectives], float).T

    def label(self, name, width):
        """Name of a column in words, with its unit."""
        unit = self.quantities[name].shown(0.0)[0] if self.quantities[name].kind == "Real" else ""
        return wrapped(f"{in_words(name)}{f', {unit}' if unit else ''}".replace("N.m", "N·m"), width)

    def scatter(self, panel, x, y, best, style):
        """Draws each design as a mark: those that miss conditions below the others, those of the front on top."""
        at = [self._values(panel, name, axis) for name, axis in ((x, "x"), (y, "y"))]
        kinds = [(~self.feasible, "misses conditions", {"marker": "x", "color": style.GREY, "ms": 4.0}),
                 (self.feasible & ~best, "meets all conditions" if self.result.metadata["conditions"] else "design",
                  {"marker": "o", "color": style.BLUE, "ms": 3.5}),
                 (best, "on the Pareto front", {"marker": "o", "color": style.RED, "ms": 5.5})]
        for chosen, label, look in kinds:
            if chosen.any():
                panel.plot(*(values[chosen] for values in at), linestyle="", label=label, **look)
        panel.margins(0.08)

    def _values(self, panel, name, axis):
        """Values of a column as numbers; choices are numbered, and their names are ticks."""
        quantity, values = self.quantities[name], self.columns[name]
        if quantity.kind == "Real":
            return quantity.shown(np.array([np.nan if value is None else value for value in values], float))[1]
        written = [quantity.written(value) if quantity.literals else str(value) for value in values]
        if quantity.kind == "Integer" and not quantity.literals:
            return np.array(values, float)
        names = list(dict.fromkeys(sorted(written)))
        getattr(panel, f"set_{axis}ticks")(range(len(names)), names)
        return np.array([names.index(each) for each in written], float)


def _aim(designs, objective):
    return f"{designs.label(str(objective.want), WIDE)} ({'less' if objective.sign > 0.0 else 'more'} is better)"


def _caption(designs, across, up, objectives, best):
    metadata, count = designs.result.metadata, len(designs.feasible)
    failed = f"; {designs.failed} more failed" if designs.failed else ""
    parts = [f"Each mark is one of {count} designs of a sweep ({metadata['plan']}){failed}. Rows: the quantities; columns: the varied values."]
    left_out = [*list(metadata["vary"])[len(across):], *list(metadata["figures"])[len(up):]]
    if left_out:
        parts.append(f"Left out: {', '.join(left_out)}.")
    if metadata["conditions"]:
        parts.append(f"{int(designs.feasible.sum())} designs meet all conditions.")
    if len(objectives) > 1:
        parts.append(f"{int(best.sum())} of them are on the Pareto front: no other design that meets the conditions is better in one "
                     "objective and nowhere worse." if metadata["conditions"] else
                     f"{int(best.sum())} are on the Pareto front: no other design is better in one objective and nowhere worse.")
    return " ".join(parts)
