"""Torque and power of a run: bias, power, heat by its causes, and the error of the energy balance."""

import numpy as np

from ..panel import Mark, Panel, curve, scaled_axis
from . import dogs, words
from .blocks import Section
from .head import energy_balance
from .simulated import Simulated
from .svg_style import BLUE, CYCLE, GREEN, GREY, RED, VIOLET, picture

# bias ratios with lines
RATIOS = (1.5, 2.0, 3.0, 5.0)
# torques and heats below these values count as zero, relative to the largest or absolute (N·m, J)
NONE, NO_HEAT = 1e-9, 1e-9


def section(run: Simulated) -> Section:
    """Section with both pictures, if there is something to show."""
    found = Section("energy", "Torque bias, power and heat")
    left, right = run.series("left.shaft_torque"), run.series("right.shaft_torque")
    if max(np.max(np.abs(left)), np.max(np.abs(right))) < NONE:
        found.say("The half-shafts carry no torque at any time, so that there is no bias.")
    else:
        left, right = (run.shown(f"{side}.shaft_torque") for side in ("left", "right"))
        found.add(picture("bias", [_bias_panels(run, left, right)], _bias_caption(run, left, right), width_ratios=[1.4, 1]))
    if max(np.max(np.abs(run.series(name))) for name in ("power.in", "power.out")) < NONE and not _heats(run):
        found.say("No power flows and no heat arises.")
    else:
        rows = _power_panels(run)
        found.add(picture("power", rows, _power_caption(run), 1.6 * len(rows) + 0.8, height_ratios=[1.3, 1, 1][:len(rows)]))
    return found


def _bias_panels(run, left, right):
    unit = run.unit("left.shaft_torque")
    reach = 1.08 * max(float(np.max(np.abs(left))), float(np.max(np.abs(right))))
    low = -reach if min(left.min(), right.min()) < -0.02 * reach else -0.04 * reach
    return [Panel(run.time_axis, f"torque, {unit}", [curve(run.time, left, "left half-shaft", BLUE, lw=2.2),
                                                     curve(run.time, right, "right half-shaft", RED)], "over time"),
            Panel(f"left torque, {unit}", f"right torque, {unit}",
                  [*_ratios(low, reach), curve(left, right, None, VIOLET, ".-", ms=3, lw=0.8), curve(left[-1], right[-1], None, VIOLET, "o")],
                  "right against left torque", xlim=(low, reach), ylim=(low, reach), aspect="equal")]


def _ratios(low, reach):
    """Lines of equal ratio, with their ratios."""
    for ratio in (1.0, *RATIOS):
        for slope in {ratio, 1.0 / ratio}:
            ends = np.array([max(low, low / slope), min(reach, reach / slope)])
            yield curve(ends, slope * ends, None, GREY, "-" if ratio == 1.0 else "--", lw=1.0 if ratio == 1.0 else 0.6)
            at = 0.96 * ends[1]
            yield Mark("text", at, slope * at, words.number(ratio), color=GREY, fontsize=8, ha="right", va="bottom")


def _bias_caption(run, left, right):
    bias, locking = run.series("torque_bias_ratio"), run.series("locking_value")
    k = int(np.argmax(np.abs(left - right)))
    locked = float(locking[-1]) if abs(locking[-1]) > 1e-6 else 0.0
    even = np.max(np.abs(left - right)) < 1e-3 * np.max(np.abs(left) + np.abs(right))
    apart = ("both carry the same at all times, and the point stays on the line of ratio 1" if even else
             f"farthest apart at {words.moment(run.time[k], run.time[-1])}, left {words.number(left[k])} and right "
             f"{words.quantity(right[k], run.unit('right.shaft_torque'))}")
    closed = dogs.connected(run)
    at_end = f"{words.number(bias[-1])} at the end and " if closed[-1] else ""
    ratio = (f"The FMU's bias ratio of slow over fast shaft is {at_end}at most {words.number(bias[closed].max(), 3)} "
             f"{'in the run' if closed.all() else 'while the dog clutches are closed'}" if closed.any() else
             "There is no bias ratio, because a dog clutch is never closed")
    ends = f", its locking value {words.number(locked, 3)} at the end" if closed[-1] else ""
    return (f"Torque of the half-shafts: {apart}. Grey lines: the torques have the ratio that is printed next to them; the large "
            f"dot is the end. {ratio}{ends}.")


def _heats(run):
    """Heat outputs that are not zero at the end."""
    names = [name for name in run.scene.fmu.variables if name.startswith("heat.")]
    return [name for name in names if abs(run.record[name][-1]) > NO_HEAT]


def _power_panels(run):
    time, heats = run.time_axis, _heats(run)
    panels = [Panel(time, scaled_axis("power", "W", [run.series(name) for name in ("power.in", "power.out")]),
                    [curve(run.time, run.series(name), label, colour, lw=width)
                     for name, label, colour, width in (("power.in", "in", BLUE, 2.2), ("power.out", "out to the wheels", GREEN, 1.3),
                                                        ("power.loss", "loss", RED, 1.3))], legend="right")]
    if heats:
        series = [np.maximum(run.series(name), 0.0) for name in heats]
        labels = [name.removeprefix("heat.").replace("_", " ") for name in heats]
        panels.append(Panel(time, "heat so far, J", [Mark("stackplot", run.time, *series, labels=labels, colors=CYCLE[1:], alpha=0.75)],
                            legend="right"))
    panels.append(Panel(time, "residual, J", [curve(run.time, run.series("solver.energy_residual"), "energy residual", GREY)], legend="right"))
    return [[panel] for panel in panels]


def _power_caption(run):
    residual, throughput = energy_balance(run)
    work, out = (run.mean(name) * float(run.time[-1]) for name in ("power.in", "power.out"))
    heats = {name: float(run.record[name][-1]) for name in _heats(run)}
    total = sum(heats.values())
    by_cause = ", ".join(f"{name.removeprefix('heat.').replace('_', ' ')} {words.quantity(heat, 'J', 3)}"
                         + (f" ({words.percent(heat / total)})" if len(heats) > 1 and total > 0.0 else "")
                         for name, heat in sorted(heats.items(), key=lambda pair: -pair[1]))
    heat = f"Heat by its causes, stacked: {by_cause}." if heats else "No heat arises."
    return (f"Power delivered to the differential and to the wheels; over time {words.quantity(work, 'J')} in and "
            f"{words.quantity(out, 'J')} out, calculated from the communication points. The rest accelerates bodies, twists shafts or "
            f"is lost. {heat} Bottom: stored energy less work plus heat, {words.quantity(residual, 'J', 2)} at most, "
            f"{words.percent(residual / throughput if throughput else 0.0, 2)} of the throughput.")
