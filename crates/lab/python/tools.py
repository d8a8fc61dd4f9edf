"""Shared tools of the laboratory's scripts: progress, files of measurements, numbers for readers, sections of documents."""

import csv
import math
import os
import platform
import queue
import subprocess
import sys
import threading
from pathlib import Path

from bevel_differential.command import FINDING

WORKSPACE = Path(__file__).resolve().parents[3]
# smaller numbers are shown with a power of ten
SMALL = 1e-3
# larger fractions are shown as multiples
MANY = 10.0


class Finding(SystemExit):
    """Ends a script whose check completed with a finding."""

    def __init__(self, text):
        print(text, file=sys.stderr, flush=True)
        super().__init__(FINDING)


def say(fraction, what):
    """Moves the bar of the command that runs the script."""
    print(f"progress {fraction:.4f} {what}", file=sys.stderr, flush=True)


def tell(text, file):
    """Prints a text and writes it to a file."""
    file.write_text(text, encoding="utf-8")
    print(text, end="")


def completed(command, missing="", **options):
    """Runs a program and returns the completed process. Exits with the end of its errors if it fails, or with `missing` if it is not
    installed."""
    command = list(map(str, command))
    try:
        done = subprocess.run(command, capture_output=True, text=True, **options)
    except FileNotFoundError:
        raise SystemExit(missing or f"{command[0]} is missing") from None
    if done.returncode:
        raise SystemExit(f"{' '.join(command)}:\n{done.stderr[-4000:]}")
    return done


def lines(process, patience):
    """Lines that a process prints. If it prints nothing for `patience` seconds, it is ended, and the error is a `TimeoutError`."""
    found = queue.Queue()
    threading.Thread(target=lambda: [*map(found.put, process.stdout), found.put(None)], daemon=True).start()
    try:
        while (line := found.get(timeout=patience)) is not None:
            yield line
    except queue.Empty:
        process.kill()
        raise TimeoutError(f"no answer in {patience:g} s") from None


def machine():
    """Processor, cores and system, in one line."""
    known = Path("/proc/cpuinfo")
    lines = known.read_text(encoding="utf-8").splitlines() if known.is_file() else []
    model = next((line.split(":", 1)[1].strip() for line in lines if line.startswith("model name")), "processor not named")
    return f"{model}, {os.cpu_count()} cores, {sys.platform} {platform.machine()}"


def write_measured(path, comments, rows):
    """Writes a CSV file of measurements on this machine: comments, then rows, the first of which is the header."""
    with open(path, "w", newline="", encoding="utf-8") as file:
        file.writelines(f"# {comment}\n" for comment in [f"machine: {machine()}", *comments])
        csv.writer(file, lineterminator="\n").writerows([cell_of(value) for value in row] for row in rows)


def cell_of(value):
    """Formats a number with seven digits, or a text on one line that is never empty."""
    return f"{value:.6e}" if isinstance(value, float) else str(value).replace("\n", " ") or "-"


def significant(value, digits):
    """Formats a number with `digits` significant digits; whole numbers keep all of their digits."""
    if not math.isfinite(value):
        return "–"
    if value == 0.0:
        return "0"
    if abs(value) < SMALL:
        return f"{value:.{max(digits - 2, 0)}e}".replace("e-0", "e-")
    return f"{value:.{max(digits - 1 - math.floor(math.log10(abs(value))), 0)}f}"


def percent(fraction):
    """Formats a fraction in per cent with two significant digits, or a large one as a multiple."""
    if not math.isfinite(fraction):
        return "no number"
    if fraction >= MANY:
        return f"{fraction:.0f} x"
    decimals = max(1 - math.floor(math.log10(100.0 * abs(fraction))), 0) if fraction else 0
    return f"{100.0 * fraction:.0e} %".replace("e-0", "e-") if decimals > 5 else f"{100.0 * fraction:.{decimals}f} %"
