"""Figures of the errors and cost of faceted solid teeth, from solids.csv and solids_cycle.csv."""

import numpy as np
from matplotlib.ticker import FuncFormatter, NullFormatter

from bevel_differential import style
from bevel_differential.records import read
from bevel_differential.style import BLUE, FAINT, INK, RED, TEXT

# smoothing: colour, marker, name
KINDS = {0.02: (RED, "s", "deepest point"), 1.0: (BLUE, "o", "patch (default)")}
# numbers of facets: in the figure of one mesh cycle, and marked on the axes
CYCLE, MARKED = [4, 8, 16, 32], (4, 8, 16, 32, 64, 128)
# rpm for 1 deg/s
RPM = 1.0 / 6.0
# panels: title, label of the y axis, factor of the values or None for per cent of the mean force; columns, each with line style and name
PANELS = [
    ("Transmission error", "error, µm", 1.0,
     [("te_rms_um", "-", "all (rms)"), ("te_swing_rms_um", ":", "swing, mean taken out (rms)")]),
    ("Speed of the side gears", "error, rpm", RPM,
     [("speed_path_rms_deg_s", "-", "on the path of contact (rms)"), ("speed_corner_rms_deg_s", ":", "at tip corners (rms)")]),
    ("Normal force of a side gear", "error, % of the mean", None,
     [("force_path_ripple_N", "-", "ripple on the path, only from facets"), ("force_mean_N", ":", "mean")]),
]


def draw(folder):
    """Draws both figures from the CSV files in `folder`."""
    style.apply()
    machine, rows = read(folder / "solids.csv")
    convergence(folder, machine, rows)
    cycle(folder)


def convergence(folder, machine, rows):
    exact, solids = rows[0], rows[1:]
    figure, axes = style.panels(2, 2, 10.6)
    for panel, (title, ylabel, factor, columns) in zip(axes.flat, PANELS):
        against_facets(panel, solids, columns, 100.0 / exact["mean_force_N"] if factor is None else factor)
        panel.set(title=title, ylabel=ylabel)
    against_cost(axes[1][1], exact, solids)
    style.caption(figure, "Solid teeth with n facets on each flank against exact ones, in the study's turn. On the path of contact "
                  "(upper right, full lines) the deepest point moves from facet to facet: its ripple of speed and force falls "
                  "with 1/n only, and the patch has the smaller error. At tip corners (dotted) the patch has the larger error: the "
                  "tooth edge cuts it off, and pairs enter late and leave early. This ends when the patch is much shorter than the "
                  "hand-over. The transmission error follows the height of the arcs over the facets, ∝ 1/n². The mean force hardly "
                  "depends on facets. Lower right: exact teeth (star) are both more accurate and cheaper than solids by orders of "
                  f"magnitude. Errors at tolerance 1e-9, times at the default 1e-6. {machine}.")
    style.save(figure, folder / "solids_convergence.png")


def against_facets(axes, solids, columns, scale):
    low, high = np.inf, 0.0
    for smoothing, (color, marker, name) in KINDS.items():
        own = [row for row in solids if row["smoothing"] == smoothing]
        for column, line, label in columns:
            values = [scale * row[column] for row in own]
            axes.plot([row["facets"] for row in own], values, color=color, marker=marker, ms=5, ls=line,
                      mfc=color if line == "-" else "white", label=f"{name}: {label}")
            low, high = min(low, *values), max(high, *values)
    n = np.array([min(row["facets"] for row in solids), max(row["facets"] for row in solids)], float)
    for order, text in [(1, "∝ 1/n"), (2, "∝ 1/n²")]:
        line = 1.6 * high * (n / n[0]) ** -order
        axes.plot(n, line, color=FAINT, lw=1.0, ls="--")
        axes.text(n[1] * 1.06, line[1], text, color=FAINT, va="center", fontsize=style.SMALL)
    axes.set(xscale="log", yscale="log", xlabel="facets per flank n", xlim=(0.85 * n[0], 1.75 * n[1]),
             ylim=(0.04 * min(low, 1.6 * high * (n[1] / n[0]) ** -2), 3.0 * high))
    axes.set_xticks([facets for facets in MARKED if n[0] <= facets <= n[1]])
    axes.xaxis.set_major_formatter(FuncFormatter(lambda value, _: f"{value:g}"))
    axes.xaxis.set_minor_formatter(NullFormatter())
    style.plain_decades(axes.yaxis)
    axes.legend(loc="lower left", fontsize=style.SMALL)


def against_cost(axes, exact, solids):
    for smoothing, (color, marker, name) in KINDS.items():
        own = [row for row in solids if row["smoothing"] == smoothing]
        axes.plot([1.0 / row["real_time"] for row in own], [RPM * row["speed_rms_deg_s"] for row in own], color=color, marker=marker,
                  ms=5, label=name)
        for row in own:
            if row["facets"] in MARKED:
                # away from the other line, which crosses this one between 32 and 64 facets
                above = (smoothing == 1.0) == (row["facets"] <= 32)
                axes.annotate(f"{row['facets']:.0f}", (1.0 / row["real_time"], RPM * row["speed_rms_deg_s"]),
                              xytext=(6, 3) if above else (-5, -5), ha="left" if above else "right",
                              va="bottom" if above else "top", textcoords="offset points", color=color, fontsize=style.SMALL)
    usual, most = RPM * exact["speed_rms_usual_deg_s"], RPM * max(row["speed_rms_deg_s"] for row in solids)
    axes.plot(1.0 / exact["real_time"], usual, marker="*", ms=15, color=INK, ls="", label="exact teeth (1e-6 against 1e-9)")
    axes.axvline(1.0, color=FAINT, ls="--", lw=1)
    axes.text(0.93, np.sqrt(most * usual), "real time", rotation=90, color=TEXT, va="center", ha="right", fontsize=style.SMALL)
    axes.set(xscale="log", yscale="log", title="Error of speed against cost (numbers: facets)", ylim=(0.3 * usual, 4.0 * most),
             ylabel="error of speed (rms), rpm", xlabel="seconds on the processor per second simulated")
    for axis in (axes.xaxis, axes.yaxis):
        style.plain_decades(axis)
    axes.legend(loc="center left", fontsize=style.SMALL)


def cycle(folder):
    _, rows = read(folder / "solids_cycle.csv")
    shown = [n for n in CYCLE if any(row["facets"] == n for row in rows)]
    figure, axes = style.panels(len(shown), 2, 2.7 * len(shown) + 1.6, sharex=True, sharey="col", squeeze=False)
    exact = [row for row in rows if row["teeth"] == "tooth"]
    start = exact[0]["time_s"]

    def draw(panel, own, column, scale, **line):
        panel.plot([1e3 * (row["time_s"] - start) for row in own], [scale * row[column] for row in own], **line)

    for i, n in enumerate(shown):
        for panel, column, scale in zip(axes[i], ["force_N", "speed_deg_s"], [1e-3, RPM]):
            for smoothing, (color, _, name) in KINDS.items():
                own = [row for row in rows if row["facets"] == n and row["smoothing"] == smoothing]
                draw(panel, own, column, scale, color=color, lw=1.4, label=name)
            draw(panel, exact, column, scale, color=INK, lw=1.1, ls=(0, (4, 2)), label="exact teeth")
            style.note(panel, 0.012, 0.93, f"{n} facets", ha="left", va="top", fontweight="bold",
                       bbox={"facecolor": "white", "alpha": 0.8, "edgecolor": "none", "pad": 2})
        axes[i][0].set_ylabel("force, kN")
        axes[i][1].set_ylabel("speed, rpm")
    axes[0][0].set_title("Normal force of the left side gear, all planets")
    axes[0][1].set_title("Speed of the left side gear")
    for panel in axes[-1]:
        panel.set_xlabel("time, ms: one mesh cycle" if len(exact) > 1000 else "time, ms")
        panel.set_xlim(0.0, 1e3 * (exact[-1]["time_s"] - start))
    handles, labels = axes[0][0].get_legend_handles_labels()
    figure.legend(handles, labels, loc="outside upper center", ncols=3)
    style.caption(figure, "Effect of facets in the study's turn, coarse to fine. Exact teeth (dashed) run evenly except where a tip corner "
                  "takes load over or hands it on. The deepest point (red) goes from facet to facet: waves and spikes of speed "
                  "and force that get smaller and more frequent with the number of facets. The patch (blue), as wide as a facet, has "
                  "almost none. The tip edge cuts the patch off: pairs enter late and leave early. With 4 facets the "
                  "hand-over is lost. The load is constant throughout.")
    style.save(figure, folder / "solids_cycle.png")
