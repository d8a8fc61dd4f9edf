"""Buckingham's theorem: if lengths, masses and times of a scene are multiplied by three factors, each output is multiplied by a factor
that follows from its unit.

Dimensions are read from the units. A scene is {"start": values by name, "steps": [(size, inputs)]} as in random_scenes.py."""

import re

import numpy as np
from bevel_differential import DifferentialError

# powers of m, kg and s
SYMBOLS = {"1": (0, 0, 0), "rad": (0, 0, 0), "m": (1, 0, 0), "kg": (0, 1, 0), "s": (0, 0, 1), "Hz": (0, 0, -1), "N": (1, 1, -2),
           "Pa": (-1, 1, -2), "J": (2, 1, -2), "W": (2, 1, -3), "K": (0, 0, 0)}
FACTOR = re.compile(r"([A-Za-z]+|1)(?:\^?(\d+(?:\.\d+)?))?")
# its unit is N/m^e with the exponent e of the law
STIFFNESS, EXPONENT = "contact.stiffness", "contact.exponent"
PAIR = re.compile(r"(mesh\.pair)\[\d\]\.(.*)")
# small differences of large quantities are compared with these scales: accelerations with the forces, slow rotation with the speeds,
# energy with the power between two points
NATURAL = {"rad/s2": lambda of, _: of["N"] * of["m"] / of["kg.m2"], "m/s2": lambda of, _: of["N"] / of["kg"],
           "Hz": lambda of, _: of["rad/s"], "J": lambda of, span: of["W"] * span}
INERTIAS = ("inertia.side_gear", "inertia.planet")
RESIDUAL = "solver.energy_residual"
# fraction of the scene's largest torque below which a ratio of torques only shows rounding errors
ROUNDING = 1e-9
# sum of both torques below which the FMU gives no ratio, N·m
LEAST = 1e-3
RATIOS, TORQUES = ("torque_bias_ratio", "locking_value"), ("left.shaft_torque", "right.shaft_torque")


def dimension(unit):
    """Powers of m, kg and s of a unit such as N.m.s2/rad2, N/m^1.5 or J/(kg.K)."""
    over, _, under = unit.replace("(", "").replace(")", "").partition("/")
    powers = np.zeros(3)
    for sign, part in ((1.0, over), (-1.0, under)):
        while part:
            found = FACTOR.match(part)
            powers += sign * float(found[2] or 1.0) * np.array(SYMBOLS[found[1]])
            part = part[found.end():].removeprefix(".")
    return powers


class Scale:
    """Factors of lengths, masses and times, applied to a scene with the start values `start`."""

    def __init__(self, fmu, factors, start):
        self.variables, self.factors = fmu.variables, np.array(factors)
        self.exponent = start.get(EXPONENT, fmu.variables[EXPONENT].start)

    def factor(self, name):
        unit = self.variables[name].unit
        powers = dimension(f"N/m^{self.exponent}" if name == STIFFNESS else unit or "1")
        return float(np.prod(self.factors**powers))

    def values(self, values):
        return {name: value * self.factor(name) if self.variables[name].kind == "Real" else value
                for name, value in values.items()}

    def scene(self, scene):
        everything = {v.name: v.start for v in self.variables.values() if v.causality in ("parameter", "input")}
        steps = [(size * float(self.factors[2]), self.values(inputs)) for size, inputs in scene["steps"]]
        return {"start": self.values(everything | scene["start"]), "steps": steps}


def record(fmu, scene, names):
    """Values by point and name for as long as the scene runs, and the reason why it ends early."""
    with fmu.open() as opened:
        rows = []
        try:
            opened.initialise(scene["start"])
            rows.append(opened.read(names))
            for size, inputs in scene["steps"]:
                opened.set(inputs)
                opened.step(size)
                rows.append(opened.read(names))
            end = None
        except DifferentialError as error:
            end = str(error)
    return np.array(rows, dtype=float), end


def calculated(fmu):
    """Names of all variables that the FMU calculates."""
    return [name for name, v in fmu.variables.items() if v.causality in ("output", "local", "calculatedParameter")]


def differences(fmu, scene, factors):
    """(largest difference by name, points) between a scene and its image, which is scaled back, for all calculated variables. A difference
    is relative to the largest value of the same unit in the scene, or of the variable itself without a unit. Fails if only one of
    both scenes is refused or ends early."""
    names = calculated(fmu)
    scale = Scale(fmu, factors, scene["start"])
    one, end = record(fmu, scene, names)
    other, other_end = record(fmu, scale.scene(scene), names)
    assert (end is None) == (other_end is None) and len(one) == len(other), f"one ends: {end} and {other_end}"
    if not len(one):
        raise DifferentialError(end)
    back = other / np.array([scale.factor(name) for name in names])
    one, back = ordered(names, one), ordered(names, back)
    size = np.max(np.abs(one), axis=0)
    torques = [np.array([all_of[:, names.index(name)] for name in TORQUES]) for all_of in (one, other)]
    torque = np.sum(np.abs(torques[0]), axis=0)
    has_ratio = np.all([np.abs(np.sum(each, axis=0)) > LEAST for each in torques], axis=0)
    largest = {}
    for name, value in zip(names, size):
        unit = fmu.variables[name].unit
        largest[unit] = max(largest.get(unit, 0.0), value)
    found = {}
    span = sum(size for size, _ in scene["steps"]) / len(one)
    start = scene["start"]
    given = [start[name] for name in INERTIAS] if start.get("inertia.from_geometry") is False else []
    largest["kg.m2"] = min([largest["kg"] * largest["m"]**2, *given])
    for unit, natural in NATURAL.items():
        largest[unit] = max(largest[unit], natural(largest, span))
    residual = np.abs(one[:, names.index(RESIDUAL)]) + np.abs(back[:, names.index(RESIDUAL)])
    for i, name in enumerate(names):
        unit = fmu.variables[name].unit
        whole = largest[unit] if unit not in (None, "1") else size[i]
        off = np.abs(one[:, i] - back[:, i])
        if unit == "J" and name != RESIDUAL:
            # the energy residual limits the accuracy of heat
            off = np.maximum(off - residual, 0.0)
        if name in RATIOS:
            # the difference of equal torques is a rounding error
            whole = max(whole, 1.0)
            off = np.where(has_ratio & (torque > ROUNDING * largest["N.m"]), off, 0.0)
        found[name] = float(np.max(off)) / whole if whole > 0.0 else float(np.max(off))
    return found, len(one)


def ordered(names, rows):
    """Rows with the pairs of a mesh in the order of their teeth, because pairs on opposite flanks at one height have no other order."""
    groups = {}
    for i, name in enumerate(names):
        if found := PAIR.fullmatch(name):
            groups.setdefault(found[1], {}).setdefault(found[2], []).append(i)
    rows = rows.copy()
    for group in groups.values():
        order = np.argsort(rows[:, group["tooth"]], axis=1, kind="stable")
        for columns in group.values():
            rows[:, columns] = np.take_along_axis(rows[:, columns], order, axis=1)
    return rows
