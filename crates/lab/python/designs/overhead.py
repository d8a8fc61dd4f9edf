"""Overhead of the Python package over the FMU's C calls, and cost of designs on workers.

    python crates/lab/python/designs/overhead.py [--runs N] [--designs N]

Needs the package with its extra [sweep], the FMU (BEVEL_DIFFERENTIAL_FMU) and a C compiler. Runs with and without the package
alternate. The fastest of each are compared, because other load of the machine slows them least. Rows with workers are wall times
and need an idle machine."""

import argparse
import sys
import tempfile
import time
from pathlib import Path

from bevel_differential import Differential, Fmu, Scene
from bevel_differential.designs import Farm, Space, Task
from bevel_differential.designs.cluster import usual_workers
from bevel_differential.designs.plan import Plan
from bevel_differential.text import aligned

sys.path.append(str(Path(__file__).resolve().parents[1]))
from calls import TEN, Calls  # noqa: E402

TURN = {"scene.planet_spin": "imposed", "spin.command": "200 deg/s", "carrier.speed_command": "954 deg/s",
        "scene.start": "rolling"}
STOP = 0.5
# limits: time with the package over time of the calls in C; for the Monte Carlo wall time [s]
LIMIT_FINAL, LIMIT_RECORD, LIMIT_RANDOM, LIMIT_MONTE_CARLO = 1.3, 3.0, 1.3, 10.0
LOADS = {"left.load_torque": "normal(835 N.m, 40 N.m)", "right.load_torque": "normal(835 N.m, 40 N.m)",
         "geometry.backlash": "uniform(0.05 mm, 0.15 mm)", "tooth_friction.coefficient": "uniform(0.03, 0.08)"}
FRICTION = {"friction off": {}, "friction on": {"effects.tooth_friction": True},
            "friction on, tolerance 1e-4": {"effects.tooth_friction": True, "solver.relative_tolerance": 1e-4}}
RANDOM = {"random tooth errors": ({"effects.tooth_errors": True, "tooth_errors.accuracy_grade": 7},
                                 {"tooth_errors.seed": "seed", "tooth_errors.crowning": "uniform(2 um, 10 um)"}),
          "random geometry": ({}, {"geometry.face_width": "normal(20 mm, 0.05 mm)", "geometry.module": "normal(4.5 mm, 0.01 mm)"})}


def timed(action, *arguments):
    begun = time.perf_counter()
    action(*arguments)
    return time.perf_counter() - begun


def overhead(calls, fmu, runs):
    """Rows of one turn: time through the package and time of the calls in C."""
    with Differential(TURN, fmu=fmu.file) as turn:
        for what, step, use, limit in [
                ("0.5 s turn, final values", None, lambda: turn.final(TEN, stop=STOP), LIMIT_FINAL),
                ("0.5 s turn, ten outputs every 1 ms", 1e-3, lambda: turn.run(outputs=TEN, stop=STOP, step=1e-3), LIMIT_RECORD)]:
            use()
            package, bare = [], []
            for _ in range(max(1, runs // 20)):
                # the first run computes the tables of the gears
                bare += [whole for whole, _ in calls.seconds(fmu, TURN, TEN, [(STOP, step)], 21)[1:]]
                package += [timed(use) for _ in range(20)]
            yield row(what, min(package) * 1e3, min(bare) * 1e3, "ms", limit)


def row(what, package, bare, unit, limit):
    """A row of the table. If `bare` is None, the limit holds for the package's time itself."""
    ratio = package / bare if bare else None
    met = (ratio if bare else package) <= limit
    return (what, f"{package:.3f} {unit}", f"{bare:.3f} {unit}" if bare else "-", f"{ratio:.2f}" if bare else "-",
            f"{limit:g}" if bare else f"{limit:g} {unit}", "yes" if met else "no")


def monte_carlo(fmu, designs, workers):
    """Rows of turns with random loads, backlash and friction, simulated by `workers` processes."""
    with Farm(workers) as farm:
        for what, values in FRICTION.items():
            with Scene("turn", stop=STOP, set={**TURN, **values}, fmu=fmu.file) as scene:
                task = Task(scene, ["left.speed", "right.speed", "efficiency"])
                plan = Plan.parse(Space.parse(fmu, LOADS), "random", designs, 1).designs()
                farm.evaluate(task, plan[:200])
                taken = timed(farm.evaluate, task, plan) * 10_000 / designs
            yield row(f"10 000 turns, {workers} workers, {what}", taken, None, "s", LIMIT_MONTE_CARLO)


def random_designs(fmu, designs, workers):
    """Rows of designs with random tooth errors or geometry: wall time on workers, and time of the bare calls over the workers."""
    for what, (values, vary) in RANDOM.items():
        with Scene("turn", stop=STOP, set={**TURN, **values}, fmu=fmu.file) as scene, Farm(workers) as farm:
            task = Task(scene, ["left.speed", "right.speed", "efficiency"])
            plan = Plan.parse(Space.parse(fmu, vary), "random", designs, 1).designs()
            farm.evaluate(task, plan[:50])
            taken = timed(farm.evaluate, task, plan)
        calls = seconds_of_calls(fmu, {**TURN, **values}, plan) / workers
        yield row(f"{designs} designs, {what}", taken, calls, "s", LIMIT_RANDOM)


def seconds_of_calls(fmu, values, plan):
    """Seconds of the bare calls for all designs in sequence, through `Instance` with arrays made before."""
    from bevel_differential.batches import Batches
    from bevel_differential.instance import Instance
    instance, batches = Instance(fmu), Batches([fmu.variable(name) for name in ("left.speed", "right.speed", "efficiency")])
    record, taken = batches.record(2), 0.0
    readers = batches.readers(instance, record)
    fixed = {name: fmu.variable(name).number(value) for name, value in values.items()}
    for _, design in plan:
        pairs = [(fmu.variable(name), value) for name, value in {**fixed, **design}.items()]
        begun = time.perf_counter()
        instance.start(pairs, STOP)
        instance.do_step(0.0, STOP)
        for get, component, references, count, address, _ in readers:
            get(component, references, count, address)
        taken += time.perf_counter() - begun
    instance.close()
    return taken


def scaling(fmu, designs):
    """Rows: designs per second by number of workers, as processes and as threads."""
    with Scene("turn", stop=STOP, set=TURN, fmu=fmu.file) as scene:
        task, first = Task(scene, ["left.speed:mean"]), None
        plan = Plan.parse(Space.parse(fmu, LOADS), "random", designs, 1).designs()
        for processes in (True, False):
            for workers in sorted({1, 2, usual_workers()}):
                with Farm(workers, processes) as farm:
                    farm.evaluate(task, plan[:50])
                    rate = designs / timed(farm.evaluate, task, plan)
                first = first or rate
                yield f"{workers} {'processes' if processes else 'threads'}", f"{rate:.0f}", f"{rate / first:.2f}"


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--runs", type=int, default=200, help="runs of a turn")
    parser.add_argument("--designs", type=int, default=10_000, help="designs of the Monte Carlo; a tenth for the others")
    given = parser.parse_args()
    fmu, workers = Fmu.of(), min(2, usual_workers())
    with tempfile.TemporaryDirectory() as folder:
        calls = Calls(folder)
        rows = [("case", "package", "C calls", "ratio", "limit", "met"), *overhead(calls, fmu, given.runs),
                *monte_carlo(fmu, given.designs, workers), *random_designs(fmu, max(50, given.designs // 10), workers)]
        print("\n".join(aligned(rows, left=1)), "\n")
        by_workers = [("workers", "designs/s", "times one process"), *scaling(fmu, max(50, given.designs // 10))]
        print("\n".join(aligned(by_workers, left=1)))


if __name__ == "__main__":
    main()
