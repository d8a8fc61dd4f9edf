"""Figures of error against time and against machine-independent counts, by method, motion and level of gear contact."""

from matplotlib.ticker import LogLocator, NullFormatter

from bevel_differential import style
from bevel_differential.records import read
from bevel_differential.style import BLUE, FAINT, INK, PALE_GREY, RED, TEXT, VIOLET

# methods: colour, marker, name in legends
METHODS = {
    "adaptive": (BLUE, "o", "adaptive (Rodas5P), the default"),
    "radau": (RED, "s", "radau (Radau IIA, order 5)"),
    "fixed_step": (VIOLET, "D", "fixed_step (order 2, steps\ninstead of tolerances)"),
}
MOTIONS = {"turn": "Turn: one tooth, 0.18 s", "blow": "Turn from mid-gap: teeth\nstrike, 20 ms",
           "clunk": "Clunk: lash crossed,\nshafts wind up, 20 ms"}
FIDELITIES = {"ideal": "ideal: no teeth", "lumped": "lumped: spring per mesh",
              "impact": "tooth pairs, law impact", "line": "tooth pairs, law line"}
# smaller errors are rounding errors and are drawn at this value; the lower end of the axes is below it
FLOOR = 1e-13
LOWEST = 1e-14
HEIGHT = 10.6


def speeds(folder):
    against_time(folder, "speed_error", "work_precision", "speed", "speed of the side gears")


def forces(folder):
    against_time(folder, "force_error", "work_precision_force", "mesh force", "normal force of the meshes")


def against_time(folder, column, name, short, what):
    machine, rows = read(folder / "work_precision.csv")
    good = [row for row in rows if row["status"] == "ok"]
    costs = [row["cost"] for row in good]
    span = (0.5 * min(costs), 2.0 * max(costs))
    figure, grid = panels()
    for j, fidelity in enumerate(FIDELITIES):
        for i, motion in enumerate(MOTIONS):
            if grid[i][j]:
                own = [row for row in rows if row["case"] == f"{motion}/{fidelity}"]
                draw_case(grid[i][j], own, lambda row: row["cost"], column, span, spread=True)
    for j, title in enumerate(FIDELITIES.values()):
        grid[0 if j else 2][j].set_title(title, fontsize=11.5)
    finish(figure, grid, "time, × the default's", f"relative error of {short}")
    for axes in filter(None, grid[-1]):
        style.plain_decades(axes.xaxis)
        # labels of every decade would not fit
        axes.xaxis.set_major_locator(LogLocator(base=100.0))
    runs = sorted({int(row["runs"]) for row in good})
    times = str(runs[0]) if runs[0] == runs[-1] else f"{runs[0]} to {runs[-1]}"
    style.caption(figure, f"What accuracy costs: error in the {what} (largest at any compared time, relative) against time on the processor; "
                  "further down and further left is better. Tolerances run from loose (left) to tight (right); the ring marks the "
                  "default, adaptive at 1e-6, whose time is 1 in every panel. Crosses at the top: settings that fail. Grey band: "
                  f"smaller than the error of the reference; errors below {FLOOR:g} are drawn at {FLOOR:g}. {sources(rows)}"
                  "Results are compared every 10 ms (turn), or every 0.25 "
                  f"to 2 ms (others), so that the host does not dictate the steps. Median of {times} runs in turn, quartiles as bars. "
                  f"{machine}.")
    style.save(figure, folder / f"{name}.png")


def sources(rows):
    own = any("own" in row["reference"] for row in rows)
    return ("References: a plain Python model integrated by scipy at 1e-12"
            + (", or where that is missing (*) this program's Radau and Rodas5P at 1e-11 against each other" if own else "") + ". ")


def counts(folder):
    machine, rows = read(folder / "work_precision.csv")
    figure, axes = style.panels(3, 4, HEIGHT, sharey=True, sharex=True)
    kinds = [("lumped", "rhs_calls"), ("impact", "rhs_calls"), ("line", "rhs_calls"), ("impact", "jacobians")]
    for i, motion in enumerate(MOTIONS):
        for j, (fidelity, count) in enumerate(kinds):
            own = [row for row in rows if row["case"] == f"{motion}/{fidelity}"]
            draw_case(axes[i][j], own, lambda row: row[count], "speed_error", (10, 1e7))
    for j, (fidelity, count) in enumerate(kinds):
        what = "evaluations of forces" if count == "rhs_calls" else "Jacobians, each factorised"
        axes[0][j].set_title(f"{FIDELITIES[fidelity]}:\n{what}", fontsize=11.5)
    finish(figure, axes, "number", "relative error of speed")
    legend = handles(axes[0][1])
    figure.legend(legend.values(), legend.keys(), loc="outside upper center", ncols=5, fontsize=style.SMALL)
    style.caption(figure, "Counts that hold on any machine: error in the speed of the side gears against evaluations of "
                  "the forces (three columns) and against Jacobians (right column). Ring: the default. "
                  f"*: the reference is this program's own. {machine}.")
    style.save(figure, folder / "work_precision_counts.png")


def panels():
    """Axes by motion (rows) and level of gear contact (columns).

    Ideal gears have axes only for the clunk, because nothing is integrated in their turns. The legend fills the free space."""
    figure = style.figure(HEIGHT)
    spec = figure.add_gridspec(3, 4)
    grid, first = [[None] * 4 for _ in range(3)], None
    for i in range(3):
        for j in range(4):
            if j or i == 2:
                grid[i][j] = first = figure.add_subplot(spec[i, j], sharex=first, sharey=first)
    legend = figure.add_subplot(spec[:2, 0])
    legend.set_axis_off()
    style.note(legend, -0.38, 0.45, "Ideal gears in both turns: a closed\nform without error at any setting,\nand no teeth that "
               "could strike.", ha="left", color=FAINT)
    return figure, grid


def draw_case(axes, rows, work, column, span, spread=False):
    axes.set(xscale="log", yscale="log", xlim=span, ylim=(LOWEST, 3.0))
    if not rows:
        return
    floor = rows[0]["reference_" + column]
    if floor > 0.0:
        axes.axhspan(LOWEST, floor, color=PALE_GREY, lw=0, zorder=0)
    if "own" in rows[0]["reference"]:
        style.note(axes, 0.985, 0.94, "*", fontsize=15, color=FAINT)
    for method, (color, marker, label) in METHODS.items():
        good = [row for row in rows if row["method"] == method and row["status"] == "ok" and work(row) > 0]
        x, y = [work(row) for row in good], [max(row[column], FLOOR) for row in good]
        bars = None
        if spread and good:
            bars = [[at * (1.0 - row["cpu_s_low"] / row["cpu_s"]) for at, row in zip(x, good)],
                    [at * (row["cpu_s_high"] / row["cpu_s"] - 1.0) for at, row in zip(x, good)]]
        axes.errorbar(x, y, xerr=bars, color=color, marker=marker, ms=3.5, lw=1.4, elinewidth=0.8, label=label)
        if method == "adaptive":
            default = [(at, error) for at, error, row in zip(x, y, good) if row["setting"] == 1e-6]
            axes.plot(*zip(*default), ls="", marker="o", ms=11, mfc="none", mec=INK, mew=1.3, zorder=5)
    for place, row in enumerate(row for row in rows if row["status"] == "failed"):
        axes.plot(0.04 + 0.045 * place, 0.955, transform=axes.transAxes, marker="x", color=METHODS[row["method"]][0], ms=7,
                  mew=2, ls="", clip_on=False)


def handles(axes):
    found = {}
    for handle, label in zip(*axes.get_legend_handles_labels()):
        found.setdefault(label, handle)
    return found


def finish(figure, grid, xlabel, ylabel):
    for i, motion in enumerate(MOTIONS.values()):
        for j, axes in enumerate(grid[i]):
            if axes is None:
                continue
            first = j == 0 or grid[i][j - 1] is None
            axes.tick_params(labelleft=first, labelbottom=i == 2, which="both")
            if first:
                axes.set_ylabel(f"{motion}\n\n{ylabel}", fontsize=style.SMALL)
            if i == 2:
                axes.set_xlabel(xlabel, fontsize=style.SMALL)
            axes.xaxis.set_major_locator(LogLocator(numticks=6))
            axes.yaxis.set_major_locator(LogLocator(numticks=8))
            axes.xaxis.set_minor_formatter(NullFormatter())
            axes.yaxis.set_minor_formatter(NullFormatter())
    if grid[0][0] is None:
        legend = handles(grid[0][2])
        figure.legend(legend.values(), legend.keys(), loc="upper left", bbox_to_anchor=(0.01, 0.985),
                      labelspacing=0.9, title="methods", alignment="left", labelcolor=TEXT)
