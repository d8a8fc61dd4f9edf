"""Error of a coupled run against the communication step of the host, with and without rollback. The host is coupling.c.
Writes communication_step.csv.

Inputs that are held from the beginning of a step are late by half a step on average: order 1. A host that can take a step back
repeats the step with the mean of the inputs at both ends: order 2."""

import math
import subprocess
from pathlib import Path

import numpy as np

from calls import compiled, in_turn, library_of, quartiles, write_start
from precision import COMPARED, FIDELITIES, errors
from tools import say, write_measured

HEAD = ["coupling", "fidelity", "h_s", "status", "message", "runs", "cpu_s", "cpu_s_low", "cpu_s_high", "cost", "speed_error",
        "force_error", "order", "steps", "rhs_calls"]
# runs: the coupling as an argument of coupling.c, the level of gear contact, the name in the CSV file
COUPLINGS = [("0", "impact", "plain"), ("1", "impact", "rollback_once"), ("2", "impact", "rollback_twice"),
             ("constant", "impact", "constant_inputs"), ("0", "ideal", "plain"), ("2", "ideal", "rollback_twice")]
# as in coupling.c: inertia of a wheel [kg·m²], speed of the wheels at the start [rad/s], slip stiffness [N] and radius [m] of a
# tyre, force of a tyre at the start [N]
WHEEL_INERTIA, SPEED, SLIP_STIFFNESS, RADIUS, FORCE = 1.0, 70.0, 6e4, 0.3, 0.5 * 50.0 / 0.3
# communication step [s]; cost is relative to stepping without rollback at this step, with teeth
UNIT_STEP = 1e-3
# tolerance of the differential, small enough for the errors of coupling to show; tolerance of the reference with constant inputs
TOLERANCE, REFERENCE_TOLERANCE = 1e-9, 1e-11
# step of the reference, which integrates host and differential as one system [s]: an explicit method has to resolve the teeth's
# damping
IN_ONE_PIECE = {"ideal": 1e-4, "impact": 1e-6}
FULL = (1e-5, 2e-5, 5e-5, 1e-4, 2e-4, 5e-4, 1e-3, 2e-3, 5e-3, 1e-2, 2e-2, 5e-2, 1e-1)
QUICK = (1e-4, 1e-3, 1e-2, 1e-1)
RUNS = 5


class Host:
    """The host in C on an FMU. `folder` takes the built program and its start values."""

    def __init__(self, fmu, folder):
        self.fmu, self.folder, self.program = fmu, Path(folder), compiled(folder, "coupling", "-lm")
        names = ["carrier.torque_command", "left.load_torque", "right.load_torque", *COMPARED, "solver.steps", "solver.rhs_calls"]
        self.references = [str(fmu.variable(name).reference) for name in names]

    def run(self, how, fidelity, step, tolerance=TOLERANCE, runs=1):
        """Samples of shape (times, 4); steps and evaluations; processor time of each run [s]. Raises `ValueError`."""
        values = {**FIDELITIES[fidelity], "scene.carrier_drive": "torque", "inertia.left_end": WHEEL_INERTIA,
                  "inertia.right_end": WHEEL_INERTIA, "carrier.speed_command": SPEED, "solver.relative_tolerance": tolerance}
        write_start(self.folder / "set", self.fmu, values)
        command = [self.program, library_of(self.fmu), self.fmu.description.guid, self.folder / "set", how, repr(step), str(runs),
                   str(self.fmu.description.numberOfContinuousStates), *self.references]
        done = subprocess.run(command, capture_output=True, text=True)
        if done.returncode:
            raise ValueError(done.stderr.strip())
        lines = [line.split() for line in done.stdout.splitlines()]
        reports = [list(map(float, line[1:])) for line in lines if line[0] == "run"]
        samples = np.array([line for line in lines if line[0] != "run"], float)
        return samples, [int(count) for count in reports[0][:2]] if reports else [], [seconds for *_, seconds in reports]

    def reference(self, how, fidelity):
        """Samples of the reference."""
        if how == "constant":
            return self.run(how, fidelity, 0.1, REFERENCE_TOLERANCE)[0]
        return self.run("whole", fidelity, IN_ONE_PIECE[fidelity], 1e-6)[0]


def longest_stable_step():
    """Longest communication step at which a tyre that grips is stable without rollback [s]: 2 J v/(C r²), v speed of the car."""
    return 2.0 * WHEEL_INERTIA * RADIUS * SPEED / (1.0 + FORCE / SLIP_STIFFNESS) / (SLIP_STIFFNESS * RADIUS**2)


def measure(fmu, folder, steps, rounds, begin, end):
    """Measures and writes the file. The progress bar moves from `begin` to `end`."""
    host, runs, references = Host(fmu, folder), [], {}
    for done, (how, fidelity, name) in enumerate(COUPLINGS):
        say(begin + 0.4 * (end - begin) * done / len(COUPLINGS), "coupled runs: errors")
        kind = ("constant" if how == "constant" else "whole", fidelity)
        if kind not in references:
            references[kind] = host.reference(how, fidelity)
        for step in steps:
            run = {"of": (how, fidelity, name), "step": step, "ends": ["ok", ""]}
            try:
                samples, run["counts"], _ = host.run(how, fidelity, step)
                run["errors"] = errors(references[kind], samples)
                if not all(map(math.isfinite, run["errors"])):
                    raise ValueError("results are no numbers")
            except ValueError as why:
                run |= {"ends": ["failed", str(why)], "errors": [math.nan] * 2, "counts": ["nan"] * 2}
            runs.append(run)

    def take(run, _):
        return host.run(*run["of"][:2], run["step"], runs=RUNS)[2] if run["ends"][0] == "ok" else []

    seconds = in_turn(runs, rounds, take, (begin + 0.4 * (end - begin), end), "coupled runs: times")
    unit = next(quartiles(taken)[0] for run, taken in zip(runs, seconds)
                if run["of"] == COUPLINGS[0] and run["step"] == UNIT_STEP)
    rows = [HEAD]
    for before, run, taken in zip([None, *runs], runs, seconds):
        median, low, high = quartiles(taken)
        order = math.nan
        if before and before["of"] == run["of"]:
            order = float(np.log(run["errors"][0] / before["errors"][0]) / np.log(run["step"] / before["step"]))
        _, fidelity, name = run["of"]
        rows.append([name, fidelity, run["step"], *run["ends"], len(taken), median, low, high, median / unit, *run["errors"],
                     order, *run["counts"]])
    write_measured(folder / "communication_step.csv", [
        "a car accelerates with its left wheel on ice; tyres and car in the host, differential and wheels in the FMU",
        "errors against one integration of host and differential (Runge-Kutta of order 4); constant_inputs: against tolerance 1e-11",
        "cost: cpu_s over that of plain stepping with teeth at 1e-3 s; order: between this step and the next smaller",
        "steps, rhs_calls: without the steps taken back, which are in the times only",
        f"longest stable plain step by the tyre's slope, s: {longest_stable_step():.6e}"], rows)
