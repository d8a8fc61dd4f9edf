"""The command `accuracy`."""

import argparse
import time

from ..command import DONE, FINDING
from ..command.arguments import add_file, add_progress, add_scene, add_units, changes


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Adds the arguments of the command."""
    add_scene(parser)
    add_units(parser)
    parser.add_argument("--want", metavar="OUTPUT[:STATISTIC]", action="append", default=[],
                        help="a quantity, such as left.speed:mean; may be repeated (default: all outputs of the scene)")
    parser.add_argument("--within", metavar="PERCENT", required=True, help="the accuracy that it needs, such as 1%%")
    parser.add_argument("--from", metavar="TIME", dest="from_", help="judge outputs from this time on, such as 10ms")
    add_file(parser, "--csv", "CSV file", "write a table of all runs")
    add_file(parser, "--plot", "picture", "draw error against cost")
    add_file(parser, "--write", "scene", "write the scene with the chosen setting")
    add_file(parser, "--ssv", "parameter set", "write the start values of the chosen setting for hosts of the FMU")
    add_file(parser, "--python", "Python script", "write the scene with the chosen setting as a script")
    add_progress(parser)


def run(arguments: argparse.Namespace) -> int:
    """Finds the setting, prints it and writes files. If no setting is accurate enough, this is a finding."""
    from ..extras import matplotlib
    from ..progress import shown
    from ..records import localised
    from ..values import DifferentialError
    from ..writing import write_whole
    from . import accuracy

    # an error before the work, not after it
    if arguments.write and arguments.write.exists():
        raise DifferentialError(f"{arguments.write} is there already: remove it, or name another with --write FILE")
    if arguments.plot:
        matplotlib("plot")
    begin = time.monotonic()
    with shown(arguments.progress) as progress:
        found = accuracy(arguments.scene, arguments.want, arguments.within, from_=arguments.from_, set=changes(arguments),
                         display_units=arguments.unit, file=arguments.write, progress=progress)
    print(found.text)
    print(f"{len(found.runs) - 1} runs, as much work as {found.answer['spent']:.2g} reference runs of {found.reference.seconds:.2g} s. "
          f"The search took {time.monotonic() - begin:.2g} s, with the start of each run.")
    for file, key in [(arguments.csv, "csv"), (arguments.write, "file"), (arguments.ssv, "ssv"), (arguments.python, "python")]:
        # if no setting is accurate enough, there is nothing to write
        if file and found.answer[key]:
            write_whole(file, localised(found.answer[key]) if key == "csv" else found.answer[key])
            print(f"written: {file}")
    if arguments.plot:
        found.plot(arguments.plot)
        print(f"written: {arguments.plot}")
    return DONE if found.use else FINDING
