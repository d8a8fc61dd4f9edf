"""The sub-command `spectrum`: damage and life over a duty cycle."""

import argparse

from ..command import DONE, FINDING
from ..command.arguments import add_files, add_fmu, assignment, once
from .result import ORDERS, spectrum


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Adds the arguments of the command."""
    parser.add_argument("cycle", help="CSV file of the duty cycle: a line for each event")
    parser.add_argument("--scene", help="name or file of the scene whose [set] applies to all events")
    parser.add_argument("--set", action="append", default=[], metavar="NAME=VALUE", type=assignment,
                        help="parameter of the FMU or quantity of the vehicle for all events, such as \"wheel_radius=334 mm\"; "
                             "may be repeated")
    parser.add_argument("--order", choices=ORDERS, default=ORDERS[0],
                        help="order of the events: unknown assumes the worst one, written is that of the file (default: %(default)s)")
    add_files(parser, "the damage by event", "damage by event and the load spectrum")
    add_fmu(parser)


def run(arguments: argparse.Namespace) -> int:
    """Prints damage and life, and writes the requested files. Gears that do not survive one cycle are a finding."""
    result = spectrum(arguments.cycle, once("--set", arguments.set), arguments.scene, order=arguments.order, fmu=arguments.fmu)
    print(result.summary())
    for file, write in ((arguments.csv, result.save), (arguments.plot, result.plot)):
        if file:
            print(f"wrote {write(file)}")
    return FINDING if result.cycles_to_failure < 1.0 else DONE
