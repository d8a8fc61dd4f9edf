"""The calls of runs without anything around them: calls.c, compiled."""

import subprocess
from pathlib import Path

from bevel_differential.batches import CALLS

# what a host reads at each communication point, where reading counts
TEN = ["carrier.speed", "left.speed", "right.speed", "left.shaft_torque", "right.shaft_torque", "left.tangential_force",
       "right.tangential_force", "planet[1].left_normal_force", "planet[1].left_transmission_error", "efficiency"]


class Calls:
    """The C program; `folder` is where it is built and finds its start values."""

    def __init__(self, folder):
        self.folder = Path(folder)
        self.program = self.folder / "calls"
        subprocess.run(["cc", "-O2", "-o", self.program, Path(__file__).with_name("calls.c"), "-ldl"], check=True)

    def seconds(self, fmu, values, outputs, stop, step, runs=1, later=None):
        """Seconds of each run of `fmu` to `stop`, and those of the processor that its steps took; inputs `later` are set after
        initialisation."""
        library = next(file for file in Path(fmu.folder, "binaries", "linux64").iterdir() if file.suffix == ".so")
        lines = []
        for named, kind in ((values, None), (later or {}, "Later")):
            for name, value in named.items():
                variable = fmu.variable(name)
                lines.append(f"{kind or CALLS[variable.kind]} {variable.reference} {float(variable.number(value))!r}")
        (self.folder / "set").write_text("\n".join(lines))
        references = [str(fmu.variable(name).reference) for name in outputs]
        command = [self.program, library, fmu.description.guid, self.folder / "set", str(stop), str(step or 0.0), str(runs), *references]
        printed = subprocess.run(command, check=True, capture_output=True, text=True).stdout
        return [tuple(map(float, line.split())) for line in printed.splitlines()]
