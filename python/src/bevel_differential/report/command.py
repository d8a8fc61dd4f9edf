"""The command `report`: a page about a scene."""

import argparse

from ..command import DONE
from ..command.arguments import add_file, add_fmu, add_progress, add_quick, add_scene, add_units, once

# parts of a report that need other runs
LEFT_OUT = "without the run-up, and without the effects that are off"


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Adds the arguments of the command."""
    add_scene(parser)
    add_units(parser)
    add_file(parser, "--out", "page", "the page to write; default: report-NAME.html")
    add_quick(parser, LEFT_OUT)
    add_fmu(parser)
    add_progress(parser)


def run(arguments: argparse.Namespace) -> int:
    """Writes the report and prints its path."""
    from ..progress import shown
    from ..scene import Scene
    from .write import write

    with Scene.load(arguments.scene, arguments.fmu, arguments.stop, arguments.unit, arguments.step) as scene:
        scene.set(once("--set", arguments.set))
        file = arguments.out or f"report-{scene.name}.html"
        with shown(arguments.progress) as progress:
            written = write(scene, file, arguments.quick, progress)
        print(f"written: {written}" + (f"; quick: {LEFT_OUT}" if arguments.quick else ""))
    return DONE
