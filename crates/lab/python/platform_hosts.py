"""Hosts for the libraries of all platforms: this process, fmpy's server under wine, and qemu; libraries for macOS are only inspected."""

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
from bevel_differential import DifferentialError, Fmu
from emulated import Emulated

# prevents wider vector instructions, for platforms whose names have this ending
VECTORS, NARROW = "BEVEL_DIFFERENTIAL_VECTORS", "narrow"
# number of communication steps of a scene
STEPS = 100
# number of timings of a step
REPEATS = 3
# port of fmpy's server, time limit of its start [s], and pause between checks [s]
PORT, START_TIMEOUT, PAUSE = 8080, 60.0, 0.1


def course(fmu, events, tables, duration):
    """Communication points of a scene: time, next step (0 at the end), and values that change there."""
    step, events = duration / STEPS, sorted(events, key=lambda event: event["time"])
    for k in range(STEPS + 1):
        now, settings = k * step, {}
        while events and events[0]["time"] <= now + 1e-9 * step:
            settings |= {name: value for name, value in events.pop(0).items() if name != "time"}
        for table in tables:
            within = now % table["period"] if "period" in table else now
            points = [fmu.variable(table["input"]).number(value) for value in table["value"]]
            settings[table["input"]] = float(np.interp(within, table["time"], points))
        yield now, step if k < STEPS else 0.0, settings


class Platform:
    """An FMU with one library that runs in this process."""

    run_by = "this machine"
    # compiler and linker
    built_by = property(lambda self: "Rust, zig" if "glibc" in self.name else "Rust, gcc")
    # True if its times are representative of a processor
    is_timed = True

    def __init__(self, name, fmu):
        self.name = name
        self.folder = Path(fmu) if Path(fmu).is_dir() else Path(extract(str(fmu)))
        self.binary = next((self.folder / "binaries").glob("*/*"))
        self.fmu = Fmu(self.folder)
        self.outputs = [variable.name for variable in self.fmu.variables.values() if variable.causality == "output" and variable.kind == "Real"]

    def close(self):
        """Ends everything that was started."""

    def opened(self):
        """Creates an instance."""
        # a library reads this variable at its first step
        os.environ[VECTORS] = NARROW if self.name.endswith(NARROW) else ""
        return self.fmu.open()

    def end(self, instance):
        """Frees an instance."""
        instance.close()

    def described(self):
        """Exported functions, required libraries, and the oldest system."""
        exported, needed, glibc, _ = binaries.of_linux(self.binary)
        return exported, needed, f"glibc {'.'.join(map(str, glibc))}"

    def start(self, values):
        """Creates and initialises an instance."""
        return self.opened().initialise(values)

    def record(self, values, events, tables, duration):
        """All outputs at all communication points."""
        instance, rows = self.start(values), []
        for now, step, settings in course(self.fmu, events, tables, duration):
            rows.append(instance.read(self.outputs))
            instance.set(settings)
            if step:
                instance.do_step(now, step)
        self.end(instance)
        return np.array(rows, dtype=float)

    def seconds(self, values, duration):
        """Minimum time of one step of `duration`."""
        least = np.inf
        for _ in range(REPEATS):
            instance = self.start(values)
            begin = time.perf_counter()
            instance.step(duration)
            least = min(least, time.perf_counter() - begin)
            self.end(instance)
        return least

    def refuses(self):
        """Statuses returned by wrong calls, after which the library must stay usable."""
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


class Windows(Platform):
    """A platform that runs in fmpy's server under wine."""

    run_by, built_by = "wine", "Debian's Rust, MinGW"

    def __init__(self, name, fmu, wine):
        super().__init__(name, fmu)
        self.wine, self.server = wine, None
        add_remoting(str(self.folder), "linux64", "win64")

    def close(self):
        if self.server:
            self.server.terminate()
            self.server.wait()
            self.server = None

    def opened(self):
        # a new server, because a server ends with its instance
        self.close()
        self.serve()
        return super().opened()

    def end(self, instance):
        # together with its server, because fmpy's client waits forever for a server that it did not start
        instance.forget()
        self.close()

    def described(self):
        return *binaries.of_windows(self.binary), "–"

    def serve(self):
        """Starts fmpy's server before anything connects, because its client would time out while wine loads the library."""
        deadline = time.monotonic() + START_TIMEOUT
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
            sys.exit(f"{problem}: no success after {START_TIMEOUT:g} s")
        time.sleep(PAUSE)


class Arm(Platform):
    """A platform for ARM, which runs in a host in C under qemu."""

    run_by, built_by, is_timed = "qemu", "Debian's Rust, zig", False

    def __init__(self, name, fmu, emulator, host):
        super().__init__(name, fmu)
        self.command = [emulator, host]

    def opened(self):
        return Emulated(self.fmu, self.command, self.binary)


class MacOS(Platform):
    """A platform for macOS, which nothing here can run."""

    run_by, built_by = None, "Debian's Rust, lld"

    def described(self):
        found = binaries.of_macos(self.binary)
        assert set(found) == set(binaries.PROCESSORS.values()), f"{self.name} has code only for {', '.join(found)}"
        for processor, library in found.items():
            assert library.signature == "ad hoc", f"{self.name}, {processor}: signature {library.signature}"
            assert not library.searched and all(name.startswith("@rpath/") for name in library.own_name), f"{self.name}: a path"
        one, other = found["x86_64"], found["arm64"]
        assert set(one.exported) == set(other.exported), f"{self.name}: the processors' functions differ"
        return one.exported, sorted({*one.needed, *other.needed}), f"macOS {one.oldest}, {other.oldest} on ARM"


def is_listening():
    """True if a server waits on the port. The check does not connect, because the server accepts only one client."""
    with open("/proc/net/tcp", encoding="ascii") as sockets:
        rows = [line.split() for line in sockets][1:]
    return any(row[1].endswith(f":{PORT:04X}") and row[3] == "0A" for row in rows)
