"""The command `run`: simulates a scene."""

import argparse
from collections.abc import Callable

from .arguments import add_files, add_fmu, add_set, once


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Adds the arguments of the command."""
    parser.add_argument("scene", nargs="?", help="a scene file (TOML), or the name of a shipped scene; without it, list the scenes")
    add_set(parser)
    parser.add_argument("--stop", metavar="TIME", help="another end, such as \"0.2 s\"")
    parser.add_argument("--output", metavar="NAME", action="append", help="what to record, instead of the scene's outputs")
    add_files(parser, "the record in SI", "the record")
    parser.add_argument("--parquet", help=argparse.SUPPRESS)
    add_fmu(parser)


def run(arguments: argparse.Namespace) -> int:
    """Simulates, prints a summary and writes files. Returns 0."""
    from ..output_file import checked, checked_picture, is_parquet
    from ..scene import Scene
    from ..values import DifferentialError
    from .plan import listed

    if arguments.scene is None:
        print(listed("run", arguments))
        return 0
    for file in (arguments.csv, arguments.parquet):
        checked(file)
    if arguments.parquet and not is_parquet(arguments.parquet):
        raise DifferentialError(f"--parquet {arguments.parquet}: a Parquet file ends in .parquet; --csv writes either by its ending")
    checked_picture(arguments.plot)
    with Scene.load(arguments.scene, fmu=arguments.fmu) as scene:
        record = scene.set(once("--set", arguments.set)).run(arguments.output, stop=arguments.stop)
        print(scene.summary(record))
        writers: list[tuple[Callable[..., object], str | None]] = [
            (scene.to_parquet if is_parquet(arguments.csv) else scene.to_csv, arguments.csv), (scene.to_parquet, arguments.parquet),
            (scene.plot, arguments.plot)]
        for write, file in writers:
            if file:
                write(record, file)
                print(f"written: {file}")
    return 0
