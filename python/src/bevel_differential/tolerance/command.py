"""The command `tolerance`: what manufacturing tolerances do."""

import argparse
from pathlib import Path

from ..command.arguments import add_fmu

HELP = "what manufacturing tolerances do: spread of figures, yield, and which tolerance is worth its money"
EXTRA = "design"
QUICK = 64


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """What the command takes."""
    parser.add_argument("file", help="tolerance file (docs/tolerances.md)")
    parser.add_argument("--runs", type=int, help="differentials to draw, a power of two, instead of what the file says")
    parser.add_argument("--seed", type=int, help="another draw")
    parser.add_argument("--quick", action="store_true", help=f"{QUICK} draws: a first look")
    parser.add_argument("--no-indices", action="store_true", help="spread and yield alone: a fraction of the runs")
    parser.add_argument("--workers", type=int, help="how many work at once (default: one per core; 0: this process alone)")
    parser.add_argument("--threads", action="store_true", help="workers are threads, not processes")
    parser.add_argument("--scheduler", metavar="ADDRESS", help="a dask scheduler whose workers run the designs")
    parser.add_argument("--csv", type=Path, help="write all runs to this file")
    parser.add_argument("--picture", type=Path, help="write a picture (PNG, SVG or PDF) to this file")
    add_fmu(parser)


def run(arguments: argparse.Namespace) -> int:
    """Runs the command."""
    from ..designs import Farm
    from ..output_file import checked, checked_picture
    from . import report
    from .plan import Plan

    checked(arguments.csv)
    checked_picture(arguments.picture)
    runs = QUICK if arguments.quick and arguments.runs is None else arguments.runs
    plan = Plan.load(arguments.file, fmu=arguments.fmu, runs=runs, seed=arguments.seed, indices=not arguments.no_indices)
    with Farm(arguments.workers, not arguments.threads, arguments.scheduler, progress=True) as farm:
        result = plan.run(farm)
    print(report.text(plan, result))
    if arguments.csv:
        print(f"\nruns: {report.write_runs(plan, result, arguments.csv)}")
    if arguments.picture:
        from . import picture

        print(f"picture: {picture.draw(plan, result, arguments.picture)}")
    return 0
