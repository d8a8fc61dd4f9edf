"""Picture of a sweep: a matrix of quantities over varied values, and the Pareto front of two or more objectives."""

from collections.abc import Sequence
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np

from ..fmu import Fmu
from ..panel import BLUE, GREY, RED, Axis, Mark, Panel, curve, picture
from ..readable import axis_label, in_words, wrapped
from ..values import DifferentialError, FileName
from ..want import Want
from .sweep import SweepResult

if TYPE_CHECKING:
    from ..optimise.problem import Objective

# maximum number of columns and rows of the matrix, and of panels of the front
MOST_COLUMNS, MOST_ROWS, MOST_FRONTS = 6, 6, 3
# height of a row of the matrix, and of the front, inches
ROW, FRONT = 1.9, 3.6
# letters of a line of a label of the matrix and of the front
NARROW, WIDE = 22, 44


def draw(result: SweepResult, fmu: Fmu, file: FileName, objectives: Sequence["Objective"] = ()) -> Path:
    """Draws all designs that ran into `file`; returns its path. The front needs two or more `objectives`, which are quantities of the
    sweep."""
    designs = _Designs(result, fmu)
    across, up = list(result.metadata["vary"])[:MOST_COLUMNS], list(result.metadata["figures"])[:MOST_ROWS]
    # of one objective, the front would be a single design
    has_front = len(objectives) > 1
    best = front(designs.costs(objectives)) if has_front else np.zeros(len(designs.feasible), bool)
    columns, rows = ([Axis(designs.label(name, NARROW)) for name in names] for names in (across, up))
    blocks = [[[Panel(of_x, of_y, designs.marks(x, y, best), legend="") for x, of_x in zip(across, columns)]
               for y, of_y in zip(up, rows)]]
    if has_front:
        first, *others = objectives
        blocks.append([[Panel(_aim(designs, first), _aim(designs, other), designs.marks(str(first.want), str(other.want), best),
                              "" if index else "Pareto front", legend="") for index, other in enumerate(others[:MOST_FRONTS])]])
    heights = [ROW * len(up), FRONT][:len(blocks)]
    picture(blocks, _caption(designs, across, up, objectives, best), file, sum(heights) + 1.6, legend="upper center", height_ratios=heights)
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
        return wrapped(axis_label(in_words(name), unit), width)

    def marks(self, x, y, best):
        """Marks of all designs: those that miss conditions below the others, those of the front on top."""
        (across, x_ticks), (up, y_ticks) = self._values(x, "x"), self._values(y, "y")
        kinds = [(~self.feasible, "misses conditions", GREY, "x", 4.0),
                 (self.feasible & ~best, "meets all conditions" if self.result.metadata["conditions"] else "design", BLUE, "o", 3.5),
                 (best, "on the Pareto front", RED, "o", 5.5)]
        return [*(curve(across[chosen], up[chosen], label, colour, form, ms=size) for chosen, label, colour, form, size in kinds if chosen.any()),
                *x_ticks, *y_ticks, Mark("margins", 0.08)]

    def _values(self, name, axis):
        """Values of a column as numbers, and ticks with the names of choices, which are numbered."""
        quantity, values = self.quantities[name], self.columns[name]
        if quantity.kind == "Real":
            return quantity.shown(np.array(values, float))[1], []
        written = [quantity.written(value) if quantity.literals else str(value) for value in values]
        if quantity.kind == "Integer" and not quantity.literals:
            return np.array(values, float), []
        names = sorted(set(written))
        return np.array([names.index(each) for each in written], float), [Mark(f"set_{axis}ticks", range(len(names)), names)]


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
