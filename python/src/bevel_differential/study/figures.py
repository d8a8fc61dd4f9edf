"""Pictures of the study: speeds, tooth forces, spectrum of the forces."""

from collections.abc import Mapping
from pathlib import Path

import numpy as np

from ..answers import Progress
from ..panel import BLUE, FAINT, GREY, INK, OCHRE, PALE_BLUE, RED, SMALL, TEXT, Axis, Mark, Panel, curve, picture
from ..readable import spaced
from ..style import in_rpm, note
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
SIDES = [("left", BLUE), ("right", RED)]


def draw(folder: Path, runs: Mapping[str, Run], progress: Progress) -> None:
    """Draws all pictures of both `runs`, by case, into `folder`."""
    drawings = {"speeds": speeds, "tooth_forces": tooth_forces, "force_spectrum": force_spectrum}
    for index, (name, drawing) in enumerate(drawings.items()):
        progress(index / len(drawings), f"drawing {name}.png")
        drawing(runs["straight"], runs["turning"], folder / f"{name}.png")


def speeds(straight, turning, file):
    ripple, after, band = turning.results["ripple"], straight.results["settled_after"], 100.0 * SETTLED_BAND
    picture([[start_of_speeds(straight), speeds_in_turn(turning)], [ripple_in_turn(turning)] * 2],
            f"Speeds of both half-shafts with {LOAD:.0f} N·m on each, started in the middle of the "
            "backlash. Upper left: the load throws the light side gears back through the play until the teeth meet; "
            f"{1e3 * after:.1f} ms after the start straight driving is within {band:.0f} % of theory and stays there "
            "without ripple. Upper right and below: in the turn the planets roll, and the speeds swing as one or two "
            f"pairs of teeth share the load, once per tooth: {ripple[0]:.2f} % (left) and {ripple[1]:.2f} % (right) "
            f"from peak to peak. The study shows ±{RIPPLE:.0f} %.", file, 9.0, height_ratios=[1.15, 1])


def within(record, begin, end):
    """Rows after `begin` and up to `end` [s]."""
    return record[(record["time"] > begin) & (record["time"] <= end + 1e-9)]


def start_of_speeds(run):
    start = within(run.start, -1.0, THROWN)
    time, side = start["time"] * 1e3, np.degrees(start["left.speed"])
    lowest = int(np.argmin(side))
    return Panel("time, ms", "speed, deg/s", [
        curve(time, np.degrees(start["carrier.speed"]), "carrier", GREY), curve(time, side, "left and right (equal)", BLUE, lw=2.0),
        Mark("annotate", "teeth meet", (time[lowest], side[lowest]), (time[lowest] + 0.05, side[lowest]), va="center",
             arrowprops={"arrowstyle": "-", "color": FAINT}),
        Mark(note, 0.98, 0.55, f"then, to {run.record['time'][-1]:.0f} s: all three at {run.case.carrier_speed:.0f} deg/s,\n"
             "the speed that theory gives (ω₁ = ω₂ = ω₀)"), Mark(in_rpm)],
        f"Straight ahead, {run.case.vehicle_speed:.0f} km/h: the first {1e3 * THROWN:.1f} ms", legend="lower right", xlim=(0, 1e3 * THROWN))


def speeds_in_turn(run):
    record = within(run.record, SETTLED, DURATION)
    left, right = run.expected.side_speeds
    span = left - right
    marks = [curve(record["time"], np.degrees(record[f"{name}.speed"]), name, colour) for name, colour in [SIDES[0], ("carrier", GREY), SIDES[1]]]
    for speed, sign in [(left, "+"), (right, "−")]:
        marks += [Mark("axhline", speed, **THEORY),
                  Mark("text", 0.99 * DURATION, speed + 0.09 * span, f"theory ω₀ {sign} ωₚ zₚ/zₛ = {speed:.0f} deg/s", ha="right",
                       va="center")]
    return Panel("time, s", "speed, deg/s", [*marks, Mark(in_rpm)], f"Turn, {run.case.vehicle_speed:.0f} km/h: {DURATION:g} s",
                 legend="upper left", columns=3, xlim=(0, DURATION), ylim=(right - 0.2 * span, left + 0.42 * span))


def ripple_in_turn(run):
    record = within(run.record, 0.02, DURATION)
    ripples = [curve(record["time"], 100.0 * (np.degrees(record[f"{side}.speed"]) / theory - 1.0), side, colour)
               for (side, colour), theory in zip(SIDES, run.expected.side_speeds)]
    return Panel("time, s", "deviation, %", [*ripples, Mark("axhline", 0.0, label="theory", **THEORY),
                                             *period(0.15, run.expected.mesh_frequency, -1.0, -1.0)],
                 "Turn: ripple of the speeds about theory", legend="upper right", columns=3, xlim=(0, DURATION), ylim=(-1.2, 1.1))


def tooth_forces(straight, turning, file):
    record, static = within(turning.record, SETTLED, DURATION), straight.expected.tangential_force
    peak = straight.results["peak_tangential_force"] / static
    swing = 1e6 * np.ptp(record["left.tangential_force"]) / static
    settled = within(straight.record, 0.01, DURATION)["left.tangential_force"]
    still = 1e6 * np.max(np.abs(settled / static - 1.0))
    left, time = strike(straight), Axis("time, s")
    picture([[left, mesh_forces(turning.expected, record, time)], [left, pairs(turning.expected, record, time)]],
            f"Left: started in the middle of the play, the teeth strike once with {peak:.1f} times the static "
            "force and settle within a fraction of a millisecond; an output every millisecond, as in the study, cannot "
            f"show this. Afterwards the force straight ahead stays within {max(still, 0.01):.2g} parts per million of T/r. "
            "Right: the turn. One mesh carries its share "
            "T/(N Rₘ sin δ_b), a few per cent more while the corner of a tip carries at a shorter lever arm; one pair and "
            "two pairs take turns once per tooth. The sum of all planets at the outer pitch circle stays T/r = "
            f"{static / 1e3:.2f} kN within {swing:.0f} parts per million, as the load is constant. "
            "After the start there are no spikes.", file, 7.8, width_ratios=[1, 1.35], height_ratios=[1.6, 1])


def strike(run):
    shown = within(run.start, -1.0, STRUCK)
    time, force, theory = shown["time"] * 1e3, shown["left.tangential_force"] / 1e3, run.expected.tangential_force / 1e3
    top = int(np.argmax(force))
    when, peak = time[top], force[top]
    return Panel("time, ms", "force, kN", [
        curve(time, force, "tangential force, left side gear", BLUE, lw=2.0),
        Mark("axhline", theory, label=f"theory T/r = {theory:.2f} kN", **THEORY),
        Mark("annotate", f"teeth strike: {peak:.1f} kN\n= {peak / theory:.2f} × T/r at {when * 1e3:.0f} µs", (when, peak),
             xytext=(when + 0.012, peak * 0.86), arrowprops={"arrowstyle": "-", "color": FAINT}),
        Mark("text", when * 0.3, 0.62 * peak, "through the play", rotation=90, ha="center", va="center", color=FAINT)],
        "Straight ahead: the start", legend="upper right", xlim=(0, 1e3 * STRUCK), ylim=(0, 1.18 * peak))


def mesh_forces(expected, record, time):
    theory = expected.normal_force / 1e3
    forces = [curve(record["time"], record[f"planet[1].{side}_normal_force"] / 1e3, f"{side} mesh", colour) for side, colour in SIDES]
    return Panel(time, "force, kN", [*forces, Mark("axhline", theory, label=f"theory {theory:.2f} kN", **THEORY)],
                 "Turn: normal force of both meshes of a planet", legend="upper center", columns=3, ylim=(0.995 * theory, 1.048 * theory))


def pairs(expected, record, time):
    # the lines are shifted slightly so that both are visible
    counts = [curve(record["time"], record[f"planet[1].{side}_pairs"] + shift, f"{side} mesh", colour, drawstyle="steps-post")
              for (side, colour), shift in zip(SIDES, (0.03, -0.03))]
    return Panel(time, "pairs", [*counts, *period(0.1273, expected.mesh_frequency, 0.62, 0.3)], "Turn: pairs of teeth under load",
                 legend="upper center", columns=2, yticks=[0, 1, 2], ylim=(0, 2.9), xlim=(0, DURATION))


def force_spectrum(straight, turning, file):
    mesh, claim, spin = turning.expected.mesh_frequency, MESH_FREQUENCY, turning.case.planet_spin
    teeth = round(360.0 * mesh / spin)
    largest = np.max(straight.spectrum["left.normal_force"][1:])
    picture([[forces_in_time(straight, turning)], [lines_of_force(turning.spectrum, mesh, claim)]],
            f"Forces on the left side gear. A planet with {teeth} teeth that spins at {spin:.0f} deg/s meshes "
            f"{teeth} · {spin:.0f}/360 = {mesh:.3f} times a second, and every line of the turn is a multiple of that. "
            "Straight ahead planets and side gears turn as one body: no meshing and no line at any frequency "
            f"(largest amplitude {largest:.0e} N), also not at the study's {claim:.1f} Hz, which is ten times the "
            f"carrier's rotation. Spectrum of the last {SPECTRUM_PERIODS / mesh:.1f} s of {RECORD:.1f} s, sampled every "
            f"{1e3 * INTERVAL:.0f} ms: {SPECTRUM_PERIODS:.0f} whole mesh periods, so that a rectangular window does "
            "not spread the lines.", file, 9.0, height_ratios=[1, 1.5])


THRUST, NORMAL = [("left.thrust_force", PALE_BLUE, "thrust"), ("left.normal_force", BLUE, "normal force")]


def forces_in_time(straight, turning):
    """Signals of the spectrum: three teeth of the turn, and the same force straight ahead."""
    end = 3.0 / turning.expected.mesh_frequency
    marks, ends = [], []
    for run, case, (name, colour, label), look in [(turning, "turn", THRUST, {"lw": 2.2}), (turning, "turn", NORMAL, {}),
                                                   (straight, "straight ahead", NORMAL, THEORY)]:
        record = run.record[run.record["time"] >= RECORD - end]
        mean = run.spectrum[name][0]
        time, force = 1e3 * (record["time"] - RECORD + end), record[name] - mean
        ends += [force.min(), force.max()]
        marks.append(Mark("plot", time, force, label=f"{case}, {label} (mean {spaced(mean)} N)", **{"color": colour, **look}))
    low, high = min(ends), max(ends)
    return Panel("time, ms", "force − mean, N", marks, "Forces over three teeth, about their means", legend="upper center", columns=3,
                 xlim=(0, 1e3 * end), ylim=(low - 0.05 * (high - low), high + 0.32 * (high - low)))


def lines_of_force(spectrum, mesh, claim):
    floor = spectrum["left.normal_force"][0] * SPECTRUM_FLOOR
    bottom = 10.0 ** np.ceil(np.log10(floor))
    frequency, highest, marks = spectrum["frequency"], 0.0, []
    for (name, colour, label), width in ((THRUST, 7.0), (NORMAL, 3.0)):
        amplitude = spectrum[name]
        shown = (frequency > 0.0) & (frequency <= SPECTRUM_END) & (amplitude > floor)
        marks.append(Mark("vlines", frequency[shown], bottom, amplitude[shown], color=colour, lw=width, label=label))
        highest = max(highest, 6.0 * amplitude[shown].max())
    multiples = np.arange(1, int(SPECTRUM_END / mesh) + 1) * mesh
    marks += [curve(multiples, np.full(len(multiples), bottom), f"multiples of {mesh:.3f} Hz", INK, "^", ms=7, clip_on=False, zorder=5),
              Mark("axvline", claim, color=OCHRE, ls="--", lw=1.6),
              Mark("text", claim + 0.8, highest * 0.55, f"the study's {claim:.1f} Hz,\nnot a multiple", color=OCHRE, va="top")]
    return Panel("frequency, Hz", "amplitude, N", marks, f"Turn: spectrum of these forces, lines at multiples of the mesh frequency {mesh:.3f} Hz",
                 legend="upper left", columns=3, grid="y", yscale="log", xlim=(0, SPECTRUM_END), ylim=(bottom, highest))


def period(begin, frequency, height, text_height):
    """Double arrow with the length of a mesh period, with its name at `text_height`."""
    end = begin + 1.0 / frequency
    return [Mark("annotate", "", (begin, height), (end, height), arrowprops={"arrowstyle": "<->", "color": FAINT}),
            Mark("text", 0.5 * (begin + end), text_height, f"one tooth: 1/{frequency:.3f} Hz = {1e3 / frequency:.0f} ms", ha="center", va="center",
                 fontsize=SMALL, color=TEXT, bbox={"facecolor": "white", "edgecolor": "none", "pad": 1.5})]
