"""Picture of the error and the cost of each level of fidelity."""

import matplotlib.pyplot as plt
import numpy as np
from matplotlib.colors import BoundaryNorm, ListedColormap

from bevel_differential import style
from bevel_differential.readable import percent, ratio, with_unit, wrapped
from bevel_differential.records import read

SCENES = {"turn": "The study's turn, one tooth, settled", "clunk": "Clunk: the backlash is crossed, half-shafts wind up"}
# number of communication steps of 1 ms in the turn
TURN_STEPS = 360
COLORS = ListedColormap(["#2f7d4f", "#8cc084", "#f2d680", "#e59a6f", "#c94f4f"])
LIMITS = BoundaryNorm([0.0, 1e-3, 1e-2, 0.1, 0.5, 1e9], COLORS.N)
# font sizes that are readable on a page that shows the picture at two thirds of its size
CELL, LABEL, TITLE = 15, 14, 16


def fidelity_ladder(folder):
    machine, rows = read(folder / "fidelity_ladder.csv")
    count = len({row["rung"] for row in rows})
    figure, grid = style.panels(2, 2, 5.0 + 1.36 * count, width_ratios=[4.2, 1])
    for (left, right), (scene, title) in zip(grid, SCENES.items()):
        own = [row for row in rows if row["scene"] == scene]
        rungs = list(dict.fromkeys(row["rung"] for row in own))
        errors(left, own, rungs, title)
        costs(right, [next(row for row in own if row["rung"] == rung) for rung in rungs])
    ideal = next(row for row in rows if (row["scene"], row["rung"]) == ("turn", "ideal"))
    style.caption(figure, "Error of seven levels of fidelity against the most detailed one, the bottom row of each panel, which shows the "
                  "values. Colours: below 0.1 % (dark green), 1 %, 10 %, 50 %, above (red). Mean speeds and forces need no teeth, the "
                  "peaks of a clunk need backlash, ripple needs tooth pairs, deflection needs their stiffness, heat needs friction. Time is that of ideal "
                  f"gears times the number; these take {1e9 * ideal['cpu_s'] / TURN_STEPS:.0f} ns for a communication step of 1 ms in the "
                  f"turn. Medians with quartiles. {machine}.")
    style.save(figure, folder / "fidelity_ladder.png")


def errors(axes, rows, rungs, title):
    quantities = list(dict.fromkeys(row["quantity"] for row in rows))
    cell = {(row["rung"], row["quantity"]): row for row in rows}
    found = np.array([[cell[rung, quantity]["error"] for quantity in quantities] for rung in rungs])
    texts = [["failed" if cell[rung, quantity]["status"] == "failed" else percent(cell[rung, quantity]["error"])
              for quantity in quantities] for rung in rungs[:-1]]
    last = [cell[rungs[-1], quantity] for quantity in quantities]
    texts.append([with_unit(row["richest"], row["unit"])[::-1].replace(" ", "\n", 1)[::-1].replace("-", "−") for row in last])
    # a failed run has no error: its cells have the colour of the largest errors
    draw_cells(axes, np.where(np.isfinite(found), found, 1e8), texts, COLORS, LIMITS, lambda error: error < 1e-3 or error >= 0.5)
    axes.set_title(title, fontsize=TITLE, loc="left")
    axes.set_xticklabels([wrapped(quantity, 11) for quantity in quantities], fontsize=LABEL)
    axes.set_yticklabels([wrapped(cell[rung, quantities[0]]["words"], 20) for rung in rungs], fontsize=LABEL)


def costs(axes, rows):
    cost = np.array([row["cost"] for row in rows])
    spread = [[at - row["cpu_s_low"] / row["cpu_s"] * at for at, row in zip(cost, rows)],
              [row["cpu_s_high"] / row["cpu_s"] * at - at for at, row in zip(cost, rows)]]
    axes.barh(range(len(rows)), cost, xerr=spread, color=style.PALE_BLUE, height=0.62, error_kw={"elinewidth": 1, "capsize": 2})
    for i, (at, row) in enumerate(zip(cost, rows)):
        text = "failed" if row["status"] == "failed" else f"{ratio(at)} ×"
        axes.text(1.4 * np.nanmax([1.0, row["cpu_s_high"] / row["cpu_s"] * at]), i, text, va="center", fontsize=CELL)
    axes.set(xscale="log", yticks=range(len(rows)), ylim=(len(rows) - 0.5, -0.5), xlim=(0.5, np.nanmax(cost) ** 2))
    axes.set_title("Time", fontsize=TITLE)
    axes.xaxis.set_major_locator(plt.NullLocator())
    axes.xaxis.set_minor_locator(plt.NullLocator())
    axes.set_yticklabels([])
    axes.grid(visible=False)


def draw_cells(axes, values, texts, colors, limits, is_dark, size=CELL):
    """Draws `texts[i][j]` in a cell with the colour for `values[i, j]`; the text is white if `is_dark(value)`."""
    axes.imshow(np.where(np.isfinite(values), values, 0.0), cmap=colors, norm=limits, aspect="auto")
    for (i, j), value in np.ndenumerate(values):
        axes.text(j, i, texts[i][j], ha="center", va="center", fontsize=size, color="white" if is_dark(value) else style.INK)
    axes.set(xticks=range(values.shape[1]), yticks=range(values.shape[0]))
    axes.grid(False)
    axes.tick_params(length=0)
