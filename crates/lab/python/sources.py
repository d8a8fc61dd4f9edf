"""Builds the unit as sources in C with several compilers, and compares the bits of all outputs with those of the library.

usage: sources.py [--quick] FOLDER SCENES FMU UNIT ZIG

FOLDER is emptied; UNIT is the archive with the sources, ZIG a program or empty.
Prints a table; fails if bits differ, a compiler warns, the C library is called for more than is listed, or a limit is missed."""

import os
import re
import resource
import shutil
import subprocess
import sys
import zipfile
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

import fmpy
import numpy as np

import binaries
import platform_scenes
from bevel_differential.text import markdown
from effects_list import effects
from platform_hosts import STEPS, Platform
from platforms import FMU, compared
from tools import WORKSPACE, Finding, say

# what the sources do without
SOLID, RADAU = "solid", "radau"
# scenes of a quick check: levels, fixed steps, friction that sticks, half-shafts, elastic bodies
QUICK = ("study, turn, tooth", "study, turn, lumped", "turn, fixed_step", "all effects, line", "scenes/hil.toml", "scenes/locked.toml",
         "drive, ideal", "drive, tooth")
# scenes that fmpy runs with what it builds
BY_FMPY = ("study, turn, tooth", "scenes/hil.toml", "scenes/study_turning.toml")
# what the sources may call of the C library; processors without an instruction that rounds take floor and trunc from there
ALLOWED = {"setjmp", "longjmp", "memcpy", "memmove", "memset", "strlen", "sqrt", "floor", "trunc"}
# what compilers for 32-bit ARM bring along for whole numbers, which is no part of the C library
OF_COMPILERS = "__aeabi_"
# the names that libraries have for these
ALIASES = {"_setjmp": "setjmp", "__aeabi_memcpy": "memcpy", "__aeabi_memmove": "memmove", "__aeabi_memset": "memset"}
# scenes that are timed, each in steps of 1 ms [s], so long that they take a tenth of a second or more; how often; and the least speed,
# against the library without wide vectors
TIMED = {"study, turn, tooth": 40.0, "study, turn, lumped": 40.0, "turn, fixed_step": 5.0, "turn, line, restitution": 10.0,
         "all effects, impact": 2.0, "scenes/hil.toml": 40.0}
REPEATS, LEAST_SPEED = 3, 0.35
# written by hand, as opposed to made by wasm2c
OWN = ("bd_runtime.c", "bd_unit.c", "fmi2Functions.c")
# limits: bytes of the sources, and in the archive, seconds of processor time, bytes of an instance
MOST_BYTES, MOST_PACKED, MOST_SECONDS, MOST_MEMORY = 14e6, 1.5e6, 150.0, 4 << 20


class Build:
    """A way to compile: a name, the compiler with its options, what runs its programs, and that for lists of symbols."""

    def __init__(self, name, compiler, runner=(), symbols="nm"):
        self.name, self.compiler, self.runner, self.symbols = name, list(compiler), list(runner), symbols

    def is_there(self):
        return all(shutil.which(str(program)) for program in [self.compiler[0], *self.runner[:1]])


def builds(zig, quick):
    """All of them; one of them in a quick check."""
    if quick:
        # compiles in half the time
        yield Build("gcc -O1", ["gcc", "-O1"])
        return
    yield Build("gcc -O2", ["gcc", "-O2"])
    yield Build("gcc -O2 -march=native", ["gcc", "-O2", "-march=native"])
    if zig:
        yield Build("clang -O2 (zig)", [zig, "cc", "-O2"])
        yield Build("clang -O2 -march=native (zig)", [zig, "cc", "-O2", "-march=native"])
    yield Build("aarch64, gcc -O2", ["aarch64-linux-gnu-gcc", "-O2", "-static"], ["qemu-aarch64"])
    if zig:
        yield Build("armv7, clang -O2 (zig)", [zig, "cc", "-O2", "-target", "arm-linux-musleabihf", "-mcpu=cortex_a9", "-static"], ["qemu-arm"])


def compile_all(build, sources, headers, folder):
    """Compiles every file and links the program that carries out calls; its path, warnings, seconds and what is called."""
    folder.mkdir(parents=True)
    before = processor_time()
    files = sorted(sources.glob("*.c"))
    objects = [folder / f"{file.stem}.o" for file in files]
    with ThreadPoolExecutor(os.cpu_count()) as pool:
        done = list(pool.map(lambda pair: run([*build.compiler, f"-I{headers}", "-c", pair[0], "-o", pair[1]]), zip(files, objects)))
    warnings = [line for one in done for line in one.stderr.splitlines() if "warning:" in line]
    seconds = processor_time() - before
    program = folder / "commands"
    commands = Path(__file__).with_name("commands.c")
    run([*build.compiler, "-DMEMORY", f"-I{headers}", f"-I{sources}", commands, *objects, "-o", program, "-lm"])
    return program, warnings, seconds, called(objects)


def processor_time():
    """Seconds of all programs that were waited for. Short ones are split into user's and system's by chance: their sum is right."""
    used = resource.getrusage(resource.RUSAGE_CHILDREN)
    return used.ru_utime + used.ru_stime


def called(objects):
    """What the objects take from elsewhere, by the names of C."""
    defined, wanted = set(), set()
    for line in run(["nm", "--format=posix", *objects]).stdout.splitlines():
        name, kind = (line.split() + ["", ""])[:2]
        (wanted if kind == "U" else defined).add(name)
    names = {ALIASES.get(name, name) for name in wanted - defined}
    return {name for name in names if not name.startswith(OF_COMPILERS)}


def run(command, **options):
    done = subprocess.run([str(part) for part in command], capture_output=True, text=True, check=False, **options)
    if done.returncode:
        raise SystemExit(f"{' '.join(map(str, command))}:\n{done.stderr[-4000:]}")
    return done


KINDS = {"Real": "r", "Integer": "i", "Enumeration": "i", "Boolean": "b"}


def set_line(fmu, name, value):
    """The call that sets a variable."""
    variable = fmu.variable(name)
    number = variable.number(value)
    kind = KINDS[variable.kind]
    return f"{kind} {variable.reference} {float(number).hex() if kind == 'r' else int(number)}"


def calls_of(platform, values, events, tables, duration):
    """The calls that `Platform.record` makes of a scene."""
    fmu, step = platform.fmu, duration / STEPS
    lines = [f"n {fmu.description.guid}", *(set_line(fmu, name, value) for name, value in values.items())]
    lines += [f"o {fmu.variable(name).reference}" for name in platform.outputs] + ["x"]
    events = sorted(events, key=lambda event: event["time"])
    for k in range(STEPS + 1):
        lines.append("g")
        now = k * step
        while events and events[0]["time"] <= now + 1e-9 * step:
            lines += [set_line(fmu, name, value) for name, value in events.pop(0).items() if name != "time"]
        for table in tables:
            within = now % table["period"] if "period" in table else now
            points = [fmu.variable(table["input"]).number(value) for value in table["value"]]
            lines.append(set_line(fmu, table["input"], float(np.interp(within, table["time"], points))))
        if k < STEPS:
            lines.append(f"d {float(now).hex()} {float(step).hex()}")
    return lines


def timed_calls(platform, values, duration):
    """The calls of a run of which nothing is read before its end; and those of its start alone."""
    start = calls_of(platform, values, [], [], 0.0)
    start = start[:start.index("x") + 1]
    return start, start + [f"d {k * 1e-3!r} 0.001" for k in range(round(duration * 1e3))]


def seconds_of(program, calls, file):
    """The least processor time of the steps: of the whole run without that of its start."""
    def least(lines):
        file.write_text("\n".join(lines) + "\n", encoding="ascii")
        found = []
        for _ in range(REPEATS):
            before = processor_time()
            run([program, file], env={**os.environ, "BEVEL_DIFFERENTIAL_VECTORS": "narrow"})
            found.append(processor_time() - before)
        return min(found)

    start, whole = calls
    return least(whole) - least(start)


def speeds(program, native, timed, folder):
    """Speed of each scene against the library."""
    return [seconds_of(native, calls, folder / "timed") / seconds_of(program, calls, folder / "timed") for calls in timed]


def is_within(scene):
    """Whether the sources can do a scene."""
    return scene[1].get("scene.gear_contact") != SOLID and scene[1].get("solver.method") != RADAU


def main():
    quick, *arguments = sys.argv[1:] if sys.argv[1:2] == ["--quick"] else [None, *sys.argv[1:]]
    folder, scene_files, fmu, unit, zig = arguments
    folder, headers = Path(folder), Path(fmpy.__file__).parent / "c-code"
    shutil.rmtree(folder, ignore_errors=True)
    with zipfile.ZipFile(unit) as archive:
        archive.extractall(folder / "unit")
        packed = sum(entry.compress_size for entry in archive.infolist() if entry.filename.startswith("sources/"))
    sources = folder / "unit" / "sources"
    fmpy.read_model_description(unit, validate=True)
    # what zig compiles of its own, beside its tool chain
    os.environ.setdefault("ZIG_GLOBAL_CACHE_DIR", str(WORKSPACE / "target" / "toolchains" / "zig-cache"))
    native = Platform("native", fmu)
    scenes = [scene for scene in platform_scenes.all_scenes(Path(scene_files), effects(FMU)) if is_within(scene)]
    if quick:
        scenes = [scene for scene in scenes if scene[0] in QUICK]
    wanted, lines, values, taken = [], [], 0, 0
    for name, *scene in scenes:
        say(0.0, f"recording {name}")
        wanted.append(native.record(*scene))
        lines.append(calls_of(native, *scene))
        values += wanted[-1].size
    timed = [timed_calls(native, next(scene[1] for scene in scenes if scene[0] == name), duration)
             for name, duration in ({} if quick else TIMED).items()]
    native.close()
    library = folder / "library"
    run(["gcc", "-O2", f"-I{headers}", Path(__file__).with_name("commands.c"), native.binary, "-o", library, f"-Wl,-rpath,{native.binary.parent}"])
    problems, calls_of_c, rows = [], set(), [["compiler", "scenes", "bits", "speed", "compiled in, s"]]
    known = list(builds(zig, quick))
    for place, build in enumerate(known):
        if not build.is_there():
            rows.append([build.name, "–", "not there", *"––"])
            continue
        say(place / len(known), f"compiling by {build.name}")
        program, warnings, seconds, names = compile_all(build, sources, headers, folder / str(place))
        differing = []
        for scene, expected, calls in zip(scenes, wanted, lines):
            say((place + 0.7) / len(known), f"{build.name}: {scene[0]}")
            file = folder / "calls"
            file.write_text("\n".join(calls) + "\n", encoding="ascii")
            done = subprocess.run([*build.runner, program, file], capture_output=True, check=False)
            told = dict(line.split() for line in done.stderr.decode().splitlines() if line.startswith(("memory ", "allocated ")))
            taken = max(taken, int(told.get("memory", 0)))
            if told.get("allocated") != "0":
                problems.append(f"{build.name}: {scene[0]}: {told.get('allocated')} calls of the allocator after the initialisation")
            found = np.frombuffer(done.stdout, dtype="<f8").reshape(-1, len(native.outputs))
            agrees, words = compared(expected, found)
            if done.returncode or not agrees:
                differing.append(f"{scene[0]}: {words} {done.stderr.decode()[-300:]}")
        fast = [] if build.runner else speeds(program, library, timed, folder)
        rows.append([build.name, str(len(scenes)), "same" if not differing else "different",
                     f"{min(fast):.2f} to {max(fast):.2f}" if fast else "–", f"{seconds:.0f}"])
        calls_of_c |= names
        problems += [f"{build.name}: {problem}" for problem in [*differing, *warnings[:3]]]
        problems += [f"{build.name} calls {name}" for name in sorted(names - ALLOWED)]
        if fast and min(fast) < LEAST_SPEED:
            problems.append(f"{build.name}: speeds {', '.join(f'{speed:.2f}' for speed in fast)}, less than {LEAST_SPEED:g}")
        if seconds > MOST_SECONDS and build.name == "gcc -O2":
            problems.append(f"compiling takes {seconds:.0f} s of processor time, more than {MOST_SECONDS:g}")
    if not quick:
        rows.append(by_fmpy(unit, folder / "fmpy", scenes, wanted, problems))
    size = sum(file.stat().st_size for file in sources.iterdir())
    if packed > MOST_PACKED:
        problems.append(f"{packed / 1e6:.2f} MB of sources in the archive, more than {MOST_PACKED / 1e6:g}")
    problems += checked_by_hand(sources, headers, size)
    problems += refusals(folder, sources, headers, folder / "0")
    text = markdown(rows, left=(0, 2))
    text += f"\n{values} values of {len(scenes)} scenes; {size / 1e6:.1f} MB of sources, {packed / 1e6:.2f} MB in the archive. "
    text += f"They call {', '.join(sorted(calls_of_c))}. An instance uses at most {taken / 2**20:.2f} MiB.\n"
    if problems:
        raise Finding(f"{text}\n" + "\n".join(problems))
    print(text, end="")


def by_fmpy(unit, folder, scenes, wanted, problems):
    """The row of the build by fmpy: what it compiles as its users do, with cmake, runs in fmpy itself."""
    if not shutil.which("cmake"):
        return ["fmpy, gcc -O3", "–", "not there", *"––"]
    say(0.97, "compiling by fmpy")
    with zipfile.ZipFile(unit) as archive:
        archive.extractall(folder)
    with open(folder / "log", "w", encoding="utf-8") as log:
        done = subprocess.run([sys.executable, "-c", "import sys; from fmpy.build import build_platform_binary as b; b(sys.argv[1])", folder],
                              stdout=log, stderr=log, check=False)
    if done.returncode:
        problems.append(f"fmpy cannot build the unit, see {folder / 'log'}")
        return ["fmpy, gcc -O3", "–", "not built", *"––"]
    platform, differing, tried = Platform("fmpy", folder), [], 0
    for (name, *scene), expected in zip(scenes, wanted):
        if name in BY_FMPY:
            tried += 1
            agrees, words = compared(expected, platform.record(*scene))
            differing += [] if agrees else [f"fmpy: {name}: {words}"]
    platform.close()
    exported, _, _ = binaries.of_linux(platform.binary)
    problems += differing + [f"{name} is exported" for name in exported if not name.startswith("fmi2")]
    return ["fmpy, gcc -O3", str(tried), "different" if differing else "same", *"––"]


def checked_by_hand(sources, headers, size):
    """What else must hold of the sources."""
    problems = [f"{size / 1e6:.1f} MB of sources, more than {MOST_BYTES / 1e6:g}"] if size > MOST_BYTES else []
    for name in OWN:
        done = run(["gcc", "-O2", "-Wall", "-Wextra", f"-I{headers}", "-c", sources / name, "-o", "/dev/null"])
        problems += [line for line in done.stderr.splitlines() if "warning:" in line]
    lines = sum(len((sources / name).read_text(encoding="utf-8").splitlines()) for name in ("bd_runtime.h", "bd_runtime.c"))
    if lines > 300:
        problems.append(f"the runtime has {lines} lines, more than 300")
    pages = re.search(r"#define BD_PAGES (\d+)u", (sources / "bd_runtime.h").read_text(encoding="utf-8"))
    if int(pages[1]) * 65536 > MOST_MEMORY:
        problems.append(f"an instance takes {pages[1]} pages, more than {MOST_MEMORY} bytes")
    return problems


def refusals(folder, sources, headers, built):
    """What goes wrong in the program that provokes traps and processors with other arithmetic; `built` holds the objects of the sources."""
    objects = [file for file in built.glob("*.o") if file.stem != "bd_runtime"]
    problems, fused = [], folder / "bd_runtime.c"
    # the runtime as a compiler would see it that does not know the pragma, and fuses
    text = re.sub("#pragma GCC optimize.*", "", (sources / "bd_runtime.h").read_text(encoding="utf-8"))
    (folder / "bd_runtime.h").write_text(text, encoding="utf-8")
    for name in ("bd_runtime.c", "bd_library.h"):
        shutil.copy(sources / name, folder)
    for name, file, options in [("usual", sources / "bd_runtime.c", ["-DARITHMETIC=0"]),
                                ("fused", fused, ["-mfma", "-ffp-contract=fast", "-DARITHMETIC=1"])]:
        program = folder / f"traps-{name}"
        run(["gcc", "-O2", *options, f"-I{file.parent}", f"-I{headers}", f"-I{sources}", Path(__file__).with_name("traps.c"), file, *objects,
             "-o", program, "-lm"])
        done = subprocess.run([program], capture_output=True, text=True, check=False)
        if done.returncode:
            problems.append(f"{name}: {done.stdout}{done.stderr}")
    return problems


if __name__ == "__main__":
    main()
