"""What each effect changes in a scene, what it costs, and whether the scene needs it."""

import numpy as np
from matplotlib.colors import BoundaryNorm, ListedColormap
from matplotlib.ticker import FuncFormatter, LogLocator, NullFormatter

import style
from cost_figures.cells import draw_cells
from readable import percent, ratio, wrapped
from records import read

COLORS = ListedColormap(["#ffffff", "#e3edf6", "#a9c8e4", "#5f97c9", "#1f5a92"])
LIMITS = BoundaryNorm([0.0, 1e-4, 1e-2, 0.1, 0.5, 1e9], COLORS.N)
NEEDED, NOT_NEEDED, NOT_ALLOWED = "#c94f4f", "#2f7d4f", "#888888"


def effects(folder):
    machine, rows = read(folder / "effects.csv")
    looked_at = [row for row in rows if row["verdict"] not in ("not in this scene", "set off by the scene")]
    scenes = list(dict.fromkeys(row["scene"] for row in rows))
    sizes = [len({row["effect"] for row in looked_at if row["scene"] == scene}) for scene in scenes]
    figure, grid = style.panels(len(scenes), 2, 2.2 + 0.44 * sum(sizes) + 1.3 * len(scenes), width_ratios=[3.2, 1],
                                height_ratios=sizes, squeeze=False)
    for (left, right), scene in zip(grid, scenes):
        own = [row for row in looked_at if row["scene"] == scene]
        names = list(dict.fromkeys(row["effect"] for row in own))
        firsts = [next(row for row in own if row["effect"] == name) for name in names]
        changes(left, own, names, scene)
        costs(right, firsts)
        for label, row in zip(left.get_yticklabels(), firsts):
            label.set_color(color(row))
    accuracy = 100.0 * rows[0]["accuracy"]
    style.caption(figure, f"Which effects a scene needs at an accuracy of {accuracy:g} %. Each effect is switched in the scene with all "
                  "effects on that it allows; a cell is the largest change of an output's mean, rms, minimum or maximum, on that "
                  "output's scale (darker: more). Red: needed, or a level of contact too simple for the scene. Green: may stay off. "
                  "Grey or –: not allowed in this scene. ×: the scene fails without it. Cost of a level: the scene's over the "
                  "simpler one. Not shown: effects that the scene sets off, and those that are part of the question (limited slip, "
                  f"a broken tooth, the final drive). {machine}.")
    style.save(figure, folder / "effects.png")


def changes(axes, rows, names, scene):
    outputs = list(dict.fromkeys(row["output"] for row in rows))
    cell = {(row["effect"], row["output"]): row for row in rows}
    found = np.array([[cell[name, output]["change"] for output in outputs] for name in names])
    texts = [[text_of(cell[name, output]) for output in outputs] for name in names]
    draw_cells(axes, found, texts, COLORS, LIMITS, lambda change: change >= 0.1, 9)
    axes.set_title(f"Scene {scene}: change of each output by each effect, with all others on", fontsize=11.5)
    axes.set_xticklabels([broken(output) for output in outputs], fontsize=9)
    axes.set_yticklabels(names, fontsize=style.SMALL)


def text_of(row):
    return percent(row["change"]) if row["status"] == "ok" else "×" if row["status"] == "failed" else "–"


def broken(name):
    """The name of a variable in lines short enough for a column."""
    return wrapped(name.replace("_", " ").replace(".", ". "), 12).replace(". ", ".")


def costs(axes, rows):
    timed = np.isfinite([row["cost"] for row in rows]).any()
    for i, row in enumerate(rows):
        cost = row["cost"] if timed else row["evaluations"]
        if row["status"] == "ok" and np.isfinite(cost):
            axes.barh(i, cost - 1.0, left=1.0, xerr=row["cost_spread"] if timed else None, color=color(row), height=0.6,
                      error_kw={"elinewidth": 1})
        label = f"{ratio(cost)} ×  {row['verdict']}" if np.isfinite(cost) else row["verdict"]
        axes.text(1.02, i, wrapped(label, 20), transform=axes.get_yaxis_transform(), va="center", fontsize=9, color=color(row))
    axes.axvline(1.0, color=style.TEXT, lw=1)
    axes.set(xscale="log", yticks=range(len(rows)), ylim=(len(rows) - 0.5, -0.5),
             xlabel=f"{'time' if timed else 'evaluations'} with / without")
    axes.set_title("Cost, and whether needed", fontsize=11.5)
    axes.set_yticklabels([])
    axes.xaxis.set_major_locator(LogLocator(subs=(1.0, 2.0, 5.0), numticks=20))
    axes.xaxis.set_major_formatter(FuncFormatter(lambda value, _: f"{value:g}"))
    axes.xaxis.set_minor_formatter(NullFormatter())
    axes.grid(axis="y", visible=False)


def color(row):
    if row["status"] == "refused":
        return NOT_ALLOWED
    return NEEDED if row["kept"] == "true" or row["verdict"] == "too plain" else NOT_NEEDED
