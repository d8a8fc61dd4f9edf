"""The command `bench`."""

import argparse
from pathlib import Path

from ..command import DONE
from ..command.arguments import add_farm, add_fmu, add_set, add_units, farm, once


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Adds the arguments of the command."""
    from . import TESTS
    parser.add_argument("test", nargs="*", metavar="TEST", help=f"{', '.join(TESTS)} (default: all)")
    parser.add_argument("--scene", metavar="FILE", help="another scene for one test")
    add_set(parser)
    add_units(parser)
    parser.add_argument("--out", metavar="FOLDER", default="bench", help="folder of figures, numbers and scenes (default: bench)")
    add_farm(parser)
    add_fmu(parser)


def run(arguments: argparse.Namespace) -> int:
    """Runs the tests, prints their conclusions and writes files. Raises `DifferentialError`."""
    from ..extras import matplotlib
    from ..scene_file import find
    from ..values import DifferentialError, suggestion
    from ..writing import in_folder, write_whole
    from . import TESTS, bench, scene_file

    matplotlib("plot")
    for name in arguments.test:
        if name not in TESTS:
            raise DifferentialError(f"there is no test {name!r}{suggestion(name, TESTS)}; known: {', '.join(TESTS)}", kind="use")
    if arguments.scene and len(arguments.test) != 1:
        raise DifferentialError("--scene: name the one test that it is for", kind="use")
    for name in arguments.test or TESTS:
        scene = find(arguments.scene) if arguments.scene else scene_file(name)
        with in_folder(arguments.out) as folder:
            conclusion = bench(name, folder, scene, once("--set", arguments.set), arguments.fmu, arguments.unit, **farm(arguments))
            write_whole(folder / scene.name, scene.read_bytes())
        print(f"{name}: {conclusion} ({Path(arguments.out) / name}.png, .csv)")
    return DONE
