"""Ladder of fidelities: error of each level compared with the richest one, and its cost. Writes fidelity_ladder.csv."""

import math

import numpy as np

from bevel_differential import DifferentialError, Scene
from calls import Calls, in_turn, quartiles
from tools import say, write_measured

HEAD = ["scene", "rung", "words", "status", "message", "quantity", "unit", "value", "richest", "error", "runs", "cpu_s", "cpu_s_low",
        "cpu_s_high", "cost"]
# all levels, the plainest first: a description, and the values changed from the level before
RUNGS = {
    "ideal": ("ideal gears (ideal)", {"scene.gear_contact": "ideal"}),
    "lumped": ("a spring with backlash per mesh (lumped)", {"scene.gear_contact": "lumped"}),
    "tooth, impact": ("tooth pairs with Adams' IMPACT (impact)", {"scene.gear_contact": "tooth"}),
    "tooth, line": ("stiffness from geometry (line)", {"contact.law": "line"}),
    "tooth, line_weber": ("Hertz part by load (line_weber)", {"contact.law": "line_weber"}),
    "+ friction": ("with friction", {"effects.tooth_friction": True, "effects.thrust_friction": True}),
    "+ pins and case": ("with elastic pins and case", {"effects.pin_compliance": True}),
    "+ gear bodies": ("with elastic gear bodies", {"effects.body_compliance": True}),
}
# communication step for timing [s]; number of runs of each level per round; number of rounds, in which all levels alternate
STEP, RUNS, ROUNDS = 1e-3, 5, 3
OUTPUTS = ["left.speed", "carrier.speed", "planet[1].left_normal_force", "left.shaft_torque", "planet[1].left_transmission_error"]
# the study's turn with the inertias of the references in tests/data
TURN = {"inertia.from_geometry": False, "inertia.side_gear": 9e-5, "inertia.planet": 2e-5, "scene.planet_spin": "imposed",
        "spin.command": "200 deg/s", "carrier.speed_command": "954 deg/s"}


class Turn:
    """The study's turn: one mesh cycle after a settling cycle. Names and units of the quantities, times [s], start values."""

    name, settled, end, interval = "turn", 0.18, 0.36, 5e-4
    values, changes = TURN, {}
    quantities = {"mean speed, left": "rad/s", "mean mesh force": "N", "peak mesh force": "N", "speed ripple, left": "1",
                  "mean deflection": "m", "deflection, peak to peak": "m", "heat of one tooth": "J"}

    @staticmethod
    def quantities_of(points):
        """Values of the quantities in a record."""
        speed, force, deflection = (points[name] for name in (OUTPUTS[0], OUTPUTS[2], OUTPUTS[4]))
        return [np.mean(speed), np.mean(force), np.max(force), np.ptp(speed) / np.mean(speed), np.mean(deflection), np.ptp(deflection),
                points["heat"][-1] - points["heat"][0]]


class Clunk:
    """The scene clunk with the study's gears, damped by restitution, and with its inputs from the start. With the light, undamped gears of
    the scene, teeth keep rattling, and solutions that differ by rounding diverge."""

    name, settled, end, interval = "clunk", 0.0, 0.02, 1e-5
    quantities = {"speed of the carrier at the end": "rad/s", "peak shaft torque": "N.m", "time of the peak": "s",
                  "speed of the left gear, rms": "rad/s", "peak mesh force": "N", "heat": "J"}

    def __init__(self, fmu):
        study = {name: fmu.variable(name).start for name in ("inertia.side_gear", "inertia.planet")}
        with Scene.load("clunk", fmu=fmu) as scene:
            self.values = {**scene.values, **study, "contact.damping_model": "restitution"}
            self.changes = {name: value for _, values in scene.changes for name, value in values.items()}

    @staticmethod
    def quantities_of(points):
        """Values of the quantities in a record."""
        torque = points[OUTPUTS[3]]
        return [points[OUTPUTS[1]][-1], np.max(torque), points["time"][np.argmax(torque)], math.sqrt(np.mean(points[OUTPUTS[0]] ** 2)),
                np.max(points[OUTPUTS[2]]), points["heat"][-1] - points["heat"][0]]


def record(fmu, scene, values):
    """Record after the settled state, as a dict of arrays."""
    heats = [name for name in fmu.variables if name.startswith("heat.")]
    rows = []
    with fmu.open() as instance:
        instance.initialise(values).set(scene.changes)
        for k in range(round(scene.end / scene.interval)):
            time = (k + 1) * scene.interval
            instance.do_step(k * scene.interval, time - k * scene.interval)
            if time >= scene.settled - 0.5 * scene.interval:
                read = instance.read([*OUTPUTS, *heats])
                rows.append([time, *read[:len(OUTPUTS)], sum(read[len(OUTPUTS):])])
    return dict(zip(["time", *OUTPUTS, "heat"], np.array(rows).T))


def measure(fmu, folder, short, begin, end):
    """Measures errors and times, and writes the file; the bar moves from `begin` to `end`."""
    scenes, calls, runs = [Turn(), Clunk(fmu)], Calls(folder), []
    for scene in scenes:
        values = dict(scene.values)
        for name, (description, more) in RUNGS.items():
            values |= more
            runs.append((scene, name, description, dict(values)))
    found = []
    for done, (scene, name, _, values) in enumerate(runs):
        say(begin + 0.2 * (end - begin) * done / len(runs), f"ladder: {scene.name}, {name}")
        try:
            found.append(("ok", "", list(map(float, scene.quantities_of(record(fmu, scene, values))))))
        except DifferentialError as why:
            found.append(("failed", str(why), [math.nan] * len(scene.quantities)))

    def take(run, _):
        (scene, *_, values), (status, *_) = run
        return [own for _, own in calls.seconds(fmu, values, [], [(scene.end, STEP)], RUNS, scene.changes)] if status == "ok" else []

    bar = begin + 0.2 * (end - begin), end
    seconds = in_turn(list(zip(runs, found)), 1 if short else ROUNDS, take, bar, "ladder: times")
    rows = [HEAD]
    for place, ((scene, name, description, _), (status, message, values)) in enumerate(zip(runs, found)):
        first = place // len(RUNGS) * len(RUNGS)
        median, low, high = quartiles(seconds[place])
        unit, richest = quartiles(seconds[first])[0], found[first + len(RUNGS) - 1][2]
        for (quantity, unit_of), value, best in zip(scene.quantities.items(), values, richest):
            rows.append([scene.name, name, description, status, message, quantity, unit_of, value, best, abs(value / best - 1.0),
                         len(seconds[place]), median, low, high, median / unit])
    write_measured(folder / "fidelity_ladder.csv", [
        "error: difference from the richest rung over its value; cost: cpu_s over that of the ideal rung",
        "turn: the study's, one mesh cycle after one to settle; clunk: the scene with the study's gears and restitution"], rows)
