"""The command `geometry`: all dimensions of the gears, whether they turn freely, and files for CAD."""

import argparse
from pathlib import Path

from .arguments import add_set, once

HELP = "calculate all dimensions of the gears, check them for interference, make files for CAD"
EXTRA = None


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Adds what the command takes."""
    from ..progress import add_progress

    add_set(parser)
    parser.add_argument("--facets", metavar="N", type=int, default=32, help="pieces of a flank's curve (start value: 32)")
    parser.add_argument("--thicken", metavar="LENGTH", help="check for interference with teeth thicker by this length, such as 0.15mm")
    parser.add_argument("--out", metavar="FOLDER", default="geometry", help="folder of the files (start value: geometry)")
    add_progress(parser)


def run(arguments: argparse.Namespace) -> int:
    """Prints the dimensions and writes the files. Returns 0."""
    from ..answers import ask, assignments
    from ..progress import shown

    question = {"ask": "geometry", "set": assignments(once("--set", arguments.set)), "facets": arguments.facets,
                "thicken": arguments.thicken}
    with shown(arguments.progress) as progress:
        found = ask(question, progress=progress)
    folder = Path(arguments.out)
    folder.mkdir(parents=True, exist_ok=True)
    for name, content in found["files"].items():
        (folder / name).write_text(content, encoding="utf-8")
    print(f"{found['text']}\nfiles in {folder}\n" + "\n".join(f"  {name}" for name in found["files"]))
    return 0
