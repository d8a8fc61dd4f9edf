"""What every host's script needs: the scene, the variables of the FMU by name, and the table that is written.

usage of each script: HOST.py FMU SCENE.json OUT.csv

The FMU is that of FMI 2.0, or that of FMI 3.0 for hosts that read it. All do the same. Parameters and inputs are set
before initialisation; inputs that change at a communication point are set before the step that begins there; outputs are
read after initialisation, where the host can, and after every step. The table has a line for each communication point,
with 17 significant digits, which restore every bit of a double. A line of JSON on standard output gives the host's
version and the seconds from loading the FMU to freeing it. A host that cannot be loaded on this machine ends with status
3 and says why in one line.
"""

import json
import sys
import time
from dataclasses import dataclass
from functools import cache

from fmpy import read_model_description

CANNOT_LOAD = 3
# what numbers of other types are in Python
TYPES = {"Real": float, "Float64": float, "Boolean": bool}


@dataclass
class Variable:
    """A variable; `kind` is its element in the model description. `structural`: FMI 3.0 sets it in configuration mode."""

    name: str
    kind: str
    reference: int
    structural: bool

    def number(self, value):
        """`value` of the scene as the FMU takes it."""
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
    """Whether it is an FMU of FMI 3.0."""
    return described(fmu).fmiVersion.startswith("3")


class Scene:
    """What is simulated: values by name in SI, enumerations as numbers, and the outputs to record."""

    def __init__(self, path):
        with open(path, encoding="utf-8") as file:
            order = json.load(file)
        self.step, self.stop = order["step"], order["stop"]
        self.steps = round(self.stop / self.step)
        self.parameters, self.outputs = order["parameters"], list(order["outputs"])
        # an input is a number or a series of [time, value], each value from that communication point on
        self.series = {name: value if isinstance(value, list) else [[0.0, value]]
                       for name, value in order["inputs"].items()}

    def start(self, known):
        """(variable, value) of all that is set before initialisation."""
        values = self.parameters | {name: series[0][1] for name, series in self.series.items()}
        return [(known[name], known[name].number(value)) for name, value in values.items()]

    def changes(self, k):
        """Names and values of the inputs that change at communication point k."""
        if k == 0:
            return {}
        return {name: float(value) for name, series in self.series.items() for time, value in series
                if round(time / self.step) == k}


def stepped(scene, write, step, read, at_start=True):
    """Values at all communication points: `write(name, value)` sets an input, `step(k)` begins at point k, `read()` gives
    the outputs; not `at_start`: the host cannot read before the first step."""
    rows = {0: read()} if at_start else {}
    for k in range(scene.steps):
        for name, value in scene.changes(k).items():
            write(name, value)
        step(k)
        rows[k + 1] = read()
    return rows


def main(load, run):
    """`load` imports the host and returns its version; `run(fmu, scene)` returns {communication point: values}."""
    if len(sys.argv) != 4:
        raise SystemExit(f"usage: {sys.argv[0]} FMU SCENE.json OUT.csv")
    fmu, scene = sys.argv[1], Scene(sys.argv[2])
    try:
        version = load()
    except (ImportError, OSError) as error:
        print(error, file=sys.stderr)
        raise SystemExit(CANNOT_LOAD) from None
    # the description is read and kept before the clock runs
    described(fmu)
    begin = time.perf_counter()
    rows = run(fmu, scene)
    seconds = time.perf_counter() - begin
    with open(sys.argv[3], "w", encoding="utf-8") as file:
        print("point", *scene.outputs, sep=",", file=file)
        for k, values in sorted(rows.items()):
            print(k, *(f"{value:.17g}" for value in values), sep=",", file=file)
    print(json.dumps({"version": version, "seconds": seconds}))
