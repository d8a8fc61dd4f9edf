"""The command `optimise`: from a problem file to a Pareto front, chosen designs and files for CAD."""

import argparse
import math
from pathlib import Path

from ..command import DONE, FINDING
from ..command.arguments import add_farm, add_fmu, add_quick, add_stop, farm
from ..warned import warn
from ..writing import in_folder, locked, write_whole

# effort of --quick: enough for a front, but not for an accurate one
QUICK = {"population": 32, "generations": 12, "starts": 1}


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Adds the arguments of the command."""
    parser.add_argument("problem", type=Path, help="problem file (TOML), such as study_gears.toml of `bevel-differential examples`")
    parser.add_argument("--out", type=Path, help="folder of the results (default: target/optimise/NAME)")
    parser.add_argument("--population", type=int, help="designs of a generation")
    parser.add_argument("--generations", type=int, help="number of generations")
    parser.add_argument("--starts", type=int, help="independent searches; with several, a last one starts from the best designs of all")
    parser.add_argument("--seed", type=int, help="seed of all random numbers; the same seed gives the same front")
    add_stop(parser)
    add_quick(parser, "a small search, and only the chosen designs are confirmed")
    parser.add_argument("--resume", action="store_true", help="continue from the results in the folder")
    add_farm(parser)
    add_fmu(parser)


def run(arguments: argparse.Namespace) -> int:
    """Runs the optimisation. Interference of a chosen design is a finding. Raises `DifferentialError`, of the kind "finding" if no
    design is feasible, and `KeyboardInterrupt`."""
    from ..designs.farm import Farm
    from ..extras import needed
    from .problem import Problem
    from .search import Store

    needed("matplotlib", "design")
    given = {key: getattr(arguments, key) for key in ("population", "generations", "starts", "seed")}
    effort = {key: value for key, value in given.items() if value is not None}
    problem = Problem.load(arguments.problem, arguments.fmu, arguments.stop).sized(**{**(QUICK if arguments.quick else {}), **effort})
    if start_warning := problem.start_warning():
        warn([start_warning])
    out = arguments.out or Path("target/optimise") / arguments.problem.stem
    with locked(out):
        store = Store(out, problem, arguments.resume)
        try:
            with Farm(**farm(arguments)) as workers:
                free = _optimise(arguments, problem, out, store, workers)
        except KeyboardInterrupt:
            raise KeyboardInterrupt(f"stopped: {len(store.rows)} designs are in {out}, the front of the last generation in "
                                    f"{out / 'front.csv'}; continue with --resume") from None
    return DONE if free else FINDING


def _optimise(arguments, problem, out, store, workers):
    """Runs the search; prints and writes its results. Returns true if the gears of all chosen designs turn freely."""
    from .design_task import Confirmed, DesignTask, confirm
    from .front import choice, thinned
    from .report import LETTERS, choice_table, compared_with_front, below_one, draw, scene_text, to_csv, write_gears
    from .search import search

    total = problem.generations * (problem.starts + (problem.starts > 1))

    def after_generation(generation, best):
        # the file must be complete before the line is printed, because readers of the line may open it
        to_csv([Confirmed(row, {}) for row in best], problem, out / "front.csv")
        print(f"generation {generation} of {total}: {len(store.rows)} designs, {len(best)} on the front",
              flush=True)

    task = DesignTask(problem, thorough=True)
    with task.scene:
        compared = {name: task.evaluate(-1 - k, values) for k, (name, values) in enumerate(problem.compare.items())}
    best = search(problem, workers, store, after_generation)
    rows = thinned(best, problem.objectives, problem.front)
    reasons = choice(rows, problem.objectives, next(iter(compared.values()), None))
    chosen = [row for _, row in reasons]
    confirmed = {each.row.run: each for each in confirm(chosen if arguments.quick else rows, chosen, problem, workers)}
    table = choice_table([(reason, confirmed[row.run]) for reason, row in reasons], compared, problem)
    notes = [compared_with_front(name, row, best, problem) for name, row in compared.items()]
    notes += _confirmation(confirmed.values(), problem)
    notes += below_one(chosen)
    if arguments.quick:
        notes.append(f"quick: {len(rows) - len(chosen)} designs of the front are not confirmed; {problem.population} designs x {total} "
                     "generations are a small search, and other seeds may find much better designs")
    print("\n".join(["", table, *notes]))
    all_free = True
    with in_folder(out) as stage:
        to_csv(confirmed.values(), problem, stage / "front.csv")
        write_whole(stage / "choice.md", table + "".join(f"\n{line}\n" for line in notes))
        draw(rows, chosen, compared, problem, stage / "front.png")
        for letter, (reason, row) in zip(LETTERS, reasons):
            write_whole(stage / f"{letter}.toml", scene_text(problem, row, f"design {letter}, {reason}"))
            free = write_gears(problem, row, stage / letter)
            print(f"{letter}: gears in {out / letter}; they turn {'freely' if free else 'with INTERFERENCE'}")
            all_free = all_free and free
    return all_free


def _confirmation(confirmed, problem):
    """Lines for each richer model: number of designs that still meet all conditions, and changes of the objectives."""
    for model in problem.confirm:
        ran = [each for each in confirmed if model in each.models]
        broken = [each for each in ran if each.models[model].refused]
        spans = []
        for objective in problem.objectives:
            changes = [100.0 * each.difference(model, str(objective.want)) for each in ran]
            known = [change for change in changes if not math.isnan(change)]
            if not known:
                spans.append(f"{str(objective.want).removesuffix(':final')} by no known share")
            elif not all(abs(change) < 0.05 for change in changes):
                spans.append(f"{str(objective.want).removesuffix(':final')} by {min(known):+.1f} to {max(known):+.1f} %")
        yield (f"with {model}: {len(ran) - len(broken)} of {len(ran)} designs that ran meet all conditions; this model changes "
               f"{', '.join(spans) or 'nothing'}")
