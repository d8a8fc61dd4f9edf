"""Commands that fail if the library breaks a promise. They check calls, ordinary drives, memory, inactive effects, real-time steps, other
hosts and platforms, C compilers, browsers, and machines without Rust. Two more commands look for source changes that no test notices, and
for wrong coefficients that the evidence does not reveal."""

import json
import subprocess
from pathlib import Path

from . import memcheck as memory
from . import page_tests, platform_units
from .command import Option, command, flag, number, path, write
from .paths import CALL, FMU, SCENES, TARGET, TOOLCHAINS, WORKSPACE, builder, packaged, plain, program, shown, version
from .questions import ask
from .terminal import Failure, Finding
from .work import TESTS

HOSTS = ("tests/hosts", "hosts/venv", "fmpy, libcosimpy, ecospy, FMU Manipulation Toolbox, CasADi")
CHANGES = ("crates/lab/python/mutants", "mutants/venv", "tree-sitter, fmpy")


@command(passes_on=True)
def test_python(work):
    """Packages the FMU and runs the Python tests on it.

    Arguments are passed on to pytest."""
    python, variables = work.environment(*TESTS)
    fmu, built = packaged(), program("fmu-build")
    work.progress.stage("running pytest")
    words = [python, "-m", "pytest", "-p", "no:cacheprovider", "--color=no", "tests/python", *work.options.more]
    done = subprocess.run(words, cwd=WORKSPACE, env={**variables, "FMU": str(fmu), "FMU_BUILD": str(built)}, capture_output=True, encoding="utf-8")
    report = done.stdout + done.stderr
    if done.returncode:
        raise Finding(f"the FMU fails its Python tests:\n{report}")
    print(report, end="")


@command(number("count", 1000, "Number of drives"), number("seed", 1, "The first of the three seeds"),
         number("index", None, "Only this drive of the first seed, in detail"), short=["--count", "300"])
def drives(work):
    """Checks random ordinary drives: launches, stops, holds, turns and parking of vehicles from a pedal car to a truck.

    Drives alternate between three seeds. A drive that violates a requirement is written as JSON."""
    options = work.options
    work.run("crates/lab/python/drives.py", packaged, work.folder("drives"), options.seed, options.count, f"{CALL} drives",
             *([] if options.index is None else [options.index]), doing="driving")


@command(Option(("wheel",), {"metavar": "WHEEL", "nargs": "?", "type": Path, "help": "The wheel [default: the one that the command `wheel` built]"}))
def test_wheel(work):
    """Installs the wheel in a fresh environment without Rust, and checks it there: examples, bits against fmpy, a sweep."""
    folder, wheel = TARGET / "wheel", work.options.wheel
    if wheel is None:
        # names differ between platforms
        wheels = sorted(folder.glob(f"bevel_differential-{version()}-py3-none-*.whl"), key=lambda file: file.stat().st_mtime)
        if not wheels:
            raise Failure(f"no wheel is in {shown(folder)}; build it: cargo run --release -- wheel")
        wheel = wheels[-1]
    if not wheel.is_file():
        raise Failure(f"{shown(wheel)} cannot be read")
    work.run("crates/lab/python/wheel.py", wheel.resolve(), folder, doing="creating a new Python environment")


@command(Option(("page",), {"nargs": "?", "type": Path, "help": "The page [default: the one that the command `page` built]"}),
         path("shots", "DIR", "Keep the screenshots in this folder"))
def test_page(work):
    """Opens the page in Chromium and checks it there: scenes, controls, messages, links, pictures, the bits of the native FMU.

    First make the page, with the command `page`. The tests need node, and Chromium: `chromium` on the search path, or
    the program that the environment variable CHROME names."""
    page_tests.run(work)


@command(flag("quick", "Leave out what each effect costs when it is on"), write("the table in docs/inside/cost.md", without=["quick"]))
def zero_cost(work):
    """Checks that inactive effects cost nothing, compared with a build without effects in bits and instructions (needs valgrind)."""
    work.run("crates/lab/python/zero_cost.py", TARGET / "off", [] if work.options.quick else effects, doing="counting",
             sections=[("docs/inside/cost.md", "off", "")])


@command()
def trace(work):
    """Checks through which files a torque passes on its way to a tooth pair, by backtraces of a debug build (needs gdb)."""
    work.run("crates/lab/python/trace.py", TARGET / "trace", "docs/inside/architecture.md", doing="building without optimisation")


def effects():
    """Names of all effects."""
    listed = packaged().with_name("effects.json").read_text(encoding="utf-8")
    return [effect["name"].rpartition(".")[2] for effect in json.loads(listed)]


@command(flag("quick", "Leave out steps of 10 µs and the levels"), write("the tables in docs/inside/cost.md and docs/accuracy.md", without=["quick"]))
def real_time(work):
    """Checks that no step of the fixed-step method costs more than twice the median, in instructions (needs valgrind)."""
    work.run("crates/lab/python/real_time.py", work.folder("real-time"), TARGET / "off", *work.given("quick"), doing="counting",
             sections=[("docs/inside/cost.md", "real-time", ""), ("docs/accuracy.md", "levels", "levels.md")])


@command(number("calls", 1_000_000, "Number of calls", metavar="N"),
         number("seed", 1, "Seed of the first round; it rises by 1 from round to round", metavar="S"),
         number("fmi", None, "Version of FMI: 2 or 3 [default: alternating with the seed]", least=2, most=3, metavar="N"),
         short=["--calls", "100000"])
def fuzz(work):
    """Calls the C functions at random and checks each result against the promises of the FMU."""
    options = work.options
    work.run("crates/lab/python/fuzz.py", program("lab"), -(-options.calls // memory.CALLS), memory.CALLS, options.seed, f"{CALL} fuzz",
             *([] if options.fmi is None else [options.fmi]), doing="calling")


@command(number("count", 100_000, "Number of questions"), number("threads", 8, "Number of threads"), number("seed", 1, "Seed of the random numbers"))
def questions(work):
    """Asks the library of answers random questions, from several threads at the same time."""
    program("lab")
    work.progress.stage("asking")
    ask(work.options.count, work.options.seed, work.options.threads)


@command(number("questions", 200, "Number of random questions"))
def memcheck(work):
    """Checks a host in C, random calls and random questions for memory errors and leaks (needs valgrind and cc)."""
    memory.run(work)


SEED = number("seed", 1, "Seed of the draw")


@command(number("count", 120, "Number of changes"), SEED, write("the report in docs/inside/architecture.md"), short=["--count", "8"])
def mutants(work):
    """Changes the source in one place at a time and lists the changes that no test notices (continues where it was stopped)."""
    change(work, "mutants", doing="trying changes", sections=[("docs/inside/architecture.md", "mutants", "")])


@command(number("count", 20, "Number of coefficients"), SEED, write("docs/coefficients.csv"), short=["--count", "8"])
def coefficients(work):
    """Makes coefficients of the physics 2 % larger, one at a time, and lists what `verify` notices."""
    change(work, "coefficients", packaged, doing="verifying", sections=[("docs/coefficients.csv", "", "coefficients.csv")])


def change(work, name, *fmu, **options):
    """Runs the campaign of `mutants` or `coefficients`."""
    count, seed = work.options.count, work.options.seed
    folder = TARGET / name / f"{seed}-{count}"
    work.run("crates/lab/python/mutants/campaign.py", WORKSPACE, work.folder(folder), count, seed, *fmu, environment=CHANGES, **options)


@command(flag("require", "Fail if a host cannot be loaded"), write("docs/inside/hosts.md"),
         flag("with-fmi-sim", "Also run fmi-sim (builds for many minutes)"))
def hosts(work):
    """Runs the FMU in other FMI hosts on the same scenes and compares their results with fmpy's."""
    work.run("crates/lab/python/hosts.py", FMU, plain, work.folder("hosts"), *work.given("require", "with-fmi-sim"), environment=HOSTS,
             doing="running hosts", sections=[("docs/inside/hosts.md", "hosts", "")])


@command(write("docs/inside/hosts.md"))
def platforms(work):
    """Checks that the libraries of all platforms give the same bits, Windows under wine, ARM under qemu; inspects the one for macOS."""
    work.run("crates/lab/python/platforms.py", SCENES, lambda: platform_units.arguments(work), environment=TESTS, doing="comparing",
             sections=[("docs/inside/hosts.md", "platforms", "")])


@command(flag("quick", "Only gcc -O1, and six scenes"), write("docs/inside/hosts.md", without=["quick"]))
def sources(work):
    """Checks that the unit as sources in C gives the same bits with several compilers, on x86-64 and on ARM under qemu.

    It needs the tool chains `sources` and, for clang and ARMv7, `linux64`; for ARM apt install gcc-aarch64-linux-gnu
    libc6-dev-arm64-cross qemu-user. Missing compilers are left out."""

    def unit():
        file = FMU.with_name("BevelDifferential_sources.fmu")
        said = builder("package", "--sources", *work.given("quick")).splitlines()
        if not any(line.endswith(file.name) for line in said):
            raise Failure(said[-1])
        return file

    zig = next((TOOLCHAINS / "linux").glob("lib/python*/site-packages/ziglang/zig"), "")
    work.run("crates/lab/python/sources.py", *work.given("quick"), work.folder("sources"), SCENES, FMU, unit, zig, environment=TESTS,
             doing="comparing", sections=[("docs/inside/hosts.md", "sources", "")])
