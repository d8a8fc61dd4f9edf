"""The outputs of the scene over time; speeds; torques."""

import numpy as np

from . import style, words
from .blocks import Picture, Section
from .simulated import Simulated

# inches
PANEL = 1.55
SPEEDS = ("carrier.speed", "left.speed", "right.speed", "planet[1].spin_speed")
TORQUES = ("carrier.torque", "left.shaft_torque", "right.shaft_torque")


def section(run: Simulated) -> Section:
    """All three pictures."""
    found = Section("traces", "Traces")
    for name, outputs, caption in (("outputs", run.scene.outputs, _ranges), ("speeds", SPEEDS, _speeds), ("torques", TORQUES, _torques)):
        found.add(Picture(name, style.drawn(name)(_draw)(run, outputs), caption(run)))
    return found


def _draw(picture, run, names):
    """Outputs over time. The range of a curve that is constant but for rounding, which would be drawn as noise, is widened."""
    axes = style.over_time(picture, run, names, PANEL)
    if len(axes) == 1:
        picture.set_figheight(1.6 * PANEL + 0.6)
    for panel in axes:
        values = np.concatenate([line.get_ydata() for line in panel.lines])
        size = np.max(np.abs(values), initial=0.0)
        if size > 0.0 and np.ptp(values) <= 1e-7 * size:
            panel.set_ylim(values.mean() - 0.05 * size, values.mean() + 0.05 * size)
    picture.align_ylabels(axes)


def _ranges(run):
    parts = []
    for name in run.scene.outputs:
        values = run.shown(name)
        unit = run.unit(name)
        low, high = words.number(values.min()), words.number(values.max())
        parts.append(f"{name} {words.quantity(values[-1], unit)}" if low == high
                     else f"{name} {low} to {words.quantity(values.max(), unit)}")
    return f"What the scene records: {'; '.join(parts)}."


def _speeds(run):
    left, right, carrier = (run.shown(f"{part}.speed") for part in ("left", "right", "carrier"))
    apart = left - right
    k = int(np.argmax(np.abs(apart)))
    unit = run.unit("left.speed")
    mean = float(np.max(np.abs(0.5 * (left + right) - carrier)))
    size = max(float(np.max(np.abs(carrier))), float(np.max(np.abs(left))), 1e-300)
    if np.abs(apart[k]) < 1e-6 * size:
        split = "Both side gears turn alike all the time"
    else:
        split = (f"The side gears are farthest apart at {words.quantity(run.time[k], 's')}: left {words.number(left[k])}, right "
                 f"{words.quantity(right[k], unit)}")
    return (f"{split}. Their mean leaves the carrier's speed by {words.quantity(mean, unit, 2)} at most, through lash and "
            "deflection of the teeth." if run.has_teeth else f"{split}. Their mean is the carrier's speed to within "
            f"{words.quantity(mean, unit, 2)}.")


def _torques(run):
    left, right, carrier = (run.series(name) for name in ("left.shaft_torque", "right.shaft_torque", "carrier.torque"))
    means = [words.number(float(np.mean(values))) for values in (carrier, left, right)]
    return (f"Torque of the drive on the carrier and of the half-shafts on the wheels; on the mean carrier {means[0]}, left "
            f"{means[1]} and right {means[2]} N·m; what is missing between them speeds bodies up or is lost. Largest: carrier "
            f"{words.number(np.max(np.abs(carrier)))}, left "
            f"{words.number(np.max(np.abs(left)))}, right {words.quantity(np.max(np.abs(right)), 'N.m')}.")
