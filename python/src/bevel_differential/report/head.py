"""Head of a report: program and scene, duration, verdicts, and set-up."""

from collections.abc import Container

import numpy as np

from ..extras import version
from ..fmu import Fmu
from ..plot import over_time
from ..scene import Scene
from ..want import mean_over_time
from . import dogs, strength, words
from .blocks import Section, Table, Text
from .simulated import Simulated
from .svg_style import picture

# largest error of the energy balance, as a fraction of the throughput
BALANCED = 1e-4
SOLVER = ("solver.method", "solver.relative_tolerance", "solver.fixed_step")
# height of a panel, inches
PANEL = 1.7


def section(run: Simulated) -> Section:
    """Section with versions, solver and speed, warnings of the FMU, and verdicts."""
    found = Section("head", "What was run")
    found.add(Table(("", ""), _facts(run), "Program and solver. Times were measured on the machine that wrote this report."))
    found.add(*verdicts(run))
    found.add(*(Text(f"The FMU warns: {warning}", "warning") for warning in run.warnings))
    return found


def verdicts(run: Simulated) -> list[Text]:
    """Verdicts on the energy balance, the strength of the gears, and the split of the torque."""
    residual, throughput = energy_balance(run)
    share = residual / throughput if throughput else 0.0
    found = [Text(f"Energy balances to {words.quantity(residual, 'J', 2)} of the {words.quantity(throughput, 'J', 3)} that "
                  f"passed through ({words.percent(share, 2)}).", "verdict", share <= BALANCED)]
    if "effects.strength" in run.refused:
        found.append(Text("No safety factor: there are no teeth whose stress could be rated.", "verdict"))
    else:
        root, flank = float(run.record["safety.root_min"][-1]), float(run.record["safety.flank_min"][-1])
        found.append(Text(f"Smallest safety factors of the run{strength.where(run)}: roots {words.number(root, 3)}, "
                          f"flanks {words.number(flank, 3)}; below 1 the life is finite, or the tooth breaks.", "verdict", min(root, flank) >= 1.0))
    found.append(Text(_split(run), "verdict"))
    return found


def energy_balance(run: Simulated) -> tuple[float, float]:
    """Largest residual of the energy balance, and the larger of input work and heat, J."""
    work = mean_over_time(np.abs(run.series("power.in")), run.time) * float(run.time[-1])
    heat = sum(float(run.record[name][-1]) for name in run.scene.fmu.variables if name.startswith("heat."))
    return float(np.max(np.abs(run.series("solver.energy_residual")))), max(work, heat)


def _split(run):
    left, right = (run.mean(f"{side}.shaft_torque") for side in ("left", "right"))
    if max(abs(left), abs(right)) < 1e-9:
        return f"The half-shafts carry no torque on the mean, so that there is no bias. {dogs.phases(run)}".rstrip()
    torque = run.scene.fmu.variable("left.shaft_torque")
    shares = f"left {words.shown(torque, left)}, right {words.shown(torque, right)} on the mean"
    closed = dogs.connected(run)
    if not closed.any():
        return f"Torque: {shares}; no bias ratio, because a dog clutch is never closed. {dogs.phases(run)}"
    low, high = (words.number(float(bound(run.series("torque_bias_ratio")[closed])), 3) for bound in (np.min, np.max))
    course = f"{low} all the time" if low == high else f"from {low} to {high}"
    when = "" if closed.all() else " while the dog clutches are closed"
    return f"Torque: {shares}; bias ratio (slow over fast half-shaft) {course}{when}. {dogs.phases(run)}".rstrip()


def program(fmu: Fmu) -> list[tuple[str, str]]:
    """Names and versions of package and FMU."""
    return [("package", f"bevel-differential {version() or '(from sources)'}"),
            ("FMU", f"{fmu.description.modelName} {fmu.description.version or ''}, FMI {fmu.description.fmiVersion}, co-simulation"),
            ("SHA-256 of the FMU", fmu.sha256)]


def _facts(run):
    last = run.record[-1]
    real = run.scene.stop / run.seconds
    counts = [("solver.steps", "steps"), ("solver.rejected", "rejected"), ("solver.rhs_calls", "evaluations of the tooth forces")]
    steps = ", ".join(f"{int(last[name])} {what}" for name, what in counts)
    solver = ", ".join(f"{name.removeprefix('solver.').replace('_', ' ')} {words.shown(run.scene.fmu.variable(name), run.value(name))}"
                       for name in SOLVER if name != "solver.fixed_step" or run.literal("solver.method") == "fixed_step")
    rows = [
        *program(run.scene.fmu),
        ("solver", f"{solver}; {steps}"),
        ("simulated time", f"{words.quantity(run.scene.stop, 's')} in {len(np.unique(run.time)) - 1} communication steps of "
                           f"{words.quantity(1e3 * run.scene.step, 'ms')}"),
        ("took", f"{words.quantity(1e3 * run.seconds, 'ms', 3)}: {words.number(real, 2)} × real time"),
    ]
    if run.added:
        rows.append(("switched on for this report", f"{words.listed(run.added)}: they only add outputs. The scene's own outputs with "
                                                    "and without them "
                     + ("are the same to the last bit." if run.difference == 0.0 else
                        f"differ by {run.difference:.1e} of their largest values.")))
    rows += [("not available here", reason) for reason in run.refused.values()]
    return rows


def setup(run: Simulated) -> Section:
    """Section with plan, values that differ from the start values, and inputs over time."""
    found = Section("setup", "Set-up and plan")
    found.say(f"The FMU says that it simulates: {run.plan_text}.")
    if not run.scene.values:
        found.say("All values are the start values of the FMU.")
    else:
        found.add(values(run.scene))
    unset = run.scene.nobody_set()
    if unset:
        found.say(f"Values that act and that nobody set, with the start values of the FMU, which are those of the study: {unset}.")
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


def values(scene: Scene, without: Container[str] = ()) -> Table:
    """Values that a scene sets, next to the start values of the FMU; `without`: names to leave out, because something else sets them."""
    fmu = scene.fmu
    rows = []
    for name, value in scene.values.items():
        if name in without:
            continue
        variable = fmu.variable(name)
        start = "" if variable.start is None else words.shown(variable, variable.start)
        rows.append((name, variable.description or "", words.shown(variable, value),
                     start if variable.start != value else "the same"))
    driven = ", ".join(dict.fromkeys(name for name, *_ in scene.tables))
    return Table(("name", "meaning", "scene", "start value of the FMU"), rows,
                 f"{len(rows)} values that the scene sets; all others have the start values of the FMU."
                 + (f" {driven}: by a table over time." if driven else ""), left=2)


def _inputs(run, names):
    changes = []
    for name in names:
        values = run.shown(name)
        changes.append(f"{name} between {words.number(values.min())} and {words.quantity(values.max(), run.unit(name))}, "
                       f"{words.number(values[-1])} at the end")
    # the FMU holds inputs between communication points
    rows = over_time(run.scene.fmu, run.record, names, held=True)
    return picture("inputs", rows, f"Inputs that change: {'; '.join(changes)}. All others are constant.", PANEL * len(rows) + 0.6)
