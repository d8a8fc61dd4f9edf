"""Unit as sources in C in a loop of 1 ms: instructions of each step, memory and stack."""

import shutil
import statistics
import tomllib
import zipfile
from pathlib import Path

import fmpy
import numpy as np

from bevel_differential import Fmu
from bevel_differential.scene_file import flat
from calls import write_start
from counting import callgrind, counts
from tools import WORKSPACE, completed, say

# path of the packed unit
UNIT = WORKSPACE / "target" / "fmu" / "BevelDifferential_sources.fmu"
# remark if the unit is missing
REMARK = "The C build is left out; to get it: cargo run --release -- package --sources\n"
STEP = 1e-3
# counted intervals of the drive of the scene hil [s], in which its changes begin and end
WINDOWS = ((0.0, 0.05), (1.99, 2.06), (2.48, 2.53), (2.98, 3.05), (3.98, 4.03), (4.98, 5.25))
# teeth: the study's turn, with loads that alternate every 50 steps, and the number of steps of the test without C
TEETH = {"scene.planet_spin": "imposed", "spin.command": "200 deg/s", "carrier.speed_command": "954 deg/s"}
LOADS, TURN, STEPS = ("left.load_torque", "right.load_torque"), 50, 300
OUTPUTS = ("carrier.speed", "left.shaft_torque", "right.shaft_torque", "planet[1].spin_speed")


def hil(fmu):
    """Start values, inputs with their values at each step, and True for each step that is counted."""
    scene = tomllib.loads((WORKSPACE / "scenes" / "hil.toml").read_text(encoding="utf-8"))
    times = np.arange(round(6.0 / STEP)) * STEP
    inputs = {}
    for table in scene["table"]:
        points = [fmu.variable(table["input"]).number(value) for value in table["value"]]
        inputs[table["input"]] = np.interp(times, table["time"], points)
    counted = [any(begin <= time < end for begin, end in WINDOWS) for time in times]
    return flat(scene["set"]), inputs, counted


def teeth(_):
    """Start values, inputs and counted steps of the turn."""
    loads = [835.0 if k // TURN % 2 == 0 else -835.0 for k in range(STEPS)]
    return TEETH | {"scene.start": "rolling"}, {name: np.array(loads) for name in LOADS}, [True] * STEPS


# scenes, each with step sizes of the method [s]
SCENES = (("hil", hil, ("1e-3",)), ("turn, rolling, reversal", teeth, ("1e-3", "1e-4")))


def compiled(folder):
    """Compiles the loop with the sources by gcc. Returns the program and the unit."""
    shutil.rmtree(folder, ignore_errors=True)
    with zipfile.ZipFile(UNIT) as unit:
        unit.extractall(folder)
    headers, objects = Path(fmpy.__file__).parent / "c-code", []
    files = sorted((folder / "sources").glob("*.c"))
    for place, file in enumerate([*files, Path(__file__).with_name("loop.c")]):
        say(place / len(files) / 2, f"compiling {file.name}")
        objects.append(folder / f"{file.stem}.o")
        completed(["gcc", "-O2", f"-I{headers}", f"-I{folder / 'sources'}", "-c", file, "-o", objects[-1]],
                  "gcc compiles the sources: install it (apt-get install gcc)")
    completed(["gcc", *objects, "-o", folder / "loop", "-lm", "-lpthread"])
    return folder / "loop", Fmu(folder)


def rows(folder):
    """Rows of the table: scene, step size, median and most expensive step; and a remark on memory and stack of an instance."""
    program, fmu = compiled(folder)
    found, told = [], {}
    for name, scene, sizes in SCENES:
        values, inputs, counted = scene(fmu)
        drive = [" ".join(str(fmu.variable(name).reference) for name in inputs)]
        drive += [" ".join(["01"[mark], *(repr(float(series[k])) for series in inputs.values())]) for k, mark in enumerate(counted)]
        (folder / "drive").write_text("\n".join(drive) + "\n", encoding="ascii")
        for size in sizes:
            say(0.5 + 0.5 * len(found) / 3, f"counting C, {name}, steps of {size} s")
            write_start(folder / "set", fmu, values | {"solver.method": "fixed_step", "solver.fixed_step": float(size)})
            arguments = [fmu.description.guid, folder / "set", folder / "drive", *(str(fmu.variable(one).reference) for one in OUTPUTS)]
            for line in completed([program, *arguments]).stdout.splitlines():
                what, _, number = line.rpartition(" ")
                if what:
                    told[what] = max(told.get(what, 0), int(number))
            dumps = folder / "counts"
            shutil.rmtree(dumps, ignore_errors=True)
            dumps.mkdir()
            callgrind(program, arguments, ["--toggle-collect=one_communication_step", "--dump-after=one_communication_step"], dumps / "count")
            of_steps = counts(dumps, first=1)
            found.append([f"C: {name}", size, statistics.median(of_steps), max(of_steps)])
    remark = (f"C: an instance takes {told['instance'] / 2**20:.2f} MiB, of which at most {told['used'] / 2**20:.2f} are used, "
              f"{told['stack'] / 1024:.0f} KiB of the program's stack and {told['stack within'] / 1024:.0f} KiB of a stack of its own.\n")
    return found, remark
