"""The command `loads`: the force on each loaded tooth pair over time, for FEA."""

import argparse

from . import DONE
from .arguments import add_file, add_progress, add_scene, changes


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Adds the arguments of the command."""
    add_scene(parser)
    parser.add_argument("--every", metavar="TIME", help="time between records, such as 0.1ms (default: the scene's "
                                                        "communication step)")
    add_file(parser, "--out", "CSV file", "the file to write", required=True)
    add_progress(parser)


def run(arguments: argparse.Namespace) -> int:
    """Writes the loads and prints their number."""
    from ..answers import about, ask
    from ..progress import shown
    from ..records import localised
    from ..writing import write_whole

    of = about(arguments.scene, changes(arguments))
    with shown(arguments.progress) as progress:
        found = ask({"ask": "loads", "of": of, "every": arguments.every, "out": arguments.out}, progress=progress)
    if arguments.csv_decimal != "point":
        write_whole(arguments.out, localised(arguments.out.read_text(encoding="utf-8")))
    print(f"{arguments.out}: {found['lines']} loads of tooth pairs\n{found['text']}", end="")
    return DONE
