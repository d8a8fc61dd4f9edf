"""Tests units with a wrong coefficient by their evidence: all in one build, each woken by an environment variable.

usage: wrong_units.py REPOSITORY FMU FOLDER COUNT SEED

Prints what `bevel-differential verify` says of each as Markdown, and writes FOLDER/coefficients.csv."""

import csv
import json
import os
import subprocess
import sys
import tomllib
import zipfile
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

from build import WATCH, built
from changes import drawn
from coefficients import LARGER, MODULES, coefficients, opened

HEAD = ("coefficient", "value", "noticed", "scene", "variable", "time_s", "off_by", "unit", "times_tolerance", "remark")


def main():
    repository, fmu, folder = map(Path, sys.argv[1:4])
    count, seed = map(int, sys.argv[4:])
    if not 0 < count < WATCH:
        raise SystemExit(f"{count} changes: a run takes 1 to {WATCH - 1}")
    folder.mkdir(parents=True, exist_ok=True)

    def draw(source, refused):
        opened(source)
        return drawn(source, MODULES, count, seed, refused, coefficients)

    changes, messages = built(repository, folder, draw, ["cargo", "build", "--lib"])
    unit = packed(fmu, library_of(messages), folder / "wrong.fmu")
    asleep = verified(unit, 0, folder)
    if any(row["verdict"] != "passed" for row in asleep):
        raise SystemExit("the unit does not pass with all changes asleep")
    bits = digests(unit, 0)

    def tried(number):
        rows = verified(unit, number, folder)
        wrong = [row for row in rows if row["verdict"] != "passed"]
        worst = max(wrong or rows, key=ratio_of)
        differ = None if wrong else [name for name, digest in digests(unit, number).items() if digest != bits[name]]
        print(f"progress {number / (len(changes) + 1):.4f} {'noticed' if wrong else 'not noticed'}", file=sys.stderr, flush=True)
        return worst, differ

    with ThreadPoolExecutor(os.cpu_count()) as pool:
        said = tomllib.loads((repository / "docs" / "mutants.toml").read_text(encoding="utf-8"))["coefficient"]
        rows = [row_of(change, *found, said) for change, found in zip(changes, pool.map(tried, range(1, len(changes) + 1)))]
    with (folder / "coefficients.csv").open("w", encoding="utf-8", newline="") as file:
        csv.writer(file, lineterminator="\n").writerows([HEAD, *rows])
    noticed = sum(row[2] == "yes" for row in rows)
    print(f"{len(rows)} coefficients, drawn by seed {seed}, each {LARGER - 1.0:.0%} larger: verify notices {noticed}\n")
    print(f"| {' | '.join(HEAD)} |\n|{'---|' * len(HEAD)}")
    for row in rows:
        print(f"| {' | '.join(row)} |")


def library_of(messages):
    """The dynamic library that was built."""
    files = [name for message in messages if message.get("reason") == "compiler-artifact" and message["target"]["name"] == "bevel_differential"
             for name in message["filenames"]]
    return Path(next(name for name in files if name.endswith((".so", ".dylib", ".dll"))))


def packed(fmu, library, file):
    """An FMU with this library in the place of its own."""
    with zipfile.ZipFile(fmu) as given, zipfile.ZipFile(file, "w", zipfile.ZIP_DEFLATED) as made:
        for name in given.namelist():
            own = name.startswith("binaries/") and name.endswith(library.suffix)
            made.writestr(name, library.read_bytes() if own else given.read(name))
    return file


def verified(unit, number, folder):
    """Rows of the table that `verify` writes with a change awake: one for each variable of each scene."""
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
    """The environment that wakes a change."""
    return {**os.environ, "MUTANT": str(number)}


def ratio_of(row):
    """The deviation divided by the tolerance; 0 of a scene that cannot be compared."""
    return deviation_of(row) / float(row["tolerance"]) if row["value"] else 0.0


def deviation_of(row):
    """The deviation of a variable."""
    return abs(float(row["value"]) - float(row["expected"]))


def row_of(change, worst, differ, said):
    """A line of the table. `differ`: scenes whose bits differ if none fails; `said`: why some are not noticed."""
    begin = [f"{change.file}:{change.line}", change.before, "yes" if differ is None else "no"]
    why = next((each["why"] for each in said if (each["file"], each["value"]) == (change.file, change.before)), "not explained")
    if differ == []:
        return [*begin, *[""] * 6, f"equal bits of all outputs in all scenes; {why}"]
    if not worst["value"]:
        return [*begin, worst["scene"], *[""] * 5, "the run breaks off"]
    found = [f"{float(worst['time']):.6g}", f"{deviation_of(worst):.3g}", worst["unit"], f"{ratio_of(worst):.3g}"]
    return [*begin, worst["scene"], worst["variable"], *found, f"bits differ in {', '.join(differ)}; {why}" if differ else ""]


if __name__ == "__main__":
    main()
