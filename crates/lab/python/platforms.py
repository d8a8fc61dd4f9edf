"""Simulates the same scenes with the library for each platform and compares the bits of all outputs; inspects the library for macOS.

usage: platforms.py SCENES FOLDER TOOL=FILE... NAME=FMU...

Each FMU contains the library for one platform; the others are compared with the first one. Tools: wine runs the library for win64 in
fmpy's server; qemu runs the library for aarch64-linux in far.c, which zig builds in FOLDER. Prints the tables of docs/inside/hosts.md. Fails if
any bits differ, or if a library for macOS is wrong. Lines "progress FRACTION WHAT" on standard error report progress.
"""

import sys
from pathlib import Path

import numpy as np

import emulated
import platform_hosts
import platform_scenes
from bevel_differential.text import markdown
from effects_list import effects
from tools import WORKSPACE, Finding, say

# the list of effects is next to this file
FMU = WORKSPACE / "target" / "fmu" / "BevelDifferential.fmu"
# timed scenes, each as one step of this length [s]
TIMED = {"study, turn, tooth": 2.0, "study, turn, solid": 0.02, "all effects, impact": 0.05}
# prefixes of libraries that every program of the system uses
C_LIBRARIES = ("libc.so", "libm.so", "libdl.so", "libpthread.so", "ld-linux", "/usr/lib/libSystem.B.dylib")
TOOLS = ("wine", "qemu", "zig")
# target for which far.c is built
ARM = "aarch64-linux-gnu.2.17"


def platform(name, fmu, tools, folder):
    """Host of the FMU with this name."""
    if name.startswith("win64"):
        return platform_hosts.Windows(name, fmu, tools["wine"])
    if name.startswith("aarch64-linux"):
        host = emulated.compiled([tools["zig"], "-m", "ziglang", "cc", "-target", ARM], folder)
        return platform_hosts.Arm(name, fmu, tools["qemu"], host)
    if name.startswith("darwin64"):
        return platform_hosts.MacOS(name, fmu)
    return platform_hosts.Platform(name, fmu)


def compared(one, other):
    """True if all bits agree, and a description of the difference."""
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
    folder, work, *pairs = sys.argv[1:]
    named = dict(pair.split("=", 1) for pair in pairs)
    tools = {name: named.pop(name) for name in TOOLS if name in named}
    platforms = []
    try:
        for name, fmu in named.items():
            say(0.0, f"starting {name}")
            platforms.append(platform(name, fmu, tools, work))
        text, same = tables(platforms, list(platform_scenes.all_scenes(Path(folder), effects(FMU))))
    finally:
        for each in platforms:
            each.close()
    if not same:
        raise Finding(f"the libraries do not agree:\n{text}")
    print(text, end="")


def tables(platforms, scenes):
    """The tables, and True if everything agrees."""
    run = [each for each in platforms if each.run_by]
    text, same, values = comparison(run, scenes)
    described = [each.described() for each in platforms]
    rows = [["library", "built by", "run by", "other bits", "MB", "oldest system"]]
    needs = {}
    for each, (_, needed, oldest) in zip(platforms, described):
        bits = "–" if each is run[0] or not each.run_by else "none" if same else "see below"
        size = f"{each.binary.stat().st_size / 1e6:.2f}"
        rows.append([each.name, each.built_by, each.run_by or "inspected alone", bits, size, oldest])
        # several FMUs of one platform may have equal needs
        needs.setdefault(", ".join(name for name in needed if not name.startswith(C_LIBRARIES)), each.name)
    counts = " or ".join(sorted({str(len(exported)) for exported, *_ in described}))
    foreign = ", ".join(sorted({name for exported, *_ in described for name in exported if not name.startswith(("fmi2", "fmi3"))}))
    head = markdown(rows, left=(0, 1, 2, 3, 5)) + "\n"
    head += f"Each exports {counts} functions, {'not of FMI: ' + foreign if foreign else 'all of FMI'}. Beside the system's C library "
    head += "; ".join(f"{name} needs {needed}" for needed, name in needs.items() if needed) + ".\n\n"
    head += f"All outputs of {len(scenes)} scenes at all communication points, {values} values: "
    text = head + text + timed(run, scenes)
    statuses = {tuple(each.refuses()) for each in run}
    words = "; ".join(", ".join(one) for one in statuses)
    text += (f"\nAn unknown variable, a step before initialisation and a module that is NaN return status {words} "
             f"{'in all that run' if len(statuses) == 1 else '(NOT alike)'}.\n")
    return text, same and len(statuses) == 1


def comparison(run, scenes):
    """Description of the differences, True if there are none, and the number of values."""
    first, *others = run
    values, rows = 0, [["scene", *(each.name for each in others)]]
    for index, (name, settings, *rest) in enumerate(scenes):
        say(0.9 * index / len(scenes), name)
        wanted = first.record(settings, *rest)
        found = [compared(wanted, each.record(settings, *rest)) for each in others]
        values += wanted.size
        if not all(agrees for agrees, _ in found):
            rows.append([name, *(words for _, words in found)])
    same = len(rows) == 1
    text = "the same bits in all libraries that run.\n\n" if same else f"different bits in these scenes:\n\n{markdown(rows, left=range(len(rows[0])))}\n"
    return text, same, values


def timed(run, scenes):
    """Table of the times of one step, without emulators because their times say nothing about a processor."""
    first, *others = [each for each in run if each.is_timed]
    lines = [["one step", "simulated", first.name, *(each.name for each in others)]]
    for index, (name, duration) in enumerate(TIMED.items()):
        say(0.9 + 0.1 * index / len(TIMED), f"timing {name}")
        settings = next(scene[1] for scene in scenes if scene[0] == name)
        seconds = [each.seconds(settings, duration) for each in (first, *others)]
        lines.append([name, f"{duration:g} s", f"{1e3 * seconds[0]:.1f} ms",
                      *(f"×{one / seconds[0]:.2f}" for one in seconds[1:])])
    return markdown(lines)


if __name__ == "__main__":
    main()
