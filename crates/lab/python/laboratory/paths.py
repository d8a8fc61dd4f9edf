"""Folders of the workspace and of the target directory, and the programs that cargo builds."""

import functools
import os
import re
import subprocess
import sys
from pathlib import Path

from .terminal import Failure

# command line of users
CALL = "python3 crates/lab/lab.py"
WORKSPACE = Path(__file__).resolve().parents[4]
TARGET = WORKSPACE / os.environ.get("CARGO_TARGET_DIR", "target")
SCENES = WORKSPACE / "scenes"
FMU = TARGET / "fmu" / "BevelDifferential.fmu"
TOOLCHAINS = TARGET / "toolchains"


def shown(path):
    """A path relative to the present folder or to the workspace, for messages."""
    for folder in (Path.cwd(), WORKSPACE):
        if folder in path.parents:
            return str(path.relative_to(folder))
    return str(path)


def version():
    """Version of the workspace."""
    return re.search(r'^version = "(.*)"', (WORKSPACE / "Cargo.toml").read_text(encoding="utf-8"), re.MULTILINE)[1]


def library(name):
    """Path of a dynamic library that cargo built. Cargo updates the copy outside `deps` only if the library itself was requested."""
    prefix, ending = {"win32": ("", "dll"), "darwin": ("lib", "dylib")}.get(sys.platform, ("lib", "so"))
    return TARGET / "release" / "deps" / f"{prefix}{name}.{ending}"


def cargo(*words):
    """Runs cargo with the profile of the user's first command, so that nothing is compiled twice. It shows its progress and errors."""
    command = [os.environ.get("CARGO", "cargo"), *words, "--release"]
    try:
        done = subprocess.run(command, cwd=WORKSPACE, stdin=subprocess.DEVNULL)
    except FileNotFoundError:
        raise Failure(f"{command[0]} cannot be run: install Rust (see rustup.rs)") from None
    if done.returncode:
        raise Failure("the program cannot be built")


@functools.cache
def program(name):
    """Path of a program of the workspace. It is built again if a source has changed."""
    file = TARGET / "release" / (f"{name}.exe" if sys.platform == "win32" else name)
    if not is_current(file):
        cargo("build", "--bin", name)
    return file


def is_current(file):
    """True if a program is newer than its sources, which cargo lists next to it. Cargo itself would wait for other builds."""
    listed = file.with_suffix(".d")
    if not (file.is_file() and listed.is_file()):
        return False
    sources = listed.read_text(encoding="utf-8").partition(": ")[2].replace("\\ ", "\0").split()
    sources = [Path(source.replace("\0", " ")) for source in sources] + [WORKSPACE / "Cargo.lock"]
    return all(source.is_file() and source.stat().st_mtime <= file.stat().st_mtime for source in sources)


def printed(name, *words):
    """Output of a program of the workspace, which shows its own progress and errors. If it fails, the laboratory ends with its status."""
    done = subprocess.run([program(name), *map(str, words)], stdout=subprocess.PIPE, stdin=subprocess.DEVNULL, encoding="utf-8", cwd=WORKSPACE)
    if done.returncode < 0:
        raise Failure(f"{name} crashed (signal {-done.returncode})")
    if done.returncode:
        print(done.stdout, end="", flush=True)
        sys.exit(done.returncode)
    return done.stdout


def builder(*words):
    """Output of a command of fmu-build."""
    return printed("fmu-build", *words)


def packaged(*options):
    """Path of the packaged FMU."""
    builder("package", *options)
    return FMU


def plain():
    """Path of the packaged FMU with integers instead of enumerations."""
    return packaged("--integers").with_name("BevelDifferential_integers.fmu")


def equations():
    """Path of a library with the equations of motion, for other solvers."""
    # together with fmu-build, so that both have the same features and shared crates are compiled once
    cargo("build", "--lib", "-p", "fmu-build", "-p", "foreign-solvers")
    return library("foreign_solvers")
