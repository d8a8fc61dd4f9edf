"""Host that loads the library for each simulation and unloads it afterwards: python loading_host.py FMU FMU3.

Prints the growth of the process for each version and kind [KiB per simulation]."""

import gc
import sys
from itertools import pairwise
from pathlib import Path

from fmpy import extract, read_model_description
from fmpy.fmi2 import FMU2Model, FMU2Slave
from fmpy.fmi3 import FMU3Model, FMU3Slave

# runs before the measurement, and runs in each of some spans
WARM_UP, SPAN, SPANS = 10, 20, 4
KINDS = {"2.0": (FMU2Slave, FMU2Model), "3.0": (FMU3Slave, FMU3Model)}


def resident():
    """Memory of the process without garbage of Python [KiB]."""
    gc.collect()
    pages = int(Path("/proc/self/statm").read_text(encoding="ascii").split()[1])
    return pages * 4


def growth(folder, description, kind):
    """Growth of the process over a simulation [KiB]: mean of the span with the smallest growth. A leak is in every span; the heap of
    Python grows in some."""

    def simulate(count):
        for _ in range(count):
            unit = kind(guid=description.guid, unzipDirectory=folder, modelIdentifier="BevelDifferential", instanceName="loaded")
            unit.instantiate()
            unit.enterInitializationMode()
            unit.exitInitializationMode()
            # unloads the library, too
            unit.freeInstance()

    simulate(WARM_UP)
    sizes = [resident()]
    for _ in range(SPANS):
        simulate(SPAN)
        sizes.append(resident())
    return min(after - before for before, after in pairwise(sizes)) / SPAN


if __name__ == "__main__":
    for file in sys.argv[1:]:
        folder, description = extract(file), read_model_description(file)
        for kind in KINDS[description.fmiVersion]:
            print(growth(folder, description, kind), flush=True)
