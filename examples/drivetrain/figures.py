"""Pictures: the launch, errors against the communication step, and the flow of signals."""

from math import pi

from matplotlib.patches import Rectangle

from bevel_differential import style
from masters import ALL
from parameters import CONNECTIONS, STEP

RADIUS, RATIO = 0.334, 13.65
# rpm for 1 rad/s
RPM = 30.0 / pi


def launch(file, reference, coupled, contact):
    """Draws the launch. Lines: the whole as one set of equations; dots: the FMUs, coupled as in plain hosts."""
    panels = [
        ("torque, N·m", {f"engine × {RATIO:g}": (("engine", "torque"), RATIO), "carrier": (("final_drive", "carrier_torque"), 1),
                         "each half-shaft (both equal)": (("differential", "left.shaft_torque"), 1)}),
        ("speed, rpm", {"left wheel, on ice": (("left_wheel", "speed"), RPM), "carrier": (("differential", "carrier.speed"), RPM),
                        "right wheel, on dry road": (("right_wheel", "speed"), RPM),
                        "vehicle / tyre radius": (("vehicle", "speed"), RPM / RADIUS)}),
        ("force of the road, N", {"left wheel, on ice": (("left_wheel", "force"), 1),
                                  "right wheel, on dry road": (("right_wheel", "force"), 1)}),
    ]
    style.apply()
    figure, axes = style.panels(3, 1, 11.0, sharex=True)
    # a dot for every hundredth of a second
    apart = max(round(0.01 / (coupled[0][1] - coupled[0][0])), 1)
    for axis, (label, lines) in zip(axes, panels):
        for name, (signal, factor) in lines.items():
            line, = axis.plot(reference[0], reference[1][signal] * factor, label=name)
            axis.plot(coupled[0][::apart], coupled[1][signal][::apart] * factor, ".", color=line.get_color(), markersize=7)
        axis.set_ylabel(label)
        axis.legend(loc="upper left", bbox_to_anchor=(1.0, 1.0))
    axes[0].set_title("Launch on split friction: left wheel on ice, right wheel on dry road")
    axes[-1].set(xlabel="time, s", xlim=(0.0, reference[0][-1]))
    style.caption(figure, "A car starts with its left wheel on ice. The wheel on ice spins up; the open differential gives both half-shafts "
                  "the same torque, so the wheel on dry road gets little more than the ice transmits. "
                  "Lines: the whole drivetrain as one set of equations. Dots: six FMUs coupled by a plain host in steps of "
                  f"{STEP * 1e3:g} ms; they agree with the lines. gear_contact = {contact}.")
    style.save(figure, file)


def errors(file, rows, limits):
    """Draws errors, log-log, with lines of order 1 and 2, and the predicted limits as vertical lines."""
    contacts = list(dict.fromkeys(row["contact"] for row in rows))
    style.apply()
    figure, axes = style.panels(1, len(contacts), 7.6, sharey=True, squeeze=False)
    axes = axes[0]
    for axis, contact in zip(axes, contacts):
        for (name, master), color, marker in zip(ALL.items(), style.CYCLE, style.MARKERS):
            own = [row for row in rows if (row["contact"], row["master"], row["state"]) == (contact, name, "ok")]
            axis.plot([row["step"] * 1e3 for row in own], [100.0 * row["largest"] for row in own], marker=marker, color=color,
                      label=master.label, markersize=6)
            axis.axvline(limits[name]["predicted"] * 1e3, color=color, linestyle=":", linewidth=1.3)
        axis.set(xscale="log", yscale="log", title=f"gear_contact = {contact}", xlabel="communication step, ms")
        for order, at, level in ((1, 1e-2, 1e-1), (2, 2e-2, 1.5e-5)):
            ends = (at, 3.0 * at)
            axis.plot(ends, [level * (end / at) ** order for end in ends], color=style.INK, linewidth=1)
            axis.text(ends[1], level * 3.0**order, f" order {order}", fontsize=style.SMALL, va="center")
        style.plain_decades(axis.xaxis)
    style.plain_decades(axes[0].yaxis)
    axes[0].set_ylabel("largest error of any quantity, % of its largest value")
    handles, labels = axes[0].get_legend_handles_labels()
    figure.legend(handles, labels, loc="outside upper center", ncols=3)
    style.caption(figure, "Error of the coupled drivetrain against the communication step, by the way the host exchanges signals. Inputs held "
                  "over a step give order 1; inputs on lines give order 2. Dotted: the longest step that the linearised parts allow, "
                  "in the colour of the curve. With teeth and with ideal gears orders and limits are the same, "
                  "because the stiff mesh stays inside one FMU.")
    style.save(figure, file)


# boxes of the flow of signals: position, text
BOXES = {
    "engine": (0.0, 1.0, "engine\ntorque by time\nand speed, lag"),
    "final_drive": (2.6, 1.0, "final drive\ninertia, prop shaft,\nratio"),
    "differential": (5.2, 1.0, "BevelDifferential\nteeth, half-shafts\n(stiff mesh inside)"),
    "left_wheel": (7.8, 2.0, "left wheel\ninertia, tyre\non ice"),
    "right_wheel": (7.8, 0.0, "right wheel\ninertia, tyre\non dry road"),
    "vehicle": (10.4, 1.0, "vehicle\nmass, drag"),
}
WIDTH, HEIGHT = 1.48, 0.8


def signals(file):
    """Draws the signals between the parts: torques and forces as full lines, speeds as dashed lines."""
    style.apply()
    figure, axis = style.panels(1, 1, 5.2)
    for name, (x, y, text) in BOXES.items():
        own = name == "differential"
        axis.add_patch(Rectangle((x, y), WIDTH, HEIGHT, facecolor="#dbe9f6" if own else "#f3f3f3", edgecolor=style.TEXT))
        axis.text(x + WIDTH / 2, y + HEIGHT / 2, text, ha="center", va="center", fontsize=style.SMALL)
    for (to, _), (source, output) in CONNECTIONS.items():
        arrow(axis, source, to, output)
    axis.set_xlim(-0.1, 12.0)
    axis.set_ylim(-0.1, 2.95)
    axis.axis("off")
    style.caption(figure, "The drivetrain as six FMUs. Torques and forces (red) go forward, speeds (green, dashed) come back. The stiff tooth "
                  "mesh is inside one part and never crosses an interface; the half-shafts are the soft place where the parts are "
                  "cut.")
    style.save(figure, file)


def arrow(axis, source, to, output):
    forward, speed = BOXES[source][0] < BOXES[to][0], "speed" in output
    start, end = port(source, to, forward), port(to, source, forward)
    color = style.GREEN if speed else style.RED
    axis.annotate("", xy=end, xytext=start, arrowprops={"arrowstyle": "-|>", "linestyle": "--" if speed else "-", "color": color,
                                                        "linewidth": 1.5})
    label = f"{source.split('_')[-1]} speed" if output == "speed" else output
    label = label.removeprefix("left.").removeprefix("right.").replace("_", " ").replace(".", " ")
    level = start[1] == end[1]
    axis.text((start[0] + end[0]) / 2, (start[1] + end[1]) / 2 + (0.0 if not level else 0.06 if forward else -0.06), label,
              fontsize=9, ha="center", va="center" if not level else "bottom" if forward else "top", color=color,
              bbox={"facecolor": "white", "edgecolor": "none", "pad": 0.5, "alpha": 0.9})


def port(box, other, forward):
    """End of an arrow between two boxes at `box`. Forward arrows are above backward arrows."""
    (x, y, _), (_, y_other, _) = BOXES[box], BOXES[other]
    # boxes that have two neighbours on one edge reserve half of it for each
    half = 0.0 if y == y_other else (0.21 if y_other > y else -0.21) if box in ("differential", "vehicle") else 0.0
    apart = 0.11 if half else 0.22
    return x + (WIDTH if BOXES[box][0] < BOXES[other][0] else 0.0), y + HEIGHT / 2 + half + (apart if forward else -apart)
