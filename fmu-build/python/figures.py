"""Figures of the study: speeds, tooth forces, spectrum of the forces."""

import textwrap

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt  # noqa: E402
import numpy as np  # noqa: E402

LEFT, RIGHT, CARRIER, THEORY, CLAIM = "#1f6fb4", "#d1495b", "#6b7280", "#111111", "#b7791f"
DPI = 130
# caption: characters per line and height of a line in inches, at its font size
CAPTION_WIDTH, CAPTION_LINE, CAPTION_SIZE = 168, 0.19, 10.5
# highest frequency shown
SPECTRUM_END = 120.0
# amplitudes below this share of the mean force are drawn at the bottom
SPECTRUM_BOTTOM = 1e-9

plt.rcParams.update({
    "font.size": 11, "axes.titlesize": 12, "axes.titleweight": "bold", "axes.grid": True, "grid.alpha": 0.3,
    "axes.spines.top": False, "axes.spines.right": False, "legend.frameon": False, "figure.facecolor": "white",
})


def speeds(folder, order, runs):
    figure = plt.figure(figsize=(13, 9.4), layout="constrained")
    grid = figure.add_gridspec(2, 2, height_ratios=[1.25, 1])
    for column, (case, title) in enumerate([("straight", "Straight ahead"), ("turning", "Turn")]):
        run, expected = runs[case], order[case]
        title = f"{title}, {expected['vehicle_speed']:.0f} km/h"
        axes = figure.add_subplot(grid[0, column])
        draw_speeds(axes, run["record"], order["duration"], 1.0)
        left, right = expected["side_speeds"]
        span = expected["carrier_speed"]
        axes.set(title=title, xlabel="time, s", ylabel="speed, °/s", xlim=(0, order["duration"]),
                 ylim=(-0.02 * span, 1.48 * span))
        axes.legend(loc="upper right", ncols=3)
        if left != right:
            note(axes, 0.98, 0.86, f"theory ω₀ ± ωₚ zₚ/zₛ: {left:.0f} and {right:.0f} °/s")
        else:
            note(axes, 0.98, 0.86, f"theory ω₁ = ω₂ = ω₀ = {left:.0f} °/s")
        inset = axes.inset_axes([0.36, 0.12, 0.60, 0.34])
        draw_speeds(inset, run["start"], order["start_record"] / 2.0, 1e3)
        shown = order["start_record"] / 2.0 * 1e3
        inset.set_title(f"the first {shown:.1f} ms, every {order['start_interval'] * 1e6:.0f} µs", fontsize=10,
                        fontweight="normal")
        inset.set_xlabel("time, ms", fontsize=9, labelpad=1)
        inset.set_xlim(0, shown)
        inset.tick_params(labelsize=9)
    axes = figure.add_subplot(grid[1, :])
    record, expected = runs["turning"]["record"], order["turning"]
    shown = record[(record["time"] > 0.02) & (record["time"] <= order["duration"])]
    for side, color, theory in zip(["left", "right"], [LEFT, RIGHT], expected["side_speeds"]):
        axes.plot(shown["time"], 100.0 * (np.degrees(shown[f"{side}.speed"]) / theory - 1.0), color=color, label=side)
    axes.axhline(0.0, color=THEORY, lw=1, ls="--", label="theory")
    axes.set(title="Turn: ripple of the speeds about theory", xlabel="time, s", ylabel="deviation, %",
             xlim=(0, order["duration"]), ylim=(-1.25, 1.6))
    axes.legend(loc="upper right", ncols=3)
    period(axes, 0.15, expected["mesh_frequency"], -1.0)
    ripple = runs["turning"]["results"]["ripple"]
    after = runs["straight"]["results"]["settled_after"]
    band = 100.0 * order["settled_band"]
    caption(figure, f"Speeds of both half-shafts with {order['load']:.0f} N·m on each, started in the middle of the "
            "backlash. Insets: the load throws the light side gears back through the play until the teeth meet; "
            f"{1e3 * after:.1f} ms after the start straight driving is within {band:.0f} % of theory and stays there "
            "without ripple. Below: in the turn the planets roll, and the speeds swing as one or two pairs of teeth "
            f"share the load, once per tooth: {ripple[0]:.2f} % (left) and {ripple[1]:.2f} % (right) from peak to "
            f"peak. The study shows ±{order['claimed_ripple']:.0f} %.")
    save(figure, folder, "speeds")


def draw_speeds(axes, record, end, scale):
    record = record[record["time"] <= end + 1e-9]
    for name, color, style in [("carrier", CARRIER, "-"), ("left", LEFT, "-"), ("right", RIGHT, (0, (4, 2)))]:
        axes.plot(record["time"] * scale, np.degrees(record[f"{name}.speed"]), color=color, ls=style, lw=1.6,
                  label=name)


def tooth_forces(folder, order, runs):
    figure = plt.figure(figsize=(13, 9.2), layout="constrained")
    grid = figure.add_gridspec(3, 2, width_ratios=[1, 1.35], height_ratios=[1, 1.15, 0.8])
    turning, straight = order["turning"], order["straight"]

    axes = figure.add_subplot(grid[:2, 0])
    start = runs["straight"]["start"]
    shown = start[start["time"] <= 0.12e-3]
    axes.plot(shown["time"] * 1e3, shown["left.tangential_force"] / 1e3, color=LEFT, label="left.tangential_force")
    theory = straight["tangential_force"] / 1e3
    axes.axhline(theory, color=THEORY, ls="--", lw=1.2, label=f"theory T/r = {theory:.2f} kN")
    top = int(np.argmax(shown["left.tangential_force"]))
    when, peak = shown["time"][top] * 1e3, shown["left.tangential_force"][top] / 1e3
    axes.annotate(f"teeth strike: {peak:.1f} kN\n= {peak / theory:.2f} × T/r at {when * 1e3:.0f} µs", (when, peak),
                  xytext=(when + 0.012, peak * 0.86), arrowprops={"arrowstyle": "-", "color": "#888888"})
    axes.set(title="Straight, the start: force on the left side gear", xlabel="time, ms", ylabel="force, kN",
             xlim=(0, 0.12), ylim=(0, 1.18 * peak))
    axes.legend(loc="upper right")
    axes.text(when * 0.3, 0.62 * peak, "through the play", rotation=90, ha="center", va="center", color="#666666")

    axes = figure.add_subplot(grid[2, 0])
    shown = runs["straight"]["record"]
    shown = shown[(shown["time"] > 0.0) & (shown["time"] <= order["duration"])]
    deviation = shown["left.tangential_force"] / straight["tangential_force"] - 1.0
    axes.plot(shown["time"], 1e6 * deviation, color=LEFT)
    axes.set(title="Straight, every ms: deviation from T/r", xlabel="time, s", ylabel="parts per million",
             xlim=(0, order["duration"]), ylim=widened(1e6 * deviation, 0.1))

    record = runs["turning"]["record"]
    record = record[(record["time"] > 1.5e-3) & (record["time"] <= order["duration"])]
    time = record["time"]
    upper = figure.add_subplot(grid[0, 1])
    upper.plot(time, record["left.tangential_force"] / 1e3, color=LEFT, lw=2, label="left.tangential_force")
    theory = turning["tangential_force"] / 1e3
    upper.axhline(theory, color=THEORY, ls="--", lw=1.2, label=f"theory T/r = {theory:.2f} kN")
    upper.set(title="Turn: force of all planets at the outer pitch circle", ylabel="force, kN", ylim=(22.0, 24.8))
    upper.legend(loc="upper center", ncols=2)
    middle = figure.add_subplot(grid[1, 1], sharex=upper)
    for side, color in [("left", LEFT), ("right", RIGHT)]:
        middle.plot(time, record[f"planet[1].{side}_normal_force"] / 1e3, color=color, label=f"{side} mesh")
    theory = turning["normal_force"] / 1e3
    middle.axhline(theory, color=THEORY, ls="--", lw=1.2, label=f"theory {theory:.2f} kN")
    middle.set(title="Turn: normal force of each mesh of a planet", ylabel="force, kN", ylim=(15.8, 17.5))
    middle.legend(loc="upper center", ncols=3)
    lower = figure.add_subplot(grid[2, 1], sharex=upper)
    for side, color, shift in [("left", LEFT, 0.02), ("right", RIGHT, -0.02)]:
        lower.step(time, record[f"planet[1].{side}_pairs"] + shift, where="post", color=color, label=f"{side} mesh")
    lower.set(title="Turn: pairs of teeth under load", xlabel="time, s", ylabel="pairs", yticks=[0, 1, 2],
              ylim=(0, 3.1), xlim=(0, order["duration"]))
    lower.legend(loc="upper center", ncols=2)
    period(lower, 0.1273, turning["mesh_frequency"], 0.68, 0.32)
    ratio = runs["straight"]["results"]["peak_tangential_force"] / straight["tangential_force"]
    caption(figure, f"Left: started in the middle of the play, the teeth strike once with "
            f"{ratio:.1f} times the static force "
            "and settle within a fraction of a millisecond; an output every millisecond, as the study has it, cannot "
            "see this. Afterwards nothing is left of it. Right: in the turn the total force stays T/r, since the load "
            "is constant; one mesh bears its share T/(N Rₘ sin δ_b), a few per cent more while the corner of a tip "
            "carries at a shorter lever arm, and pairs take turns once per tooth. After the start there are no spikes.")
    save(figure, folder, "tooth_forces")


def force_spectrum(folder, order, runs):
    figure, (upper, lower) = plt.subplots(2, 1, figsize=(13, 9), sharex=True, layout="constrained",
                                          height_ratios=[1.5, 1])
    mesh, claim = order["turning"]["mesh_frequency"], order["claimed_frequency"]
    spin = order["turning"]["start_values"]["planet.spin_command"][0]
    curves = [("left.thrust_force", "#9bbfe0", "thrust on the left side gear"),
              ("left.normal_force", LEFT, "normal force, left side gear")]
    for axes, case in [(upper, "turning"), (lower, "straight")]:
        spectrum = runs[case]["spectrum"]
        mean = spectrum["left.normal_force"][0]
        bottom = mean * SPECTRUM_BOTTOM
        shown = (spectrum["frequency"] > 0.0) & (spectrum["frequency"] <= SPECTRUM_END)
        for name, color, label in curves:
            axes.vlines(spectrum["frequency"][shown], bottom, np.maximum(spectrum[name][shown], bottom), color=color,
                        lw=3.2 if "thrust" in name else 1.6, label=label)
        axes.set(yscale="log", ylabel="amplitude, N", ylim=(bottom, mean * 1e3))
        axes.axvline(claim, color=CLAIM, ls="--", lw=1.4)
        axes.axhline(mean, color="#aaaaaa", lw=1)
        axes.text(0.4, mean * 1.3, f"mean normal force {mean:,.0f} N".replace(",", " "), fontsize=9.5, color="#666666")
    harmonics = np.arange(1, int(SPECTRUM_END / mesh) + 1) * mesh
    upper.plot(harmonics, np.full(len(harmonics), mean * 3e-9), ls="", marker="^", color="#333333", ms=6,
               label=f"multiples of {mesh:.3f} Hz", clip_on=False)
    upper.legend(loc="upper left", ncols=3)
    upper.set(title=f"Turn: lines at multiples of the mesh frequency {mesh:.3f} Hz")
    lower.set(title="Straight ahead: no line", xlabel="frequency, Hz", xlim=(0, SPECTRUM_END))
    amplitude = np.max(runs["straight"]["spectrum"]["left.normal_force"][1:])
    mean = runs["straight"]["spectrum"]["left.normal_force"][0]
    text = (f"the study's mesh frequency, {claim:.1f} Hz: ten times the\ncarrier's rotation. "
            "The teeth stand still here: 0 Hz")
    lower.text(claim - 1.0, mean * 3e-4, text, ha="right", va="center", color=CLAIM)
    largest = f"largest amplitude at any frequency: {amplitude:.1g} N" if amplitude > 0.0 else "all amplitudes are 0"
    lower.text(claim - 1.0, mean * 3e-6, largest, ha="right", va="center", color="#444444")
    upper.text(claim + 1.0, mean * 0.1, f"{claim:.1f} Hz is no\nmultiple", color=CLAIM, va="center")
    window, teeth = order["spectrum_window"], order["planet_teeth"]
    caption(figure, f"Amplitudes of the forces on the left side gear over the last {window:.1f} s of a record of "
            f"{order['record']:.1f} s, every ms: {window * mesh:.0f} whole mesh periods, so a rectangular window leaks "
            f"nothing. A planet with {teeth} teeth spinning at {spin:.0f} °/s meshes {teeth} · {spin:.0f}/360 = "
            f"{mesh:.3f} times a second, and every line of the turn is a multiple of it. Straight ahead planets and "
            f"side gears turn as one body: no meshing, no line, and nothing at {claim} Hz.")
    save(figure, folder, "force_spectrum")


def widened(values, share):
    """Limits that hold all values with room around them."""
    low, high = float(np.min(values)), float(np.max(values))
    margin = max(share * (high - low), 1.0)
    return low - margin, high + margin


def period(axes, begin, frequency, height, text_height=None):
    """A double arrow as long as a mesh period, with its name on it or at `text_height`."""
    end = begin + 1.0 / frequency
    axes.annotate("", (begin, height), (end, height), arrowprops={"arrowstyle": "<->", "color": "#444444"})
    axes.text(0.5 * (begin + end), height if text_height is None else text_height,
              f"one tooth: 1/{frequency:.3f} Hz = {1e3 / frequency:.0f} ms", ha="center", va="center", fontsize=10,
              color="#444444", bbox={"facecolor": "white", "edgecolor": "none", "pad": 1.5})


def note(axes, x, y, text):
    axes.text(x, y, text, transform=axes.transAxes, ha="right", va="center", fontsize=10.5, color=THEORY)


def caption(figure, text, above=0.0):
    """What to see, in lines under the axes; `above` them so many inches are kept free."""
    lines = textwrap.wrap(text, CAPTION_WIDTH)
    height = (CAPTION_LINE * len(lines) + 0.15) / figure.get_figheight()
    room = 0.99 - height - above / figure.get_figheight()
    figure.get_layout_engine().set(rect=(0.0, height, 0.995, room), hspace=0.04, wspace=0.03)
    figure.text(0.02, height - 0.05 / figure.get_figheight(), "\n".join(lines), va="top", fontsize=CAPTION_SIZE,
                color="#333333", linespacing=1.3)


def save(figure, folder, name):
    figure.savefig(folder / f"{name}.png", dpi=DPI)
    plt.close(figure)
