"""Measurements on the coupled drivetrain."""

import csv
import sys
import time
from types import SimpleNamespace

import numpy as np
from bevel_differential import DifferentialError
from scipy.integrate import solve_ivp

import masters
import stability
from hosts import HOSTS
from parameters import END, STEP
from reference import Teeth, reference
from slaves import System
from system import archive_file

# distance of the points at which errors are evaluated [s]: a multiple of all communication steps
GRID = 0.01
STEPS = (1e-2, 5e-3, 2e-3, 1e-3, 5e-4, 2e-4, 1e-4, 5e-5, 2e-5, 1e-5)
# shortest communication step of masters that repeat their steps [s]
SHORTEST_REPEATED = 1e-4
QUICK_STEPS, QUICK_END = (5e-4, 2.5e-4, 1.25e-4), 0.2
# fractions of a predicted limit at which a disturbance must decay and grow
INSIDE, OUTSIDE = 0.85, 1.15
# a short push of the engine, too weak for any tyre to slide
PUSH = {("engine", "high"): 1.0, ("engine", "low"): 0.0, ("engine", "rise"): 0.02, ("engine", "fall"): 0.02,
        ("engine", "release"): 0.02}
QUANTITIES = {
    "wheel speeds": lambda y: [y["left_wheel", "speed"], y["right_wheel", "speed"]],
    "shaft torques": lambda y: [y["differential", "left.shaft_torque"], y["differential", "right.shaft_torque"]],
    "vehicle speed": lambda y: [y["vehicle", "speed"]],
    "carrier torque": lambda y: [y["final_drive", "carrier_torque"]],
}


def progress(fraction, what):
    print(f"progress {fraction:.4f} {what}", file=sys.stderr, flush=True)


def difference(signals, rows, reference_rows):
    """Largest difference of each quantity over all times, relative to the largest value of the quantity."""
    own, right = (dict(zip(signals, values.T)) for values in (rows, reference_rows))
    return {name: np.max(np.abs(np.subtract(of(own), of(right)))) / np.max(np.abs(of(right)))
            for name, of in QUANTITIES.items()}


def hosts(folder, fmus, quick):
    """Largest difference of each host, and of this example's master, from the first host."""
    end = QUICK_END if quick else END
    times = [GRID * k for k in range(1, round(end / GRID) + 1)]
    found = {}
    for contact in ("ideal", "tooth"):
        with System.of_fmus(fmus, contact) as system:
            signals = system.signals
            own = masters.run(system, masters.Jacobi(), STEP, round(end / STEP), round(GRID / STEP))[1:]
        rows = {}
        for name, (run, version) in HOSTS.items():
            progress(0.02, f"{contact}: {name}")
            rows[name] = run(archive_file(folder, f"drivetrain_{contact}", version), signals, STEP, times)
        rows["this example's Jacobi"] = own
        first = rows["FMPy"]
        found[contact] = {name: max(difference(signals, values, first).values()) for name, values in rows.items()}
    return found


def references(library_path, fmus, contact):
    """Reference on the grid and, for the picture, on a finer one, with `doubt`: its difference from another method of scipy."""
    progress(0.1, f"{contact}: the whole as one set of equations")
    with System.of_fmus(fmus, contact) as system:
        signals = system.signals
    count = round(END / GRID)
    fine = np.linspace(0.0, END, 10 * count + 1)
    methods = (("DOP853", 1e-11), ("Radau", 1e-9)) if contact == "ideal" else (("LSODA", 1e-10), ("Radau", 1e-7))
    rows, other = (reference(library_path, contact, fine, signals, *method)[0] for method in methods)
    doubt = max(difference(signals, other, rows).values())
    return SimpleNamespace(signals=signals, rows=rows[::10], dense=(fine, dict(zip(signals, rows.T))), doubt=doubt,
                           methods=[method for method, _ in methods])


def errors(fmus, all_references, quick):
    """A row for each contact, master and communication step."""
    steps, end = (QUICK_STEPS, QUICK_END) if quick else (STEPS, END)
    runs = [(contact, name, step) for contact in all_references for step in steps for name in masters.ALL
            if step >= SHORTEST_REPEATED or not masters.ALL[name].states]
    # runs with short steps take longest
    weight = np.cumsum([1.0 / step for _, _, step in runs])
    rows = []
    for k, (contact, name, step) in enumerate(runs):
        progress(0.3 + 0.7 * (weight[k - 1] if k else 0.0) / weight[-1], f"{contact}, {name}, {step:g} s")
        master, began = masters.ALL[name](), time.process_time()
        row = {"contact": contact, "master": name, "step": step, "state": "ok"}
        with System.of_fmus(fmus, contact) as system:
            try:
                found = masters.run(system, master, step, round(end / step), round(GRID / step))
                if len(found) < round(end / GRID) + 1:
                    row["state"] = "unstable"
            except masters.NoConvergence:
                row["state"] = "no convergence"
            except DifferentialError:
                # an input outside its range is rejected
                row["state"] = "no convergence" if master.states else "unstable"
        if row["state"] == "ok":
            right = all_references[contact]
            row |= difference(right.signals, found, right.rows[:len(found)])
            row |= {"largest": max(row[q] for q in QUANTITIES), "seconds": time.process_time() - began,
                    "repeats": np.mean(getattr(master, "iterations", [1]))}
            if row["largest"] > 1.0:
                row["state"] = "unstable"
        rows.append(row)
    return rows


def write_csv(file, rows):
    with file.open("w", newline="") as target:
        writer = csv.DictWriter(target, list(max(rows, key=len)))
        writer.writeheader()
        writer.writerows(rows)


def limits(fmus, quick):
    """Predicted limits of the communication step by master, with the growth of a disturbance in the FMUs on both sides."""
    with System.of_fmus(fmus, "ideal") as system:
        interpolates = system.part("differential").interpolates
    differential = str(fmus["BevelDifferential"])
    sliding = stability.linear_system(differential, interpolates, 0.0)
    linear = stability.linear_system(differential, interpolates)
    found = {"interpolates": interpolates, "frequency": stability.frequency(linear)}
    for name, master in masters.ALL.items():
        progress(0.2, f"limit of {master.label}")
        row = {"predicted": stability.limit(linear, master()), "order": stability.order(sliding, master)}
        if not master.states:
            row["inside"] = swell(fmus, master(), INSIDE * row["predicted"])
            row["outside"] = swell(fmus, master(), OUTSIDE * row["predicted"])
            row["measured"] = None if quick else bisected(fmus, master, row["predicted"])
        found[name] = row
    return found


def swell(fmus, master, step):
    """Factor by which the disturbance after a push of the engine grows in 0.2 s."""
    with System.of_fmus(fmus, "ideal", PUSH) as system:
        try:
            rows = masters.run(system, master, step, round(0.4 / step))
        except DifferentialError:
            return np.inf
        torque = rows[:, system.signals.index(("final_drive", "carrier_torque"))]
    if len(torque) < round(0.4 / step):
        return np.inf
    jumps, at = np.abs(np.diff(torque, 2)), lambda time: round(time / step)
    return np.max(jumps[at(0.3):at(0.4) - 2]) / np.max(jumps[at(0.1):at(0.2)])


def bisected(fmus, master, predicted):
    low, high = 0.5 * predicted, 2.0 * predicted
    while high / low > 1.02:
        middle = np.sqrt(low * high)
        low, high = (middle, high) if swell(fmus, master(), middle) < 1.0 else (low, middle)
    return np.sqrt(low * high)


def coupled(fmus, contact):
    """The launch at the communication step of the SSP, as plain hosts run it."""
    with System.of_fmus(fmus, contact) as system:
        every = round(1e-3 / STEP)
        rows = masters.run(system, masters.Jacobi(), STEP, round(END / STEP), every)
        return np.arange(len(rows)) * every * STEP, dict(zip(system.signals, rows.T))


def mesh(library):
    """Fastest motion of loaded teeth [1/s], which limits the exchange if the mesh were cut open."""
    teeth = Teeth(library, "tooth")
    x, load = teeth.start.copy(), 300.0
    teeth.lib.foreign_drive(teeth.handle, load, 0.0, 0.0)
    # against wheels at rest, until the teeth are loaded
    settled = solve_ivp(teeth.rhs, (0.0, 0.3), x, method="LSODA", rtol=1e-8, atol=1e-10)
    jacobian = teeth.python_jacobian()(0.0, settled.y[:, -1])
    poles = np.linalg.eigvals(jacobian)
    teeth.close()
    # accelerations from positions only: without damping
    springs = jacobian[teeth.n:, :teeth.n]
    return {"fastest": np.max(np.abs(poles)), "swing": np.sqrt(np.max(np.abs(np.linalg.eigvals(springs)))), "load": load}
