"""The command `verify`."""

import argparse
from collections.abc import Iterable

from ..command import DONE, FINDING
from ..command.arguments import add_file, add_progress, add_quick
from .judged import ASSUMED, Judged

HEAD = ("experiment", "kind", "variable", "deviation by tolerance", "time, s", "verdict")
TABLE = ("experiment", "kind", "variable", "unit", "time", "value", "expected", "deviation", "tolerance", "verdict")


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Adds the arguments of the command."""
    parser.add_argument("fmu", metavar="FMU", nargs="?", help="an FMU that carries evidence by FMI-LS-REF (start value: that of this package)")
    add_quick(parser, "only smoke tests")
    add_file(parser, "--csv", "table", "write the largest deviation of each variable")
    add_progress(parser)


def run(arguments: argparse.Namespace) -> int:
    """Runs the experiments, prints a table and writes a file. An experiment that fails or is broken is a finding."""
    from ..fmu import usual
    from ..progress import shown
    from ..records import write
    from ..text import aligned
    from . import verify

    with shown(arguments.progress) as progress:
        found, faults = verify(arguments.fmu or usual(), arguments.quick, progress)
    for fault in faults:
        print(f"fault: {fault}")
    print("\n".join(aligned([HEAD, *map(_row, found)], 3)))
    for judged in found:
        for line in _problems(judged):
            print(line)
    if any(judged.assumed for judged in found):
        print(f"no tolerance is stated: {ASSUMED:g} of each variable's largest magnitude is assumed")
    wrong = sum(judged.verdict != "passed" for judged in found)
    print(f"{len(found)} experiments, {len(found) - wrong} passed" + (f", {wrong} not" if wrong else ""))
    if arguments.quick:
        print("quick: only smoke tests where there are any")
    if arguments.csv:
        write(arguments.csv, TABLE, _cells(found), "times in s, values in the unit of the variable")
        print(f"written: {arguments.csv}")
    return FINDING if wrong else DONE


def _row(judged: Judged) -> tuple[str, ...]:
    worst = judged.worst
    if worst is None:
        return judged.name, judged.kind, "", "", "", judged.verdict
    return judged.name, judged.kind, worst.variable, f"{worst.ratio:.3g}", f"{worst.time:.6g}", judged.verdict


def _problems(judged: Judged) -> list[str]:
    """What is wrong, a line for each variable that deviates too far, the worst first."""
    if judged.problem:
        return [f"{judged.name}, {judged.kind}: {judged.problem}"]
    wrong = sorted((each for each in judged.deviations if not each.ratio <= 1.0), key=lambda each: -each.ratio)
    return [f"{judged.name}, {judged.kind}: {each.variable} at {each.time:.6g} s is {each.value:.9g} {each.unit}, expected "
            f"{each.expected:.9g} {each.unit} within {each.tolerance:.2g}: off by {each.size:.3g}, {each.ratio:.3g} times the tolerance"
            for each in wrong]


def _cells(found: Iterable[Judged]) -> list[tuple[object, ...]]:
    rows: list[tuple[object, ...]] = []
    for judged in found:
        if judged.problem:
            rows.append((judged.name, judged.kind, *("",) * 7, judged.verdict))
        for each in judged.deviations:
            verdict = "passed" if each.ratio <= 1.0 else "failed"
            rows.append((judged.name, judged.kind, each.variable, each.unit, float(each.time), float(each.value), float(each.expected),
                         float(each.size), float(each.tolerance), verdict))
    return rows
