"""Runs that consist only of the calls of a host: calls.c, compiled and executed."""

import math
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from bevel_differential.batches import CALLS
from tools import completed, say

# outputs that a host reads at each communication point, if reading is part of the measurement
TEN = ["carrier.speed", "left.speed", "right.speed", "left.shaft_torque", "right.shaft_torque", "left.tangential_force",
       "right.tangential_force", "planet[1].left_normal_force", "planet[1].left_transmission_error", "efficiency"]


def compiled(folder):
    """Builds calls.c in a folder, and returns the path of the program."""
    program = Path(folder) / "calls"
    completed(["cc", "-O2", "-o", program, Path(__file__).with_name("calls.c"), "-ldl", "-lm"],
              "a C compiler builds the host that is timed: install one (apt-get install gcc)")
    return program


def library_of(fmu):
    """The library of this machine."""
    return next(file for file in Path(fmu.folder, "binaries", "linux64").iterdir() if file.suffix == ".so")


def write_start(file, fmu, values, later=None):
    """Writes start values for a host; inputs `later` are set after initialisation."""
    lines = []
    for named, kind in ((values, None), (later or {}, "Later")):
        for name, value in named.items():
            variable = fmu.variable(name)
            lines.append(f"{kind or CALLS[variable.kind]} {variable.reference} {float(variable.number(value))!r}")
    file.write_text("\n".join(lines))


@dataclass(frozen=True)
class Sine:
    """An input that a coupled host sets to a sine before each step. `how`: "held" during the step, or "lines" with the slope."""

    how: str
    input: str
    mean: float
    amplitude: float
    frequency: float

    def argument(self, fmu):
        """The argument of calls.c, in SI units."""
        return f"{self.how}:{fmu.variable(self.input).reference}:{self.mean!r}:{self.amplitude!r}:{self.frequency!r}"


def in_turn(runs, rounds, take, bar, what):
    """Rounds of timed runs, each run once in a round, so that other load of the machine affects all alike. `take(run, round)` gives the
    seconds of a run; the bar moves over the pair `bar`. Returns the seconds of each."""
    seconds = [[] for _ in runs]
    for number in range(rounds):
        for place, run in enumerate(runs):
            say(bar[0] + (bar[1] - bar[0]) * (number + place / len(runs)) / rounds, what)
            seconds[place] += take(run, number)
    return seconds


def quartiles(seconds):
    """Median and quartiles; NaN if there are no values."""
    return np.quantile(seconds, [0.5, 0.25, 0.75]).tolist() if len(seconds) else [math.nan] * 3


class Calls:
    """The C program, built in `folder`. It reads its start values from a file in this folder."""

    def __init__(self, folder):
        self.folder, self.program = Path(folder), compiled(folder)

    def seconds(self, fmu, values, outputs, stretches, runs=1, later=None, moving=None):
        """Elapsed time of each run of `fmu`, and processor time of its steps [s]. `stretches`: (end, communication step) of each part
        of the run [s]; the step None means one long step. Inputs `later` are set after initialisation. `moving`: a `Sine`, or None if
        inputs are constant."""
        write_start(self.folder / "set", fmu, values, later)
        parts = ",".join(f"{end!r}:{step or 0.0!r}" for end, step in stretches)
        references = [str(fmu.variable(name).reference) for name in outputs]
        command = [self.program, library_of(fmu), fmu.description.guid, self.folder / "set", parts, str(runs),
                   moving.argument(fmu) if moving else "constant", *references]
        printed = completed(command).stdout
        return [tuple(map(float, line.split())) for line in printed.splitlines()]
