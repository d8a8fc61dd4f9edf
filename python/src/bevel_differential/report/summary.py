"""The key table: outputs by their statistics."""

from ..want import figures as figures_of
from . import words
from .blocks import Section, Table
from .simulated import Simulated

ROUNDING = 1e-12
STATISTICS = ("mean", "min", "max", "rms", "peak_to_peak", "final")
# besides the scene's own outputs; those of meshes where there are some
MAIN = ("carrier.speed", "left.speed", "right.speed", "planet[1].spin_speed", "carrier.torque", "left.shaft_torque",
        "right.shaft_torque", "power.in", "power.out", "power.loss")
OF_MESHES = ("planet[1].left_normal_force", "planet[1].right_normal_force", "left.tangential_force", "right.tangential_force",
             "planet[1].left_transmission_error")


def section(run: Simulated) -> Section:
    """The table."""
    found = Section("key", "Key figures")
    rows = []
    for name in main_outputs(run):
        variable = run.scene.fmu.variable(name)
        unit, values = variable.shown(run.series(name))
        figures = figures_of(STATISTICS, run.time, values)
        # what is left of a difference of large numbers is rounding
        rounding = ROUNDING * max(map(abs, figures))
        rounded = [figure if abs(figure) > rounding else 0.0 for figure in figures]
        rows.append((name, words.unit_text(unit), *(words.number(figure, 5) for figure in rounded)))
    span = f"{words.number(run.time[0])} to {words.quantity(run.time[-1], 's')}"
    found.add(Table(("output", "unit", *(word.replace("_", " ") for word in STATISTICS)), rows,
                    f"Outputs of the scene and the main ones of every scene, over the whole run from {span}, the start "
                    "included. Means are over time.", left=2))
    return found


def main_outputs(run: Simulated) -> list[str]:
    """The scene's outputs, and those that count in every scene."""
    return list(dict.fromkeys([*run.scene.outputs, *MAIN, *(OF_MESHES if run.has_teeth else ())]))
