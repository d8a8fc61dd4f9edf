"""Files of the evidence that follow from the experiments: tables, the manifest of FMI-LS-REF, and what tests require."""

import csv
import io

from bevel_differential.verify.evidence import DESCRIPTION, NAME, NAMESPACE, VERSION
from lxml import etree

REQUIREMENTS = """# What a test with this evidence requires

The manifest's folder, name and root attributes are those of FMI-LS-REF {version}; the elements within it are the project's own. Each
scene is a parameter set, a table of inputs where inputs change, and two experiments.

- **Smoke test**: the first {smoke:.0%} of a scene. It shows that the unit runs and starts as it should.
- **Validation**: the whole scene.

A test sets all values of the parameter set, then initialises, and takes communication steps of `stepSize` from `startTime` to
`stopTime`. Values of the inputs at a communication point hold through the step that begins there. Between two rows of a table they lie
on a straight line. Two rows of one time are a jump; the step that begins there has the second value.

Outputs are read after each step. A test passes if each value of the result differs from the output at the same time by at most the
tolerance of its variable in `tolerances.csv`. Tolerances are absolute, in the unit of the variable.

Results come from runs with `solver.relative_tolerance` = {tight:g}. A test keeps the usual {usual:g}. The tolerance is {margin:g} times the
largest difference between runs with both over all communication points, and {rounding:g} of the largest magnitude of the variable in any
shipped scene, for other scenes in any scene; of `heat.contact` for `solver.energy_residual`, which should be 0. A result ends where a difference exceeds {lost:g} of that magnitude: later the motion depends on the tolerance of the solver, as
that of rattling teeth does. The run still goes on to `stopTime`.

The experiments are for co-simulation. The command `bevel-differential verify` does all this; any host can.
"""


def write_table(file, rows):
    """Writes a table as CSV."""
    text = io.StringIO()
    csv.writer(text, lineterminator="\n").writerows(rows)
    file.write_text(text.getvalue(), encoding="utf-8")


def manifest(parts):
    """The manifest as XML."""
    root = etree.Element(f"{{{NAMESPACE}}}fmiLayeredStandardManifest", nsmap={"fmi-ls": NAMESPACE})
    for key, value in (("name", NAME), ("version", VERSION), ("description", DESCRIPTION)):
        root.set(f"{{{NAMESPACE}}}fmi-ls-{key}", value)
    for part in parts:
        given = {"name": part["name"], "kind": part["kind"], "description": described(part), "startTime": "0.0",
                 "stopTime": f"{part['stop']:.10g}", "stepSize": f"{part['step']:.10g}", "parameterSet": f"parameters/{part['scene']}.ssv",
                 "input": part["inputs"], "result": part["result"], "tolerances": "tolerances.csv"}
        etree.SubElement(root, "Experiment", {key: value for key, value in given.items() if value})
    return etree.tostring(root, xml_declaration=True, encoding="UTF-8", pretty_print=True)


def described(part):
    """The scene's description, and where its result ends early."""
    until = "" if part["until"] is None else f" (the result ends at {part['until']:.6g} s: later the motion depends on the tolerance of the solver)"
    return part["description"] + until


def requirements(usual, tight, margin, rounding, lost, smoke):
    """What a test requires."""
    return REQUIREMENTS.format(version=VERSION, usual=usual, tight=tight, margin=margin, rounding=rounding, lost=lost, smoke=smoke)
