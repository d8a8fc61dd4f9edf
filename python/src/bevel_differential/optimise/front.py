"""Best designs: dominance, the front, and a few designs to choose from."""

from collections.abc import Sequence

import numpy as np
from pymoo.operators.survival.rank_and_crowding.metrics import calc_crowding_distance
from pymoo.util.nds.non_dominated_sorting import NonDominatedSorting

from .design_task import DesignRow
from .problem import Objective

# number of proposed designs
CHOICES = 5


def costs(rows: Sequence[DesignRow], objectives: Sequence[Objective]) -> np.ndarray:
    """Figures with signs such that smaller values are better, shape (rows, objectives)."""
    figures = [[each.sign * row.figures[str(each.want)] for each in objectives] for row in rows]
    return np.array(figures, float).reshape(-1, len(objectives))


def front(rows: Sequence[DesignRow], objectives: Sequence[Objective]) -> list[DesignRow]:
    """Feasible rows that no other row dominates, in order of the first objective."""
    rows = [row for row in rows if row.feasible]
    if not rows:
        return []
    cost = costs(rows, objectives)
    best = NonDominatedSorting().do(cost, only_non_dominated_front=True)
    return sorted((rows[i] for i in best), key=lambda row: (*costs([row], objectives)[0], row.run))


def thinned(rows: Sequence[DesignRow], objectives: Sequence[Objective], count: int) -> list[DesignRow]:
    """At most `count` rows of a front, spread by crowding distance; the ends stay."""
    rows = list(rows)
    while len(rows) > count:
        distance = calc_crowding_distance(costs(rows, objectives))
        # crowding changes with each removed row; of many rows, several are removed at a time
        leaving = np.argsort(distance, kind="stable")[:max(1, (len(rows) - count) // 10)]
        rows = [row for i, row in enumerate(rows) if i not in set(leaving.tolist())]
    return rows


def dominates(one: np.ndarray, other: np.ndarray) -> bool:
    """True if costs `one` are nowhere worse than `other`, and better in at least one."""
    return bool(np.all(one <= other) and np.any(one < other))


def choice(rows: Sequence[DesignRow], objectives: Sequence[Objective], compared: DesignRow | None) -> list[tuple[str, DesignRow]]:
    """Up to CHOICES designs of a front, each with a reason: the knee, a design that dominates the compared one, ends.

    The knee is nearest to the point with the best value of every objective. Of the designs that dominate the compared one, the choice
    is the one whose smallest gain, relative to the extent of the front, is largest."""
    cost = costs(rows, objectives)
    extent = np.where(np.ptp(cost, axis=0) > 0.0, np.ptp(cost, axis=0), 1.0)
    # 0 is the best value, 1 the worst
    scaled = (cost - cost.min(axis=0)) / extent
    found = [("knee: nearest to the best of all objectives", int(np.argmin(np.linalg.norm(scaled, axis=1))))]
    if compared is not None and len(compared.figures) and all(str(each.want) in compared.figures for each in objectives):
        old = costs([compared], objectives)[0]
        better = [i for i in range(len(rows)) if dominates(cost[i], old)]
        if better:
            gains = ((old - cost[better]) / extent).min(axis=1)
            found.append(("better in all than the compared design", better[int(np.argmax(gains))]))
    found += [(f"{'least' if each.sign > 0 else 'most'} {each.want.name}", int(np.argmin(cost[:, k])))
              for k, each in enumerate(objectives)]
    chosen: dict[int, str] = {}
    for reason, i in found:
        chosen[i] = f"{chosen[i]}; {reason}" if i in chosen else reason
    while len(chosen) < min(CHOICES, len(rows)):
        # the design farthest from all chosen ones
        away = np.linalg.norm(scaled[:, None] - scaled[list(chosen)], axis=2).min(axis=1)
        chosen[int(np.argmax(away))] = "in between"
    return [(reason, rows[i]) for i, reason in list(chosen.items())[:CHOICES]]
