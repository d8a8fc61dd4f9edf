"""Files of the evidence that follow from the experiments: tables, the manifest and the files of experiments by FMI-LS-REF, and what
tests require."""

import csv
import io

from bevel_differential.verify.evidence import DESCRIPTION, MANIFEST, NAME, NAMESPACE, ROOT, TOLERANCES, VERSION
from bevel_differential.verify.experiments import TYPES
from bevel_differential.verify.files import PARAMETERS, TABLES
from lxml import etree

# kinds of experiments: their file, the second part of its role, their title, and what they run of a scene
SETS = {"smoke test": ("smoke-tests.exp", "smoke-test", "Smoke tests", "The first {smoke:.0%} of each scene"),
        "validation": ("validation.exp", "validation", "Validation", "Each scene as a whole")}
REQUIREMENTS = """# What a test with this evidence requires

Files, roles and the form of experiments are those of FMI-LS-REF {version}; `tolerances.csv` is the project's own. Each scene is a
parameter set, a table of inputs where inputs change, and two experiments with their results.

- **Smoke test** (`smoke-tests.exp`): the first {smoke:.0%} of a scene. It shows that the unit runs and starts as it should.
- **Validation** (`validation.exp`): the whole scene.

## How a test is made

A test sets all values of the parameter set, then initialises, and takes communication steps of `stepSize` from `startTime` to
`stopTime`. Values of the inputs at a communication point hold through the step that begins there. Between two rows of a table they lie
on a straight line. Two rows of one time are a jump; the step that begins there has the second value.

Outputs are read after each step. A test passes if each value of the result differs from the output at the same time by at most the
tolerance of its variable in `tolerances.csv`. Tolerances are absolute, in the unit of the variable.

The experiments are for co-simulation. The command `bevel-differential verify` does all this; any host can. By fmpy alone this prints the
largest deviation of each scene by its tolerance, which must not be above 1:

```python
{script}```

## Deviations to be expected

Results come from runs with `solver.relative_tolerance` = {tight:g}. A test keeps the usual {usual:g}. The tolerance is {margin:g} times the
largest difference between runs with both over all communication points, and {rounding:g} of the largest magnitude of the variable in any
shipped scene, for other scenes in any scene; of `heat.contact` for `solver.energy_residual`, which should be 0. A result ends where a difference exceeds {lost:g} of that magnitude: later the motion depends on the tolerance of the solver, as
that of rattling teeth does. The run still goes on to `stopTime`.

## Scenes

{scenes}
"""
SCRIPT = """\
from pathlib import Path

import numpy as np
from fmpy import extract, read_model_description, simulate_fmu
from lxml import etree

unit = extract("BevelDifferential.fmu")
evidence = Path(unit, "extra", "org.fmi-standard.fmi-ls-ref")
variables = {variable.name: variable for variable in read_model_description(unit).modelVariables}
tolerances = {tuple(row[:2]): float(row[3]) for row in np.genfromtxt(evidence / "tolerances.csv", str, delimiter=",", skip_header=1)}


def table(file):
    return np.genfromtxt(evidence / file, delimiter=",", names=True, deletechars="", replace_space=" ")


for test in etree.parse(evidence / "validation.exp").iter("Experiment"):
    files = {child.tag: child.get("source") for child in test}
    start = {}
    for parameter in etree.parse(evidence / files["Parameters"]).iter("{*}Parameter"):
        name, value = parameter.get("name"), parameter[0].get("value")
        choices = getattr(variables[name].declaredType, "items", None) or ()
        start[name] = next((choice.value for choice in choices if choice.name == value), value)
    result = table(files["References"])
    names = result.dtype.names[1:]
    run = simulate_fmu(unit, start_values=start, stop_time=float(test.get("stopTime")), output_interval=float(test.get("stepSize")),
                       input=table(files["Stimuli"]) if "Stimuli" in files else None, output=names)
    off = {name: np.abs(np.interp(result["time"], run["time"], run[name]) - result[name]).max() for name in names}
    print(test.get("name"), max(off[name] / tolerances[test.get("name"), name] for name in names))
"""


def write_table(file, rows):
    """Writes a table as CSV."""
    text = io.StringIO()
    csv.writer(text, lineterminator="\n").writerows(rows)
    file.write_text(text.getvalue(), encoding="utf-8")


def manifest(parts, smoke):
    """The manifest and the files of experiments as XML, by name."""
    about = {kind: text.format(smoke=smoke) for kind, (*_, text) in SETS.items()}
    root = etree.Element(ROOT, nsmap={"fmi-ls": NAMESPACE})
    for key, value in (("name", NAME), ("version", VERSION), ("description", DESCRIPTION)):
        root.set(f"{{{NAMESPACE}}}fmi-ls-{key}", value)
    related = [(TYPES[0], file, f"experiment/{role}", about[kind]) for kind, (file, role, *_) in SETS.items()]
    # results are no entries: one with the role `result` would be taken for that of the default experiment
    related += [(PARAMETERS[0], parameters(part), "parameter", part["description"]) for part in parts if part["kind"] == "validation"]
    related += [(TABLES[0], TOLERANCES, "other", "Tolerance of each variable in each experiment"),
                ("text/markdown", "requirements.md", "document", "What a test with these files requires")]
    for values in related:
        etree.SubElement(root, "Related", dict(zip(("type", "source", "role", "description"), values)))
    files = {SETS[kind][0]: experiments([part for part in parts if part["kind"] == kind], SETS[kind][2], about[kind]) for kind in SETS}
    return {name: etree.tostring(tree, xml_declaration=True, encoding="UTF-8", pretty_print=True)
            for name, tree in {MANIFEST: root, **files}.items()}


def experiments(parts, title, description):
    """The experiments of a kind."""
    root = etree.Element("Experiments", {"name": title, "description": description})
    for part in parts:
        experiment = etree.SubElement(root, "Experiment", {
            "name": part["name"], "description": described(part), "startTime": "0.0", "stopTime": f"{part['stop']:.10g}",
            "stepSize": f"{part['step']:.10g}"})
        for what, file in (("Parameters", parameters(part)), ("Stimuli", part["inputs"]), ("References", part["result"])):
            if file:
                etree.SubElement(experiment, what, {"source": file})
    return root


def parameters(part):
    """The file of the scene's parameter set."""
    return f"parameters/{part['scene']}.ssv"


def described(part):
    """The scene's description, and where its result ends early."""
    until = "" if part["until"] is None else f" (the result ends at {part['until']:.6g} s: later the motion depends on the tolerance of the solver)"
    return part["description"] + until


def requirements(parts, usual, tight, margin, rounding, lost, smoke):
    """What a test requires."""
    scenes = "\n".join(f"- `{part['name']}`: {described(part)}" for part in parts if part["kind"] == "validation")
    return REQUIREMENTS.format(version=VERSION, script=SCRIPT, scenes=scenes, usual=usual, tight=tight, margin=margin,
                               rounding=rounding, lost=lost, smoke=smoke)
