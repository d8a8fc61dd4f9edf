"""The command `loads`: the force on each loaded tooth pair over time, for FEA."""

import argparse

from .arguments import add_progress, add_scene, once


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Adds the arguments of the command."""
    add_scene(parser)
    parser.add_argument("--every", metavar="TIME", help="time between records, such as 0.1ms (default: the scene's "
                                                        "communication step)")
    parser.add_argument("--out", metavar="FILE", required=True, help="the CSV file to write")
    add_progress(parser)


def run(arguments: argparse.Namespace) -> int:
    """Writes the loads and says how many. Returns 0."""
    from ..answers import about, ask
    from ..output_file import checked
    from ..progress import shown

    of, file = about(arguments.scene, once("--set", arguments.set)), checked(arguments.out)
    with shown(arguments.progress) as progress:
        found = ask({"ask": "loads", "of": of, "every": arguments.every, "out": file}, progress=progress)
    print(f"{file}: {found['lines']} loads of tooth pairs")
    return 0
