"""The command `loads`: forces over time for FEA, of each loaded tooth pair, and of the final drive on ring gear and bearings."""

import argparse

from . import DONE
from .arguments import add_file, add_progress, add_scene, changes


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Adds the arguments of the command."""
    add_scene(parser)
    parser.add_argument("--every", metavar="TIME", help="time between records, such as 0.1ms (default: the scene's "
                                                        "communication step)")
    add_file(parser, "--out", "CSV file", "the file to write, with the loads of tooth pairs")
    add_file(parser, "--bearings", "CSV file", "the file to write, with the forces of the final drive on the ring gear and on the bearings "
                                               "of the carrier")
    add_progress(parser)


def run(arguments: argparse.Namespace) -> int:
    """Writes the loads and prints their number."""
    from ..answers import about, ask
    from ..progress import shown
    from ..records import localised
    from ..values import DifferentialError
    from ..writing import write_whole

    files = {"loads of tooth pairs": arguments.out, "records of forces on ring gear and bearings": arguments.bearings}
    if not any(files.values()):
        raise DifferentialError("name a file to write: --out for the loads of tooth pairs, --bearings for the forces of the final drive",
                                kind="use")
    of = about(arguments.scene, changes(arguments))
    for what, file in files.items():
        if file is None:
            continue
        with shown(arguments.progress) as progress:
            found = ask({"ask": "loads", "of": of, "every": arguments.every, "out": file, "bearings": file is arguments.bearings},
                        progress=progress)
        if arguments.csv_decimal != "point":
            write_whole(file, localised(file.read_text(encoding="utf-8")))
        print(f"{file}: {found['lines']} {what}\n{found['text']}", end="")
    return DONE
