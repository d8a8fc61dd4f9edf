"""Digests of all outputs of each scene of an FMU's evidence: equal digests mean equal bits.

usage: record.py FMU"""

import hashlib
import json
import sys

from bevel_differential.verify import Evidence, record


def main(fmu):
    evidence = Evidence(fmu)
    outputs = [name for name, variable in evidence.fmu.variables.items() if variable.causality in ("output", "calculatedParameter")]
    digests = {}
    for scene in evidence.scenes:
        times = evidence.result(scene)["time"]
        found = record(evidence.fmu, evidence.start(scene), evidence.inputs(scene), times[-1], times[1], outputs, [])
        digests[scene] = hashlib.sha256(found.tobytes()).hexdigest()
    print(json.dumps(digests))


if __name__ == "__main__":
    main(*sys.argv[1:])
