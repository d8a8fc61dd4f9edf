"""The command `geometry`: all dimensions of the gears, a check for interference, and files for CAD."""

import argparse

from . import DONE, FINDING
from .arguments import add_progress, add_set, once

_WHAT = {"step": "solids for CAD", "stl": "meshes", "3mf": "meshes for printing", "glb": "meshes for viewers of glTF",
         "dxf": "drawings and curves in space"}


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Adds the arguments of the command."""
    from ..cad import KINDS, PARTS
    add_set(parser)
    for kind in KINDS:
        parser.add_argument(f"--{kind}", action="append_const", dest="kinds", const=kind, help=f"write {_WHAT[kind]} (extra cad)")
    parser.add_argument("--part", action="append", choices=PARTS, help="write files only for this part (may be repeated)")
    parser.add_argument("--facets", metavar="N", type=int, default=32, help="pieces of a flank's curve, and facets of meshes (default: 32)")
    parser.add_argument("--thicken", metavar="LENGTH", help="check for interference with teeth thicker by this length, such as 0.15mm")
    parser.add_argument("--out", metavar="FOLDER", default="geometry", help="folder of the files (default: geometry)")
    add_progress(parser)


def run(arguments: argparse.Namespace) -> int:
    """Writes the files and prints the dimensions and, at the end, the result of the interference check. Interference is a finding."""
    from ..answers import ask, assignments
    from ..cad import PARTS, write
    from ..progress import shown

    question = {"ask": "geometry", "set": assignments(once("--set", arguments.set)), "facets": arguments.facets,
                "thicken": arguments.thicken, "solids": bool(arguments.kinds)}
    with shown(arguments.progress) as progress:
        found = ask(question, progress=progress)
    names = write(found, arguments.out, arguments.kinds or (), arguments.part or PARTS)
    # the verdict is last, where users look first
    print(f"{found['text']}\nfiles in {arguments.out}: {', '.join(names)}\n{found['verdict']}")
    return FINDING if found["interference"] else DONE
