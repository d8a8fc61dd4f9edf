"""Outputs of the scene over time, with their statistics; speeds; torques."""

import numpy as np

from ..plot import over_time
from ..want import Statistic, Want
from ..want import figures as figures_of
from ..want import mean_over_time
from . import words
from .blocks import Section, Table
from .simulated import SPEEDS, TORQUES, Simulated
from .svg_style import picture

# height of a panel, inches
PANEL = 1.55
ROUNDING = 1e-12
STATISTICS = ("mean", "min", "max", "rms", "peak_to_peak", "final")
# shown in addition to the scene's own outputs; those of meshes only if there are teeth
MAIN = ("carrier.speed", "left.speed", "right.speed", "planet[1].spin_speed", "carrier.torque", "left.shaft_torque",
        "right.shaft_torque", "power.in", "power.out", "power.loss")
OF_MESHES = ("planet[1].left_normal_force", "planet[1].right_normal_force", "left.tangential_force", "right.tangential_force",
             "planet[1].left_transmission_error")


def section(run: Simulated) -> Section:
    """Section with all three pictures."""
    found = Section("traces", "Traces")
    for name, outputs, caption in (("outputs", run.scene.outputs, _ranges), ("speeds", SPEEDS, _speeds),
                                   ("torques", TORQUES, _torques)):
        rows = over_time(run.scene.fmu, run.drawn, outputs)
        found.add(picture(name, rows, caption(run), (1.6 * PANEL if len(rows) == 1 else PANEL * len(rows)) + 0.6))
    return found


def _ranges(run):
    parts = []
    for name in run.scene.outputs:
        values = run.shown(name)
        unit = run.unit(name)
        low, high = words.number(values.min()), words.number(values.max())
        parts.append(f"{name} {words.quantity(values[-1], unit)}" if low == high
                     else f"{name} {low} to {words.quantity(values.max(), unit)}")
    return f"Recorded by the scene: {'; '.join(parts)}."


def _speeds(run):
    left, right, carrier = (run.shown(f"{part}.speed") for part in ("left", "right", "carrier"))
    apart = left - right
    k = int(np.argmax(np.abs(apart)))
    unit = run.unit("left.speed")
    mean = float(np.max(np.abs(0.5 * (left + right) - carrier)))
    size = max(float(np.max(np.abs(carrier))), float(np.max(np.abs(left))), 1e-300)
    if np.abs(apart[k]) < 1e-6 * size:
        split = "Both side gears turn equally all the time"
    else:
        split = (f"The side gears are farthest apart at {words.moment(run.time[k], run.time[-1])}: left {words.number(left[k])}, right "
                 f"{words.quantity(right[k], unit)}")
    return (f"{split}. Their mean leaves the carrier's speed by {words.quantity(mean, unit, 2)} at most, through lash and "
            "deflection of the teeth." if run.has_teeth else f"{split}. Their mean is the carrier's speed to within "
            f"{words.quantity(mean, unit, 2)}.")


def _torques(run):
    left, right, carrier = (run.shown(name) for name in ("left.shaft_torque", "right.shaft_torque", "carrier.torque"))
    unit = words.unit_text(run.unit("carrier.torque"))
    means = [words.number(mean_over_time(values, run.time)) for values in (carrier, left, right)]
    housing = run.shown("clutches.housing_torque")
    taken = ""
    if np.any(housing):
        taken = f"the gearings of the clutches give {words.quantity(mean_over_time(housing, run.time), unit)} to the housing, and "
    return (f"Torque of the drive on the carrier and of the half-shafts on the wheels; on the mean carrier {means[0]}, left "
            f"{means[1]} and right {means[2]} {unit}; {taken}the {'rest' if taken else 'difference'} accelerates bodies or is lost. Largest: carrier "
            f"{words.number(np.max(np.abs(carrier)))}, left "
            f"{words.number(np.max(np.abs(left)))}, right {words.quantity(np.max(np.abs(right)), unit)}.")


def key_figures(run: Simulated) -> Section:
    """Section with the key table: outputs and their statistics."""
    found = Section("key", "Key figures")
    rows = []
    for name in main_outputs(run):
        variable = run.scene.fmu.variable(name)
        unit, _ = variable.shown(0.0)
        figures = figures_of(STATISTICS, run.time, run.series(name))
        # small remainders of large numbers are rounding errors
        rounding = ROUNDING * max(map(abs, figures))
        quantities = [Want(name, Statistic(word)).quantity(run.scene.fmu) for word in STATISTICS]
        rounded = [quantity.shown(figure if abs(figure) > rounding else 0.0)[1] for quantity, figure in zip(quantities, figures)]
        rows.append((name, words.unit_text(unit), *(words.number(figure, 5) for figure in rounded)))
    span = f"{words.number(run.time[0])} to {words.quantity(run.time[-1], 's')}"
    found.add(Table(("output", "unit", *(word.replace("_", " ") for word in STATISTICS)), rows,
                    f"Outputs of the scene and the main ones of every scene, over the whole run from {span}, the start "
                    "included. Means are over time.", left=2))
    return found


def main_outputs(run: Simulated) -> list[str]:
    """Outputs of the scene, and those that are important in every scene."""
    return list(dict.fromkeys([*run.scene.outputs, *MAIN, *(OF_MESHES if run.has_teeth else ())]))
