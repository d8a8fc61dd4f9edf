"""Work and precision: three motions at four fidelities with every method, over tolerances and steps, each compared with its reference.
Writes work_precision.csv.

Results are compared at few points, because fixed steps end at every communication point. Points closer than the solver's steps would
limit the steps, and the figure would show the host's step instead of the solver's. Other methods interpolate between the ends of
their steps."""

import math
import re
import time
from dataclasses import dataclass

import numpy as np

from bevel_differential import DifferentialError
from bevel_differential.records import read
from calls import Calls, in_turn, quartiles
from ladder import TURN, Clunk
from tools import WORKSPACE, say, write_measured

HEAD = ["case", "motion", "fidelity", "method", "setting", "unit", "status", "message", "runs", "cpu_s", "cpu_s_low", "cpu_s_high",
        "cost", "speed_error", "force_error", "steps", "rejected", "rhs_calls", "jacobians", "reference", "reference_speed_error",
        "reference_force_error"]
# compared outputs: two speeds, two forces
COMPARED = ["left.speed", "right.speed", "planet[1].left_normal_force", "planet[1].right_normal_force"]
# motions, with ends and steps of their time intervals [s]. The turn lasts one tooth pitch with preloaded teeth: it is smooth, except
# for the hand-over of the load from pair to pair. The blow is a turn that starts in the middle of the gaps. In the clunk, the whole
# lash is crossed
MOTIONS = {"turn": [(0.18, 10e-3)], "blow": [(2e-3, 250e-6), (20e-3, 2e-3)], "clunk": [(20e-3, 1e-3)]}
FIDELITIES = {"ideal": {"scene.gear_contact": "ideal"}, "lumped": {"scene.gear_contact": "lumped"},
              "impact": {"scene.gear_contact": "tooth"}, "line": {"scene.gear_contact": "tooth", "contact.law": "line"}}
# without teeth, there is no blow
CASES = [(motion, fidelity) for motion in MOTIONS for fidelity in FIDELITIES if (motion, fidelity) != ("blow", "ideal")]
# the default method first
METHODS = ["adaptive", "radau", "fixed_step"]
DEFAULT = ("adaptive", 1e-6)
# tolerance of the methods that replace a reference; times that differ by less are equal [s]
FINEST, SAME = 1e-11, 1e-9
# references from independent equations and an independent solver: a plain model in Python, integrated by scipy at 1e-12
FILES = {("turn", "impact"): "reference_turn_equilibrium.csv", ("blow", "impact"): "reference_turn_rolling.csv"}
# number of runs of each setting in a round: all settings alternate; those that take longer than LONG [s] are timed in only one round
RUNS, LONG = 5, 0.2
ACCOUNT = re.compile(r"(\d+) steps accepted, (\d+) rejected for their error, \d+ for their ledger, (\d+) for values that are not finite, "
                     r"(\d+) cut at a switch; (\d+) evaluations of the tooth forces, (\d+) Jacobians")


@dataclass(frozen=True)
class Plan:
    """Tolerances, fixed steps [s], number of rounds, and the limit of processor time of a run [s]."""

    tolerances: tuple[float, ...]
    steps: tuple[float, ...]
    rounds: int
    patience: float


FULL = Plan((1e-2, 1e-3, 1e-4, 1e-5, 1e-6, 1e-7, 1e-8, 1e-9, 1e-10), (1e-3, 3e-4, 1e-4, 3e-5, 1e-5, 3e-6, 1e-6), 3, 10.0)
QUICK = Plan((1e-3, 1e-6, 1e-9), (1e-4, 1e-5), 1, 0.5)


class Case:
    """A motion at a level of fidelity."""

    def __init__(self, fmu, motion, fidelity):
        self.fmu, self.motion, self.fidelity, self.stretches = fmu, motion, fidelity, MOTIONS[motion]
        clunk = Clunk(fmu) if motion == "clunk" else None
        start = {"scene.start": "rolling"} if motion == "blow" else {}
        self.values = {**(clunk.values if clunk else TURN), **start, **FIDELITIES[fidelity]}
        self.changes = clunk.changes if clunk else {}
        self.times, begin = [], 0.0
        for end, step in self.stretches:
            self.times += [begin + step * (k + 1) for k in range(round((end - begin) / step))]
            begin = end

    @property
    def name(self):
        return f"{self.motion}/{self.fidelity}"

    def with_solver(self, method, value):
        """Start values with a method at a tolerance, or with fixed steps."""
        name = "solver.fixed_step" if method == "fixed_step" else "solver.relative_tolerance"
        return {**self.values, "solver.method": method, name: value}

    def samples(self, method, value, patience=math.inf):
        """Compared values, of shape (times, 4), and the numbers of steps, rejected steps, evaluations and Jacobians. Raises an error if the
        run fails."""
        found, before = [], 0.0
        with self.fmu.open() as instance:
            instance.log(["logStatusWarning", "logStatusDiscard", "logStatusError", "logEvents"])
            instance.initialise(self.with_solver(method, value)).set(self.changes)
            begun = time.process_time()
            for now in self.times:
                instance.do_step(before, now - before)
                found.append(instance.read(COMPARED))
                before = now
                if time.process_time() - begun > patience:
                    raise DifferentialError(f"given up at {now:g} s, after {patience:g} s on the processor")
            # the last of its messages contains its statistics
            instance.raw.terminate()
            accepted, wrong, not_finite, cut, evaluations, jacobians = map(int, ACCOUNT.search(instance.events[-1]).groups())
        return np.array(found), [accepted, wrong + not_finite + cut, evaluations, jacobians]

    def reference(self):
        """Reference of the errors: samples, their source, and their own errors in the same measure."""
        if (self.motion, self.fidelity) == ("turn", "ideal"):
            return self._closed_form(), "closed form", [0.0, 0.0]
        file = FILES.get((self.motion, self.fidelity))
        if file:
            samples, strays = from_file(WORKSPACE / "tests" / "data" / file, self.times)
            return samples, f"scipy DOP853 1e-12 on a plain model ({file})", strays
        # two methods that share the equations and the error control, but not the formula of a step
        radau, adaptive = (self.samples(method, FINEST)[0] for method in ("radau", "adaptive"))
        return radau, "own Radau 1e-11, checked by own Rodas5P 1e-11", errors(radau, adaptive)

    def _closed_form(self):
        """Turn of ideal gears with imposed speeds, which needs no solution: Willis' equation and static forces."""
        with self.fmu.open() as instance:
            instance.initialise(self.values)
            carrier, spin, *forces = instance.read(["carrier.speed_command", "spin.command", *COMPARED[2:]])
            planet, side = instance.read(["geometry.planet_teeth", "geometry.side_teeth"])
        return np.array([[carrier + spin * planet / side, carrier - spin * planet / side, *forces]] * len(self.times))


def from_file(path, times):
    """Samples at `times` from a file of references, and the deviations of scipy's Radau that the file states."""
    _, rows = read(path)
    for name in COMPARED:
        if name not in rows[0]:
            raise SystemExit(f"{path.name} has no column {name}")
    samples = []
    for now in times:
        row = next((row for row in rows if abs(row["time"] - now) < SAME), None)
        if row is None:
            raise SystemExit(f"{path.name} has no row for {now:g} s: renew the file with tests/python/make_reference.py")
        samples.append([row[name] for name in COMPARED])
    head = "\n".join(line for line in path.read_text(encoding="utf-8").splitlines() if line.startswith("#"))
    strays = [float(re.search(rf"{re.escape(name)} (\d\S*e[-+]\d+)", head)[1]) for name in COMPARED]
    return np.array(samples), [max(strays[:2]), max(strays[2:])]


def errors(reference, samples):
    """Errors in speed and force: the largest differences, divided by the largest speed and the mean force of `reference`."""
    apart, size = np.abs(samples - reference), np.abs(reference)
    return [float(apart[:, :2].max() / size[:, :2].max()), float(apart[:, 2:].max() / size[:, 2:].mean())]


def measure(fmu, folder, plan, begin, end):
    """Measures errors and times, and writes the file; the bar moves from `begin` to `end`."""
    settings = [(method, value) for method in METHODS for value in (plan.steps if method == "fixed_step" else plan.tolerances)]
    runs, calls = [], Calls(folder)
    for done, (motion, fidelity) in enumerate(CASES):
        case = Case(fmu, motion, fidelity)
        say(begin + 0.3 * (end - begin) * done / len(CASES), f"{case.name}: errors")
        exact, source, strays = case.reference()
        for method, value in settings:
            begun = time.process_time()
            try:
                samples, counts = case.samples(method, value, plan.patience)
                found = errors(exact, samples)
                status, message = ("ok", "") if all(map(math.isfinite, found)) else ("failed", "results are not finite")
            except DifferentialError as why:
                status, message, found, counts = "failed", str(why), [math.nan] * 2, ["nan"] * 4
            first = time.process_time() - begun
            runs.append({"case": case, "setting": (method, value), "ends": [status, message], "errors": found, "counts": counts,
                         "first": first, "reference": [source, *strays]})

    def take(run, number):
        if run["ends"][0] != "ok" or (number and run["first"] > LONG):
            return []
        case = run["case"]
        return [own for _, own in calls.seconds(fmu, case.with_solver(*run["setting"]), [], case.stretches, RUNS, case.changes)]

    seconds = in_turn(runs, plan.rounds, take, (begin + 0.3 * (end - begin), end), "measuring times")
    units = {run["case"]: quartiles(taken)[0] for run, taken in zip(runs, seconds) if run["setting"] == DEFAULT}
    rows = [HEAD]
    for run, taken in zip(runs, seconds):
        case, (method, value) = run["case"], run["setting"]
        median, low, high = quartiles(taken)
        rows.append([case.name, case.motion, case.fidelity, method, value, "s" if method == "fixed_step" else "1", *run["ends"],
                     len(taken), median, low, high, median / units[case], *run["errors"], *run["counts"], *run["reference"]])
    write_measured(folder / "work_precision.csv", [
        "speed_error: largest difference over the largest speed; force_error: over the mean force of a mesh",
        "cost: cpu_s over that of the default, adaptive at 1e-6, in the same case; cpu_s: median, _low and _high quartiles",
        "setting: relative tolerance, or for fixed_step the step in s"], rows)
