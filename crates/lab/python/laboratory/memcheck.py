"""Check for memory errors and leaks: a host in C that uses instances from creation to end, random calls, and random questions run under
valgrind's memcheck."""

import json
import os
import re
import subprocess
import tempfile
import time
import xml.etree.ElementTree as xml
from pathlib import Path

from .paths import CALL, WORKSPACE, library, program
from .questions import write
from .terminal import Failure, Finding, aligned

# number of rounds of random calls, half of them for each version of FMI, and calls of a round
ROUNDS, CALLS = 20, 500
# Longest processor time of a random call [s]. A few calls are steps of very stiff scenes, and need more time than all other calls together.
LONGEST = 0.2
VALGRIND = ["valgrind", "--leak-check=full", "--error-exitcode=99", "--errors-for-leak-kinds=definite,indirect,possible",
            "--show-leak-kinds=definite,indirect,possible", "--num-callers=30"]


def run(work):
    """Runs everything under memcheck and prints a table. Fails if there is an error or a leak."""
    work.progress.stage("building the library and the host")
    lab = program("lab")
    with tempfile.TemporaryDirectory() as folder:
        life = Path(folder, "life")
        compiler = ["cc", "-std=gnu11", "-O1", "-g", "-Wall", "-Wextra", "-Werror", "-o", life, WORKSPACE / "tests/c/life.c", "-ldl", "-lm"]
        done = completed(compiler, "a C compiler builds the hosts: install one (apt-get install gcc)")
        if done.returncode:
            raise Failure(f"life.c: {done.stderr}")
        asked = Path(folder, "questions")
        write(asked, work.options.questions, seed=1)
        work.progress.stage("looking for calls that take no time")
        checks = {
            "life of instances, in C": [life, *host_arguments()],
            "calls at random": [lab, "fuzz", "--rounds", str(ROUNDS), "--calls", str(CALLS), "--seed", str(quick_seed(lab))],
            "questions at random": [lab, "questions", asked, "1"],
        }
        rows = [["program", "checker", "errors", "bytes lost", "time, s"]]
        for name, command in checks.items():
            work.progress.stage(f"memcheck on {name}")
            rows.append(checked(name, command))
    work.progress.finish()
    print("\n".join(aligned(rows, (0, 1))))


def completed(command, missing, **variables):
    """The completed process of a program. Fails with `missing` if the program is not installed."""
    try:
        return subprocess.run(command, capture_output=True, encoding="utf-8", errors="replace", env={**os.environ, **variables})
    except FileNotFoundError:
        raise Failure(missing) from None


def host_arguments():
    """Arguments of hosts in C: library, GUID, value references of an input and of an output."""
    description = xml.parse(WORKSPACE / "modelDescription" / "modelDescription.xml").getroot()
    references = {row.get("name"): row.get("valueReference") for row in description.iter("ScalarVariable")}
    return [library("bevel_differential"), description.get("guid"), references["left.load_torque"], references["left.speed"]]


def quick_seed(lab):
    """The first seed of ROUNDS successive rounds in which every call takes at most LONGEST without memcheck."""
    first = seed = 1
    while seed < first + ROUNDS:
        done = completed([lab, "fuzz", "--rounds", "1", "--calls", str(CALLS), "--seed", str(seed)], "the program is missing")
        if done.returncode:
            raise Finding(f"{done.stderr}\nagain: {CALL} fuzz --seed {seed} --calls {CALLS}")
        seed += 1
        if json.loads(done.stdout.splitlines()[-1])["longest"]["seconds"] > LONGEST:
            first = seed
    return first


def checked(name, command):
    """Runs a program under memcheck and returns its row of the table."""
    begin = time.monotonic()
    # valgrind may not support all instructions on wider vectors
    done = completed([*VALGRIND, *command], "valgrind checks the memory: install it (apt-get install valgrind)",
                     BEVEL_DIFFERENTIAL_VECTORS="narrow")
    if done.returncode:
        raise Finding(f"{name} (exit status: {done.returncode}):\n{done.stderr.rstrip()}\n"
                      "to see names of functions, build and run again with CARGO_PROFILE_RELEASE_STRIP=none")
    errors, lost = (re.search(pattern, done.stderr) for pattern in ("ERROR SUMMARY: (.*?) errors", "definitely lost: (.*?) bytes"))
    if not errors:
        raise Failure("valgrind reported no count of errors")
    return [name, "memcheck", errors[1], lost[1] if lost else "0", f"{time.monotonic() - begin:.1f}"]
