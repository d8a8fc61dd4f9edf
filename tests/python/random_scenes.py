"""Random scenes: Latin hypercubes over all parameters and inputs of the FMU.

`wild` takes every value from its whole range, so that few values are consistent. `plausible` stays near scenes that can be
built and follows the documented rules of combination, so that most of them run. `bold` is plausible except for a few values
from their whole ranges: it passes the first checks and reaches the others."""

from zlib import crc32

import numpy as np
import plausible_scenes
from sampling import latin, spread

KINDS = ("wild", "bold", "plausible")
# duration of a run [s], with some impacts and some teeth passing; shorter if values at the ends of their ranges need many steps
DURATION = {"wild": (0.001, 0.003), "bold": (0.001, 0.003), "plausible": (0.01, 0.03)}
# share of values that a bold scene takes from their whole ranges
BOLD = 0.03


# tests of random scenes expect that inputs are held through each step; other tests cover ramps
HELD = "solver.input_ramp"


def free_variables(fmu):
    """All parameters and inputs, except the one that would turn held inputs into ramps."""
    return [v for v in fmu.variables.values() if v.causality in ("parameter", "input") and v.name != HELD]


def wild_value(variable, u):
    if variable.kind == "Boolean":
        return u < 0.5
    if variable.kind == "Enumeration":
        return 1 + int(u * len(variable.literals))
    low, high = plausible_scenes.limits(variable)
    if variable.kind == "Integer":
        return int(low + u * (high - low + 1.0))
    return spread(u, low, high, plausible_scenes.TYPICAL.get(variable.name, variable.start))


def schedule(random, duration, inputs, draw):
    """Irregular communication steps of a short run, some of them with new inputs: (size, inputs) each."""
    sizes = 10.0 ** random.uniform(-5.0, -2.0, 12)
    sizes *= random.uniform(*duration) / sizes.sum()
    return [(float(size), {v.name: draw(v) for v in inputs if random.random() < 0.15}) for size in sizes]


def scenes(fmu, kind, count, seed, first=0, last=None):
    """Yields scenes `first` to `last` of the `count` of a kind: {"start": values by name, "steps": [(size, inputs)]}. Each variable has
    a separate generator, so that an added variable does not change the draws of the others."""
    variables, place = free_variables(fmu), [seed, KINDS.index(kind)]
    inputs = [v for v in variables if v.causality == "input"]
    columns = {v.name: latin(count, np.random.default_rng([*place, crc32(v.name.encode())])).tolist() for v in variables}
    for index in range(first, count if last is None else last):
        random = np.random.default_rng([*place, index])
        if kind == "wild":
            start = {v.name: wild_value(v, columns[v.name][index]) for v in variables}
            draw = wild_value
        else:
            start = plausible_scenes.values(variables, {name: column[index] for name, column in columns.items()})
            draw = lambda v, u: plausible_scenes.value(v, u, start)  # noqa: E731
            if kind == "bold":
                start |= {v.name: wild_value(v, random.random()) for v in variables if random.random() < BOLD}
        steps = schedule(random, DURATION[kind], inputs, lambda v: draw(v, random.random()))
        yield index, {"start": start, "steps": steps}
