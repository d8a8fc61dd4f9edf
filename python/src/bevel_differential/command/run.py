"""The command `run`: simulates a scene."""

import argparse
from collections.abc import Callable

from .arguments import add_fmu, add_scene, once


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Adds what the command takes."""
    add_scene(parser)
    parser.add_argument("--stop", metavar="TIME", help="another end, such as \"0.2 s\"")
    parser.add_argument("--output", metavar="NAME", action="append", help="what to record, instead of the scene's outputs")
    parser.add_argument("--csv", metavar="FILE", help="write the record as CSV, in SI")
    parser.add_argument("--parquet", metavar="FILE", help="write the record as Parquet, in SI")
    parser.add_argument("--plot", metavar="FILE", help="write a picture (PNG, SVG or PDF)")
    add_fmu(parser)


def run(arguments: argparse.Namespace) -> int:
    """Simulates, prints a summary and writes files. Returns 0."""
    from ..output_file import checked, checked_picture
    from ..scene import Scene

    for file in (arguments.csv, arguments.parquet):
        checked(file)
    checked_picture(arguments.plot)
    with Scene.load(arguments.scene, fmu=arguments.fmu) as scene:
        record = scene.set(once("--set", arguments.set)).run(arguments.output, stop=arguments.stop)
        for warning in scene.warnings:
            print(f"warning: {warning}")
        print(scene.summary(record))
        writers: list[tuple[Callable[..., object], str | None]] = [
            (scene.to_csv, arguments.csv), (scene.to_parquet, arguments.parquet), (scene.plot, arguments.plot)]
        for write, file in writers:
            if file:
                write(record, file)
                print(f"written: {file}")
    return 0
