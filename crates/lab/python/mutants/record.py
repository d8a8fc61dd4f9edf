"""Digests of all outputs over each experiment that an FMU carries: equal ones mean equal bits.

usage: record.py FMU"""

import hashlib
import json
import sys
from pathlib import Path

import numpy as np
from bevel_differential.verify.evidence import Evidence
from bevel_differential.verify.experiment import Unit
from fmpy import extract, read_model_description


def main(fmu):
    folder = Path(extract(fmu))
    unit = Unit(Path(fmu), folder, read_model_description(str(folder)))
    outputs = [name for name, variable in unit.variables.items() if variable.causality in ("output", "calculatedParameter")]
    digests = {}
    for experiment in Evidence.of(unit).experiments:
        experiment.read(unit)
        experiment.expected = np.zeros(1, [("time", float), *((name, float) for name in outputs)])
        digests[experiment.name] = hashlib.sha256(experiment.run(unit).tobytes()).hexdigest()
    print(json.dumps(digests))


if __name__ == "__main__":
    main(*sys.argv[1:])
