"""Units with a wrong coefficient, checked against their own evidence by `verify`.

usage: wrong_units.py FMU    prints the worst deviation, true if all scenes pass, and if they do, digests of all outputs by scene"""

import csv
import hashlib
import json
import subprocess
import sys
import zipfile
from dataclasses import asdict
from pathlib import Path

import coefficients
from bevel_differential.text import markdown
from bevel_differential.verify import Evidence, record, verify
from build import active

HEAD = ["coefficient", "value", "noticed", "scene", "variable", "time_s", "off_by", "unit", "times_tolerance", "remark"]


class WrongUnits:
    """Judge of coefficients: runs `verify` on the unit with one wrong coefficient."""

    modules, build, explained = coefficients.MODULES, ["cargo", "build", "--lib"], "coefficient"
    prepare, is_closed, replacement = map(staticmethod, (coefficients.opened, coefficients.is_closed, coefficients.replacement))

    def __init__(self, folder, _changes, messages, fmu):
        self.folder, self.unit = folder, folder / "wrong.fmu"
        pack(fmu, messages, self.unit)
        found = self.judged(0)
        if not found["passed"]:
            raise SystemExit("the unit does not pass with all changes asleep")
        self.bits = found["bits"]

    def judged(self, number):
        """What this script prints about the unit with an active change."""
        done = subprocess.run([sys.executable, __file__, self.unit], capture_output=True, text=True, env=active(number))
        if done.returncode:
            raise SystemExit(done.stderr)
        return json.loads(done.stdout)

    def fate(self, number):
        """Fate of a change with its worst deviation, and the scenes with different bits if no scene fails."""
        found = self.judged(number)
        differ = [name for name, digest in found["bits"].items() if digest != self.bits[name]] if found["passed"] else None
        return {"fate": "not noticed" if found["passed"] else "noticed", "worst": found["worst"], "differ": differ}

    def report(self, tried, seed, explained):
        """Table of coefficients, which is also written as coefficients.csv."""
        why = {(each["file"], each["value"]): each["why"] for each in explained}
        rows = [row_of(change, fate["worst"], fate["differ"], why.get((change.file, change.before), "not explained")) for change, fate in tried]
        with (self.folder / "coefficients.csv").open("w", encoding="utf-8", newline="") as file:
            csv.writer(file, lineterminator="\n").writerows([HEAD, *rows])
        noticed = sum(row[2] == "yes" for row in rows)
        return (f"{len(rows)} coefficients, drawn by seed {seed}, each {coefficients.LARGER - 1.0:.0%} larger: verify notices {noticed}\n\n"
                f"{markdown([HEAD, *rows], left=range(len(HEAD)))}").rstrip()


def pack(fmu, messages, file):
    """Writes a copy of an FMU with the library that cargo built instead of its own."""
    library = next(Path(name) for message in messages
                   if message.get("reason") == "compiler-artifact" and message["target"]["name"] == "bevel_differential"
                   for name in message["filenames"] if name.endswith((".so", ".dylib", ".dll")))
    with zipfile.ZipFile(fmu) as given, zipfile.ZipFile(file, "w", zipfile.ZIP_DEFLATED) as copy:
        for name in given.namelist():
            own = name.startswith("binaries/") and name.endswith(library.suffix)
            copy.writestr(name, library.read_bytes() if own else given.read(name))


def row_of(change, worst, differ, why):
    """Line of the table. `differ`: scenes whose bits differ if none fails; `why` verify does not notice the coefficient."""
    begin = [f"{change.file}:{change.line}", change.before, "yes" if differ is None else "no"]
    if differ == []:
        return [*begin, *[""] * 6, f"equal bits of all outputs in all scenes; {why}"]
    if "output" not in worst:
        return [*begin, worst["scene"], *[""] * 5, "the run breaks off"]
    off_by = abs(worst["value"] - worst["expected"])
    found = [worst["scene"], worst["output"], f"{worst['time']:.6g}", f"{off_by:.3g}", worst["unit"], f"{off_by / worst['tolerance']:.3g}"]
    return [*begin, *found, f"bits differ in {', '.join(differ)}; {why}" if differ else ""]


def bits(fmu):
    """Digests of all outputs of each scene: equal digests mean equal bits."""
    evidence = Evidence(fmu)
    outputs = [name for name, variable in evidence.fmu.variables.items() if variable.causality in ("output", "calculatedParameter")]
    for scene in evidence.scenes:
        times = evidence.result(scene)["time"]
        found = record(evidence.fmu, evidence.start(scene), evidence.inputs(scene), times[-1], times[1], outputs, [])
        yield scene, hashlib.sha256(found.tobytes()).hexdigest()


def main(fmu):
    verdicts = verify(fmu)
    wrong = [each for each in verdicts if each.verdict != "passed"]
    worst = max(wrong or verdicts, key=lambda each: each.worst.ratio if each.worst else 0.0)
    worst = {"scene": worst.scene, **(asdict(worst.worst) if worst.worst else {})}
    print(json.dumps({"passed": not wrong, "worst": worst, "bits": None if wrong else dict(bits(fmu))}, default=float))


if __name__ == "__main__":
    main(*sys.argv[1:])
