"""The command `run`: simulates a scene."""

import argparse
from collections.abc import Callable

from .arguments import add_files, add_fmu, add_set, add_units, once


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Adds the arguments of the command."""
    parser.add_argument("scene", nargs="*", help="a scene file (TOML), or the name of a shipped scene; several are compared; without "
                                                 "one, list the scenes")
    add_set(parser)
    parser.add_argument("--stop", metavar="TIME", help="another end, such as \"0.2 s\"")
    parser.add_argument("--output", metavar="NAME", action="append", help="what to record, instead of the scene's outputs")
    add_units(parser)
    add_files(parser, "the record, in SI without --unit", "the record")
    parser.add_argument("--parquet", help=argparse.SUPPRESS)
    add_fmu(parser)


def run(arguments: argparse.Namespace) -> int:
    """Simulates, prints a summary and writes files. Returns 0."""
    from ..output_file import checked, checked_picture, is_parquet
    from ..scene import Scene
    from ..values import DifferentialError
    from .plan import listed

    if not arguments.scene:
        print(listed("run", arguments))
        return 0
    for file in (arguments.csv, arguments.parquet):
        checked(file)
    if arguments.parquet and not is_parquet(arguments.parquet):
        raise DifferentialError(f"--parquet {arguments.parquet}: a Parquet file ends in .parquet; --csv writes either by its ending")
    checked_picture(arguments.plot)
    if len(arguments.scene) > 1:
        return _compare(arguments)
    with Scene.load(arguments.scene[0], fmu=arguments.fmu, display_units=arguments.unit) as scene:
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


def _compare(arguments):
    from ..comparison import compare

    found = compare(*arguments.scene, outputs=arguments.output, values=once("--set", arguments.set), stop=arguments.stop,
                    display_units=arguments.unit, fmu=arguments.fmu)
    print(found)
    for write, file in ((found.to_csv, arguments.csv), (found.to_csv, arguments.parquet), (found.plot, arguments.plot)):
        if file:
            write(file)
            print(f"written: {file}")
    return 0
