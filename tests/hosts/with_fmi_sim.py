"""fmi-sim, the program of the Rust crates fmi and fmi-schema.

The environment variable FMI_SIM contains its path. Values before initialisation are passed on the command line, with
enumerations as numbers; inputs are passed in a file. fmi-sim interpolates inputs linearly between rows. The file has a row for
every communication point, so nothing is interpolated. Like the other scripts, fmi-sim records outputs before it sets the
inputs of the same point.
"""

import csv
import os
import re
import subprocess
import tempfile
from pathlib import Path

import common

QUIET = os.environ | {"RUST_BACKTRACE": "0"}


def load():
    program = os.environ.get("FMI_SIM", "")
    if not os.path.isfile(program):
        raise ImportError("FMI_SIM does not name the program fmi-sim")
    # fmi-sim prints its version as an error
    asked = subprocess.run([program, "--version"], capture_output=True, text=True, env=QUIET)
    return re.search(r"fmi-sim (\S+)", asked.stdout + asked.stderr).group(1)


def output_of(command):
    ended = subprocess.run(command, capture_output=True, text=True, env=QUIET)
    if ended.returncode != 0:
        raise SystemExit(f"fmi-sim fails: {ended.stderr.strip() or ended.stdout.strip()}")
    return ended.stdout


def run(fmu, scene):
    """{communication point: values}"""
    with tempfile.TemporaryDirectory() as folder:
        out, inputs = Path(folder) / "out.csv", Path(folder) / "in.csv"
        command = [os.environ["FMI_SIM"], "--model", str(Path(fmu).resolve()), "-o", str(out)]
        if scene.series:
            inputs.write_text(table(scene))
            command += ["-i", str(inputs)]
        command += ["co-simulation", "--output-interval", repr(scene.step), "-s", "0.0", "-f", repr(scene.stop)]
        for variable, value in scene.start(common.variables(fmu)):
            command += ["--init-values", f"{variable.name}={str(value).lower()}"]
        output_of(command)
        with out.open(newline="") as file:
            lines = list(csv.DictReader(file))
    if len(lines) != scene.steps + 1:
        raise SystemExit(f"fmi-sim records {len(lines)} communication points instead of {scene.steps + 1}")
    return {k: [float(line[name]) for name in scene.outputs] for k, line in enumerate(lines)}


def table(scene):
    """CSV table of all inputs at all communication points."""
    values = {name: series[0][1] for name, series in scene.series.items()}
    lines = [",".join(["time", *values])]
    for k in range(scene.steps + 1):
        values |= scene.changes(k)
        lines.append(",".join(repr(float(value)) for value in [k * scene.step, *values.values()]))
    return "\n".join(lines) + "\n"


if __name__ == "__main__":
    common.main(load, run)
