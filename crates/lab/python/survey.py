"""Runs the FMU with the parameter sets that `lab survey` wrote, and records its outputs.

usage: survey.py FMU FOLDER    for each NAME.json reads NAME.ssv, writes NAME.csv
"""

import csv
import json
import sys
from pathlib import Path

from bevel_differential import Differential
from fmpy.ssp.ssd import read_ssv


def main(file, folder):
    runs = sorted(folder.glob("*.json"))
    for number, path in enumerate(runs):
        print(f"progress {number / len(runs):.3f} running the FMU, {path.stem}", file=sys.stderr, flush=True)
        run = json.loads(path.read_text(encoding="utf-8"))
        parameters = read_ssv(str(path.with_suffix(".ssv"))).parameters
        with Differential({parameter.name: parameter.value for parameter in parameters}, fmu=file) as differential:
            record = differential.run(outputs=run["outputs"], stop=run["stop"], step=run["step"])
        with open(path.with_suffix(".csv"), "w", encoding="utf-8", newline="") as out:
            csv.writer(out).writerows(record[1:].tolist())


if __name__ == "__main__":
    main(sys.argv[1], Path(sys.argv[2]))
