"""The command `run`: simulates a scene."""

import argparse
from collections.abc import Callable

from . import DONE
from .arguments import add_files, add_fmu, add_set, add_times, add_units, once


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Adds the arguments of the command."""
    parser.add_argument("scene", nargs="*", help="a scene file (TOML), or the name of a shipped scene; several are compared; without "
                                                 "one, list the scenes")
    add_set(parser)
    add_times(parser)
    parser.add_argument("--output", metavar="NAME", action="append",
                        help="a variable to record instead of the scene's outputs; may be repeated")
    add_units(parser)
    add_files(parser, "the record, in SI without --unit", "the record")
    add_fmu(parser)


def run(arguments: argparse.Namespace) -> int:
    """Simulates, prints a summary and writes files."""
    from ..output_file import is_parquet
    from ..scene import Scene
    from ..values import DifferentialError
    from .plan import listed

    if not arguments.scene:
        print(listed("run", arguments))
        return DONE
    if len(arguments.scene) > 1:
        if arguments.step is not None:
            raise DifferentialError("--step: several scenes are compared at the steps of their files; run each of them alone")
        return _compare(arguments)
    with Scene.load(arguments.scene[0], arguments.fmu, arguments.stop, arguments.unit, arguments.step) as scene:
        record = scene.set(once("--set", arguments.set)).run(arguments.output)
        scene.fmu.check_shown(arguments.unit, (record.dtype.names or ())[1:])
        print(scene.summary(record))
        writers: list[tuple[Callable[..., object], str | None]] = [
            (scene.to_parquet if is_parquet(arguments.csv) else scene.to_csv, arguments.csv), (scene.plot, arguments.plot)]
        for write, file in writers:
            if file:
                write(record, file)
                print(f"written: {file}")
        if arguments.csv and not is_parquet(arguments.csv):
            print(_about(scene))
    return DONE


def _about(scene):
    """Description of a CSV file with a record, which the file itself does not contain."""
    units = ", ".join(scene.fmu.display_units.values())
    in_units = f"names contain the units {units}, so fmpy cannot read it as an input" if units else "in SI"
    return f"scene {scene.name}: {scene.description}; {in_units}"


def _compare(arguments):
    from ..comparison import compare

    found = compare(*arguments.scene, outputs=arguments.output, values=once("--set", arguments.set), stop=arguments.stop,
                    display_units=arguments.unit, fmu=arguments.fmu)
    found.fmu.check_shown(arguments.unit, found.outputs)
    print(found)
    for write, file in ((found.to_csv, arguments.csv), (found.plot, arguments.plot)):
        if file:
            write(file)
            print(f"written: {file}")
    return DONE
