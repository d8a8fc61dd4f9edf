"""Pictures: the launch, errors by communication step, and the flow of signals."""

import matplotlib.pyplot as plt

from masters import ALL
from parameters import CONNECTIONS, STEP

COLOURS = ("tab:blue", "tab:orange", "tab:green", "tab:red", "tab:purple")
MARKERS = ("o", "s", "^", "D", "v")


def launch(file, reference, coupled):
    """Lines: the whole as one set of equations; dots: the FMUs as plain hosts couple them."""
    radius = 0.334
    panels = [
        ("torque, N m", {"engine × 13.65": (("engine", "torque"), 13.65), "carrier": (("final_drive", "carrier_torque"), 1),
                         "each half-shaft (both alike)": (("differential", "left.shaft_torque"), 1)}),
        ("speed, rad/s", {"left wheel, on ice": (("left_wheel", "speed"), 1), "carrier": (("differential", "carrier.speed"), 1),
                          "right wheel, on dry road": (("right_wheel", "speed"), 1),
                          "vehicle / tyre radius": (("vehicle", "speed"), 1 / radius)}),
        ("force of the road, N", {"left wheel, on ice": (("left_wheel", "force"), 1),
                                  "right wheel, on dry road": (("right_wheel", "force"), 1)}),
    ]
    figure, axes = plt.subplots(3, 1, figsize=(8, 9), sharex=True, layout="constrained")
    for axis, (unit, lines) in zip(axes, panels):
        for k, (label, (signal, factor)) in enumerate(lines.items()):
            axis.plot(reference[0], reference[1][signal] * factor, color=COLOURS[k], label=label, linewidth=1.2)
            axis.plot(coupled[0][::10], coupled[1][signal][::10] * factor, ".", color=COLOURS[k], markersize=5)
        axis.set_ylabel(unit)
        axis.grid(alpha=0.3)
        axis.legend(fontsize=8)
    axes[0].set_title(f"Launch on split friction, with teeth\nlines: one set of equations; dots: FMUs, steps of "
                      f"{STEP * 1e3:g} ms", fontsize=10)
    axes[-1].set_xlabel("time, s")
    figure.savefig(file, dpi=110)
    plt.close(figure)


def errors(file, rows, limits):
    """Log-log, with lines of order 1 and 2, and the predicted limits as vertical lines."""
    contacts = list(dict.fromkeys(row["contact"] for row in rows))
    figure, axes = plt.subplots(1, len(contacts), figsize=(5.5 * len(contacts), 5.5), sharey=True, layout="constrained")
    for axis, contact in zip(axes, contacts):
        for k, (name, master) in enumerate(ALL.items()):
            own = [row for row in rows if (row["contact"], row["master"], row["state"]) == (contact, name, "ok")]
            axis.loglog([row["step"] * 1e3 for row in own], [row["largest"] for row in own], marker=MARKERS[k],
                        color=COLOURS[k], label=master.label, markersize=5, linewidth=1.2)
            axis.axvline(limits[name]["predicted"] * 1e3, color=COLOURS[k], linestyle=":", linewidth=1)
        for order, at, level in ((1, 1e-2, 1e-3), (2, 1e-1, 3e-5)):
            ends = (at, 3.0 * at)
            axis.loglog(ends, [level * (end / at) ** order for end in ends], color="black", linewidth=1)
            axis.text(ends[1], level * 3.0**order, f" order {order}", fontsize=8, va="center")
        axis.set_title(f"gear_contact = {contact}", fontsize=10)
        axis.set_xlabel("communication step, ms")
        axis.grid(alpha=0.3, which="both")
    axes[0].set_ylabel("largest error of any quantity, relative")
    axes[0].legend(fontsize=8, loc="upper left")
    figure.savefig(file, dpi=110)
    plt.close(figure)


# boxes of the flow of signals: place, text
BOXES = {
    "engine": (0.0, 1.0, "engine\ntorque by time\nand speed, lag"),
    "final_drive": (2.6, 1.0, "final drive\ninertia, prop shaft,\nratio"),
    "differential": (5.2, 1.0, "BevelDifferential\nteeth, half-shafts\n(stiff mesh inside)"),
    "left_wheel": (7.8, 2.0, "left wheel\ninertia, tyre\non ice"),
    "right_wheel": (7.8, 0.0, "right wheel\ninertia, tyre\non dry road"),
    "vehicle": (10.4, 1.0, "vehicle\nmass, drag"),
}
WIDTH, HEIGHT = 1.55, 0.75


def signals(file):
    """Who gives what to whom: torques and forces drawn full, speeds dashed."""
    figure, axis = plt.subplots(figsize=(12.5, 4.2), layout="constrained")
    for name, (x, y, text) in BOXES.items():
        own = name == "differential"
        axis.add_patch(plt.Rectangle((x, y), WIDTH, HEIGHT, facecolor="#dbe9f6" if own else "#f3f3f3", edgecolor="black"))
        axis.text(x + WIDTH / 2, y + HEIGHT / 2, text, ha="center", va="center", fontsize=8)
    for (to, _), (source, output) in CONNECTIONS.items():
        arrow(axis, source, to, output)
    axis.set_xlim(-0.2, 12.2)
    axis.set_ylim(-0.25, 3.0)
    axis.axis("off")
    figure.savefig(file, dpi=110)
    plt.close(figure)


def arrow(axis, source, to, output):
    forward, speed = BOXES[source][0] < BOXES[to][0], "speed" in output
    start, end = port(source, to, forward), port(to, source, forward)
    colour = "tab:green" if speed else "tab:red"
    axis.annotate("", xy=end, xytext=start, arrowprops={"arrowstyle": "-|>", "linestyle": "--" if speed else "-",
                                                        "color": colour})
    label = f"{source.split('_')[-1]} speed" if output == "speed" else output
    label = label.removeprefix("left.").removeprefix("right.").replace("_", " ").replace(".", " ")
    level = start[1] == end[1]
    axis.text((start[0] + end[0]) / 2, (start[1] + end[1]) / 2 + (0.0 if not level else 0.06 if forward else -0.06), label,
              fontsize=7, ha="center", va="center" if not level else "bottom" if forward else "top", color=colour,
              bbox={"facecolor": "white", "edgecolor": "none", "pad": 0.5, "alpha": 0.9})


def port(box, other, forward):
    """Where an arrow between two boxes meets `box`: what goes forward lies above what comes back."""
    (x, y, _), (_, y_other, _) = BOXES[box], BOXES[other]
    # boxes that have two neighbours on one edge keep a half for each
    half = 0.0 if y == y_other else (0.19 if y_other > y else -0.19) if box in ("differential", "vehicle") else 0.0
    apart = 0.1 if half else 0.2
    return x + (WIDTH if BOXES[box][0] < BOXES[other][0] else 0.0), y + HEIGHT / 2 + half + (apart if forward else -apart)
