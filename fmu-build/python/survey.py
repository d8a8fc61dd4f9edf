"""Runs the FMU with the parameter sets that `fmu-build survey` wrote, and records its outputs.

usage: survey.py FMU FOLDER    for each NAME.json reads NAME.ssv, writes NAME.csv
"""

import csv
import json
import shutil
import sys
from pathlib import Path

from fmpy import extract, read_model_description
from fmpy.fmi2 import FMU2Slave
from fmpy.ssp.ssd import read_ssv


class Model:
    """The FMU, unpacked once, and what its variables are."""

    def __init__(self, file):
        self.description = read_model_description(file)
        self.folder = extract(file)
        self.rows = {variable.name: variable for variable in self.description.modelVariables}

    def start(self, ssv, stop):
        """An instance with the values of a parameter set, initialised."""
        fmu = FMU2Slave(guid=self.description.guid, unzipDirectory=self.folder, instanceName="survey",
                        modelIdentifier=self.description.coSimulation.modelIdentifier)
        fmu.instantiate()
        fmu.setupExperiment(startTime=0.0, stopTime=stop)
        for parameter in read_ssv(str(ssv)).parameters:
            row = self.rows[parameter.name]
            value, reference = parameter.value, [row.valueReference]
            if row.type == "Real":
                fmu.setReal(reference, [float(value)])
            elif row.type == "Boolean":
                fmu.setBoolean(reference, [str(value).lower() == "true"])
            elif row.type == "Enumeration":
                fmu.setInteger(reference, [next(int(i.value) for i in row.declaredType.items if i.name == value)])
            else:
                fmu.setInteger(reference, [int(value)])
        fmu.enterInitializationMode()
        fmu.exitInitializationMode()
        return fmu


def simulate(model, ssv, run):
    fmu = model.start(ssv, run["stop"])
    references = [model.rows[name].valueReference for name in run["outputs"]]
    rows, time, done = [], 0.0, 0
    while time < run["stop"] - 1e-9 * run["step"]:
        done += 1
        until = min(done * run["step"], run["stop"])
        size = until - time
        # a point and a size whose sum is not rounded
        fmu.doStep(until - size, size)
        time = until
        rows.append([time, *fmu.getReal(references)])
    fmu.freeInstance()
    return rows


def main(file, folder):
    model = Model(file)
    runs = sorted(folder.glob("*.json"))
    try:
        for number, path in enumerate(runs):
            print(f"progress {number / len(runs):.3f} running the FMU, {path.stem}", file=sys.stderr, flush=True)
            run = json.loads(path.read_text(encoding="utf-8"))
            rows = simulate(model, path.with_suffix(".ssv"), run)
            with open(path.with_suffix(".csv"), "w", encoding="utf-8", newline="") as out:
                csv.writer(out).writerows(rows)
    finally:
        shutil.rmtree(model.folder, ignore_errors=True)


if __name__ == "__main__":
    main(sys.argv[1], Path(sys.argv[2]))
