"""Test of the page in a browser: Chromium runs it as a reader does. Its results are compared with those of node and of the native FMU."""

import csv
import os
import shutil
import subprocess

from .documents import locked
from .paths import TARGET, WORKSPACE, packaged, shown
from .terminal import Failure, Finding, aligned

# folder of the tests, name of their Python environment, and its packages
ENVIRONMENT = ("tests/browser", "browser", "playwright, pytest, fmpy, numpy")
# environment variable for a Chromium that is not on the search path
CHROME = "CHROME"


def run(work):
    """Runs the tests and prints a table of what was checked."""
    page = work.options.page or TARGET / "page" / "BevelDifferential.html"
    if not page.is_file():
        raise Failure(f"{shown(page)} is not there; make it: cargo run --release -- page")
    node, chromium = runnable("node", "node is not installed: apt install nodejs (or see nodejs.org)"), chromium_file()
    python, variables = work.environment(*ENVIRONMENT)
    fmu = packaged()
    work.progress.stage("testing the page")
    folder = TARGET / "browser"
    checked, shots = folder / "checked.csv", work.options.shots
    if shots:
        shots.mkdir(parents=True, exist_ok=True)
    words = [python, "-m", "pytest", "-p", "no:cacheprovider", "--color=no", "--tb=short", "--table", checked, WORKSPACE / ENVIRONMENT[0],
             *(["--shots", shots.resolve()] if shots else [])]
    variables |= {"PAGE": str(page.resolve()), "FMU": str(fmu), "BEVEL_DIFFERENTIAL_FMU": str(fmu), "NODE": node, "CHROMIUM": chromium}
    with locked(folder):
        done = subprocess.run(words, env=variables, capture_output=True, encoding="utf-8")
    if done.returncode:
        raise Finding(f"the page fails its tests:\n{done.stdout}{done.stderr}")
    work.progress.finish()
    with checked.open(encoding="utf-8", newline="") as file:
        print("\n".join(aligned([["checked", "cases", "found", "time, s"], *csv.reader(file)], (0, 2))))


def chromium_file():
    """File of Chromium."""
    named = os.environ.get(CHROME)
    if named:
        return runnable(named, f"{CHROME} = {named}: this program does not run; name a Chromium")
    return runnable("chromium", f"Chromium is not installed: apt install chromium, or name one by {CHROME}")


def runnable(name, missing):
    """File of a program that runs, on the search path unless `name` is a path. Fails with the message `missing`."""
    file = shutil.which(name)
    try:
        if file and not subprocess.run([file, "--version"], stdin=subprocess.DEVNULL, capture_output=True).returncode:
            return file
    except OSError:
        pass
    raise Failure(missing)
