"""Simulates the same scenes with the library for each platform through fmpy and compares the bits of all outputs.

usage: platforms.py SCENES WINE64 NAME=FMU...

Each FMU holds the library for one platform; the first one is what the others are compared with. One for win64 runs in
fmpy's server under WINE64. Prints the tables of docs/fmi.md; fails if any bits differ. A line
"progress FRACTION WHAT" on standard error reports progress.
"""

import os
import subprocess
import sys
import time
from pathlib import Path

import numpy as np
from fmpy import extract
from fmpy.fmi1 import FMICallException
from fmpy.util import add_remoting

import binaries
import platform_scenes
from bevel_differential import DifferentialError, Fmu
from bevel_differential.text import markdown
from effects_list import effects
from tools import WORKSPACE, say

# where the list of effects is
FMU = WORKSPACE / "target" / "fmu" / "BevelDifferential.fmu"
# keeps a library from wider vector instructions; a platform whose name ends so is kept from them
VECTORS, NARROW = "BEVEL_DIFFERENTIAL_VECTORS", "narrow"
# what is timed, each as one step of this length [s], and how often
TIMED = {"study, turn, tooth": 2.0, "study, turn, solid": 0.02, "all effects, impact": 0.05}
REPEATS = 3
# communication steps of a scene
STEPS = 100
# port of fmpy's server, time limit of its start [s], and pause between checks [s]
PORT, PATIENCE, PAUSE = 8080, 60.0, 0.1


class Platform:
    """An FMU with one library, and a server if that is for Windows."""

    def __init__(self, name, fmu, wine):
        self.name, self.server = name, None
        self.folder = Path(fmu) if Path(fmu).is_dir() else Path(extract(str(fmu)))
        self.binary = next((self.folder / "binaries").glob("*/*"))
        self.windows, self.wine = self.binary.suffix == ".dll", wine
        if self.windows:
            add_remoting(str(self.folder), "linux64", "win64")
        self.fmu = Fmu(self.folder)
        self.outputs = [variable.name for variable in self.fmu.variables.values() if variable.causality == "output"]

    def close(self):
        if self.server:
            self.server.terminate()
            self.server.wait()
            self.server = None

    def opened(self):
        """A new instance; under wine with a new server, as that ends with the instance."""
        # a library reads this variable at its first step
        os.environ[VECTORS] = NARROW if self.name.endswith(NARROW) else ""
        if self.windows:
            self.close()
            self.serve()
        return self.fmu.open()

    def end(self, instance):
        """Frees an instance; under wine with its server, as fmpy's client waits forever for one it did not start."""
        if self.windows:
            instance.forget()
            self.close()
        else:
            instance.close()

    def serve(self):
        """Starts fmpy's server before anything connects: its client would time out while wine loads the library."""
        deadline = time.monotonic() + PATIENCE
        while is_listening():
            self.wait(deadline, f"port {PORT}, which fmpy's server needs, is in use")
        library = "Z:" + str(self.binary).replace("/", "\\")
        server = str(self.binary.parent / "server_tcp.exe")
        self.server = subprocess.Popen([self.wine, server, library], stdin=subprocess.DEVNULL, stdout=subprocess.DEVNULL,
                                       stderr=subprocess.DEVNULL)
        while not is_listening():
            if self.server.poll() is not None:
                sys.exit(f"fmpy's server did not start under wine: it ended with {self.server.returncode}")
            self.wait(deadline, "fmpy's server did not start under wine")

    @staticmethod
    def wait(deadline, problem):
        if time.monotonic() > deadline:
            sys.exit(f"{problem}: no success after {PATIENCE:g} s")
        time.sleep(PAUSE)

    def start(self, values):
        """An initialised instance."""
        return self.opened().initialise(values)

    def record(self, values, events, tables, duration):
        """All outputs at all communication points."""
        step = duration / STEPS
        instance = self.start(values)
        rows, events = [], sorted(events, key=lambda event: event["time"])
        for k in range(STEPS + 1):
            rows.append(instance.read(self.outputs))
            now = k * step
            while events and events[0]["time"] <= now + 1e-9 * step:
                event = events.pop(0)
                instance.set({name: value for name, value in event.items() if name != "time"})
            for table in tables:
                within = now % table["period"] if "period" in table else now
                points = [self.fmu.variable(table["input"]).number(value) for value in table["value"]]
                instance.set({table["input"]: np.interp(within, table["time"], points)})
            if k < STEPS:
                instance.do_step(now, step)
        self.end(instance)
        return np.array(rows, dtype=float)

    def seconds(self, values, duration):
        """The least time that one step of `duration` takes."""
        least = np.inf
        for _ in range(REPEATS):
            instance = self.start(values)
            begin = time.perf_counter()
            instance.step(duration)
            least = min(least, time.perf_counter() - begin)
            self.end(instance)
        return least

    def refuses(self):
        """Statuses that wrong calls return, while the library stays usable."""
        instance, statuses = self.opened(), []
        module = self.fmu.variable("geometry.module").reference
        for call in [lambda: instance.raw.setReal([10**6], [1.0]),
                     lambda: instance.step(1e-3),
                     lambda: instance.raw.setReal([module], [float("nan")]) or instance.initialise()]:
            try:
                call()
                statuses.append("ok")
            except (DifferentialError, FMICallException) as problem:
                statuses.append(str(problem.status))
        instance.reset()
        self.end(instance)
        return statuses


def is_listening():
    """Whether a server waits on the port; checked without connecting, as the server accepts one client."""
    with open("/proc/net/tcp", encoding="ascii") as sockets:
        rows = [line.split() for line in sockets][1:]
    return any(row[1].endswith(f":{PORT:04X}") and row[3] == "0A" for row in rows)


def described(platform):
    """A row of the table of platforms, and how many symbols the library exports, with those that are not FMI's."""
    if platform.windows:
        exported, needed = binaries.of_windows(platform.binary)
        version = "–"
    else:
        exported, needed, glibc = binaries.of_linux(platform.binary)
        version = ".".join(str(part) for part in glibc)
    others = [name for name in exported if not name.startswith(("fmi2", "fmi3"))]
    size = platform.binary.stat().st_size / 1e6
    return [platform.name, f"{size:.2f}", version, ", ".join(needed)], [len(exported), *others]


def compared(one, other):
    """Whether all bits agree, and the difference in words."""
    if one.shape != other.shape:
        return False, f"{len(other)} communication points instead of {len(one)}"
    different = one.view(np.uint64) != other.view(np.uint64)
    if not different.any():
        return True, "same"
    scale = np.maximum(np.abs(one), np.abs(other))
    apart = np.abs(one - other)[different] / np.where(scale[different] > 0, scale[different], 1.0)
    first = np.argwhere(different)[0]
    return False, f"{different.sum()} of {different.size} differ, by {apart.max():.1e} at most, first at point {first[0]}"


def main():
    folder, wine, *named = sys.argv[1:]
    platforms = []
    try:
        for name, fmu in (pair.split("=", 1) for pair in named):
            say(0.0, f"starting {name}")
            platforms.append(Platform(name, fmu, wine))
        text, same = tables(platforms, list(platform_scenes.all_scenes(Path(folder), effects(FMU))))
    finally:
        for platform in platforms:
            platform.close()
    if not same:
        sys.exit(f"the libraries do not agree:\n{text}")
    print(text, end="")


def tables(platforms, scenes):
    first, *others = platforms
    described_as, exported = zip(*map(described, platforms))
    text = markdown([["library", "MB", "glibc", "libraries needed"], *described_as], left=(0, 3)) + "\n"
    counts = " or ".join(sorted({str(count) for count, *_ in exported}))
    foreign = ", ".join(sorted({name for _, *names in exported for name in names}))
    text += f"Each exports {counts} symbols, {'not of FMI: ' + foreign if foreign else 'all of FMI'}.\n\n"
    values, columns = 0, [platform.name for platform in others]
    rows = [["scene", *columns]]
    lines = [["one step", "simulated", first.name, *columns]]
    for index, (name, settings, *rest) in enumerate(scenes):
        say(0.9 * index / len(scenes), name)
        wanted = first.record(settings, *rest)
        found = [compared(wanted, platform.record(settings, *rest)) for platform in others]
        values += wanted.size
        if not all(agrees for agrees, _ in found):
            rows.append([name, *(words for _, words in found)])
    same = len(rows) == 1
    text += f"All outputs of {len(scenes)} scenes at all communication points, {values} values: "
    text += "the same bits in all libraries.\n\n" if same else f"different bits in these scenes:\n\n{markdown(rows, left=range(len(rows[0])))}\n"
    for index, (name, duration) in enumerate(TIMED.items()):
        say(0.9 + 0.1 * index / len(TIMED), f"timing {name}")
        settings = next(scene[1] for scene in scenes if scene[0] == name)
        seconds = [platform.seconds(settings, duration) for platform in platforms]
        lines.append([name, f"{duration:g} s", f"{1e3 * seconds[0]:.1f} ms",
                      *(f"×{one / seconds[0]:.2f}" for one in seconds[1:])])
    text += markdown(lines) + "\n"
    statuses = {tuple(platform.refuses()) for platform in platforms}
    same &= len(statuses) == 1
    words = "; ".join(", ".join(one) for one in statuses)
    text += (f"An unknown variable, a step before initialisation and a module that is NaN return status {words} "
             f"{'in all' if len(statuses) == 1 else '(NOT alike)'}.\n")
    return text, same


if __name__ == "__main__":
    main()
