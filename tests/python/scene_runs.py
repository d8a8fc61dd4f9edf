"""Attempts at scenes: each is refused with a clear error, or runs. Both outcomes are checked here.

`Attempts` runs them in a separate process, so that a crash or a hang is reported with its scene. To replay one:

    export FMU=target/fmu/BevelDifferential.fmu PYTHONPATH=python/src:fmu-build/python
        target/python/bin/python tests/python/scene_runs.py replay 'the printed scene'
"""

import ast
import json
import math
import os
import queue
import subprocess
import sys
import threading
import time

import random_scenes
from bevel_differential import DifferentialError, Fmu
from bevel_differential.instance import Instance
from fmpy.fmi1 import FMICallException
from momentum import Momentum
from two_places import Scene, compared, unbalanced

OK, DISCARD, ERROR = 0, 2, 3
# attempts at steps after which the FMU discards a communication step of up to a second
ATTEMPTS = 2_000_000
# Energy residual over the energy turned over, in tolerances: in each step, the error of a speed is at most one, that of its
# energy two, and the errors of fifty impacts may have the same sign. The method of fixed steps has no error control. Without
# tip corners, a bent pair leaves its path with its energy, which no output contains.
IMBALANCE = 100.0
# largest negative heat over the energy turned over
COLD = 1e-3
FIXED_STEP = 2
# energy below which a scene counts as at rest [J]
LEAST = 1e-9
# duration that counts as a hang [s]: longer than any attempt, unless several effects are calculated slice by slice
PATIENCE = 300.0


class StatusInstance(Instance):
    """Instance whose calls return their status instead of raising errors."""

    def __init__(self, fmu):
        super().__init__(fmu)
        # only errors are logged
        self.raw.setDebugLogging(False, [])
        self.readable = [name for name, variable in fmu.variables.items() if variable.causality == "output"]

    def call(self, function, *arguments):
        try:
            function(*arguments)
        except (DifferentialError, FMICallException) as failure:
            if failure.status is None:
                # refused by the package instead of the FMU
                raise
            return failure.status
        return OK

    def set(self, name, value):
        return self.call(super().set, {name: value})

    def initialise(self):
        return self.call(super().initialise)

    def step(self, size):
        return self.call(super().step, size)

    def reset(self):
        return self.call(super().reset)

    def outputs(self):
        return dict(zip(self.readable, self.read(self.readable)))

    def names_a_variable(self, since=0):
        """True if the log names an existing variable."""
        words = " ".join(self.messages[since:]).replace(",", " ").replace(":", " ").replace("\"", " ").replace("`", " ")
        return any(word.strip(".;()") in self.fmu.variables for word in words.split())


class Attempt:
    """One scene. `verdict`: refused, ran, discarded or failed; `problems`: violated requirements. `is_plausible`: true if outputs that
    show the same quantity in two ways are compared."""

    def __init__(self, fmu, scene, is_plausible=False):
        self.scene, self.problems, self.verdict = scene, [], "ran"
        self.imbalance = self.turned_over = self.attempts = self.slowest = 0.0
        self.balanced, self.is_plausible, self.compared = False, is_plausible, 0
        self.instance, self.messages = StatusInstance(fmu), []
        try:
            if self.start():
                self.go()
            else:
                self.verdict = "refused"
            self.messages = self.instance.messages[-2:]
            self.fresh_again()
        finally:
            self.instance.close()
        if self.problems:
            self.verdict = "failed"

    def record(self):
        found = {name: getattr(self, name) for name in ("verdict", "problems", "imbalance", "turned_over", "attempts",
                                                        "slowest", "balanced", "compared")}
        return {**found, "log": self.messages}

    def demand(self, holds, what):
        if not holds:
            self.problems.append(what)

    def start(self):
        """Returns true if the scene was accepted. A refusal must be an error with a message that names a variable."""
        one = self.instance
        for name, value in self.scene["start"].items():
            status = one.set(name, value)
            if status:
                self.demand(status in (DISCARD, ERROR) and one.names_a_variable(), f"{name} refused with {status}")
                return False
        begin, time_before = len(one.messages), time.monotonic()
        status = one.initialise()
        self.slowest = time.monotonic() - time_before
        if status > 1:
            self.demand(status == ERROR and one.names_a_variable(begin), f"refused with {status}, {one.messages[begin:]}")
        return status <= 1

    def go(self):
        one = self.instance
        self.finite(one.outputs(), "at the start")
        momentum = self.momentum()
        places = Scene(one.fmu, one) if self.is_plausible else None
        self.demand_agreement(places, momentum, "at the start")
        exchanged = inertial = 0.0
        for size, inputs in self.scene["steps"]:
            for name, value in inputs.items():
                self.demand(one.set(name, value) == OK, f"input {name} = {value} refused")
            before = one.outputs()
            kept = one.raw.getFMUstate()
            if momentum:
                momentum.before_step()
            now, begin, time_before = one.time, len(one.messages), time.monotonic()
            status = one.step(size)
            self.slowest = max(self.slowest, time.monotonic() - time_before)
            after = one.outputs()
            self.finite(after, f"after the step from {now}")
            done = sum(after[n] - before[n] for n in ("solver.steps", "solver.rejected"))
            self.attempts += done
            self.demand(done <= ATTEMPTS, f"{done} attempts in one communication step")
            if status > 1:
                self.verdict = "discarded"
                self.demand(status == DISCARD, f"step from {now} has status {status}")
                self.demand("t = " in " ".join(one.messages[begin:]), f"no time in {one.messages[begin:]}")
                self.demand(one.call(one.raw.setFMUstate, kept) == OK and one.outputs() == before, "state not restored")
            else:
                if momentum:
                    self.demand_momentum(momentum, size)
                self.demand_agreement(places, momentum, f"after the step from {now}")
                exchanged += size * (turned(before) + turned(after)) / 2.0
                inertial = max(inertial, kinetic(self.scene, before), kinetic(self.scene, after))
            one.raw.freeFMUstate(kept)
            if status > 1:
                break
        outputs = one.outputs()
        heat = {name: value for name, value in outputs.items() if name.startswith("heat.")}
        self.turned_over = sum(map(abs, heat.values())) + exchanged + inertial
        self.imbalance = abs(outputs["solver.energy_residual"]) / max(self.turned_over, LEAST)
        start = self.scene["start"]
        if start["solver.method"] != FIXED_STEP and start["effects.corner_contact"]:
            limit = IMBALANCE * start["solver.relative_tolerance"]
            self.demand(self.imbalance <= limit, f"energy residual of {self.imbalance:.2e} of what was turned over")
            # springs in stiction may briefly return more energy than friction has received
            made = [name for name, value in heat.items() if value < -COLD * self.turned_over]
            self.demand(not made, f"energy made out of heat: {made}")

    def momentum(self):
        """Balance of the angular momentum, or None if the gears have no solids that the tests can weigh."""
        try:
            return Momentum(self.instance)
        except DifferentialError:
            raise
        except ValueError:
            return None

    def demand_momentum(self, momentum, size):
        try:
            momentum.after_step(size)
            self.balanced = True
        except AssertionError as wrong:
            self.demand(False, str(wrong))

    def demand_agreement(self, places, momentum, when):
        if places:
            values = places.read(self.instance)
            wrong = compared(places, values) + (unbalanced(momentum, places, values) if momentum else [])
            self.demand(not wrong, f"two outputs disagree {when}: {wrong}")
            self.compared += 1

    def finite(self, outputs, when):
        wrong = [name for name, value in outputs.items() if not math.isfinite(value)]
        self.demand(not wrong, f"not finite {when}: {wrong}")

    def fresh_again(self):
        """Checks that the instance is as new after fmi2Reset, by the study's straight case."""
        one = self.instance
        done = one.reset() == OK and one.initialise() == OK and one.step(1e-3) == OK
        straight = done and one.outputs()["left.speed"] == one.outputs()["right.speed"]
        self.demand(done and straight, "not usable after fmi2Reset")


def turned(outputs):
    return abs(outputs["power.in"]) + abs(outputs["power.out"])


def kinetic(scene, outputs):
    """Kinetic energy of the bodies with given inertia."""
    start = scene["start"]
    bodies = [("inertia.carrier", "carrier.speed"), ("inertia.left_end", "left.speed"),
              ("inertia.right_end", "right.speed"), ("inertia.side_gear", "left.speed"),
              ("inertia.side_gear", "right.speed")]
    bodies += [("inertia.pinion", "pinion.speed")] if start["effects.final_drive"] else []
    bodies += [("inertia.propeller_end", "propeller.speed")] if start["effects.propeller_shaft"] else []
    return sum(0.5 * start[inertia] * outputs[speed] ** 2 for inertia, speed in bodies)


def work(file, kind, count, seed, first):
    """Runs in the worker process: attempts scenes from `first` on, and reports start and end of each."""
    fmu = Fmu.of(file)
    for index, scene in random_scenes.scenes(fmu, kind, count, seed, first):
        print(json.dumps({"index": index}), flush=True)
        print(json.dumps(Attempt(fmu, scene, kind == "plausible").record()), flush=True)


def listen(stream, lines):
    for line in stream:
        lines.put(line)
    lines.put(None)


def attempts(file, kind, count, seed):
    """Yields records of all scenes of a kind, from processes that may crash or hang."""
    first = 0
    while first < count:
        arguments = [str(file), kind, str(count), str(seed), str(first)]
        process = subprocess.Popen([sys.executable, os.path.abspath(__file__), "work", *arguments],
                                   stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True)
        lines = queue.Queue()
        threading.Thread(target=listen, args=(process.stdout, lines), daemon=True).start()
        running, said = first, []
        try:
            while (line := lines.get(timeout=PATIENCE)) is not None:
                try:
                    record = json.loads(line)
                except ValueError:
                    said.append(line)
                    continue
                if "verdict" in record:
                    yield running, record
                    running += 1
            end = f"process ended with {process.wait()}: {''.join(said[-20:])}"
        except queue.Empty:
            end = f"no answer in {PATIENCE} s"
        finally:
            process.kill()
        if running < count:
            yield running, {"verdict": "failed", "problems": [end], "imbalance": 0.0, "turned_over": 0.0,
                            "attempts": 0, "slowest": PATIENCE, "log": []}
        first = running + 1


if __name__ == "__main__":
    task, *arguments = sys.argv[1:]
    if task == "work":
        file, kind, *numbers = arguments
        work(file, kind, *map(int, numbers))
    else:
        print(json.dumps(Attempt(Fmu.of(os.environ["FMU"]), ast.literal_eval(arguments[0])).record(), indent=2))
