"""The command `verify`."""

import argparse

from . import DONE, FINDING
from .arguments import add_file, add_progress

HEAD = ("scene", "variable", "deviation by tolerance", "time, s", "verdict")
TABLE = ("scene", "variable", "unit", "time", "value", "expected", "tolerance", "verdict")


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Adds the arguments of the command."""
    parser.add_argument("fmu", metavar="FMU", nargs="?", help="the FMU (default: that of this package, or BEVEL_DIFFERENTIAL_FMU)")
    add_file(parser, "--csv", "table", "write the largest deviation of each variable")
    add_progress(parser)


def run(arguments: argparse.Namespace) -> int:
    """Simulates the scenes, prints a table and writes a file. A scene that fails or is broken is a finding."""
    from ..fmu import usual
    from ..progress import shown
    from ..records import write
    from ..text import aligned
    from ..verify import verify

    with shown(arguments.progress) as progress:
        found = verify(arguments.fmu or usual(), progress)
    rows, problems, cells = [HEAD], [], []
    for each in found:
        worst = each.worst
        rows.append((each.scene, *((worst.output, f"{worst.ratio:.3g}", f"{worst.time:.6g}") if worst else ("",) * 3), each.verdict))
        if not worst:
            problems.append(f"{each.scene}: {each.problem}")
            cells.append((each.scene, *("",) * 6, each.verdict))
        for one in sorted(each.deviations, key=lambda one: -one.ratio):
            passed = one.ratio <= 1.0
            cells.append((each.scene, one.output, one.unit, *map(float, (one.time, one.value, one.expected, one.tolerance)),
                          "passed" if passed else "failed"))
            if not passed:
                problems.append(f"{each.scene}: {one.output} at {one.time:.6g} s is {one.value:.9g} {one.unit}, expected {one.expected:.9g} "
                                f"within {one.tolerance:.2g}: {one.ratio:.3g} times the tolerance")
    print("\n".join([*aligned(rows), *problems]))
    wrong = sum(each.verdict != "passed" for each in found)
    print(f"{len(found)} scenes, {len(found) - wrong} passed" + (f", {wrong} not" if wrong else ""))
    if arguments.csv:
        write(arguments.csv, TABLE, cells, "times in s, values in the unit of the variable")
        print(f"written: {arguments.csv}")
    return FINDING if wrong else DONE
