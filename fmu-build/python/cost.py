"""Draws the figures of what accuracy costs from the CSV files that `fmu-build cost` measured.

usage: cost.py FOLDER
"""

import csv
import sys
from pathlib import Path

import matplotlib.pyplot as plt
import numpy as np
from matplotlib.ticker import LogLocator, NullFormatter

from figures import caption, save

# methods: colour, marker, name in legends
METHODS = {
    "adaptive": ("#1f6fb4", "o", "adaptive (Rodas5P), the default"),
    "radau": ("#d1495b", "s", "radau (Radau IIA, order 5)"),
    "rodas4": ("#5b8c5a", "^", "rodas4 (order 4)"),
    "dormand_prince": ("#b7791f", "v", "dormand_prince (explicit, order 5)"),
    "fixed_step": ("#7b5ea7", "D", "fixed_step (order 2, steps instead of tolerances)"),
}
FOREIGN = ["-", "--", ":", "-."]
MOTIONS = {"turn": "turn, one tooth, 0.18 s", "blow": "turn from mid-gap:\nteeth strike, 20 ms",
           "clunk": "clunk: lash crossed,\nundamped, 20 ms"}
FIDELITIES = {"ideal": "ideal: no teeth", "lumped": "lumped: a spring per mesh",
              "impact": "tooth pairs, law impact", "line": "tooth pairs, law line"}
# errors below this are drawn here: rounding
FLOOR = 1e-15


def main():
    folder = Path(sys.argv[1])
    figures = [work_precision]
    for done, figure in enumerate(figures):
        print(f"progress {0.95 + 0.05 * done / len(figures):.3f} drawing {figure.__name__.replace('_', ' ')}",
              file=sys.stderr, flush=True)
        figure(folder)


def read(path):
    """Machine and rows of a CSV file; numbers as such."""
    lines = path.read_text(encoding="utf-8").splitlines()
    machine = next((line.split(":", 1)[1].strip() for line in lines if line.startswith("# machine:")), "")
    rows = list(csv.DictReader(line for line in lines if not line.startswith("#")))
    return machine, [{key: number(value) for key, value in row.items()} for row in rows]


def number(text):
    try:
        return float(text)
    except ValueError:
        return text


def work_precision(folder):
    machine, rows = read(folder / "work_precision.csv")
    path = folder / "foreign.csv"
    foreign = read(path)[1] if path.is_file() else []
    unit = {row["case"]: row["cpu_s"] for row in rows
            if row["method"] == "adaptive" and row["setting"] == 1e-6 and row["status"] == "ok"}
    costs = [row["cost"] for row in rows if row["status"] == "ok"]
    stand_in = any("own" in row["reference"] for row in rows)
    sources = ("References: the plain Python model of tests/python integrated by scipy at 1e-12"
               + (" where its file is there, else (marked *) this program's Radau and Rodas5P at 1e-11 against each other"
                  if stand_in else "") + ". ")
    for column, name, what in [("speed_error", "work_precision", "speed of the side gears"),
                               ("force_error", "work_precision_force", "normal force of the meshes")]:
        figure, grid = panels(rows)
        for axes, motion, fidelity in grid:
            case = f"{motion}/{fidelity}"
            own = [row for row in rows if row["case"] == case]
            span = (0.3 * min(costs), 5.0 * max(costs))
            draw_case(axes, own, lambda row: row["cost"], column, span, spread=True)
            for style, solver in zip(FOREIGN, dict.fromkeys(row["solver"] for row in foreign)):
                theirs = [row for row in foreign if (row["solver"], row["case"], row["status"]) == (solver, case, "ok")]
                axes.plot([row["cpu_s"] / unit.get(case, np.nan) for row in theirs],
                          [max(row[column], FLOOR) for row in theirs], color="#888888", ls=style, lw=1.3, label=solver)
        finish(figure, grid, "time on the processor, × the default's (adaptive, 1e-6)", f"error in {what}")
        counts = sorted({int(row["runs"]) for row in rows if row["status"] == "ok"})
        caption(figure, f"What accuracy costs: error in the {what} (largest at any compared time, relative) against time; "
                "further down and further left is better. Tolerances run from loose (left) to tight (right); a ring marks the "
                "default, adaptive at 1e-6, whose time is 1 in every panel. Crosses at the top: settings that fail. Grey "
                f"band: below what the reference can tell. {sources}Results are compared every 10 ms (turn), or 1 ms and "
                "more (blows), so that the host does not dictate the steps. Median of "
                f"{counts[0]}–{counts[-1]} runs in turn, quartiles as bars. {machine}.")
        save(figure, folder, name)
    counts_figure(folder, machine, rows)


def counts_figure(folder, machine, rows):
    """Errors against evaluations and Jacobians, which do not depend on the machine."""
    figure, axes = plt.subplots(3, 4, figsize=(17, 11.5), layout="constrained", sharey=True, sharex=True)
    grid = []
    kinds = [("lumped", "rhs_calls"), ("impact", "rhs_calls"), ("line", "rhs_calls"), ("impact", "jacobians")]
    for i, motion in enumerate(MOTIONS):
        for j, (fidelity, count) in enumerate(kinds):
            own = [row for row in rows if row["case"] == f"{motion}/{fidelity}"]
            draw_case(axes[i][j], own, lambda row: row[count], "speed_error", (30, 1e7))
            grid.append((axes[i][j], motion, fidelity))
    for j, (fidelity, count) in enumerate(kinds):
        what = "evaluations of forces" if count == "rhs_calls" else "Jacobians, each factorised"
        axes[0][j].set_title(f"{FIDELITIES[fidelity]}:\n{what}")
    finish(figure, grid, "evaluations of forces, or Jacobians", "error in speed of the side gears", titles=False)
    caption(figure, "The same in numbers that hold on any machine: error in the speed of the side gears against evaluations of "
            "the forces (three columns) and against Jacobians (right column; dormand_prince has none). The explicit method "
            "takes the same number of evaluations at any tolerance: not accuracy but the stiffness of the teeth dictates "
            f"its steps. Ring: the default. {machine}.")
    save(figure, folder, "work_precision_counts")


def panels(rows):
    figure, axes = plt.subplots(3, 4, figsize=(17, 11.5), layout="constrained", sharex=True, sharey=True)
    grid = []
    for i, motion in enumerate(MOTIONS):
        for j, fidelity in enumerate(FIDELITIES):
            grid.append((axes[i][j], motion, fidelity))
    for j, fidelity in enumerate(FIDELITIES):
        axes[0][j].set_title(FIDELITIES[fidelity])
    return figure, grid


def draw_case(axes, rows, work, column, span, spread=False):
    axes.set(xscale="log", yscale="log", xlim=span, ylim=(1e-13, 3.0))
    if not rows:
        axes.text(0.5, 0.5, "no teeth that could strike", transform=axes.transAxes, ha="center", color="#777777")
        return
    if all(row[column] < 1e-14 for row in rows if row["status"] == "ok"):
        best = next(row for row in rows if row["method"] == "adaptive" and row["status"] == "ok")
        axes.text(0.5, 0.5, f"closed form:\nno error at any setting,\n{1e9 * best['cpu_s'] / 18:.0f} ns a "
                  "communication step", transform=axes.transAxes, ha="center", va="center", color="#444444")
        return
    floor = rows[0]["reference_" + column]
    if floor > 0.0:
        axes.axhspan(1e-16, floor, color="#dddddd", lw=0, zorder=0)
    if "own" in rows[0]["reference"]:
        axes.text(0.985, 0.97, "*", transform=axes.transAxes, ha="right", va="top", fontsize=15, color="#666666")
    for method, (color, marker, label) in METHODS.items():
        good = [row for row in rows if row["method"] == method and row["status"] == "ok" and work(row) > 0]
        x, y = [work(row) for row in good], [max(row[column], FLOOR) for row in good]
        size = 3.5
        if spread and good:
            bars = [[x_ * (1.0 - row["cpu_s_low"] / row["cpu_s"]) for x_, row in zip(x, good)],
                    [x_ * (row["cpu_s_high"] / row["cpu_s"] - 1.0) for x_, row in zip(x, good)]]
            axes.errorbar(x, y, xerr=bars, color=color, marker=marker, ms=size, lw=1.4, elinewidth=0.8, label=label)
        else:
            axes.plot(x, y, color=color, marker=marker, ms=size, lw=1.4, label=label)
        if method == "adaptive":
            default = [(x_, y_) for x_, y_, row in zip(x, y, good) if row["setting"] == 1e-6]
            axes.plot(*zip(*default), ls="", marker="o", ms=11, mfc="none", mec="#111111", mew=1.3, zorder=5)
    failed = [row for row in rows if row["status"] == "failed"]
    for place, row in enumerate(failed):
        axes.plot(0.04 + 0.045 * place, 0.955, transform=axes.transAxes, marker="x", color=METHODS[row["method"]][0], ms=7,
                  mew=2, ls="", clip_on=False)


def finish(figure, grid, xlabel, ylabel, titles=True):
    for axes, motion, _ in grid:
        spec = axes.get_subplotspec()
        if spec.is_first_col():
            axes.set_ylabel(f"{MOTIONS[motion]}\n\n{ylabel}")
        if spec.is_last_row():
            axes.set_xlabel(xlabel, fontsize=10)
        axes.xaxis.set_major_locator(LogLocator(numticks=12))
        axes.yaxis.set_major_locator(LogLocator(numticks=8))
        axes.xaxis.set_minor_formatter(NullFormatter())
        axes.yaxis.set_minor_formatter(NullFormatter())
    handles = {}
    for axes, *_ in grid:
        for handle, label in zip(*axes.get_legend_handles_labels()):
            handles.setdefault(label, handle)
    figure.legend(handles.values(), handles.keys(), loc="outside upper center", ncols=5, fontsize=10.5)


if __name__ == "__main__":
    main()
