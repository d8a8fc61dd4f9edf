"""Changes and costs of the effects that are off in the scene."""

import re
import time
from dataclasses import dataclass, replace

import numpy as np

from ..answers import Progress
from ..answers import effect_classes
from ..panel import Axis, Mark, Panel, shades
from ..progress import silent
from ..values import DifferentialError, Number
from ..want import mean_over_time
from . import words
from .blocks import Section, Table
from .simulated import Simulated, reason_of
from .svg_style import BLUE, GREY, RED, picture
from .traces import main_outputs

# number of largest changes in the table
NAMED = 3
PREFIX = "effects."
TOGETHER = "all of these together"
# a run that should change nothing: its changes show the influence of rounding and of the solver
CONTROL = "tolerance halved"
TOLERANCE = "solver.relative_tolerance"
# changes up to this multiple of the solver's tolerance are attributed to the solver
NOISE = 10.0


@dataclass(frozen=True)
class Tried:
    """Run with an effect switched on. `mean` and `swing`: change of the mean and of the peak-to-peak value by output, relative to the
    largest value of its kind in the scene; `nothing`: changes up to this are within the solver's tolerance; `calls` and `seconds`:
    evaluations and time, relative to those of the scene; `refused`: reason if the FMU refused the run."""

    name: str
    nothing: float
    mean: dict[str, float]
    swing: dict[str, float]
    calls: float = 0.0
    seconds: float = 0.0
    refused: str = ""

    @property
    def changes(self) -> bool:
        """True if the effect changes any output."""
        return any(abs(change) > self.nothing for change in (*self.mean.values(), *self.swing.values()))


def section(run: Simulated, progress: Progress = silent) -> Section:
    """Section with a run for each effect that is off, and a run with all of them."""
    found = Section("worth", "What is switched off, and what it is worth")
    variables = run.scene.fmu.variables
    switches = [name for name, variable in variables.items() if name.startswith(PREFIX) and variable.kind == "Boolean"]
    classes = effect_classes()
    switches = [name for name in switches if name not in classes["outputs"]]
    off = [name for name in switches if not run.value(name)]
    question = [name for name in classes["machine"] if name in off]
    there = [name for name in off if name not in question]
    found.say(_named([name for name in switches if name not in off], question))
    if not there:
        return found
    progress(0.0, "effects that are off")
    tried = [attempt(run, CONTROL, {TOLERANCE: 0.5 * float(run.value(TOLERANCE))})]
    for index, name in enumerate(there):
        progress(index / (len(there) + 1), "effects that are off")
        tried.append(attempt(run, name.removeprefix(PREFIX), {name: True}))
    tried.append(together(run, [name for name, one in zip(there, tried[1:]) if not one.refused]))
    if any(one.changes for one in tried if one.name != CONTROL):
        rows = [one for one in tried if not one.refused]
        found.add(picture("worth", [_panels(rows)], _caption(tried), 0.34 * len(rows[0].mean) + 1.9))
    found.add(_table(run, tried))
    found.say("The command accuracy finds the effects that a quantity needs for a given accuracy: "
              "bevel-differential accuracy NAME --want OUTPUT:STATISTIC --within 1%.")
    return found


def attempt(run: Simulated, label: str, values: dict[str, Number]) -> Tried:
    """Runs the scene with these values."""
    outputs = list(dict.fromkeys([*main_outputs(run), "solver.rhs_calls"]))
    begin = time.perf_counter()
    try:
        record = run.scene._record(outputs, values)
    except DifferentialError as error:
        return Tried(label, 0.0, {}, {}, refused=reason_of(error))
    seconds = time.perf_counter() - begin
    sizes = _sizes(run)
    mean, swing = {}, {}
    for name in main_outputs(run):
        old, new = run.series(name), record[name].astype(float)
        size = sizes[name] or float(np.max(np.abs(new))) or 1.0
        mean[name] = mean_over_time(new - old, run.time) / size
        swing[name] = float((np.ptp(new) - np.ptp(old)) / size)
    calls = max(float(run.record["solver.rhs_calls"][-1]), 1.0)
    return Tried(label, NOISE * float(run.value(TOLERANCE)), mean, swing, float(record["solver.rhs_calls"][-1]) / calls, seconds / run.seconds)


def _sizes(run):
    """Largest value of all outputs with the same unit, by output. An output without a unit has its own largest value."""
    names = main_outputs(run)
    largest = {name: float(np.max(np.abs(run.series(name)))) for name in names}
    units = {name: run.scene.fmu.variable(name).unit for name in names}

    def alike(one, other):
        return one == other or (units[one] not in (None, "1") and units[one] == units[other])

    return {name: max(largest[other] for other in names if alike(name, other)) for name in names}


def together(run: Simulated, names: list[str]) -> Tried:
    """Runs all effects together. Effects that the FMU refuses are left out, and listed in the name of the run."""
    left, gone = list(names), []
    while True:
        found = attempt(run, TOGETHER, dict.fromkeys(left, True))
        refused = [name for name in left if name in found.refused]
        if not refused or not found.refused:
            break
        gone += refused
        left = [name for name in left if name not in refused]
    without = f"{TOGETHER}, without {words.listed(name.removeprefix(PREFIX) for name in gone)}" if gone else TOGETHER
    return replace(found, name=without)


def _named(on, question):
    on, question = ([name.removeprefix(PREFIX) for name in names] for names in (on, question))
    return (f"On in the scene: {words.listed(on) or 'nothing'}. " + (
        f"Not tried: {words.listed(question)}, because what is installed, broken or driven is part of the question and not of the "
        "accuracy of the answer. " if question else "") +
        "Each other effect that is off was switched on separately, with the parameters of the scene; its change is that of the whole "
        "run, including the start. The first run only halves the solver's tolerance: if that changes something, for example because "
        "teeth strike again and again, changes of this size by an effect mean nothing.")


def _panels(rows):
    outputs = Axis("")
    names = list(rows[0].mean)
    labels = ["together" if one.name.startswith(TOGETHER) else re.sub("[_ ]", " ", one.name) for one in rows]
    # transparent in the middle, so that the page's colour shows
    colours = shades((BLUE, 0.7), (GREY, 0.0), (RED, 0.7))
    for title, table in (("mean", [one.mean for one in rows]), ("peak to peak", [one.swing for one in rows])):
        values = 100.0 * np.array([[changes[name] for changes in table] for name in names])
        reach = max(1.0, float(np.percentile(np.abs(values), 95.0)))
        yield Panel("", outputs, [
            Mark("imshow", values, cmap=colours, vmin=-reach, vmax=reach, aspect="auto"),
            *(Mark("text", column, row, _cell(value, rows[column].nothing), ha="center", va="center", fontsize=8)
              for (row, column), value in np.ndenumerate(values)),
            Mark("set_xticks", range(len(rows)), labels, fontsize=8, rotation=35, ha="right", rotation_mode="anchor"),
            Mark("set_yticks", range(len(names)), names, fontsize=8), Mark("tick_params", length=0), Mark("set_frame_on", False)],
            f"change of the {title}, %", grid="")


def _cell(percent, nothing):
    if abs(percent) <= 100.0 * nothing:
        return "·"
    return words.signed(percent, 2) if abs(percent) >= 0.01 else "~0"


def _caption(tried):
    # a mean is more informative than a swing, whose relative change is large if hardly anything swings
    strongest = max((one for one in tried if not one.refused and one.name != CONTROL and not one.name.startswith(TOGETHER)),
                    key=lambda one: max(map(abs, one.mean.values())))
    what, change = max(strongest.mean.items(), key=lambda pair: abs(pair[1]))
    return ("Each column is one effect switched on. Changes are relative to the largest value that any output of the same unit "
            "has in the scene: changes of a loss are relative to the power. A dot is no change beyond the solver's tolerance, ~0 is less "
            f"than 0.01 %. The largest change by one effect is that of {strongest.name}: the mean of {what} changes by "
            f"{words.signed(100.0 * change)} %.")


def _largest(trial):
    changes = [(f"{name} mean", change) for name, change in trial.mean.items()]
    changes += [(f"{name} peak to peak", change) for name, change in trial.swing.items()]
    return sorted(changes, key=lambda pair: -abs(pair[1]))


def _table(run, tried):
    rows = []
    for trial in tried:
        changes = [f"{name} {words.signed(100.0 * change)} %" for name, change in _largest(trial)[:NAMED] if abs(change) > trial.nothing]
        what = f"refused by the FMU: {trial.refused}" if trial.refused else "; ".join(changes) or _nothing(run, trial)
        rows.append((trial.name, what, *("" if trial.refused else f"{words.number(cost, 2)} ×" for cost in (trial.calls, trial.seconds))))
    return Table(("effect", "largest changes, relative to the largest value of the kind", "evaluations", "time"), rows,
                 "Evaluations of the tooth forces and time, relative to those of the scene. Times of short runs include the start of the "
                 "simulation, in which the tables of new gears are calculated.", left=2)


def _nothing(run, trial):
    # parameters of the effect, and others whose descriptions name the effect
    own = [variable for variable in run.scene.fmu.variables.values()
           if variable.name.startswith(f"{trial.name}.") or f"{PREFIX}{trial.name}" in (variable.description or "")]
    zero = [variable.name for variable in own
            if variable.causality in ("parameter", "input") and variable.kind in ("Real", "Integer") and run.value(variable.name) == 0.0]
    zeros = f" ({words.listed(zero)} {'is' if len(zero) == 1 else 'are'} 0)" if zero else ""
    return f"changes nothing beyond the solver's tolerance{zeros}"
