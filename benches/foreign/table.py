"""The table: CPU time at equal error, and how many times that of this program."""

import numpy as np

from solvers import OURS

LEVELS = (1e-3, 1e-4, 1e-6, 1e-8)


def frontier(rows):
    """Pairs of cost and error, errors falling: points that nothing cheaper beats."""
    best = []
    for cost, error in sorted((row["cpu_s"], max(row["speed_error"], row["force_error"])) for row in rows if row["status"] == 0):
        if not best or error < best[-1][1]:
            best.append((cost, error))
    return best


def cost_at(level, rows):
    """Cost at an error of `level`, on straight lines between the points of the frontier in logarithms; None if not met."""
    best = frontier(rows)
    if not best or best[-1][1] > level:
        return None
    costs, errors = np.log(best).T[:2]
    return float(np.exp(np.interp(-np.log(level), -errors, costs)))


def markdown(rows, names, checks, missing):
    parts = []
    for name in names:
        of_case = [row for row in rows if row["case"] == name]
        solvers = list(dict.fromkeys(row["name"] for row in of_case))
        by_solver = {solver: [row for row in of_case if row["name"] == solver] for solver in solvers}
        ours = {level: cost_at(level, by_solver[OURS]) for level in LEVELS}
        lines = [[name.replace("_", " ") + ", ms", *(f"{level:.0e}" for level in LEVELS)]]
        for solver in solvers:
            cells = [solver]
            for level in LEVELS:
                cost = cost_at(level, by_solver[solver])
                text = "–" if cost is None else f"{1e3 * cost:.3g}"
                if cost is not None and ours[level] is not None and solver != OURS:
                    text += f" ({float(f'{cost / ours[level]:.2g}'):g}×)"
                cells.append(text)
            lines.append(cells)
        parts.append("\n".join(aligned(lines)))
        parts.append(f"Closest of the others to the reference: {checks[name]:.1e}.")
    parts += [f"Not run: {text}." for text in missing]
    return "\n\n".join(parts) + "\n"


def aligned(lines):
    widths = [max(len(line[i]) for line in lines) for i in range(len(lines[0]))]

    def shown(line):
        return "| " + " | ".join(text.ljust(w) if i == 0 else text.rjust(w) for i, (text, w) in enumerate(zip(line, widths))) + " |"

    rule = "|" + "|".join("-" * (w + 2) if i == 0 else "-" * (w + 1) + ":" for i, w in enumerate(widths)) + "|"
    return [shown(lines[0]), rule, *map(shown, lines[1:])]
