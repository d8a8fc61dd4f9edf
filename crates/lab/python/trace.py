"""Files on the way of a torque to the law of a tooth pair, and of a speed to the host, from the backtraces of a debug build.

Usage: trace.py FOLDER PAGE

gdb stops in the setter of `left.load_torque`, in the law of a pair in a stage of the solver, and where `left.speed` is read from the state
and from the motion. Prints the table of PAGE with the files of these backtraces, and fails if their number exceeds the limits or if PAGE
lists other files."""

import os
import re
import subprocess
import sys
import tempfile
import xml.etree.ElementTree as ET
from pathlib import Path

from tools import WORKSPACE, Finding, completed, say

MOST_IN, MOST_OUT = 14, 5
INPUT, OUTPUT = "left.load_torque", "left.speed"
FRAME = re.compile(r"^#\d+ .* at (src/[\w/]+\.rs):\d+$", re.M)
ROW = re.compile(r"^\| (\d+) \| `([^`]+)` \| (.*?) \|$", re.M)
BEGIN, END = "<!-- trace:begin -->", "<!-- trace:end -->"
# a host that steps, sets a torque, steps, and reads a speed
HOST = """
import ctypes, sys
unit = ctypes.CDLL(sys.argv[1])
unit.fmi2Instantiate.restype = ctypes.c_void_p
logger = ctypes.CFUNCTYPE(None)(lambda: None)
allocate = ctypes.CFUNCTYPE(ctypes.c_void_p, ctypes.c_size_t, ctypes.c_size_t)
free = ctypes.CFUNCTYPE(None, ctypes.c_void_p)
standard = ctypes.CDLL(None)
class Callbacks(ctypes.Structure):
    _fields_ = [(name, ctypes.c_void_p) for name in ("logger", "allocate", "free", "finished", "environment")]
given = Callbacks(ctypes.cast(logger, ctypes.c_void_p), ctypes.cast(standard.calloc, ctypes.c_void_p),
                  ctypes.cast(standard.free, ctypes.c_void_p))
unit_ = ctypes.c_void_p(unit.fmi2Instantiate(b"trace", 1, sys.argv[2].encode(), b"", ctypes.byref(given), 0, 0))
def step(k):
    return unit.fmi2DoStep(unit_, ctypes.c_double(1e-3 * k), ctypes.c_double(1e-3), 1)
status = [unit.fmi2SetupExperiment(unit_, 0, ctypes.c_double(0), ctypes.c_double(0), 0, ctypes.c_double(0)),
          unit.fmi2EnterInitializationMode(unit_), unit.fmi2ExitInitializationMode(unit_), step(0), step(1)]
one, value = ctypes.c_size_t(1), ctypes.c_double(500)
status += [unit.fmi2SetReal(unit_, (ctypes.c_uint * 1)(int(sys.argv[3])), one, ctypes.byref(value)), step(2),
           unit.fmi2GetReal(unit_, (ctypes.c_uint * 1)(int(sys.argv[4])), one, ctypes.byref(value))]
assert not any(status), status
"""


def line_of(file, pattern):
    """Place of a breakpoint: the line of `file` in which the first group of `pattern`, or all of it, begins."""
    text = (WORKSPACE / file).read_text(encoding="utf-8")
    found = re.search(pattern, text, re.S)
    if not found:
        raise SystemExit(f"{file} has no place that matches {pattern}")
    return f"{file}:{text.count(chr(10), 0, found.start(found.lastindex or 0)) + 1}"


def stops():
    """Breakpoints in order, and true for those whose backtrace counts."""
    return [("fmi2SetReal", False),
            (line_of("src/variables/inputs.rs", r"\|i\| &mut i\.load_torque\[0\]"), True),
            (line_of("src/integrate/rodas5p.rs", r"fn step<.*?(let per_h)"), False),
            (line_of("src/contact/spring.rs", r"impl Spring for ImpactSpring.*?fn respond_whole<.*?(let energy)"), True),
            ("fmi2GetReal", False),
            (line_of("src/model/readings/motion_and_forces.rs", r"fn motion_of_state.*?(let position)"), True),
            (line_of("src/variables/outputs.rs", r"\|m, s\| m\.side_speed\[s\]"), True)]


def backtraces(library, guid, references):
    """Files of the backtraces that count, from the host inwards."""
    with tempfile.TemporaryDirectory() as folder:
        host, commands = Path(folder, "host.py"), Path(folder, "commands")
        host.write_text(HOST, encoding="utf-8")
        lines = ["set pagination off", "set breakpoint pending on", "set width 0", "set confirm off"]
        for k, (place, counts) in enumerate(stops()):
            lines += [f"tbreak {place}", "continue" if k else "run", f"echo === {k if counts else ''}\\n"] + ["backtrace"] * counts
        commands.write_text("\n".join([*lines, "kill", ""]), encoding="utf-8")
        words = ["gdb", "--batch", "--command", commands, "--args", sys.executable, host, library, guid, *references]
        try:
            printed = subprocess.run(list(map(str, words)), cwd=WORKSPACE, capture_output=True, text=True, check=False).stdout
        except FileNotFoundError:
            raise SystemExit("gdb takes the backtraces: install it (apt-get install gdb)") from None
    parts = [part for part in printed.split("=== ")[1:] if part[0].isdigit()]
    found = [list(dict.fromkeys(reversed(FRAME.findall(part)))) for part in parts]
    if [bool(files) for files in found] != [True] * 4:
        raise SystemExit(f"gdb did not stop at all places:\n{printed[-2000:]}")
    return found


def built(folder):
    """Library of a debug build, without optimisation, so that every function has a frame."""
    cargo, settings = os.environ.get("CARGO", "cargo"), {"CARGO_PROFILE_DEV_OPT_LEVEL": "0"}
    completed([cargo, "build", "--package", "bevel-differential", "--lib", "--quiet", "--target-dir", folder], cwd=WORKSPACE,
              env=os.environ | settings)
    return Path(folder, "debug", "libbevel_differential.so").resolve()


def table(files, texts):
    """Rows of the page: a number, the file, and what it does."""
    return "\n".join(["| | file | what it does |", "|---|---|---|", *(f"| {k} | `{file}` | {texts.get(file, '?')} |" for k, file in enumerate(files, 1))])


def main(folder, page):
    say(0.1, "building without optimisation")
    library = built(folder)
    root = ET.parse(WORKSPACE / "modelDescription/modelDescription.xml").getroot()
    references = {row.get("name"): row.get("valueReference") for row in root.iter("ScalarVariable")}
    say(0.8, "taking backtraces")
    setter, law, *getters = backtraces(library, root.get("guid"), [references[INPUT], references[OUTPUT]])
    inwards, getter = list(dict.fromkeys(setter + law)), list(dict.fromkeys(sum(getters, [])))
    text = (WORKSPACE / page).read_text(encoding="utf-8")
    rows = ROW.findall(text.partition(BEGIN)[2].partition(END)[0])
    print(table(inwards, {file: what for _, file, what in rows}))
    print(f"\n`{OUTPUT}` passes through {', '.join(f'`{file}`' for file in getter)}.")
    if len(inwards) > MOST_IN or len(getter) > MOST_OUT:
        raise Finding(f"{INPUT} crosses {len(inwards)} files, at most {MOST_IN}; {OUTPUT} {len(getter)}, at most {MOST_OUT}")
    if [file for _, file, _ in rows] != inwards:
        raise Finding(f"{page} lists other files: replace its table by the one above, and each '?' by what the file does")


if __name__ == "__main__":
    main(*sys.argv[1:])
