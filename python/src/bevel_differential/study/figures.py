"""Pictures of the study: speeds, tooth forces, spectrum of the forces."""

from collections.abc import Mapping
from pathlib import Path

import numpy as np

from .. import style
from ..answers import Progress
from ..readable import spaced
from ..style import BLUE, FAINT, GREY, INK, OCHRE, PALE_BLUE, RED
from .simulation import RECORD, SETTLED_BAND, SPECTRUM_PERIODS, Run
from .stated import DURATION, INTERVAL, LOAD, MESH_FREQUENCY, RIPPLE

# highest frequency shown [Hz]
SPECTRUM_END = 120.0
# lines of the spectrum are drawn if they are above this fraction of the mean force
SPECTRUM_FLOOR = 1e-5
# intervals of the start that are shown [s]
THROWN, STRUCK = 0.5e-3, 0.12e-3
# end of the start, in panels that begin after it [s]
SETTLED = 1.5e-3
THEORY = {"color": INK, "ls": (0, (5, 3)), "lw": 1.2}


def draw(folder: Path, runs: Mapping[str, Run], progress: Progress) -> None:
    """Draws all pictures of both `runs`, by case, into `folder`."""
    drawings = {"speeds": speeds, "tooth_forces": tooth_forces, "force_spectrum": force_spectrum}
    for index, (name, drawing) in enumerate(drawings.items()):
        progress(index / len(drawings), f"drawing {name}.png")
        style.save(drawing(runs["straight"], runs["turning"]), folder / f"{name}.png")


def speeds(straight, turning):
    figure = style.figure(9.0)
    grid = figure.add_gridspec(2, 2, height_ratios=[1.15, 1])
    start_of_speeds(figure.add_subplot(grid[0, 0]), straight)
    speeds_in_turn(figure.add_subplot(grid[0, 1]), turning)
    ripple_in_turn(figure.add_subplot(grid[1, :]), turning)
    ripple, after, band = turning.results["ripple"], straight.results["settled_after"], 100.0 * SETTLED_BAND
    style.caption(figure, f"Speeds of both half-shafts with {LOAD:.0f} N·m on each, started in the middle of the "
                  "backlash. Upper left: the load throws the light side gears back through the play until the teeth meet; "
                  f"{1e3 * after:.1f} ms after the start straight driving is within {band:.0f} % of theory and stays there "
                  "without ripple. Upper right and below: in the turn the planets roll, and the speeds swing as one or two "
                  f"pairs of teeth share the load, once per tooth: {ripple[0]:.2f} % (left) and {ripple[1]:.2f} % (right) "
                  f"from peak to peak. The study shows ±{RIPPLE:.0f} %.")
    return figure


def start_of_speeds(axes, run):
    start = run.start[run.start["time"] <= THROWN + 1e-9]
    time, carrier = start["time"] * 1e3, run.case.carrier_speed
    side = np.degrees(start["left.speed"])
    axes.plot(time, np.degrees(start["carrier.speed"]), color=GREY, label="carrier")
    axes.plot(time, side, color=BLUE, lw=2.0, label="left and right (equal)")
    lowest = int(np.argmin(side))
    axes.annotate("teeth meet", (time[lowest], side[lowest]), (time[lowest] + 0.05, side[lowest]), va="center",
                  arrowprops={"arrowstyle": "-", "color": FAINT})
    style.note(axes, 0.98, 0.55, f"then, to {run.record['time'][-1]:.0f} s: all three at {carrier:.0f} deg/s,\n"
               "the speed that theory gives (ω₁ = ω₂ = ω₀)")
    axes.set(title=f"Straight ahead, {run.case.vehicle_speed:.0f} km/h: the first {1e3 * THROWN:.1f} ms",
             xlabel="time, ms", ylabel="speed, deg/s", xlim=(0, 1e3 * THROWN))
    style.in_rpm(axes)
    axes.legend(loc="lower right")


def speeds_in_turn(axes, run):
    end = DURATION
    record = run.record[(run.record["time"] > SETTLED) & (run.record["time"] <= end + 1e-9)]
    for name, color in [("left", BLUE), ("carrier", GREY), ("right", RED)]:
        axes.plot(record["time"], np.degrees(record[f"{name}.speed"]), color=color, label=name)
    left, right = run.expected.side_speeds
    for speed, sign in [(left, "+"), (right, "−")]:
        axes.axhline(speed, **THEORY)
        axes.text(0.99 * end, speed + 0.09 * (left - right), f"theory ω₀ {sign} ωₚ zₚ/zₛ = {speed:.0f} deg/s", ha="right",
                  va="center")
    span = left - right
    axes.set(title=f"Turn, {run.case.vehicle_speed:.0f} km/h: {end:g} s", xlabel="time, s", ylabel="speed, deg/s",
             xlim=(0, end), ylim=(right - 0.2 * span, left + 0.42 * span))
    style.in_rpm(axes)
    axes.legend(loc="upper left", ncols=3)


def ripple_in_turn(axes, run):
    record = run.record[(run.record["time"] > 0.02) & (run.record["time"] <= DURATION)]
    for side, color, theory in zip(["left", "right"], [BLUE, RED], run.expected.side_speeds):
        axes.plot(record["time"], 100.0 * (np.degrees(record[f"{side}.speed"]) / theory - 1.0), color=color, label=side)
    axes.axhline(0.0, label="theory", **THEORY)
    axes.set(title="Turn: ripple of the speeds about theory", xlabel="time, s", ylabel="deviation, %",
             xlim=(0, DURATION), ylim=(-1.2, 1.1))
    axes.legend(loc="upper right", ncols=3)
    period(axes, 0.15, run.expected.mesh_frequency, -1.0)


def tooth_forces(straight, turning):
    figure = style.figure(7.8)
    grid = figure.add_gridspec(2, 2, width_ratios=[1, 1.35], height_ratios=[1.6, 1])
    strike(figure.add_subplot(grid[:, 0]), straight)
    record = turning.record[(turning.record["time"] > SETTLED) & (turning.record["time"] <= DURATION)]
    upper = figure.add_subplot(grid[0, 1])
    mesh_forces(upper, turning.expected, record)
    pairs(figure.add_subplot(grid[1, 1], sharex=upper), turning.expected, record)
    static = straight.expected.tangential_force
    peak = straight.results["peak_tangential_force"] / static
    swing = 1e6 * np.ptp(record["left.tangential_force"]) / static
    settled = straight.record[(straight.record["time"] > 0.01) & (straight.record["time"] <= DURATION)]["left.tangential_force"]
    still = 1e6 * np.max(np.abs(settled / static - 1.0))
    style.caption(figure, f"Left: started in the middle of the play, the teeth strike once with {peak:.1f} times the static "
                  "force and settle within a fraction of a millisecond; an output every millisecond, as in the study, cannot "
                  f"show this. Afterwards the force straight ahead stays within {max(still, 0.01):.2g} parts per million of T/r. "
                  "Right: the turn. One mesh carries its share "
                  "T/(N Rₘ sin δ_b), a few per cent more while the corner of a tip carries at a shorter lever arm; one pair and "
                  "two pairs take turns once per tooth. The sum of all planets at the outer pitch circle stays T/r = "
                  f"{static / 1e3:.2f} kN within {swing:.0f} parts per million, as the load is constant. "
                  "After the start there are no spikes.")
    return figure


def strike(axes, run):
    shown = run.start[run.start["time"] <= STRUCK]
    time, force, theory = shown["time"] * 1e3, shown["left.tangential_force"] / 1e3, run.expected.tangential_force / 1e3
    axes.plot(time, force, color=BLUE, lw=2.0, label="tangential force, left side gear")
    axes.axhline(theory, label=f"theory T/r = {theory:.2f} kN", **THEORY)
    top = int(np.argmax(force))
    when, peak = time[top], force[top]
    axes.annotate(f"teeth strike: {peak:.1f} kN\n= {peak / theory:.2f} × T/r at {when * 1e3:.0f} µs", (when, peak),
                  xytext=(when + 0.012, peak * 0.86), arrowprops={"arrowstyle": "-", "color": FAINT})
    axes.text(when * 0.3, 0.62 * peak, "through the play", rotation=90, ha="center", va="center", color=FAINT)
    axes.set(title="Straight ahead: the start", xlabel="time, ms", ylabel="force, kN", xlim=(0, 1e3 * STRUCK),
             ylim=(0, 1.18 * peak))
    axes.legend(loc="upper right")


def mesh_forces(axes, expected, record):
    theory = expected.normal_force / 1e3
    for side, color in [("left", BLUE), ("right", RED)]:
        axes.plot(record["time"], record[f"planet[1].{side}_normal_force"] / 1e3, color=color, label=f"{side} mesh")
    axes.axhline(theory, label=f"theory {theory:.2f} kN", **THEORY)
    axes.set(title="Turn: normal force of both meshes of a planet", ylabel="force, kN", ylim=(0.995 * theory, 1.048 * theory))
    axes.tick_params(labelbottom=False)
    axes.legend(loc="upper center", ncols=3)


def pairs(axes, expected, record):
    # the lines are shifted slightly so that both are visible
    for side, color, shift in [("left", BLUE, 0.03), ("right", RED, -0.03)]:
        axes.step(record["time"], record[f"planet[1].{side}_pairs"] + shift, where="post", color=color, label=f"{side} mesh")
    axes.set(title="Turn: pairs of teeth under load", xlabel="time, s", ylabel="pairs", yticks=[0, 1, 2], ylim=(0, 2.9),
             xlim=(0, DURATION))
    axes.legend(loc="upper center", ncols=2)
    period(axes, 0.1273, expected.mesh_frequency, 0.62, 0.3)


def force_spectrum(straight, turning):
    figure, (upper, lower) = style.panels(2, 1, 9.0, height_ratios=[1, 1.5])
    mesh, claim, spin = turning.expected.mesh_frequency, MESH_FREQUENCY, turning.case.planet_spin
    forces_in_time(upper, straight, turning)
    spectrum, still = turning.spectrum, straight.spectrum
    mean = spectrum["left.normal_force"][0]
    lines_of_force(lower, spectrum, mean * SPECTRUM_FLOOR)
    marks = np.arange(1, int(SPECTRUM_END / mesh) + 1) * mesh
    low, high = lower.get_ylim()
    lower.plot(marks, np.full(len(marks), low), ls="", marker="^", color=INK, ms=7, clip_on=False, zorder=5,
               label=f"multiples of {mesh:.3f} Hz")
    lower.axvline(claim, color=OCHRE, ls="--", lw=1.6)
    lower.text(claim + 0.8, high * 0.55, f"the study's {claim:.1f} Hz,\nnot a multiple", color=OCHRE, va="top")
    lower.legend(loc="upper center", bbox_to_anchor=(0.38, 1.0), ncols=3)
    lower.set(title=f"Turn: spectrum of these forces, lines at multiples of the mesh frequency {mesh:.3f} Hz")
    teeth = round(360.0 * mesh / spin)
    largest = np.max(still["left.normal_force"][1:])
    style.caption(figure, f"Forces on the left side gear. A planet with {teeth} teeth that spins at {spin:.0f} deg/s meshes "
                  f"{teeth} · {spin:.0f}/360 = {mesh:.3f} times a second, and every line of the turn is a multiple of that. "
                  "Straight ahead planets and side gears turn as one body: no meshing and no line at any frequency "
                  f"(largest amplitude {largest:.0e} N), also not at the study's {claim:.1f} Hz, which is ten times the "
                  f"carrier's rotation. Spectrum of the last {SPECTRUM_PERIODS / mesh:.1f} s of {RECORD:.1f} s, sampled every "
                  f"{1e3 * INTERVAL:.0f} ms: {SPECTRUM_PERIODS:.0f} whole mesh periods, so that a rectangular window does "
                  "not spread the lines.")
    return figure


FORCES = [("left.thrust_force", PALE_BLUE, "thrust"), ("left.normal_force", BLUE, "normal force")]


def forces_in_time(axes, straight, turning):
    """Draws the signals of the spectrum: three teeth of the turn, and the same force straight ahead."""
    end = 3.0 / turning.expected.mesh_frequency
    begin = RECORD - end
    for run in [turning, straight]:
        record = run.record[run.record["time"] >= begin]
        time = 1e3 * (record["time"] - begin)
        for name, color, label in FORCES if run is turning else FORCES[1:]:
            mean = run.spectrum[name][0]
            line = {"color": color, "lw": 2.2 if "thrust" in name else 1.7, "label": f"turn, {label} (mean {spaced(mean)} N)"}
            if run is straight:
                line |= {"color": INK, "ls": (0, (5, 3)), "lw": 1.2,
                         "label": f"straight ahead, {label} (mean {spaced(mean)} N)"}
            axes.plot(time, record[name] - mean, **line)
    low, high = axes.get_ylim()
    axes.set(title="Forces over three teeth, about their means", xlabel="time, ms", ylabel="force − mean, N",
             xlim=(0, 1e3 * end), ylim=(low, high + 0.25 * (high - low)))
    axes.legend(loc="upper center", ncols=3)


def lines_of_force(axes, spectrum, floor):
    bottom = 10.0 ** np.ceil(np.log10(floor))
    frequency, highest = spectrum["frequency"], 0.0
    for name, color, label in FORCES:
        amplitude = spectrum[name]
        shown = (frequency > 0.0) & (frequency <= SPECTRUM_END) & (amplitude > floor)
        axes.vlines(frequency[shown], bottom, amplitude[shown], color=color, lw=7.0 if "thrust" in name else 3.0, label=label)
        highest = max(highest, amplitude[shown].max())
    axes.set(yscale="log", xlabel="frequency, Hz", ylabel="amplitude, N", xlim=(0, SPECTRUM_END), ylim=(bottom, 6.0 * highest))
    style.plain_decades(axes.yaxis)
    axes.grid(axis="x", visible=False)


def period(axes, begin, frequency, height, text_height=None):
    """Draws a double arrow with the length of a mesh period, with its name on it or at `text_height`."""
    end = begin + 1.0 / frequency
    axes.annotate("", (begin, height), (end, height), arrowprops={"arrowstyle": "<->", "color": FAINT})
    axes.text(0.5 * (begin + end), height if text_height is None else text_height,
              f"one tooth: 1/{frequency:.3f} Hz = {1e3 / frequency:.0f} ms", ha="center", va="center", fontsize=style.SMALL,
              color=style.TEXT, bbox={"facecolor": "white", "edgecolor": "none", "pad": 1.5})
