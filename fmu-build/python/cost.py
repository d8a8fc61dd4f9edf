"""Draws the figures of what accuracy costs from the CSV files that `fmu-build cost` measured.

usage: cost.py FOLDER
"""

import csv
import sys
import textwrap
from pathlib import Path

import matplotlib.pyplot as plt
import numpy as np
from matplotlib.colors import BoundaryNorm, ListedColormap
from matplotlib.ticker import FuncFormatter, LogLocator, NullFormatter

from figures import caption, save

# methods: colour, marker, name in legends
METHODS = {
    "adaptive": ("#1f6fb4", "o", "adaptive (Rodas5P), the default"),
    "radau": ("#d1495b", "s", "radau (Radau IIA, order 5)"),
    "rodas4": ("#5b8c5a", "^", "rodas4 (order 4)"),
    "dormand_prince": ("#b7791f", "v", "dormand_prince (explicit, order 5)"),
    "fixed_step": ("#7b5ea7", "D", "fixed_step (order 2, steps instead of tolerances)"),
}
# solvers of others: line styles and marks; this program among them, and cases that are the same
FOREIGN, FOREIGN_MARKS, OURS = ["-", "--", ":", "-."], ["o", "s", "^", "v", "D", "P", "X"], "this program"
FOREIGN_CASES = {"turn_equilibrium": "turn/impact", "turn, force along a line": "turn/line"}
MOTIONS = {"turn": "turn, one tooth, 0.18 s", "blow": "turn from mid-gap:\nteeth strike, 20 ms",
           "clunk": "clunk: lash crossed,\nshafts wind up, 20 ms"}
FIDELITIES = {"ideal": "ideal: no teeth", "lumped": "lumped: a spring per mesh",
              "impact": "tooth pairs, law impact", "line": "tooth pairs, law line"}
# communication steps of the ladder's turn
TURN_STEPS = 360
# errors below this are drawn here: rounding
FLOOR = 1.5e-13


def main():
    folder = Path(sys.argv[1])
    figures = [work_precision, fidelity_ladder, effects, communication_step]
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


def foreign_solvers(folder):
    """Solvers of others on cases that are here too, if they were measured: by case, then by solver, rows with their cost.

    Costs are over that of this program in the same file, as the runs there are longer."""
    path = folder / "foreign.csv"
    found = {}
    for row in read(path)[1] if path.is_file() else []:
        case = FOREIGN_CASES.get(row["case"])
        if case and row["status"] in (0.0, "ok"):
            found.setdefault(case, {}).setdefault(row["solver"], []).append(row)
    for solvers in found.values():
        default = next((row for row in solvers.get(OURS, []) if np.isclose(row["tolerance"], 1e-6)), None)
        for rows in solvers.values():
            for row in rows:
                row["cost"] = row["cpu_s"] / default["cpu_s"] if default else np.nan
    # of a solver's variants the first, with the exact Jacobian where it takes one
    return {case: {name.split(",")[0]: rows for name, rows in reversed(solvers.items()) if not name.startswith(OURS)}
            for case, solvers in found.items()}


def number(text):
    try:
        return float(text)
    except ValueError:
        return text


def work_precision(folder):
    machine, rows = read(folder / "work_precision.csv")
    foreign = foreign_solvers(folder)
    costs = [row["cost"] for row in rows if row["status"] == "ok"]
    costs += [row["cost"] for solvers in foreign.values() for theirs in solvers.values() for row in theirs]
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
            for k, (solver, theirs) in enumerate(foreign.get(case, {}).items()):
                axes.plot([row["cost"] for row in theirs], [max(row[column], FLOOR) for row in theirs], color="#888888",
                          ls=FOREIGN[k % len(FOREIGN)], marker=FOREIGN_MARKS[k % len(FOREIGN_MARKS)], ms=3.5, mfc="white", lw=1.1,
                          label=solver)
        finish(figure, grid, "time on the processor, × the default's (adaptive, 1e-6)", f"error in {what}")
        counts = sorted({int(row["runs"]) for row in rows if row["status"] == "ok"})
        caption(figure, f"What accuracy costs: error in the {what} (largest at any compared time, relative) against time; "
                "further down and further left is better. Tolerances run from loose (left) to tight (right); a ring marks the "
                "default, adaptive at 1e-6, whose time is 1 in every panel. Crosses at the top: settings that fail. Grey "
                f"band: below what the reference can tell. {sources}Results are compared every 10 ms (turn), or 1 ms and "
                "more (blows), so that the host does not dictate the steps. Median of "
                f"{counts[0] if counts[0] == counts[-1] else f'{counts[0]} to {counts[-1]}'} runs in turn, quartiles as bars. {machine}.")
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
            "takes the same number of evaluations at any tolerance in the turns: not accuracy but the stiffness of loaded teeth "
            "dictates its steps. In the clunk teeth fly most of the time, and it keeps up. Ring: the default. *: this program's "
            f"own methods stand in as reference. {machine}.")
    save(figure, folder, "work_precision_counts")


def fidelity_ladder(folder):
    machine, rows = read(folder / "fidelity_ladder.csv")
    scenes = {"turn": "The study's turn: one tooth, settled", "clunk": "Clunk: the lash is crossed, half-shafts wind up"}
    count = len({(row["scene"], row["rung"]) for row in rows})
    figure, grid = plt.subplots(2, 2, figsize=(15, 2.8 + 0.55 * count), layout="constrained", width_ratios=[3.1, 1])
    colors = ListedColormap(["#2f7d4f", "#8cc084", "#f2d680", "#e59a6f", "#c94f4f"])
    limits = BoundaryNorm([0.0, 1e-3, 1e-2, 0.1, 0.5, 1e9], colors.N)
    for (left, right), (scene, title) in zip(grid, scenes.items()):
        own = [row for row in rows if row["scene"] == scene]
        rungs = list(dict.fromkeys(row["rung"] for row in own))
        quantities = list(dict.fromkeys(row["quantity"] for row in own))
        cell = {(row["rung"], row["quantity"]): row for row in own}
        errors = np.array([[cell[rung, quantity]["error"] for quantity in quantities] for rung in rungs])
        left.imshow(np.where(np.isfinite(errors), errors, 1e8), cmap=colors, norm=limits, aspect="auto")
        for i, rung in enumerate(rungs):
            for j, quantity in enumerate(quantities):
                row = cell[rung, quantity]
                text = "failed" if row["status"] == "failed" else shown(row["error"])
                if i == len(rungs) - 1:
                    text = valued(row["richest"], row["unit"])
                dark = errors[i, j] < 1e-3 or errors[i, j] >= 0.5
                left.text(j, i, text, ha="center", va="center", fontsize=10.5, color="white" if dark else "#222222")
        adds = [cell[rung, quantities[0]]["adds"] for rung in rungs]
        left.set(title=title + ": error against the richest rung (bottom)", xticks=range(len(quantities)),
                 yticks=range(len(rungs)))
        left.set_xticklabels([wrapped(quantity, 16) for quantity in quantities], fontsize=10)
        left.set_yticklabels([f"{rung}\n" + wrapped(what, 28) for rung, what in zip(rungs, adds)], fontsize=9.5)
        left.grid(False)
        left.tick_params(length=0)
        firsts = [cell[rung, quantities[0]] for rung in rungs]
        cost = np.array([row["cost"] for row in firsts])
        spread = [[c - row["cpu_s_low"] / row["cpu_s"] * c for c, row in zip(cost, firsts)],
                  [row["cpu_s_high"] / row["cpu_s"] * c - c for c, row in zip(cost, firsts)]]
        right.barh(range(len(rungs)), cost, xerr=spread, color="#1f6fb4", height=0.62, error_kw={"elinewidth": 1, "capsize": 2})
        for i, (c, row) in enumerate(zip(cost, firsts)):
            text = "failed" if row["status"] == "failed" else f"{two(c)} ×"
            right.text(c * 1.25 if np.isfinite(c) else 1.2, i, text, va="center", fontsize=10)
        right.set(xscale="log", title="Cost", xlabel="time, × that of ideal gears",
                  yticks=range(len(rungs)), ylim=(len(rungs) - 0.5, -0.5),
                  xlim=(0.5, 30 * np.nanmax(cost)))
        right.set_yticklabels([])
        right.grid(axis="y", visible=False)
    ideal = next(row for row in rows if (row["scene"], row["rung"]) == ("turn", "ideal"))
    caption(figure, "What each level of fidelity gets right, and what it costs. Colours: error below 0.1 % (dark green), 1 %, 10 %, "
            "50 %, and beyond (red); the bottom row has the values themselves. Mean speeds and mean forces need no teeth, peaks "
            "of a clunk the play that a spring per mesh has. Ripple needs tooth pairs or solids with many facets, deflection their stiffness, heat "
            f"friction. In the turn ideal gears are a closed form, {1e9 * ideal['cpu_s'] / TURN_STEPS:.0f} ns a communication step "
            "of 1 ms; in the clunk the half-shafts are integrated at every level. Friction costs four times the teeth, slices over the face more. "
            f"Default solver and tolerance; medians with quartiles. {machine}.")
    save(figure, folder, "fidelity_ladder")


def effects(folder):
    machine, rows = read(folder / "effects.csv")
    scenes = list(dict.fromkeys(row["scene"] for row in rows))
    looked_at = [row for row in rows if row["verdict"] not in ("not in this scene", "set off by the scene")]
    sizes = [len(dict.fromkeys(row["effect"] for row in looked_at if row["scene"] == scene)) for scene in scenes]
    figure, grid = plt.subplots(len(scenes), 2, figsize=(16, 2.4 + 0.46 * sum(sizes) + 1.3 * len(scenes)), layout="constrained",
                                width_ratios=[3.4, 1], height_ratios=sizes, squeeze=False)
    colors = ListedColormap(["#ffffff", "#e3edf6", "#a9c8e4", "#5f97c9", "#1f5a92"])
    limits = BoundaryNorm([0.0, 1e-4, 1e-2, 0.1, 0.5, 1e9], colors.N)
    verdicts = {"kept": "#c94f4f", "left out": "#2f7d4f", "refused": "#888888"}
    for (left, right), scene in zip(grid, scenes):
        own = [row for row in looked_at if row["scene"] == scene]
        names = list(dict.fromkeys(row["effect"] for row in own))
        outputs = list(dict.fromkeys(row["output"] for row in own))
        cell = {(row["effect"], row["output"]): row for row in own}
        changes = np.array([[cell[name, output]["change"] for output in outputs] for name in names])
        left.imshow(np.where(np.isfinite(changes), changes, 0.0), cmap=colors, norm=limits, aspect="auto")
        for i, name in enumerate(names):
            for j, output in enumerate(outputs):
                change, status = changes[i, j], cell[name, output]["status"]
                text = shown(change) if status == "ok" else "×" if status == "failed" else "–"
                left.text(j, i, text, ha="center", va="center", fontsize=9.5, color="white" if change >= 0.1 else "#222222")
        left.set(xticks=range(len(outputs)), yticks=range(len(names)),
                 title=f"Scene {scene}: change of each output by each effect, among all others")
        left.set_xticklabels([wrapped(output.replace("_", " ").replace(".", ". "), 13).replace(". ", ".") for output in outputs],
                             fontsize=9)
        left.set_yticklabels(names, fontsize=10)
        left.grid(False)
        left.tick_params(length=0)
        firsts = [cell[name, outputs[0]] for name in names]
        timed = np.isfinite([row["cost"] for row in firsts]).any()
        for i, row in enumerate(firsts):
            called_for = row["kept"] == "true" or row["verdict"] == "too plain"
            kind = "refused" if row["status"] == "refused" else "kept" if called_for else "left out"
            cost = row["cost"] if timed else row["evaluations"]
            if row["status"] == "ok" and np.isfinite(cost):
                right.barh(i, cost - 1.0, left=1.0, xerr=row["cost_spread"] if timed else None, color=verdicts[kind], height=0.6,
                           error_kw={"elinewidth": 1})
            label = f"{two(cost)} ×  {row['verdict']}" if np.isfinite(cost) else row["verdict"]
            right.text(1.02, i, label, transform=right.get_yaxis_transform(), va="center", fontsize=9.5, color=verdicts[kind])
            left.get_yticklabels()[i].set_color(verdicts[kind])
        right.axvline(1.0, color="#333333", lw=1)
        right.set(xscale="log", yticks=range(len(names)), ylim=(len(names) - 0.5, -0.5), title="Cost with / without, verdict",
                  xlabel="time with the effect / without" if timed else "evaluations with the effect / without")
        right.set_yticklabels([])
        right.xaxis.set_major_locator(LogLocator(subs=(1.0, 2.0, 5.0), numticks=20))
        right.xaxis.set_major_formatter(FuncFormatter(lambda value, _: f"{value:g}"))
        right.xaxis.set_minor_formatter(NullFormatter())
        right.grid(axis="y", visible=False)
    accuracy = 100.0 * rows[0]["accuracy"]
    caption(figure, f"Which effects a scene calls for at an accuracy of {accuracy:g} %. Each effect is switched in the scene with all "
            "effects on that it allows; a cell is the largest change of an output's mean, rms, minimum or maximum, on that "
            "output's scale (darker: more). Red: called for, or a level of contact too plain for the scene. Green: may stay off. "
            "Grey or –: not allowed in this scene. ×: the scene fails without. Cost of a level: the scene's over the plainer one. Effects that the scene sets off, and those that are "
            f"part of the question (limited slip, a broken tooth, the final drive), are not shown. {machine}.")
    save(figure, folder, "effects")


def shown(error):
    """A relative error in percent, short."""
    percent = 100.0 * error
    if not np.isfinite(percent):
        return "–"
    if percent < 1e-3:
        return "0 %" if percent < 1e-9 else "< 0.001 %"
    return f"{percent:.2g} %" if percent < 99.5 else f"{percent:.0f} %"


def valued(value, unit):
    """A value with its unit, in numbers that one can read."""
    if unit == 1.0:
        return f"{100.0 * value:.3g} %"
    for small, factor, name in [("m", 1e6, "µm"), ("s", 1e3, "ms"), ("J", 1e3, "mJ")]:
        if unit == small and abs(value) < 0.1:
            return f"{factor * value:.4g} {name}"
    return f"{value:,.0f} {unit}".replace(",", " ") if abs(value) >= 1e3 else f"{value:.4g} {unit}"


def two(value):
    """A ratio with two digits."""
    return f"{value:.2g}" if value < 100.0 else f"{float(f'{value:.2g}'):,.0f}".replace(",", " ")


def wrapped(text, width):
    return "\n".join(textwrap.wrap(text, width))


def communication_step(folder):
    machine, rows = read(folder / "communication_step.csv")
    text = (folder / "communication_step.csv").read_text(encoding="utf-8")
    stable = float(next(line for line in text.splitlines() if "longest stable" in line).rsplit(" ", 1)[1])
    figure, (left, right) = plt.subplots(1, 2, figsize=(14, 7.6), layout="constrained", width_ratios=[1.35, 1])
    styles = {
        ("plain", "impact"): ("#d1495b", "o", "-", "plain stepping, teeth"),
        ("plain", "ideal"): ("#d1495b", "", ":", "plain stepping, ideal gears"),
        ("rollback_once", "impact"): ("#b7791f", "^", "-", "rollback, corrected once, teeth"),
        ("rollback_twice", "impact"): ("#1f6fb4", "s", "-", "rollback, corrected twice, teeth"),
        ("rollback_twice", "ideal"): ("#1f6fb4", "", ":", "rollback, corrected twice, ideal gears"),
        ("constant_inputs", "impact"): ("#5b8c5a", "v", "-", "no coupling: constant inputs, teeth"),
    }
    failed = 0
    for (coupling, fidelity), (color, marker, line, label) in styles.items():
        own = [row for row in rows if (row["coupling"], row["fidelity"]) == (coupling, fidelity)]
        good = [row for row in own if row["status"] == "ok"]
        x = [row["h_s"] for row in good]
        left.plot(x, [max(row["speed_error"], 1e-13) for row in good], color=color, marker=marker, ls=line, ms=5, lw=1.7,
                  label=label)
        if fidelity == "impact":
            y = np.array([row["cost"] for row in good])
            spread = np.array([[1.0 - row["cpu_s_low"] / row["cpu_s"], row["cpu_s_high"] / row["cpu_s"] - 1.0] for row in good])
            right.errorbar(x, y, yerr=(spread * y[:, None]).T, color=color, marker=marker, ls=line, ms=5, lw=1.7, elinewidth=1,
                           capsize=2, label=label)
        for row in own:
            if row["status"] == "failed":
                left.plot(row["h_s"], 2.0 * 2.0**failed, marker="x", color=color, ms=8, mew=2)
                failed += 1
    steps = np.array([1e-5, 2e-3])
    for order, at, color in [(1, ("plain", "impact"), "#d1495b"), (2, ("rollback_twice", "impact"), "#1f6fb4")]:
        row = next(row for row in rows if (row["coupling"], row["fidelity"]) == at and row["h_s"] >= 0.9e-3
                   and row["status"] == "ok")
        line = 0.25 * row["speed_error"] * (steps / row["h_s"])**order
        left.plot(steps, np.maximum(line, 1e-13), color=color, lw=0.9, ls="--", alpha=0.7)
        left.text(1.2e-4, 0.25 * row["speed_error"] * (1.2e-4 / row["h_s"])**order * 0.35, f"∝ H{'²' if order == 2 else ''}",
                  color=color, ha="left", va="center")
    left.axvline(stable, color="#666666", ls="--", lw=1)
    left.text(stable * 1.12, 3e-9, f"2Jv/(Cr²) = {1e3 * stable:.1f} ms:\nbeyond, held tyre\ntorques swing", fontsize=9.5,
              color="#555555", va="center")
    left.set(xscale="log", yscale="log", xlabel="communication step H, s", ylabel="error in speed of the side gears",
             title="Error against the whole in one piece", ylim=(1e-13, 3.0))
    left.yaxis.set_major_locator(LogLocator(numticks=8))
    left.yaxis.set_minor_formatter(NullFormatter())
    left.legend(loc="upper left", fontsize=9.5, frameon=True, framealpha=0.9, edgecolor="none")
    right.set(xscale="log", yscale="log", xlabel="communication step H, s",
              ylabel="time on the processor, × plain stepping at 1 ms", title="Cost")
    right.yaxis.set_major_formatter(FuncFormatter(lambda value, _: f"{value:g}"))
    right.yaxis.set_minor_formatter(NullFormatter())
    right.legend(loc="upper right", fontsize=9.5)
    caption(figure, "A car accelerates for 0.4 s with its left wheel on ice. The host has the car and the slip-dependent forces of "
            "its tyres, the FMU the differential with teeth and the wheels. Inputs held over a step are late by H/2: order 1. A "
            "host that takes each step back and repeats it with the mean of begin and end gets order 2, for as many times "
            "the cost. Teeth and ideal gears (dotted) err alike: the error is of the coupling, and the stiff mesh never "
            "crosses the interface. What limits H is the host's own stiff part, the tyre that grips. With constant inputs H "
            "does not matter: the solver takes its own steps (tolerance 1e-9 here), and short H only costs. "
            f"{machine}.")
    save(figure, folder, "communication_step")


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
        axes.text(0.5, 0.5, "closed form:\nno error at any setting", transform=axes.transAxes, ha="center", va="center",
                  color="#444444")
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
