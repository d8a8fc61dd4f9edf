"""Torque and power of a run: bias, power, heat by its causes, and the error of the energy balance."""

import numpy as np

from ..plot import shown_times
from . import svg_style, words
from .blocks import Picture, Section
from .head import energy_balance
from .simulated import Simulated

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
        found.add(Picture("bias", _draw_bias(run, left, right), _bias_caption(run, left, right)))
    if max(np.max(np.abs(run.series(name))) for name in ("power.in", "power.out")) < NONE and not _heats(run):
        found.say("No power flows and no heat arises.")
    else:
        found.add(Picture("power", _draw_power(run), _power_caption(run)))
    return found


@svg_style.drawn("bias", 4.0)
def _draw_bias(picture, run, left, right):
    traces, plane = picture.subplots(1, 2, width_ratios=[1.4, 1])
    unit = words.unit_text(run.unit("left.shaft_torque"))
    times, label = shown_times(run.time)
    traces.plot(times, left, color=svg_style.BLUE, label="left half-shaft", lw=2.2)
    traces.plot(times, right, color=svg_style.RED, label="right half-shaft")
    traces.set(xlabel=label, ylabel=f"torque, {unit}", title="over time")
    traces.legend(loc="best")
    reach = 1.08 * max(float(np.max(np.abs(left))), float(np.max(np.abs(right))))
    low = -reach if min(left.min(), right.min()) < -0.02 * reach else -0.04 * reach
    for ratio in (1.0, *RATIOS):
        for slope in {ratio, 1.0 / ratio}:
            ends = np.array([max(low, low / slope), min(reach, reach / slope)])
            plane.plot(ends, slope * ends, color=svg_style.GREY, lw=1.0 if ratio == 1.0 else 0.6, ls="-" if ratio == 1.0 else "--")
            at = min(reach, reach / slope) * 0.96
            plane.text(at, slope * at, words.number(ratio), color=svg_style.GREY, fontsize=8, ha="right", va="bottom")
    plane.plot(left, right, color=svg_style.VIOLET, marker=".", ms=3, lw=0.8)
    plane.plot(left[-1], right[-1], "o", color=svg_style.VIOLET, ms=6)
    plane.set(xlabel=f"left torque, {unit}", ylabel=f"right torque, {unit}", title="right against left torque", xlim=(low, reach),
              ylim=(low, reach))
    plane.set_aspect("equal")


def _bias_caption(run, left, right):
    bias, locking = run.series("torque_bias_ratio"), run.series("locking_value")
    k = int(np.argmax(np.abs(left - right)))
    locked = float(locking[-1]) if abs(locking[-1]) > 1e-6 else 0.0
    even = np.max(np.abs(left - right)) < 1e-3 * np.max(np.abs(left) + np.abs(right))
    apart = ("both carry the same at all times, and the point stays on the line of ratio 1" if even else
             f"farthest apart at {words.moment(run.time[k], run.time[-1])}, left {words.number(left[k])} and right "
             f"{words.quantity(right[k], run.unit('right.shaft_torque'))}")
    return (f"Torque of the half-shafts: {apart}. Grey lines: the torques have the ratio that is printed next to them; the large "
            f"dot is the end. The FMU's bias ratio of slow over fast shaft is {words.number(bias[-1])} at the end and at most "
            f"{words.number(bias.max(), 3)} in the run, its locking value {words.number(locked, 3)} at the end.")


def _heats(run):
    """Heat outputs that are not zero at the end."""
    names = [name for name in run.scene.fmu.variables if name.startswith("heat.")]
    return [name for name in names if abs(run.record[name][-1]) > NO_HEAT]


@svg_style.drawn("power")
def _draw_power(picture, run):
    heats = _heats(run)
    picture.set_figheight(5.6 if heats else 4.0)
    panels = picture.subplots(3 if heats else 2, 1, sharex=True, height_ratios=[1.3, 1, 1] if heats else [1.3, 1])
    scale, unit = svg_style.unit_prefix([run.series(name) for name in ("power.in", "power.out")])
    times, time_label = shown_times(run.time)
    for name, colour, label in (("power.in", svg_style.BLUE, "in"), ("power.out", svg_style.GREEN, "out to the wheels"),
                                ("power.loss", svg_style.RED, "loss")):
        panels[0].plot(times, run.series(name) / scale, color=colour, label=label, lw=2.2 if name == "power.in" else 1.3)
    panels[0].set(ylabel=f"power, {unit}W")
    if heats:
        series = [np.maximum(run.series(name), 0.0) for name in heats]
        panels[1].stackplot(times, *series, labels=[name.removeprefix("heat.").replace("_", " ") for name in heats],
                            colors=svg_style.CYCLE[1:1 + len(heats)], alpha=0.75)
        panels[1].set(ylabel="heat so far, J")
    panels[-1].plot(times, run.series("solver.energy_residual"), color=svg_style.GREY, label="energy residual")
    panels[-1].set(xlabel=time_label, ylabel="residual, J")
    for panel in panels:
        panel.legend(loc="center left", bbox_to_anchor=(1.0, 0.5))
    picture.align_ylabels(panels)


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
