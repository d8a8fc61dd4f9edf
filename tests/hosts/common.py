"""Common code of the scripts for the FMI hosts: the scene, the variables of the FMU by name, and the table of results.

usage of each script: HOST.py FMU SCENE.json OUT.csv

The FMU is of FMI 2.0, or of FMI 3.0 for hosts that support it. All scripts follow the same sequence. They set parameters
and inputs before initialisation. An input that changes at a communication point is set before the step that begins at that
point. Outputs are read after initialisation, if the host supports it, and after every step.

The table has a line for each communication point, with 17 significant digits, which restore every bit of a double. A line
of JSON on standard output gives the host's version and the seconds from loading the FMU to freeing it. If the host cannot
be loaded on this machine, the script ends with status 3 and prints the reason in one line.
"""

import json
import sys
import time
from dataclasses import dataclass
from functools import cache

from fmpy import read_model_description

CANNOT_LOAD = 3
# Python types of FMI types; all others are int
TYPES = {"Real": float, "Float64": float, "Boolean": bool}


@dataclass
class Variable:
    """A variable. `kind` is its element in the model description; a `structural` parameter of FMI 3.0 is set in configuration mode."""

    name: str
    kind: str
    reference: int
    structural: bool

    def number(self, value):
        """Converts a `value` of the scene to the type of the variable."""
        return TYPES.get(self.kind, int)(value)


@cache
def described(fmu):
    return read_model_description(fmu)


def variables(fmu):
    """All variables by name."""
    return {each.name: Variable(each.name, each.type, each.valueReference, each.causality == "structuralParameter")
            for each in described(fmu).modelVariables}


def description(fmu):
    """GUID and model identifier."""
    known = described(fmu)
    return known.guid, known.coSimulation.modelIdentifier


def is_three(fmu):
    """True for an FMU of FMI 3.0."""
    return described(fmu).fmiVersion.startswith("3")


class Scene:
    """A simulation task: step and stop time, values by name in SI, enumerations as numbers, and the outputs to record."""

    def __init__(self, path):
        with open(path, encoding="utf-8") as file:
            order = json.load(file)
        self.step, self.stop = order["step"], order["stop"]
        self.steps = round(self.stop / self.step)
        self.parameters, self.outputs = order["parameters"], list(order["outputs"])
        # an input is a number or a series of [time, value]; each value applies from the communication point at that time on
        self.series = {name: value if isinstance(value, list) else [[0.0, value]]
                       for name, value in order["inputs"].items()}

    def start(self, known):
        """All (variable, value) pairs to set before initialisation."""
        values = self.parameters | {name: series[0][1] for name, series in self.series.items()}
        return [(known[name], known[name].number(value)) for name, value in values.items()]

    def changes(self, k):
        """Names and values of the inputs that change at communication point k."""
        if k == 0:
            return {}
        return {name: float(value) for name, series in self.series.items() for time, value in series
                if round(time / self.step) == k}


def stepped(scene, write, step, read, at_start=True):
    """Simulates a scene and returns {communication point: values}. `write(name, value)` sets an input, `step(k)` performs the
    step from point k, and `read()` returns the outputs. `at_start` is false if the host cannot read before the first step."""
    rows = {0: read()} if at_start else {}
    for k in range(scene.steps):
        for name, value in scene.changes(k).items():
            write(name, value)
        step(k)
        rows[k + 1] = read()
    return rows


def main(load, run):
    """Runs the script of a host. `load` imports the host and returns its version; `run(fmu, scene)` returns {communication
    point: values}."""
    if len(sys.argv) != 4:
        raise SystemExit(f"usage: {sys.argv[0]} FMU SCENE.json OUT.csv")
    fmu, scene = sys.argv[1], Scene(sys.argv[2])
    try:
        version = load()
    except (ImportError, OSError) as error:
        print(error, file=sys.stderr)
        raise SystemExit(CANNOT_LOAD) from None
    # reads and caches the model description before the time is measured
    described(fmu)
    begin = time.perf_counter()
    rows = run(fmu, scene)
    seconds = time.perf_counter() - begin
    with open(sys.argv[3], "w", encoding="utf-8") as file:
        print("point", *scene.outputs, sep=",", file=file)
        for k, values in sorted(rows.items()):
            print(k, *(f"{value:.17g}" for value in values), sep=",", file=file)
    print(json.dumps({"version": version, "seconds": seconds}))
