"""What each level of fidelity gets right, and what it costs."""

import matplotlib.pyplot as plt
import numpy as np
from matplotlib.colors import BoundaryNorm, ListedColormap

from bevel_differential import style
from bevel_differential.readable import percent, ratio, with_unit, wrapped
from bevel_differential.records import read

SCENES = {"turn": "The study's turn, one tooth, settled", "clunk": "Clunk: the lash is crossed, half-shafts wind up"}
# communication steps of the turn
TURN_STEPS = 360
COLORS = ListedColormap(["#2f7d4f", "#8cc084", "#f2d680", "#e59a6f", "#c94f4f"])
LIMITS = BoundaryNorm([0.0, 1e-3, 1e-2, 0.1, 0.5, 1e9], COLORS.N)


def fidelity_ladder(folder):
    machine, rows = read(folder / "fidelity_ladder.csv")
    count = len({(row["scene"], row["rung"]) for row in rows})
    figure, grid = style.panels(2, 2, 2.6 + 0.56 * count, width_ratios=[3.3, 1])
    for (left, right), (scene, title) in zip(grid, SCENES.items()):
        own = [row for row in rows if row["scene"] == scene]
        rungs = list(dict.fromkeys(row["rung"] for row in own))
        errors(left, own, rungs, title)
        costs(right, [next(row for row in own if row["rung"] == rung) for rung in rungs])
    ideal = next(row for row in rows if (row["scene"], row["rung"]) == ("turn", "ideal"))
    style.caption(figure, "What each level of fidelity gets right, and what it costs. Colours: error below 0.1 % (dark green), 1 %, 10 %, "
                  "50 %, and above (red); the bottom row of each panel holds the values themselves. Mean speeds and mean forces need "
                  "no teeth, the peaks of a clunk need the play that a spring per mesh has, ripple needs tooth pairs or solids with "
                  "many facets, deflection their stiffness, heat friction. In the turn ideal gears are a closed form, "
                  f"{1e9 * ideal['cpu_s'] / TURN_STEPS:.0f} ns for a communication step of 1 ms; in the clunk the half-shafts are "
                  f"integrated at every level. Default solver and tolerance; medians with quartiles. {machine}.")
    style.save(figure, folder / "fidelity_ladder.png")


def errors(axes, rows, rungs, title):
    quantities = list(dict.fromkeys(row["quantity"] for row in rows))
    cell = {(row["rung"], row["quantity"]): row for row in rows}
    found = np.array([[cell[rung, quantity]["error"] for quantity in quantities] for rung in rungs])
    texts = [["failed" if cell[rung, quantity]["status"] == "failed" else percent(cell[rung, quantity]["error"])
              for quantity in quantities] for rung in rungs[:-1]]
    last = [cell[rungs[-1], quantity] for quantity in quantities]
    texts.append([with_unit(row["richest"], row["unit"]) for row in last])
    # what failed has no number: the colour of the largest errors
    draw_cells(axes, np.where(np.isfinite(found), found, 1e8), texts, COLORS, LIMITS, lambda error: error < 1e-3 or error >= 0.5)
    axes.set_title(f"{title}: error against the most detailed level (bottom)", fontsize=11.5)
    axes.set_xticklabels([wrapped(quantity, 14) for quantity in quantities], fontsize=style.SMALL)
    adds = [cell[rung, quantities[0]]["adds"] for rung in rungs]
    axes.set_yticklabels([f"{rung}\n" + wrapped(what, 27) for rung, what in zip(rungs, adds)], fontsize=9)


def costs(axes, rows):
    cost = np.array([row["cost"] for row in rows])
    spread = [[at - row["cpu_s_low"] / row["cpu_s"] * at for at, row in zip(cost, rows)],
              [row["cpu_s_high"] / row["cpu_s"] * at - at for at, row in zip(cost, rows)]]
    axes.barh(range(len(rows)), cost, xerr=spread, color=style.BLUE, height=0.62, error_kw={"elinewidth": 1, "capsize": 2})
    for i, (at, row) in enumerate(zip(cost, rows)):
        text = "failed" if row["status"] == "failed" else f"{ratio(at)} ×"
        high = row["cpu_s_high"] / row["cpu_s"] * at
        axes.text(high * 1.4 if np.isfinite(high) else 1.2, i, text, va="center", fontsize=style.SMALL)
    axes.set(xscale="log", xlabel="time, × that of ideal gears", yticks=range(len(rows)), ylim=(len(rows) - 0.5, -0.5),
             xlim=(0.5, 60 * np.nanmax(cost)))
    axes.set_title("Cost", fontsize=11.5)
    axes.xaxis.set_major_locator(plt.LogLocator(numticks=5))
    axes.set_yticklabels([])
    axes.grid(axis="y", visible=False)


def draw_cells(axes, values, texts, colors, limits, is_dark, size=style.SMALL):
    """`texts[i][j]` in the colour of `values[i, j]`; white where `is_dark(value)`."""
    axes.imshow(np.where(np.isfinite(values), values, 0.0), cmap=colors, norm=limits, aspect="auto")
    for (i, j), value in np.ndenumerate(values):
        axes.text(j, i, texts[i][j], ha="center", va="center", fontsize=size, color="white" if is_dark(value) else style.INK)
    axes.set(xticks=range(values.shape[1]), yticks=range(values.shape[0]))
    axes.grid(False)
    axes.tick_params(length=0)
