"""The command `accuracy`."""

import argparse
import time
from pathlib import Path

from ..command.arguments import add_progress, add_scene, add_units, once


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Adds the arguments of the command."""
    add_scene(parser)
    add_units(parser)
    parser.add_argument("--want", metavar="OUTPUT[:STATISTIC]", action="append", default=[],
                        help="a quantity, such as left.speed:mean; may be repeated (default: all outputs of the scene)")
    parser.add_argument("--within", metavar="PERCENT", required=True, help="the accuracy that it needs, such as 1%%")
    parser.add_argument("--from", metavar="TIME", dest="from_", help="judge outputs from this time on, such as 10ms")
    parser.add_argument("--csv", metavar="FILE", help="write a table of all that was tried")
    parser.add_argument("--plot", metavar="FILE", help="draw error against cost (PNG, SVG or PDF)")
    parser.add_argument("--write", metavar="FILE", help="write the scene with the chosen setting (TOML)")
    parser.add_argument("--ssv", metavar="FILE", help="write the start values of the chosen setting for hosts of the FMU (SSP parameter set)")
    parser.add_argument("--python", metavar="FILE", help="write the scene with the chosen setting as a Python script")
    add_progress(parser)


def run(arguments: argparse.Namespace) -> int:
    """Answers, prints and writes files. Returns 0."""
    from ..extras import require
    from ..output_file import checked, checked_picture
    from ..progress import shown
    from ..values import DifferentialError
    from ..writing import write_whole
    from . import accuracy

    # before the work, not after it
    for file in (arguments.csv, arguments.write, arguments.ssv, arguments.python):
        checked(file)
    if arguments.write and Path(arguments.write).exists():
        raise DifferentialError(f"{arguments.write} is there already: remove it, or name another with --write FILE")
    if checked_picture(arguments.plot):
        require("matplotlib", "plot")
    begin = time.monotonic()
    with shown(arguments.progress) as progress:
        found = accuracy(arguments.scene, arguments.want, arguments.within, from_=arguments.from_, set=once("--set", arguments.set),
                         display_units=arguments.unit, file=arguments.write, progress=progress)
    print(found.text)
    print(f"{len(found.runs) - 1} runs cost {found.answer['spent']:.2g} reference runs of {found.reference.seconds:.2g} s each: "
          f"{time.monotonic() - begin:.2g} s in all")
    for file, key in [(arguments.csv, "csv"), (arguments.write, "file"), (arguments.ssv, "ssv"), (arguments.python, "python")]:
        # without a setting that is accurate enough there is none to write
        if file and found.answer[key]:
            write_whole(file, found.answer[key])
            print(f"written: {file}")
    if arguments.plot:
        found.plot(arguments.plot)
        print(f"written: {arguments.plot}")
    return 0
