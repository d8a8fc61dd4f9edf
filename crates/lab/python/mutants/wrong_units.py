"""Units with a wrong coefficient, checked against their own evidence by `bevel-differential verify`."""

import csv
import json
import os
import subprocess
import sys
import zipfile
from pathlib import Path

from coefficients import LARGER, MODULES, coefficients, opened

HEAD = ("coefficient", "value", "noticed", "scene", "variable", "time_s", "off_by", "unit", "times_tolerance", "remark")


class WrongUnits:
    """Judge of coefficients: runs `verify` on the unit with one wrong coefficient."""

    modules, changes_of, prepare = MODULES, staticmethod(coefficients), staticmethod(opened)
    build = ["cargo", "build", "--lib"]
    explained = "coefficient"

    def __init__(self, folder, _changes, messages, fmu):
        self.folder, self.unit = folder, packed(fmu, library_of(messages), folder / "wrong.fmu")
        if any(row["verdict"] != "passed" for row in verified(self.unit, 0, folder)):
            raise SystemExit("the unit does not pass with all changes asleep")
        self.bits = digests(self.unit, 0)

    def fate(self, number):
        """Fate of a change with its worst row, and the scenes with different bits if no row fails."""
        rows = verified(self.unit, number, self.folder)
        wrong = [row for row in rows if row["verdict"] != "passed"]
        worst = max(wrong or rows, key=ratio_of)
        differ = None if wrong else [name for name, digest in digests(self.unit, number).items() if digest != self.bits[name]]
        return {"fate": "noticed" if wrong else "not noticed", "worst": worst, "differ": differ}

    def report(self, changes, fates, seed, said):
        """Table of coefficients, which is also written as coefficients.csv."""
        rows = [row_of(change, fate["worst"], fate["differ"], said) for change, fate in zip(changes, fates)]
        with (self.folder / "coefficients.csv").open("w", encoding="utf-8", newline="") as file:
            csv.writer(file, lineterminator="\n").writerows([HEAD, *rows])
        noticed = sum(row[2] == "yes" for row in rows)
        lines = [f"{len(rows)} coefficients, drawn by seed {seed}, each {LARGER - 1.0:.0%} larger: verify notices {noticed}", "",
                 f"| {' | '.join(HEAD)} |", f"|{'---|' * len(HEAD)}", *(f"| {' | '.join(row)} |" for row in rows)]
        return "\n".join(lines)


def library_of(messages):
    """Dynamic library that was built."""
    files = [name for message in messages if message.get("reason") == "compiler-artifact" and message["target"]["name"] == "bevel_differential"
             for name in message["filenames"]]
    return Path(next(name for name in files if name.endswith((".so", ".dylib", ".dll"))))


def packed(fmu, library, file):
    """Writes a copy of an FMU with this library instead of its own, and returns the copy's path."""
    with zipfile.ZipFile(fmu) as given, zipfile.ZipFile(file, "w", zipfile.ZIP_DEFLATED) as made:
        for name in given.namelist():
            own = name.startswith("binaries/") and name.endswith(library.suffix)
            made.writestr(name, library.read_bytes() if own else given.read(name))
    return file


def verified(unit, number, folder):
    """Rows of the table that `verify` writes with an active change: one for each variable of each scene."""
    table = folder / f"verify{number}.csv"
    done = subprocess.run([sys.executable, "-m", "bevel_differential", "verify", str(unit), "--csv", str(table)], capture_output=True, text=True,
                          env=awake(number))
    if not table.is_file():
        raise SystemExit(done.stderr)
    lines = [line for line in table.read_text(encoding="utf-8").splitlines() if not line.startswith("#")]
    table.unlink()
    return list(csv.DictReader(lines))


def digests(unit, number):
    """Digests of all outputs by scene."""
    done = subprocess.run([sys.executable, str(Path(__file__).with_name("record.py")), str(unit)], capture_output=True, text=True, check=True,
                          env=awake(number))
    return json.loads(done.stdout)


def awake(number):
    """Environment that activates a change."""
    return {**os.environ, "MUTANT": str(number)}


def ratio_of(row):
    """Deviation divided by the tolerance; 0 for a scene that cannot be compared."""
    return deviation_of(row) / float(row["tolerance"]) if row["value"] else 0.0


def deviation_of(row):
    """Deviation of a variable."""
    return abs(float(row["value"]) - float(row["expected"]))


def row_of(change, worst, differ, said):
    """Line of the table. `differ`: scenes whose bits differ if none fails; `said`: explanations of coefficients that are not noticed."""
    begin = [f"{change.file}:{change.line}", change.before, "yes" if differ is None else "no"]
    why = next((each["why"] for each in said if (each["file"], each["value"]) == (change.file, change.before)), "not explained")
    if differ == []:
        return [*begin, *[""] * 6, f"equal bits of all outputs in all scenes; {why}"]
    if not worst["value"]:
        return [*begin, worst["scene"], *[""] * 5, "the run breaks off"]
    found = [f"{float(worst['time']):.6g}", f"{deviation_of(worst):.3g}", worst["unit"], f"{ratio_of(worst):.3g}"]
    return [*begin, worst["scene"], worst["variable"], *found, f"bits differ in {', '.join(differ)}; {why}" if differ else ""]
