"""Table of CPU times at equal error, and their ratios to this program."""

import numpy as np
from bevel_differential.text import markdown as aligned

from solvers import OURS

# names of the cases in the table
CASES = {"turn_equilibrium": "turn", "turn_rolling": "turn, rolling", "straight_rolling": "straight, rolling",
         "clunk, every 10 us": "clunk, 10 µs", "turn, force along a line": "turn, `line`"}

LEVELS = (1e-3, 1e-6, 1e-8)


def frontier(rows):
    """Pairs of cost and error with falling errors: points that no cheaper point beats."""
    best = []
    for cost, error in sorted((row["cpu_s"], max(row["speed_error"], row["force_error"])) for row in rows if row["status"] == 0):
        if not best or error < best[-1][1]:
            best.append((cost, error))
    return best


def cost_at(level, rows):
    """Cost at an error of `level`, interpolated linearly between the points of the frontier in logarithms; None if not reached."""
    best = frontier(rows)
    if not best or best[-1][1] > level:
        return None
    costs, errors = np.log(best).T[:2]
    return float(np.exp(np.interp(-np.log(level), -errors, costs)))


def markdown(rows, names, checks, missing):
    """Tables of compiled solvers and of those called from Python, with the ratios of their times to this program's."""
    slow = [name for name in dict.fromkeys(row["name"] for row in rows) if name.startswith(("scipy", "scikit"))]
    others = [name for name in dict.fromkeys(row["name"] for row in rows) if name != OURS and name not in slow]
    parts = [_ratios(rows, names, others)]
    if slow:
        parts.append(_ratios(rows, [name for name in names if any(row["case"] == name and row["name"] in slow for row in rows)], slow))
    closest = ", ".join(f"{checks[name]:.1e}" for name in names)
    parts.append(f"Least error of the other solvers, case by case: {closest}.")
    parts += [f"Not run: {text}." for text in missing]
    return "\n\n".join(parts) + "\n"


def _ratios(rows, names, others):
    shorter = [name.removeprefix(f"{OURS}, method ").removesuffix(", compiled") for name in others]
    lines = [["case", "error", f"{OURS}, ms", *shorter]]
    for name in names:
        costs = {each: [row for row in rows if row["case"] == name and row["name"] == each] for each in (OURS, *others)}
        for level in LEVELS:
            own = cost_at(level, costs[OURS])
            ratios = [(cost_at(level, costs[each]), own) for each in others]
            lines.append([CASES.get(name, name), f"{level:.0e}".replace("e-0", "e-"), "–" if own is None else f"{1e3 * own:.3g}",
                          *("–" if None in pair else f"{float(f'{pair[0] / pair[1]:.2g}'):g}×" for pair in ratios)])
    return aligned(lines).rstrip()
