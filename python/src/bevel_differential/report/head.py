"""The head of a report: what was run with what, how long it took, and whether it can be trusted."""

import numpy as np

from ..extras import version
from . import strength, words
from .blocks import Section, Table, Text
from .simulated import Simulated

# work and heat that the balance of energy misses, as a share of what went through
BALANCED = 1e-4
SOLVER = ("solver.method", "solver.relative_tolerance", "solver.fixed_step")


def section(run: Simulated) -> Section:
    """Versions, solver and speed; warnings of the FMU; verdicts."""
    found = Section("head", "What was run")
    found.add(Table(("", ""), _facts(run), "Program and solver. Times were measured on the machine that wrote this report."))
    found.add(*verdicts(run))
    found.add(*(Text(f"The FMU warns: {warning}", "warning") for warning in run.warnings))
    return found


def verdicts(run: Simulated) -> list[Text]:
    """Whether energy balances, whether the gears are strong enough, and how the torque is split."""
    residual, throughput = energy_balance(run)
    share = residual / throughput if throughput else 0.0
    found = [Text(f"Energy balances to {words.quantity(residual, 'J', 2)} of the {words.quantity(throughput, 'J', 3)} that "
                  f"went through ({words.percent(share, 2)}).", "verdict", share <= BALANCED)]
    if "effects.strength" in run.refused:
        found.append(Text("No safety factor: there are no teeth whose stress could be rated.", "verdict"))
    else:
        root, flank = float(run.record["safety.root_min"][-1]), float(run.record["safety.flank_min"][-1])
        found.append(Text(f"Smallest safety factors of the run{strength.where(run)}: roots {words.number(root, 3)}, flanks {words.number(flank, 3)}; "
                          "below 1 the life is finite, or the tooth breaks.", "verdict", min(root, flank) >= 1.0))
    found.append(Text(_split(run), "verdict"))
    return found


def energy_balance(run: Simulated) -> tuple[float, float]:
    """Largest residual of the energy, and the larger of the work that went in and the heat, J."""
    power = np.abs(run.series("power.in"))
    work = float(np.trapezoid(power, run.time))
    heat = sum(float(run.record[name][-1]) for name in run.scene.fmu.variables if name.startswith("heat."))
    return float(np.max(np.abs(run.series("solver.energy_residual")))), max(work, heat)


def _split(run):
    left, right = (float(np.mean(run.series(f"{side}.shaft_torque"))) for side in ("left", "right"))
    if max(abs(left), abs(right)) < 1e-9:
        return "The half-shafts carry no torque on the mean, so that there is no bias."
    shares = f"left {words.quantity(left, 'N.m')}, right {words.quantity(right, 'N.m')} on the mean"
    low, high = (words.number(float(bound(run.series("torque_bias_ratio"))), 3) for bound in (np.min, np.max))
    course = f"{low} all the time" if low == high else f"from {low} to {high}"
    return f"Torque: {shares}; bias ratio (slow over fast half-shaft) {course}."


def _facts(run):
    fmu = run.scene.fmu
    last = run.record[-1]
    real = run.scene.stop / run.seconds
    counts = [("solver.steps", "steps"), ("solver.rejected", "rejected"), ("solver.rhs_calls", "evaluations of the tooth forces")]
    steps = ", ".join(f"{int(last[name])} {what}" for name, what in counts)
    solver = ", ".join(f"{name.removeprefix('solver.').replace('_', ' ')} {words.shown(fmu.variable(name), run.value(name))}"
                       for name in SOLVER if name != "solver.fixed_step" or run.literal("solver.method") == "fixed_step")
    rows = [
        ("package", f"bevel-differential {version() or '(from sources)'}"),
        ("FMU", f"{fmu.description.modelName} {fmu.description.version or ''}, FMI {fmu.description.fmiVersion}, co-simulation"),
        ("SHA-256 of the FMU", fmu.sha256),
        ("solver", f"{solver}; {steps}"),
        ("simulated time", f"{words.quantity(run.scene.stop, 's')} in {len(run.time) - 1} communication steps of "
                           f"{words.quantity(1e3 * run.scene.step, 'ms')}"),
        ("took", f"{words.quantity(1e3 * run.seconds, 'ms', 3)}: {words.number(real, 2)} × real time"),
    ]
    if run.added:
        rows.append(("switched on for this report", f"{words.listed(run.added)}: they only add outputs. The scene's own outputs with and without them "
                     + ("are the same to the last bit." if run.difference == 0.0 else
                        f"differ by {run.difference:.1e} of their largest values.")))
    rows += [("not available here", reason) for reason in run.refused.values()]
    return rows

