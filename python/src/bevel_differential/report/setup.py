"""What the scene sets up: values that differ from the start values, and inputs over time."""

import numpy as np

from . import style, words
from .blocks import Picture, Section, Table
from .simulated import Simulated

# inches
PANEL = 1.7


def section(run: Simulated) -> Section:
    """Plan, values and inputs."""
    found = Section("setup", "Set-up and plan")
    found.say(f"The FMU says that it simulates: {run.says}.")
    if not run.scene.values:
        found.say("All values are the start values of the FMU.")
    else:
        found.add(_values(run))
    changing = [name for name, variable in run.scene.fmu.variables.items()
                if variable.causality == "input" and np.ptp(run.series(name)) > 0.0]
    if changing:
        found.add(_inputs(run, changing))
    else:
        found.say("All inputs are constant.")
    tuned = [f"{variable.name} = {words.shown(variable, number)} at {words.quantity(time, 's')}"
             for time, values in run.scene.changes for variable, number in run.scene.fmu.numbers(values)
             if variable.causality == "parameter"]
    if tuned:
        found.say(f"Parameters that change during the run: {words.listed(tuned)}.")
    return found


def _values(run):
    fmu = run.scene.fmu
    rows = []
    for name, value in run.scene.values.items():
        variable = fmu.variable(name)
        start = "" if variable.start is None else words.shown(variable, variable.start)
        rows.append((name, variable.description or "", words.shown(variable, value),
                     start if variable.start != value else "the same"))
    driven = ", ".join(dict.fromkeys(name for name, *_ in run.scene.tables))
    return Table(("name", "meaning", "scene", "start value of the FMU"), rows,
                 f"{len(rows)} values that the scene sets; all others have the start values of the FMU."
                 + (f" {driven}: by a table over time." if driven else ""), left=2)


def _inputs(run, names):
    changes = []
    for name in names:
        values = run.shown(name)
        changes.append(f"{name} between {words.number(values.min())} and {words.quantity(values.max(), run.unit(name))}, "
                       f"{words.number(values[-1])} at the end")
    return Picture("inputs", _draw(run, names), f"Inputs that change: {'; '.join(changes)}. All others are constant.")


@style.drawn("inputs")
def _draw(picture, run, names):
    # the FMU holds an input between communication points
    for panel in style.over_time(picture, run, names, PANEL, held=True):
        panel.set_ylabel(panel.get_ylabel().replace(", ", ",\n"))
