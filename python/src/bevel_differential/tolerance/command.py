"""The command `tolerance`: effects of manufacturing tolerances."""

import argparse

from ..command import DONE, FINDING
from ..command.arguments import add_farm, add_files, add_fmu, add_quick, add_stop, add_units, farm

QUICK = 64


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Adds the arguments of the command."""
    parser.add_argument("file", help="tolerance file (TOML), such as tolerances.toml of `bevel-differential examples`")
    parser.add_argument("--runs", type=int, help="differentials to draw, a power of two, instead of the number in the file")
    parser.add_argument("--seed", type=int, help="another draw")
    add_stop(parser)
    add_quick(parser, f"{QUICK} draws")
    parser.add_argument("--no-indices", action="store_true", help="only spread and yield, with a fraction of the runs")
    add_farm(parser)
    add_units(parser)
    add_files(parser, "all runs", "spread, yield and indices")
    add_fmu(parser)


def run(arguments: argparse.Namespace) -> int:
    """Runs the command. Draws that fail are a finding."""
    from ..designs import Farm
    from ..fmu import Fmu
    from . import report
    from .plan import Plan

    runs = QUICK if arguments.quick and arguments.runs is None else arguments.runs
    plan = Plan.load(arguments.file, fmu=Fmu.of(arguments.fmu).displaying(arguments.unit), runs=runs, seed=arguments.seed,
                     indices=not arguments.no_indices, stop=arguments.stop)
    with Farm(**farm(arguments), progress=True) as workers:
        result = plan.run(workers)
    print(report.text(plan, result))
    if arguments.quick:
        print(f"quick: {plan.study.runs} draws; intervals are wider than with the draws of the file")
    if arguments.csv:
        print(f"\nruns: {report.write_runs(plan, result, arguments.csv)}")
    if arguments.plot:
        print(f"picture: {report.draw(plan, result, arguments.plot)}")
    return FINDING if any(row.message for row in result.rows) else DONE
