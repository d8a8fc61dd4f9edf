"""Reference solutions for the FMU, by an independent model (plain.py) and an independent integrator (scipy).

    python tests/python/make_reference.py [CASE]...     writes tests/data/reference_<case>.csv, minutes for each

Each file states the difference from a second integration by another method, which is its own error."""

import sys
from dataclasses import dataclass, field
from math import radians
from pathlib import Path

import numpy as np
from plain import Differential, Scene
from scipy.integrate import DOP853, Radau

DATA = Path(__file__).parent.parent / "data"
SIDES = ("left", "right")
# the planets of these cases are in phase and move identically, so that the first represents all; this is checked on writing
MESH = [f"planet[1].{side}_{what}" for side in SIDES for what in ("normal_force", "transmission_error")]
OUTPUTS = ["left.speed", "right.speed", "planet[1].spin_speed", "carrier.torque", *MESH]
UNITS = {"speed": "rad/s", "torque": "N.m", "force": "N", "error": "m"}

# inertias are given, because the plain model has no solids
GIVEN = {"inertia.from_geometry": False, "inertia.side_gear": 9e-5, "inertia.planet": 2e-5}
TURN = {"carrier.speed_command": radians(954.0), "spin.command": radians(200.0), "scene.planet_spin": "imposed"}
TURNING = {"carrier_speed": radians(954.0), "spin": radians(200.0), "spin_imposed": True}
# If the inertia of a planet is given, that across its axis (about the apex) has the proportion of its solid. This is the
# proportion of the solid at the clunk's backlash, as the FMU divides it into facets: transverse_at_apex / axial of `gear_mass`,
# or 100 N·m over `carrier.acceleration` in mid-gap, less the given carrier. It is the only number here from the program.
# Without facets it is 5.0016434460, by integrals over the outline as in benches/peers/gears.py.
PLANET_ACROSS = 5.0016833898
CLUNK = {"scene.carrier_drive": "torque", "carrier.torque_command": -2e-3, "carrier.speed_command": 0.0,
         "left.load_torque": -1e-3, "right.load_torque": -1e-3, "geometry.backlash": 0.1885e-3,
         "inertia.carrier": 0.05, "inertia.side_gear": 1e-5, "inertia.planet": 1e-6, "inertia.left_end": 0.5,
         "inertia.right_end": 0.5, "effects.half_shaft": True, "half_shaft.left_stiffness": 1e4,
         "half_shaft.right_stiffness": 1e4, "half_shaft.left_damping": 0.0, "half_shaft.right_damping": 0.0,
         "contact.damping": 0.0}
CLUNKING = {"carrier_speed": 0.0, "backlash": 0.1885e-3, "carrier_inertia": 0.05 + 2.0 * PLANET_ACROSS * 1e-6,
            "side_inertia": 1e-5, "planet_inertia": 1e-6, "end_inertias": (0.5, 0.5), "shafts": (1e4, 1e4),
            "damping": 0.0}


@dataclass
class Case:
    """One scene, for the FMU and for the plain model."""

    what: str
    fmu: dict
    plain: dict
    start: str
    times: np.ndarray
    loads_at_start: dict = field(default_factory=dict)  # for the equilibrium of the plain model
    then: dict = field(default_factory=dict)  # inputs of the FMU after the start
    outputs: list = field(default_factory=lambda: OUTPUTS)

    def begin(self):
        """Plain model and its state at the start."""
        first = Differential(Scene(**(self.plain | self.loads_at_start)))
        return Differential(Scene(**self.plain)), getattr(first, self.start)()


def ticks(*parts):
    """Times [s] from 0: up to each end, by the step of this part."""
    times, begin = [0.0], 0.0
    for end, step in parts:
        times += [begin + step * (k + 1) for k in range(round((end - begin) / step))]
        begin = end
    return np.round(times, 12)


BLOW = ticks((2e-3, 1e-5), (0.5, 1e-3))
CASES = {
    "straight_equilibrium": Case("the study, straight ahead", GIVEN, {}, "equilibrium", ticks((0.5, 1e-2))),
    "straight_rolling": Case("the study, straight ahead from mid-gap", GIVEN, {}, "rolling", BLOW),
    "turn_equilibrium": Case("the study's turn", GIVEN | TURN, TURNING, "equilibrium", ticks((0.5, 5e-4))),
    "turn_rolling": Case("the study's turn from mid-gap", GIVEN | TURN, TURNING, "rolling", BLOW),
    "clunk": Case(
        "100 N.m across the lash, undamped", GIVEN | CLUNK, CLUNKING | {"carrier_torque": 100.0, "loads": (0.0, 0.0)},
        "equilibrium", ticks((0.02, 4e-5)),
        {"carrier_torque": -2e-3, "loads": (-1e-3, -1e-3)},
        {"carrier.torque_command": 100.0, "left.load_torque": 0.0, "right.load_torque": 0.0},
        ["carrier.speed", "left.shaft_torque", "right.shaft_torque", *OUTPUTS]),
}


def jacobian(model, state):
    """Jacobian by differences with fixed steps; the adaptive steps of scipy fail if nothing moves."""
    steps, still = np.full(model.size, 1e-6), np.array(model.rate(0.0, state))
    steps[model.angles] = 1e-10
    return np.array([(model.rate(0.0, state + step) - still) / step.sum() for step in np.diag(steps)]).T


def solve(case, times, method="DOP853", tolerance=1e-12):
    """Outputs of the plain model at `times`, by scipy. Its steps end at each time, because interpolated values are less accurate."""
    model, state = case.begin()
    absolute = np.full(model.size, tolerance)  # speeds [rad/s]
    absolute[model.angles] *= 1e-3  # angles of the order of tooth deflections [rad]
    options = {"rtol": tolerance, "atol": absolute, "first_step": 1e-9}
    if method == "Radau":
        solver = Radau(model.rate, times[0], state, times[-1], jac=lambda _, y: jacobian(model, y), **options)
    else:
        solver = DOP853(model.rate, times[0], state, times[-1], **options)
    rows = [model.outputs(state)]
    for end in times[1:]:
        solver.t_bound, solver.status = end, "running"
        while solver.status == "running":
            message = solver.step()
        if solver.status == "failed":
            raise ArithmeticError(f"{method} stopped at {solver.t} s: {message}")
        rows.append(model.outputs(solver.y))
    return rows


def table(case, rows):
    return np.array([[row[name] for name in case.outputs] for row in rows])


def scales(case, values):
    """Reference values of relative errors, from the second half, after the impacts of the start: the fastest speed, the largest
    torque, and the means of forces and transmission errors."""
    size = np.abs(values[len(values) // 2:])
    speeds = [name.endswith("speed") for name in case.outputs]
    return np.array([np.max(size[:, speeds]) if name.endswith("speed") else
                     np.max(column) if name.endswith("torque") else np.mean(column)
                     for name, column in zip(case.outputs, size.T)])


def write(name):
    case = CASES[name]
    rows = solve(case, case.times)
    for row in rows:
        for column in MESH:
            other = row[column.replace("[1]", "[2]")]
            assert abs(other - row[column]) <= 1e-12 * abs(other), "planets do not move as one"
    values = table(case, rows)
    second = table(case, solve(case, case.times, "Radau", 1e-11))
    error = np.max(np.abs(second - values), axis=0) / np.maximum(scales(case, values), 1e-300)
    header = [
        f"{case.what}; scene.start = {case.start}",
        f"generated by: python tests/python/make_reference.py {name}",
        "plain.py, integrated by scipy's DOP853, rtol 1e-12, atol 1e-12 rad/s and 1e-15 rad",
        "largest difference to Radau (rtol 1e-11); speeds relative to the fastest, torques to the largest, "
        "else to the mean:",
        "  " + ", ".join(f"{column} {e:.1e}" for column, e in zip(case.outputs, error)),
        "units: s, " + ", ".join(f"{unit} ({kind})" for kind, unit in UNITS.items()),
    ]
    lines = [f"# {line}" for line in header] + [",".join(["time", *case.outputs])]
    lines += [",".join([f"{time:.12g}", *(f"{x:.17g}" for x in row)]) for time, row in zip(case.times, values)]
    (DATA / f"reference_{name}.csv").write_text("\n".join(lines) + "\n")
    print(*header, sep="\n", flush=True)


def read(name):
    """Times of a file, and values by the names of its columns."""
    lines = (DATA / f"reference_{name}.csv").read_text().splitlines()
    lines = [line.split(",") for line in lines if not line.startswith("#")]
    values = np.array(lines[1:], dtype=float)
    return values[:, 0], dict(zip(lines[0][1:], values[:, 1:].T))


if __name__ == "__main__":
    for wanted in sys.argv[1:] or CASES:
        write(wanted)
