"""Compares solvers by other authors with this program, on the same equations.

    python compare.py LIBRARY FOLDER [--quick] [--cases "a;b"] [--ours]

LIBRARY is foreign-solvers, built by cargo. Writes FOLDER/foreign.csv and prints the table.
"""

import argparse
import contextlib
import csv
import hashlib
import os
import statistics
import sys
from pathlib import Path

# all comparisons are on one core
os.environ.setdefault("OPENBLAS_NUM_THREADS", "1")

import numpy as np  # noqa: E402
from scipy.integrate import solve_ivp  # noqa: E402

import solvers as all_of  # noqa: E402
import table  # noqa: E402
from library import Library, Run  # noqa: E402

sys.path.append(str(Path(__file__).resolve().parents[2] / "crates" / "lab" / "python"))
from tools import say  # noqa: E402

STRAIGHT_SPEED, TURN_SPEED, SPIN = np.radians([2861.0, 954.0, 200.0])
TURN = {"scene.planet_spin": "imposed", "carrier.speed_command": TURN_SPEED, "spin.command": SPIN}
# scenes/clunk.toml; before the blow, the coast flanks touch, and this part is integrated with the tightest tolerance
CLUNK = {"scene.carrier_drive": "torque", "geometry.backlash": 0.1885e-3, "effects.half_shaft": "true",
         "half_shaft.left_stiffness": 1e4, "half_shaft.right_stiffness": 1e4, "half_shaft.left_damping": 0.0,
         "half_shaft.right_damping": 0.0, "inertia.from_geometry": "false", "inertia.carrier": 0.05, "inertia.side_gear": 1e-5,
         "inertia.planet": 1e-6, "inertia.left_end": 0.5, "inertia.right_end": 0.5, "contact.damping": 0.0,
         "carrier.speed_command": 0.0, "carrier.torque_command": -0.002, "left.load_torque": -0.001, "right.load_torque": -0.001,
         "solver.relative_tolerance": 1e-11}
# time of the blow [s], and its inputs
BLOW_TIME, BLOW = 1e-5, {"carrier.torque_command": 100.0, "left.load_torque": 0.0, "right.load_torque": 0.0}
# case, speed of gears in it [rad/s], end [s], interval of the samples [s]; a blow of 100 N·m through the lash accelerates gears to about 10
# rad/s
CASES = {
    "turn_equilibrium": (TURN, 2.0 * TURN_SPEED + SPIN, 0.5, 1e-2),
    "turn_rolling": (TURN | {"scene.start": "rolling"}, 2.0 * TURN_SPEED + SPIN, 0.5, 1e-2),
    "straight_rolling": ({"scene.start": "rolling"}, 2.0 * STRAIGHT_SPEED, 0.5, 1e-2),
    "clunk": (CLUNK, 10.0, 0.02, 1e-4),
    "clunk, every 10 us": (CLUNK, 10.0, 0.02, 1e-5),
    "turn, force along a line": (TURN | {"contact.law": "line"}, 2.0 * TURN_SPEED + SPIN, 0.5, 1e-2),
}
# natural magnitudes of positions: approach of loaded teeth, as an angle of a gear; angle of the carrier, which is the third; twist of
# half-shafts, which follow the gears [rad]
APPROACH, TURNED, TWIST, CARRIER, ENDS = 2e-3, 1.0, 1e-2, 2, 4
QUICK = ("turn_equilibrium", "clunk")
TOLERANCES = [10.0**-k for k in range(3, 14)]
QUICK_TOLERANCES = [1e-4, 1e-6, 1e-8]
REPEATS, SLOW_REPEATS = 11, 2
# a solver that takes longer is not run again [s]
PATIENCE = 2.0
REFERENCE_RTOL, REFERENCE_ATOL = 1e-13, 1e-13
NAMES = ("left.speed", "right.speed", "planet[1].left_normal_force", "planet[1].right_normal_force", "left.shaft_torque",
         "right.shaft_torque")


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("library", type=Path)
    parser.add_argument("folder", type=Path)
    parser.add_argument("--quick", action="store_true")
    parser.add_argument("--cases")
    parser.add_argument("--ours", action="store_true", help="only this program and compiled solvers")
    arguments = parser.parse_args()
    arguments.folder.mkdir(parents=True, exist_ok=True)
    library = Library(arguments.library)
    names = arguments.cases.split(";") if arguments.cases else QUICK if arguments.quick else tuple(CASES)
    solvers, missing = all_of.all_solvers(arguments.folder / "lsoda")
    if arguments.ours:
        solvers = [solver for solver in solvers if not solver.slow]
    rows, checks = [], {}
    for k, name in enumerate(names):
        def progress(fraction, what, k=k, name=name):
            say((k + fraction) / len(names), f"{name}: {what}")

        # the cost of Python's calls does not depend on the case
        wanted = [solver for solver in solvers if name in QUICK or not solver.slow]
        rows += compare(library, name, wanted, arguments, progress, checks)
        write(arguments.folder / "foreign.csv", rows)
    print(table.markdown(rows, names, checks, missing), end="")


def started(library, name, method="adaptive", tolerance=1e-6):
    """A run of a case, with method and tolerance of the program's own solver."""
    values, speed, *_ = CASES[name]
    solver = {"solver.method": method, "solver.relative_tolerance": tolerance}
    run = Run(library, values, BLOW | solver, BLOW_TIME) if values is CLUNK else Run(library, values | solver)
    magnitudes = np.full(run.size, speed)
    magnitudes[:run.size // 2] = APPROACH
    magnitudes[ENDS:run.size // 2] = TWIST
    magnitudes[CARRIER] = TURNED
    run.scale(magnitudes)
    return run


def samples(run, end, step):
    count = round(end / step)
    times = np.arange(1, count + 1) * step
    return times[times > run.t0 * (1.0 + 1e-9)]


def reference(run, times, file):
    """Outputs at `times` from scipy's DOP853 at the tightest tolerance, cached in `file` while the equations are unchanged."""
    equations = fingerprint(run)
    with contextlib.suppress(OSError, ValueError):
        with file.open(encoding="utf-8") as known:
            if known.readline().strip() == f"# equations {equations}":
                kept = np.loadtxt(known, delimiter=",", skiprows=1, ndmin=2)
                if kept.shape == (len(times), 7) and np.array_equal(kept[:, 0], times):
                    return kept[:, 1:]
    result = solve_ivp(run.python_rhs(), (run.t0, times[-1]), run.u0, method="DOP853", t_eval=times, rtol=REFERENCE_RTOL,
                       atol=REFERENCE_ATOL)
    outputs = run.outputs(result.y.T)
    head = f"equations {equations}\n" + ",".join(["time", *NAMES])
    np.savetxt(file, np.column_stack((times, outputs)), delimiter=",", fmt="%.17g", header=head)
    return outputs


def fingerprint(run):
    """Hash of the rates at several positions around the start, which identifies the equations."""
    rhs, hashed = run.python_rhs(), hashlib.sha256(run.u0.tobytes())
    for k in range(1, 9):
        # digits of the golden ratio: scattered, but reproducible
        place = run.u0 + 2.0 * (np.arange(1, run.size + 1) * k * 0.6180339887498949 % 1.0) - 1.0
        hashed.update(rhs(0.0, place).tobytes())
    return hashed.hexdigest()[:16]


def compare(library, name, solvers, arguments, progress, checks):
    quick = arguments.quick
    *_, end, step = CASES[name]
    run = started(library, name)
    times = samples(run, end, step)
    progress(0.0, "reference by DOP853")
    exact = reference(run, times, arguments.folder / f"reference_{name.replace(' ', '_').replace(',', '')}.csv")
    wanted = QUICK_TOLERANCES if quick else TOLERANCES
    runs = {}
    jobs = []
    for solver in solvers:
        for tolerance in wanted:
            key = (solver.own_method, tolerance) if solver.own_method else None
            if key and key not in runs:
                runs[key] = started(library, name, *key)
            jobs.append((solver, tolerance, runs.get(key, run)))
    outcomes, tired = {}, set()
    rounds = 1 if quick else REPEATS
    for k in range(rounds):
        for i, (solver, tolerance, on) in enumerate(jobs):
            if (solver.slow and k >= SLOW_REPEATS) or solver.label in tired:
                continue
            outcome = solver.integrate(on, times, tolerance)
            outcomes.setdefault((solver.label, tolerance), []).append(outcome)
            if outcome.cost > PATIENCE:
                tired.add(solver.label)
            # slow solvers run only in the first rounds
            share = (min(k, SLOW_REPEATS) + i / len(jobs)) / min(rounds, SLOW_REPEATS + 1)
            progress(min(share, 1.0), f"{solver.label}, {tolerance:.0e}")
    rows = [row(name, solver, tolerance, outcomes[solver.label, tolerance], exact)
            for solver, tolerance, _ in jobs if (solver.label, tolerance) in outcomes]
    # smallest deviation of other solvers from the reference, without this program
    others = [r for r in rows if not r["solver"].startswith(all_of.OURS) and r["status"] == 0]
    checks[name] = min((max(r["speed_error"], r["force_error"]) for r in others), default=float("nan"))
    for on in [run, *runs.values()]:
        on.close()
    return rows


def row(name, solver, tolerance, outcomes, exact):
    costs = [outcome.cost for outcome in outcomes]
    first = outcomes[0]
    speed, force = errors(first.outputs, exact)
    good = first.status == 0 and np.isfinite(speed) and np.isfinite(force)
    return {"case": name, "solver": solver.label, "tolerance": tolerance, "cpu_s": statistics.median(costs),
            "cpu_s_low": min(costs), "cpu_s_high": max(costs), "speed_error": speed, "force_error": force,
            "rhs_calls": first.calls, "jacobians": first.jacobians, "status": 0 if good else first.status or 1,
            "message": first.message, "name": solver.name}


def errors(outputs, exact):
    """Maximum errors over the samples, of the side gears' speeds and of the normal forces, relative to the largest value of the run."""
    def one(columns):
        return np.max(np.abs(outputs[:, columns] - exact[:, columns])) / np.max(np.abs(exact[:, columns]))

    return one(slice(0, 2)), one(slice(2, 4))


def write(path, rows):
    with path.open("w", newline="", encoding="utf-8") as file:
        writer = csv.DictWriter(file, [key for key in rows[0] if key != "name"], extrasaction="ignore")
        writer.writeheader()
        writer.writerows(rows)


if __name__ == "__main__":
    main()
