"""The command `pattern`."""

import argparse

from ..command import DONE
from ..command.arguments import add_decimal, add_progress, add_quick, add_set, add_times, changes


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Adds the arguments of the command."""
    parser.add_argument("scenes", nargs="*", metavar="scene", help="scene files or names (default: solid teeth in the study's turn, "
                                                                   "aligned and with one thing out of place at a time)")
    add_set(parser)
    add_times(parser)
    add_quick(parser, "longer steps; without a scene, aligned and with one offset, angle and crowning")
    parser.add_argument("--out", metavar="FOLDER", default="pattern", help="folder of pictures and CSV files (default: pattern)")
    add_decimal(parser)
    add_progress(parser)


def run(arguments: argparse.Namespace) -> int:
    """Simulates, writes files and pictures, and prints the results."""
    from ..answers import about, ask
    from ..progress import part, shown
    from ..records import localised
    from ..values import DifferentialError
    from ..writing import in_folder, write_whole
    from .picture import draw

    changed = changes(arguments)
    if changed and not arguments.scenes:
        raise DifferentialError("--set and --stop change scenes: name one")
    with in_folder(arguments.out) as folder, shown(arguments.progress) as progress:
        question = {"ask": "pattern", "of": [about(scene, changed) for scene in arguments.scenes], "quick": arguments.quick}
        found = ask(question, progress=part(progress, 0.0, 0.9))
        for name, content in {**found["files"], "findings.md": found["document"]}.items():
            write_whole(folder / name, content)
        progress(0.9, "drawing")
        pictures = draw(folder, not arguments.scenes)
        for name, content in found["files"].items():
            write_whole(folder / name, localised(content))
    print(f"{found['text']}files in {arguments.out}: {', '.join([*found['files'], 'findings.md', *pictures])}")
    return DONE
