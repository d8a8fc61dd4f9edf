"""The command `run`: simulates a scene."""

import argparse
from collections.abc import Callable

from . import DONE
from .arguments import add_file, add_files, add_fmu, add_set, add_stop, once


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Adds the arguments of the command."""
    parser.add_argument("scene", nargs="?", help="a scene file (TOML), or the name of a shipped scene; without it, list the scenes")
    add_set(parser)
    add_stop(parser)
    parser.add_argument("--output", metavar="NAME", action="append", help="what to record, instead of the scene's outputs")
    add_files(parser, "the record in SI", "the record")
    add_file(parser, "--parquet", "Parquet file", argparse.SUPPRESS)
    add_fmu(parser)


def run(arguments: argparse.Namespace) -> int:
    """Simulates, prints a summary and writes files."""
    from ..output_file import is_parquet
    from ..scene import Scene
    from .plan import listed

    if arguments.scene is None:
        print(listed("run", arguments))
        return DONE
    with Scene.load(arguments.scene, arguments.fmu, arguments.stop) as scene:
        record = scene.set(once("--set", arguments.set)).run(arguments.output)
        print(scene.summary(record))
        writers: list[tuple[Callable[..., object], str | None]] = [
            (scene.to_parquet if is_parquet(arguments.csv) else scene.to_csv, arguments.csv), (scene.to_parquet, arguments.parquet),
            (scene.plot, arguments.plot)]
        for write, file in writers:
            if file:
                write(record, file)
                print(f"written: {file}")
    return DONE
