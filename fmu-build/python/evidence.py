"""Makes the evidence that the FMU carries: parameter sets, inputs, results and tolerances of the shipped scenes, and of others in which
what no shipped scene needs acts.

usage: evidence.py FMU SCENES FOLDER

SCENES is the folder of the other scenes, FOLDER the content of extra/org.fmi-standard.fmi-ls-ref. Results come from runs at a tight
solver tolerance. The tolerance of each variable comes from runs at the unit's own one, which a test keeps."""

import math
import shutil
import sys
from pathlib import Path

import numpy as np
from bevel_differential.answers import about, ask
from bevel_differential.fmu import Fmu
from bevel_differential.scene_file import find, read_scene, shipped_scenes
from bevel_differential.text import aligned
from bevel_differential.verify.experiment import Experiment, Unit
from bevel_differential.verify.parameter_sets import parameter_set
from bevel_differential.verify.tables import table
from evidence_files import manifest, requirements, write_table

SOLVER = "solver.relative_tolerance"
TIGHT = 1e-9
# a tolerance by the difference between both runs: other platforms, and hosts that place communication points otherwise, have other
# differences of the same size
MARGIN = 5.0
# parts of the largest magnitude: what the digits of the files cost, and a difference that shows another motion
ROUNDING, LOST = 1e-9, 1e-3
# what should be 0 is small or large by a heat, which is an energy as well
MEASURES = {"solver.energy_residual": "heat.contact"}
# seconds of a long scene that are compared
LONGEST = 60.0
# rows of a result, and the part of a scene that a smoke test runs
ROWS = {"validation": 200, "smoke test": 40}
SMOKE = 0.1


def main(fmu, others, folder):
    """Writes the folder anew."""
    folder = Path(folder)
    shutil.rmtree(folder, ignore_errors=True)
    for part in ("parameters", "inputs", "results"):
        (folder / part).mkdir(parents=True)
    known = Fmu.of(fmu)
    unit = Unit(Path(fmu), Path(known.folder), known.description)
    usual = float(unit.variables[SOLVER].start)
    files = sorted([*map(find, shipped_scenes()), *Path(others).glob("*.toml")], key=lambda file: file.stem)
    runs = []
    for number, file in enumerate(files):
        print(f"progress {number / len(files):.4f} {file.stem}", file=sys.stderr, flush=True)
        runs.append(Run(file, unit, known, folder, usual))
    shipped = [run for run in runs if run.name in shipped_scenes()]
    # heavy loads in the other scenes shall not widen the tolerances of shipped ones
    parts = [part for run in runs for part in run.parts(largest(shipped if run in shipped else runs))]
    for part in parts:
        write_table(folder / part["result"], part["rows"])
    rows = [(part["name"], name, unit.variables[name].unit or "1", f"{value:.1e}")
            for part in parts for name, value in part["tolerances"].items()]
    write_table(folder / "tolerances.csv", [("experiment", "variable", "unit", "tolerance"), *rows])
    for name, content in manifest(parts, SMOKE).items():
        (folder / name).write_bytes(content)
    (folder / "requirements.md").write_text(requirements(parts, usual, TIGHT, MARGIN, ROUNDING, LOST, SMOKE), encoding="utf-8")
    print(summary(parts))


class Run:
    """A scene: its parameter set and inputs as files, and its records at both solver tolerances."""

    def __init__(self, file, unit, fmu, folder, usual):
        scene, name = read_scene(file), file.stem
        scene["stop"] = min(scene["stop"], LONGEST)
        self.name, self.description, self.stop, self.step = name, scene["description"], scene["stop"], scene["step"]
        parameters = folder / "parameters" / f"{name}.ssv"
        parameters.write_text(ask({"ask": "export", "of": about(file), "format": "ssv"})["text"], encoding="utf-8")
        values = parameter_set(name, parameters, unit.variables)
        points = signals(scene, fmu, values)
        self.inputs = f"inputs/{name}.csv" if points else None
        run = Experiment(name, folder, start=0.0, stop=self.stop, step=self.step)
        run.expected = np.zeros(1, [("time", float), *((output, float) for output in scene["outputs"])])
        if points:
            write_table(folder / self.inputs, points)
            run.signals = table(name, folder / self.inputs, unit.variables, [])
        self.usual, self.tight = (self._record(run, unit, values, tolerance) for tolerance in (values.get(SOLVER, usual), TIGHT))

    @property
    def outputs(self):
        """Names of all outputs."""
        return self.tight.dtype.names[1:]

    def parts(self, scales):
        """The smoke test and the validation as files of experiments and tables name them."""
        differences = {name: np.abs(self.usual[name] - self.tight[name]) for name in self.outputs}
        lost = np.flatnonzero(np.any([differences[name] > LOST * scales[name] for name in self.outputs], axis=0))
        for kind, ending, stop in (("smoke test", "_smoke", SMOKE * self.stop), ("validation", "", self.stop)):
            end = min([int(np.searchsorted(self.tight["time"], stop * (1.0 + 1e-9))), *lost[:1].tolist()])
            kept = thinned(end, ROWS[kind])
            tolerances = {name: rounded_up(MARGIN * differences[name][:end].max() + ROUNDING * scales[name]) for name in self.outputs}
            until = self.tight["time"][end - 1] if len(lost) and end == lost[0] else None
            yield {"name": f"{self.name}{ending}", "kind": kind, "description": self.description, "scene": self.name, "inputs": self.inputs,
                   "result": f"results/{self.name}{ending}.csv", "stop": stop, "step": self.step, "until": until,
                   "tolerances": tolerances, "relative": max(tolerances[name] / scales[name] for name in self.outputs),
                   "rows": [("time", *self.outputs), *([f"{cell:.10g}" for cell in self.tight[place]] for place in kept)]}

    def _record(self, run, unit, values, tolerance):
        run.values = values | {SOLVER: tolerance}
        return run.run(unit)


def signals(scene, fmu, values):
    """The inputs of a scene over time as rows of a table, the names first; two rows of one time are a jump."""
    points = {}
    for name, times, given, period in scene["tables"]:
        points[name] = repeated([float(time) for time in times], [fmu.variable(name).number(value) for value in given], period, scene["stop"])
    for time, changes in scene["changes"]:
        for variable, value in fmu.numbers(changes):
            if variable.causality != "input":
                raise SystemExit(f"scene {scene['name']}: {variable.name} changes at {time:g} s; a table of inputs cannot hold a parameter")
            times, given = points.setdefault(variable.name, ([0.0], [float(values[variable.name])]))
            times += [float(time)] * 2
            given += [given[-1], value]
    jumps = {time for times, _ in points.values() for time, after in zip(times, times[1:]) if time == after}
    rows = []
    for time in sorted({0.0, scene["stop"], *(time for times, _ in points.values() for time in times if time < scene["stop"])}):
        for side in ("left", "right") if time in jumps else ("right",):
            rows.append((time, *(float(at(*point, time, side)) for point in points.values())))
    return [("time", *points), *rows] if points else []


def repeated(times, values, period, stop):
    """Points of a table, those of one that repeats up to the stop time."""
    if period is None:
        return times, values
    rounds = math.ceil(stop / period)
    all_times, all_values = [], []
    for count in range(rounds):
        for time, value in zip(times, values):
            # the end of a round is the beginning of the next one
            if not (all_times and math.isclose(count * period + time, all_times[-1]) and value == all_values[-1]):
                all_times.append(count * period + time)
                all_values.append(value)
    return all_times, all_values


def at(times, values, time, side):
    """Value just before a time (side "left") or just after it."""
    after = int(np.searchsorted(times, time, side))
    if after == 0 or after == len(times):
        return values[min(after, len(times) - 1)]
    share = (time - times[after - 1]) / (times[after] - times[after - 1])
    return values[after - 1] + share * (values[after] - values[after - 1])


def largest(runs):
    """The largest magnitude of each variable in any run: what is small in all of them is no reason for a wide tolerance."""
    found = {}
    for run in runs:
        for name in run.outputs:
            found[name] = max(found.get(name, 0.0), float(np.abs(run.tight[name]).max()))
    return found | {name: found[measure] for name, measure in MEASURES.items() if name in found}


def thinned(count, most):
    """Places of rows that are kept: every so many, and the last one."""
    every = max(1, math.ceil((count - 1) / most))
    return sorted({*range(0, count, every), count - 1})


def rounded_up(value):
    """The value with two digits, not below it."""
    size = 10.0 ** (math.floor(math.log10(value)) - 1)
    return math.ceil(value / size) * size


def summary(parts):
    """What was made."""
    rows = [("experiment", "kind", "rows", "compared until, s", "largest tolerance by magnitude")]
    for part in parts:
        rows.append((part["name"], part["kind"], str(len(part["rows"]) - 1), f"{float(part['rows'][-1][0]):.6g}", f"{part['relative']:.1e}"))
    return "\n".join(aligned(rows))


if __name__ == "__main__":
    main(*sys.argv[1:])
