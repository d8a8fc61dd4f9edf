"""Draws what facets of solid teeth cost from the CSV files that `fmu-build solids` measured.

usage: solids.py FOLDER
"""

import sys
from pathlib import Path

import matplotlib.pyplot as plt
import numpy as np
from matplotlib.ticker import FuncFormatter, LogLocator, NullFormatter

from cost import read
from figures import caption, save

DEEPEST, PATCH, EXACT = "#d1495b", "#1f6fb4", "#111111"
# smoothing: colour, marker, name
KINDS = {0.02: (DEEPEST, "s", "deepest point"), 1.0: (PATCH, "o", "patch (default)")}
# facets in the figure of one cycle
CYCLE = [4, 8, 16, 32]


def main():
    folder = Path(sys.argv[1])
    machine, rows = read(folder / "solids.csv")
    convergence(folder, machine, rows)
    cycle(folder)


def convergence(folder, machine, rows):
    exact, solids = rows[0], rows[1:]
    figure, axes = plt.subplots(2, 2, figsize=(13, 10.6), layout="constrained")
    panels = [
        (axes[0][0], "Transmission error", "error, µm", "", [("te_rms_um", "-", "all (rms)"), ("te_swing_rms_um", ":", "swing, mean taken out (rms)")]),
        (axes[0][1], "Speed of the side gears", "error, °/s", "", [("speed_path_rms_deg_s", "-", "on the path of contact (rms)"),
                                                                  ("speed_corner_rms_deg_s", ":", "at tip corners (rms)")]),
        (axes[1][0], "Normal force of a side gear", "error, % of the mean", "force",
         [("force_path_ripple_N", "-", "ripple on the path, by facets alone"), ("force_mean_N", ":", "mean")]),
    ]
    for ax, title, ylabel, kind, series in panels:
        scale = 100.0 / exact["mean_force_N"] if kind == "force" else 1.0
        lowest, highest = [], []
        for smoothing, (color, marker, name) in KINDS.items():
            own = [row for row in solids if row["smoothing"] == smoothing]
            for column, line, label in series:
                values = [scale * row[column] for row in own]
                ax.plot([row["facets"] for row in own], values, color=color, marker=marker, ms=5, ls=line, lw=1.8,
                        mfc=color if line == "-" else "white", label=f"{name}: {label}")
                lowest.append(min(values))
                highest.append(max(values))
        low, high = min(lowest), max(highest)
        n = np.array([min(row["facets"] for row in solids), max(row["facets"] for row in solids)], float)
        for order, text in [(1, "∝ 1/n"), (2, "∝ 1/n²")]:
            line = 1.6 * high * (n / n[0]) ** -order
            ax.plot(n, line, color="#888888", lw=1.0, ls="--")
            ax.text(n[1] * 1.06, line[1], text, color="#666666", va="center", fontsize=10)
        ax.set(xscale="log", yscale="log", title=title, xlabel="facets per flank n", ylabel=ylabel,
               xlim=(0.85 * n[0], 1.75 * n[1]), ylim=(0.04 * min(low, 1.6 * high * (n[1] / n[0]) ** -2), 3.0 * high))
        ax.set_xticks([f for f in (4, 8, 16, 32, 64, 128) if n[0] <= f <= n[1]])
        ax.xaxis.set_major_formatter(FuncFormatter(lambda value, _: f"{value:g}"))
        ax.xaxis.set_minor_formatter(NullFormatter())
        ax.legend(loc="lower left", fontsize=9.5)
    ax = axes[1][1]
    for smoothing, (color, marker, name) in KINDS.items():
        own = [row for row in solids if row["smoothing"] == smoothing]
        ax.plot([1.0 / row["real_time"] for row in own], [row["speed_rms_deg_s"] for row in own], color=color, marker=marker, ms=5,
                lw=1.8, label=name)
        for row in own:
            if row["facets"] in (4, 8, 16, 32, 64, 128):
                ax.annotate(f"{row['facets']:.0f}", (1.0 / row["real_time"], row["speed_rms_deg_s"]),
                            xytext=(-5, -5) if smoothing < 1.0 else (6, 3), ha="right" if smoothing < 1.0 else "left",
                            va="top" if smoothing < 1.0 else "bottom", textcoords="offset points", color=color, fontsize=10)
    ax.plot(1.0 / exact["real_time"], exact["speed_rms_usual_deg_s"], marker="*", ms=15, color=EXACT, ls="",
            label="exact teeth (1e-6 against 1e-9)")
    ax.axvline(1.0, color="#666666", ls="--", lw=1)
    middle = np.sqrt(max(row["speed_rms_deg_s"] for row in solids) * exact["speed_rms_usual_deg_s"])
    ax.text(0.93, middle, "real time", rotation=90, color="#555555", va="center", ha="right", fontsize=10)
    most = max(row["speed_rms_deg_s"] for row in solids)
    ax.set(xscale="log", yscale="log", title="Error of speed against cost", ylim=(0.3 * exact["speed_rms_usual_deg_s"], 4.0 * most), ylabel="error of speed (rms), °/s",
           xlabel="seconds on the processor per second simulated; numbers at points: facets")
    ax.xaxis.set_minor_formatter(NullFormatter())
    ax.yaxis.set_major_locator(LogLocator(numticks=8))
    ax.legend(loc="center left", fontsize=9.5)
    caption(figure, "Solid teeth with n facets on each flank against exact ones, in the study's turn. On the path of contact (upper "
            "right, full lines) the deepest point alone turns from facet to facet: its ripple of speed and force falls with 1/n "
            "only, and the patch is ahead. At tip corners (dotted) it is the other way round: the edge cuts the patch off, so that pairs "
            "enter late and leave early, until the patch is much shorter than the hand-over. The transmission error follows the "
            "height of the arcs over the facets, ∝ 1/n². The mean force hardly feels facets. Lower right: exact teeth (star) are at once "
            "more accurate and cheaper than solids by orders of magnitude. Errors at tolerance 1e-9, times at the default 1e-6. "
            f"{machine}.")
    save(figure, folder, "solids_convergence")


def cycle(folder):
    _, rows = read(folder / "solids_cycle.csv")
    shown = [n for n in CYCLE if any(row["facets"] == n for row in rows)]
    figure, axes = plt.subplots(len(shown), 2, figsize=(13, 2.7 * len(shown) + 1.4), layout="constrained", sharex=True, sharey="col",
                                squeeze=False)
    exact = [row for row in rows if row["teeth"] == "tooth"]
    start = exact[0]["time_s"]
    for i, n in enumerate(shown):
        for ax, column, scale in zip(axes[i], ["force_N", "speed_deg_s"], [1e-3, 1.0]):
            for smoothing, (color, _, name) in KINDS.items():
                own = [row for row in rows if row["facets"] == n and row["smoothing"] == smoothing]
                ax.plot([1e3 * (row["time_s"] - start) for row in own], [scale * row[column] for row in own], color=color, lw=1.2, label=name)
            ax.text(0.012, 0.97, f"{n} facets", transform=ax.transAxes, va="top", fontsize=12, fontweight="bold",
                    bbox={"facecolor": "white", "alpha": 0.8, "edgecolor": "none", "pad": 2})
            ax.plot([1e3 * (row["time_s"] - start) for row in exact], [scale * row[column] for row in exact], color=EXACT, lw=1.1,
                    ls=(0, (4, 2)), label="exact teeth")
        axes[i][0].set_ylabel("kN")
        axes[i][1].set_ylabel("°/s")
    axes[0][0].set_title("Normal force of the left side gear, all planets, kN")
    axes[0][1].set_title("Speed of the left side gear, °/s")
    for ax in axes[-1]:
        ax.set_xlabel("time, ms: one mesh cycle" if len(exact) > 1000 else "time, ms")
        ax.set_xlim(0.0, 1e3 * (exact[-1]["time_s"] - start))
    handles, labels = axes[0][0].get_legend_handles_labels()
    figure.legend(handles, labels, loc="outside upper center", ncols=3)
    caption(figure, "What facets do in the study's turn, coarse to fine. Exact teeth (dashed) run evenly but where a tip corner takes "
            "load over or hands it on. The deepest point alone (red) goes from facet to facet: waves and spikes of speed and force that get "
            "smaller and more with the number of facets. The patch (blue), as wide as a facet, has next to none, but is cut off at "
            "the tip edge, so that pairs enter late and leave early; with 4 facets no hand-over is left. The load is constant throughout.")
    save(figure, folder, "solids_cycle")


if __name__ == "__main__":
    main()
