"""Error and cost of a coupled run against the communication step."""

import numpy as np
from matplotlib.ticker import FuncFormatter, LogLocator, NullFormatter

from bevel_differential import style
from bevel_differential.records import read
from bevel_differential.style import BLUE, FAINT, GREEN, OCHRE, RED

# coupling and fidelity: colour, marker, line, name
CURVES = {
    ("plain", "impact"): (RED, "o", "-", "inputs held, teeth"),
    ("plain", "ideal"): (RED, "", ":", "inputs held, ideal gears"),
    ("rollback_once", "impact"): (OCHRE, "^", "-", "step repeated once, teeth"),
    ("rollback_twice", "impact"): (BLUE, "s", "-", "step repeated twice, teeth"),
    ("rollback_twice", "ideal"): (BLUE, "", ":", "step repeated twice, ideal gears"),
    ("constant_inputs", "impact"): (GREEN, "v", "-", "no coupling: constant inputs, teeth"),
}


def communication_step(folder):
    path = folder / "communication_step.csv"
    machine, rows = read(path)
    stable = float(next(line for line in path.read_text(encoding="utf-8").splitlines() if "longest stable" in line).rsplit(" ", 1)[1])
    figure, (left, right) = style.panels(1, 2, 7.6, width_ratios=[1.35, 1])
    failed = 0
    for (coupling, fidelity), (color, marker, line, label) in CURVES.items():
        own = [row for row in rows if (row["coupling"], row["fidelity"]) == (coupling, fidelity)]
        good = [row for row in own if row["status"] == "ok"]
        x = [row["h_s"] for row in good]
        left.plot(x, [max(row["speed_error"], 1e-13) for row in good], color=color, marker=marker, ls=line, ms=5, label=label)
        if fidelity == "impact":
            y = np.array([row["cost"] for row in good])
            spread = np.array([[1.0 - row["cpu_s_low"] / row["cpu_s"], row["cpu_s_high"] / row["cpu_s"] - 1.0] for row in good])
            right.errorbar(x, y, yerr=(spread * y[:, None]).T, color=color, marker=marker, ls=line, ms=5, elinewidth=1,
                           capsize=2, label=label)
        for row in own:
            if row["status"] == "failed":
                left.plot(row["h_s"], 2.0 * 2.0**failed, marker="x", color=color, ms=8, mew=2)
                failed += 1
    orders(left, rows)
    left.axvline(stable, color=FAINT, ls="--", lw=1)
    left.text(stable * 1.12, 3e-9, f"2Jv/(Cr²) = {1e3 * stable:.1f} ms:\nabove it held tyre\ntorques oscillate",
              fontsize=style.SMALL, color=FAINT, va="center")
    left.set(xscale="log", yscale="log", xlabel="communication step H, s", ylabel="error in speed of the side gears",
             title="Error against the whole as one set of equations", ylim=(1e-13, 3.0))
    left.yaxis.set_major_locator(LogLocator(numticks=8))
    left.yaxis.set_minor_formatter(NullFormatter())
    left.legend(loc="upper left", fontsize=style.SMALL, frameon=True, framealpha=0.9, edgecolor="none")
    right.set(xscale="log", yscale="log", xlabel="communication step H, s",
              ylabel="time on the processor, × inputs held at 1 ms", title="Cost")
    low, high = right.get_ylim()
    right.set_ylim(low, 2.5 * high)
    right.yaxis.set_major_locator(LogLocator(subs=(1.0, 2.0, 5.0)))
    right.yaxis.set_major_formatter(FuncFormatter(lambda value, _: f"{value:g}"))
    right.yaxis.set_minor_formatter(NullFormatter())
    right.legend(loc="upper right", fontsize=style.SMALL)
    style.caption(figure, "A car accelerates for 0.4 s with its left wheel on ice. The host has the car and the slip-dependent forces of "
                  "its tyres, the FMU the differential with teeth and the wheels. Inputs held over a step are late by H/2: order 1. A "
                  "host that restores the state and repeats each step with the mean of the inputs at its begin and end gets order 2, "
                  "at the cost of the repetitions. Teeth and ideal gears (dotted) have the same error: it comes from the coupling, and "
                  "the stiff mesh stays inside the FMU. H is limited by the host's own stiff part, the tyre that grips. With constant "
                  "inputs H does not matter: the solver chooses its own steps (tolerance 1e-9 here), and short H only costs time. "
                  f"{machine}.")
    style.save(figure, folder / "communication_step.png")


def orders(axes, rows):
    """Lines of order 1 and 2 below the curves they belong to."""
    steps = np.array([1e-5, 2e-3])
    for order, curve, color in [(1, ("plain", "impact"), RED), (2, ("rollback_twice", "impact"), BLUE)]:
        row = next(row for row in rows if (row["coupling"], row["fidelity"]) == curve and row["h_s"] >= 0.9e-3
                   and row["status"] == "ok")
        line = 0.25 * row["speed_error"] * (steps / row["h_s"])**order
        axes.plot(steps, np.maximum(line, 1e-13), color=color, lw=0.9, ls="--", alpha=0.7)
        axes.text(1.2e-4, 0.25 * row["speed_error"] * (1.2e-4 / row["h_s"])**order * 0.35, f"∝ H{'²' if order == 2 else ''}",
                  color=color, ha="left", va="center")
