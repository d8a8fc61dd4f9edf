import argparse
import csv
import math
import shutil
from bisect import bisect_right

from fmpy import extract, read_model_description
from fmpy.fmi2 import FMU2Slave

# (the scene)

RECORDED = [name for name, *_ in OUTPUTS]
# times that differ by less are the same, s
SLACK = 1e-9 * STEP


def table_value(table, time):
    """Value of an input at a time: straight between points, constant before the first and after the last."""
    times, values, period = table
    if period is not None:
        time = math.fmod(time, period)
    after = bisect_right(times, time)
    if after == 0 or after == len(times):
        return values[0 if after == 0 else -1]
    share = (time - times[after - 1]) / (times[after] - times[after - 1])
    return values[after - 1] + share * (values[after] - values[after - 1])


class Differential:
    """An instance of the FMU, whose variables are called by their names."""

    def __init__(self, fmu_file):
        description = read_model_description(fmu_file)
        self.references = {variable.name: variable.valueReference for variable in description.modelVariables}
        missing = [name for name in [*START, *RECORDED] if name not in self.references]
        if missing:
            raise SystemExit(f"{fmu_file} has no variable {missing[0]}: this script was written for another version of it")
        self.folder = extract(fmu_file)
        self.fmu = FMU2Slave(guid=description.guid, unzipDirectory=self.folder, instanceName=SCENE,
                             modelIdentifier=description.coSimulation.modelIdentifier)
        self.fmu.instantiate()

    def start(self):
        self.fmu.setupExperiment(startTime=0.0, stopTime=STOP_TIME)
        self.set(START)
        self.fmu.enterInitializationMode()
        self.fmu.exitInitializationMode()

    def set(self, values):
        """Sets values by the types that they have here, all of a type in one call."""
        for kind, function in [(float, self.fmu.setReal), (int, self.fmu.setInteger), (bool, self.fmu.setBoolean)]:
            names = [name for name, value in values.items() if type(value) is kind]
            if names:
                function([self.references[name] for name in names], [values[name] for name in names])

    def outputs(self):
        return self.fmu.getReal([self.references[name] for name in RECORDED])

    def step(self, time, until):
        """A step that ends at `until` exactly: point and size are numbers whose sum is not rounded."""
        size = until - time
        self.fmu.doStep(until - size, size)

    def close(self):
        self.fmu.freeInstance()
        shutil.rmtree(self.folder, ignore_errors=True)


def simulate(differential):
    """Times and outputs at communication points, and where inputs change between them."""
    time, done, changes = 0.0, 0, list(CHANGES)
    differential.start()
    yield time, differential.outputs()
    while time < STOP_TIME - SLACK:
        values = {}
        while changes and changes[0][0] <= time + SLACK:
            values.update(changes.pop(0)[1])
        values.update({name: table_value(table, time + SLACK) for name, table in TABLES.items()})
        differential.set(values)
        until = min((done + 1) * STEP, STOP_TIME)
        if changes and changes[0][0] < until - SLACK:
            until = changes[0][0]
        else:
            done += 1
        differential.step(time, until)
        time = until
        yield time, differential.outputs()


def summary(rows):
    """Least, mean over time, greatest and last value of each output."""
    lines = [("output", "unit", "min", "mean", "max", "end")]
    times = [time for time, _ in rows]
    for place, (name, _, unit, factor) in enumerate(OUTPUTS):
        values = [outputs[place] for _, outputs in rows]
        mean = sum(0.5 * (times[i + 1] - times[i]) * (values[i] + values[i + 1]) for i in range(len(rows) - 1))
        numbers = [min(values), mean / times[-1], max(values), values[-1]]
        lines.append((name, unit, *(f"{factor * number:.6g}" for number in numbers)))
    widths = [max(map(len, column)) for column in zip(*lines)]
    return "\n".join("  ".join(cell.ljust(width) if i < 2 else cell.rjust(width)
                               for i, (cell, width) in enumerate(zip(line, widths))) for line in lines)


def main():
    parser = argparse.ArgumentParser(description=f"Simulates the scene {SCENE} with the FMU and records its outputs.")
    parser.add_argument("fmu", nargs="?", default="BevelDifferential.fmu", help="the FMU [default: %(default)s]")
    parser.add_argument("--csv", default=f"{SCENE}.csv", help="the file to write [default: %(default)s]")
    arguments = parser.parse_args()
    differential = Differential(arguments.fmu)
    try:
        rows = list(simulate(differential))
    finally:
        differential.close()
    with open(arguments.csv, "w", newline="", encoding="utf-8") as file:
        file.write(f"# scene {SCENE}: {DESCRIPTION}\n# units: s,{','.join(unit for _, unit, *_ in OUTPUTS)}\n")
        writer = csv.writer(file, lineterminator="\n")
        writer.writerow(["time", *RECORDED])
        writer.writerows([time, *values] for time, values in rows)
    print(summary(rows))
    print(f"record: {arguments.csv}")


if __name__ == "__main__":
    main()
