"""Writes the evidence of the FMU: start values, inputs, results and tolerances of the shipped scenes, and of other scenes for laws,
levels and effects that no shipped scene uses.

usage: evidence.py FMU SCENES FOLDER

SCENES is the folder of the other scenes and of the document's template. FOLDER becomes the content of extra/org.fmi-standard.fmi-ls-ref.
Results come from runs at a tight solver tolerance. The tolerance of each output comes from the difference to a run at the unit's own
solver tolerance."""

import csv
import io
import math
import shutil
import sys
from pathlib import Path
from string import Template

import numpy as np
from bevel_differential.answers import about, ask
from bevel_differential.fmu import Fmu
from bevel_differential.scene_file import find, read_scene, shipped_scenes
from bevel_differential.text import aligned
from bevel_differential.verify import COLUMNS, MANIFEST, TOLERANCES, record, start_values, table
from lxml import etree

SOLVER = "solver.relative_tolerance"
TIGHT = 1e-9
# factor from the difference between both runs to a tolerance: other platforms, and hosts with other communication points, have other
# differences of the same size
MARGIN = 5.0
# factor of the solver tolerance by which motion and forces may additionally deviate at any point
POINTWISE = 10.0
# fractions of the largest magnitude: rounding to the digits of the files, and a difference that indicates another motion
ROUNDING, LOST = 1e-9, 1e-3
# outputs that should be 0 are compared with a heat, which is also an energy
MEASURES = {"solver.energy_residual": "heat.contact"}
# compared seconds of a long scene
LONGEST = 60.0
# maximum number of intervals between rows of a result; one more row contains the first communication step
ROWS = 200
# name of the document, which FMI-LS-REF recommends for the folder of documentation, and its template
DOCUMENT, TEMPLATE = "fmi-ls-ref.txt", "fmi-ls-ref.md"
# version of the standard, and terms that it defines
VERSION = "1.0.0-beta.1"
NAME = "org.fmi-standard.fmi-ls-ref"
DESCRIPTION = "Layered Standard providing information on related files included in an FMU."
NAMESPACE = "http://fmi-standard.org/fmi-ls-manifest"


def main(fmu, others, folder):
    """Writes the folder."""
    fmu, others, folder = Fmu.of(fmu), Path(others), Path(folder)
    shutil.rmtree(folder, ignore_errors=True)
    for part in ("parameters", "inputs", "results"):
        (folder / part).mkdir(parents=True)
    files = sorted([*map(find, shipped_scenes()), *others.glob("*.toml")], key=lambda file: file.stem)
    runs = []
    for number, file in enumerate(files):
        print(f"progress {number / len(files):.4f} {file.stem}", file=sys.stderr, flush=True)
        runs.append(Run(file, fmu, folder))
    shipped = [run for run in runs if run.name in shipped_scenes()]
    tolerances, said = [COLUMNS], [("scene", "rows", "compared until, s", "largest tolerance by magnitude")]
    for run in runs:
        # heavy loads in the other scenes must not widen the tolerances of shipped ones
        scales = largest(shipped if run in shipped else runs)
        rows, allowed = run.result(scales)
        write_table(folder / run.file("results"), rows)
        tolerances += [(run.name, name, fmu.variable(name).unit or "1", f"{value:.1e}") for name, value in allowed.items()]
        said.append((run.name, str(len(rows) - 1), rows[-1][0], f"{max(value / scales[name] for name, value in allowed.items()):.1e}"))
    write_table(folder / TOLERANCES, tolerances)
    (folder / MANIFEST).write_bytes(manifest(runs))
    template = Template((others / TEMPLATE).read_text(encoding="utf-8"))
    (folder / DOCUMENT).write_text(template.substitute(
        version=VERSION, tight=f"{TIGHT:g}", usual=fmu.variable(SOLVER).start, margin=f"{MARGIN:g}", rounding=f"{ROUNDING:g}", lost=f"{LOST:g}",
        scenes="\n".join(f"- `{run.name}`: {run.description}" for run in runs)), encoding="utf-8")
    print("\n".join(aligned(said, 1)))


class Run:
    """A scene with files of its start values and inputs, and records at both solver tolerances."""

    def __init__(self, file, fmu, folder):
        scene, self.name = read_scene(file), file.stem
        self.description, self.step = scene["description"], scene["step"]
        scene["stop"] = min(scene["stop"], LONGEST)
        (folder / self.file("parameters", "ssv")).write_text(ask({"ask": "export", "of": about(file), "format": "ssv"})["text"], encoding="utf-8")
        start = start_values(fmu, folder / self.file("parameters", "ssv"), file)
        points, inputs = signals(scene, fmu, start), None
        self.has_inputs = bool(points)
        if points:
            write_table(folder / self.file("inputs"), points)
            inputs = table(fmu, folder / self.file("inputs"), file)
        self.tolerance = usual = start.get(SOLVER, fmu.variable(SOLVER).start)
        self.usual, self.tight = (record(fmu, start | {SOLVER: tolerance}, inputs, scene["stop"], self.step, scene["outputs"], [])
                                  for tolerance in (usual, TIGHT))

    @property
    def outputs(self):
        """Names of all outputs."""
        return self.tight.dtype.names[1:]

    def file(self, folder, ending="csv"):
        """Path of a file of the scene."""
        return f"{folder}/{self.name}.{ending}"

    def result(self, scales):
        """Rows of the result, starting with the names, and the tolerance of each output. `scales`: magnitudes by output.

        Adds a remark to the description if the result ends early."""
        differences = {name: np.abs(self.usual[name] - self.tight[name]) for name in self.outputs}
        lost = np.flatnonzero(np.any([differences[name] > LOST * scales[name] for name in self.outputs], axis=0))
        end = min([len(self.tight), *lost[:1].tolist()])
        if len(lost):
            self.description += f" (the result ends at {self.tight['time'][end - 1]:.6g} s: later the motion depends on the tolerance of the solver)"
        kept = sorted({1, *range(0, end, max(1, math.ceil((end - 1) / ROWS))), end - 1})
        rows = [("time", *self.outputs), *([f"{cell:.10g}" for cell in self.tight[row]] for row in kept)]
        return rows, {
            name: rounded_up(MARGIN * differences[name][:end].max() + (ROUNDING + POINTWISE * self.tolerance) * scales[name])
            for name in self.outputs}


def signals(scene, fmu, values):
    """Inputs of a scene over time as rows of a table, starting with the names; two rows of one time are a jump."""
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
    """Points of a table; a periodic table is repeated up to the stop time."""
    if period is None:
        return times, values
    rounds = math.ceil(stop / period)
    all_times, all_values = [], []
    for count in range(rounds):
        for time, value in zip(times, values):
            # the end of a period is the start of the next one
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
    """Largest magnitude of each variable in any run: a value that is small in all runs must not get a wide tolerance."""
    found = {}
    for run in runs:
        for name in run.outputs:
            found[name] = max(found.get(name, 0.0), float(np.abs(run.tight[name]).max()))
    return found | {name: found[measure] for name, measure in MEASURES.items() if name in found}


def rounded_up(value):
    """The value rounded up to two digits."""
    size = 10.0 ** (math.floor(math.log10(value)) - 1)
    return math.ceil(value / size) * size


def manifest(runs):
    """Manifest of FMI-LS-REF as XML."""
    root = etree.Element("fmiReferences", nsmap={"fmi-ls": NAMESPACE})
    for key, value in (("name", NAME), ("version", VERSION), ("description", DESCRIPTION)):
        root.set(f"{{{NAMESPACE}}}fmi-ls-{key}", value)
    listed = [("text/markdown", f"../../documentation/{DOCUMENT}", "document", "How to test with these files"),
              ("text/csv", TOLERANCES, "testcase", "Tolerance of each output in each scene")]
    for run in runs:
        listed.append(("application/x-ssp-parameter-set", run.file("parameters", "ssv"), "parameter", run.description))
        if run.has_inputs:
            listed.append(("text/csv", run.file("inputs"), "testcase", f"Inputs of {run.name} over time"))
        listed.append(("text/csv", run.file("results"), "result", f"Results of {run.name}, communication step {run.step:g} s"))
    for values in listed:
        etree.SubElement(root, "Related", dict(zip(("type", "source", "role", "description"), values)))
    return etree.tostring(root, xml_declaration=True, encoding="UTF-8", pretty_print=True)


def write_table(file, rows):
    """Writes a table as CSV."""
    text = io.StringIO()
    csv.writer(text, lineterminator="\n").writerows(rows)
    file.write_text(text.getvalue(), encoding="utf-8")


if __name__ == "__main__":
    main(*sys.argv[1:])
