"""Runs all commands of the laboratory, each in a separate process, and prints one table of the results."""

import subprocess
import sys
import time

from .command import COMMANDS, Option, Wrong, command
from .paths import TARGET, WORKSPACE, program, shown
from .terminal import Finding, aligned

NAME = "all"
# inputs of the commands that a fresh clone lacks, built by fmu-build; tool chains come first
MADE = ["toolchains", "page", "wheel"]
# maximum length of a last line in the table
LONGEST = 90


@command(Option(("only",), {"metavar": "NAME", "nargs": "*", "help": "Only these commands"}), name=NAME)
def everything(work):
    """Runs every command of this program in its short form and prints one table of the results (about an hour)."""
    only, own = work.options.only, {name: [name, *each.short] for name, each in COMMANDS.items() if name != NAME}
    for name in only:
        if name not in own:
            raise Wrong(f"{name} is not a command that is run here; the commands are {', '.join(own)}")
    folder = TARGET / NAME
    folder.mkdir(parents=True, exist_ok=True)
    runs = [([program("fmu-build")], [name]) for name in MADE if not only]
    runs += [([sys.executable, "crates/lab/lab.py"], words) for name, words in own.items() if name in only or not only]
    rows, failed = [["command", "seconds", "outcome", "last line"]], []
    for called, words in runs:
        work.progress.stage(f"running {' '.join(words)}")
        row, held = outcome(called, words, folder)
        rows.append(row)
        failed += [] if held else row[:1]
    work.progress.finish()
    print("\n".join(aligned(rows, (0, 2, 3))))
    print(f"\noutput of each command: {shown(folder)}")
    if failed:
        raise Finding(f"these failed: {', '.join(failed)}")


def outcome(called, words, folder):
    """Runs a program with `words` and writes its output to a file. Returns its row of the table, and true if it succeeded."""
    file, begin = folder / f"{words[0]}.txt", time.monotonic()
    with file.open("w", encoding="utf-8") as output:
        held = subprocess.run([*called, *words], cwd=WORKSPACE, stdin=subprocess.DEVNULL, stdout=output, stderr=output).returncode == 0
    lines = [line.strip() for line in file.read_text(encoding="utf-8", errors="replace").splitlines() if line.strip()]
    return [" ".join(words), f"{time.monotonic() - begin:.0f}", "held" if held else "FAILED", (lines or [""])[-1][:LONGEST]], held
