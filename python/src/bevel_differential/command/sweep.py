"""The command `sweep`: runs a scene for all designs of a plan."""

import argparse
from pathlib import Path

from . import DONE, FINDING
from .arguments import add_farm, add_file, add_files, add_fmu, add_set, add_stop, add_units, assignment, farm, once

# keys of a plan file, and the names of the options here
KEYS = {"scene": "scene", "stop": "stop", "set": "set", "vary": "vary", "plan": "plan", "runs": "runs", "seed": "seed", "want": "want",
        "condition": "condition", "from": "start"}
DEFAULTS = {"plan": "random", "seed": 0, "start": 0.0}


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Adds the arguments of the command."""
    parser.add_argument("--scene", help="a scene file (TOML), or the name of a shipped scene")
    parser.add_argument("--vary", metavar="NAME=VALUES", type=assignment, action="append", default=[],
                        help="FROM..TO, FROM..TO:COUNT, a list A, B, C, uniform(A, B), normal(MEAN, SD), "
                             "triangular(A, PEAK, B), lognormal(MEDIAN, FACTOR) or seed")
    add_set(parser)
    add_stop(parser)
    parser.add_argument("--plan", choices=["grid", "lhs", "sobol", "random"], help="which designs to try (default: random)")
    parser.add_argument("--runs", type=int, metavar="N", help="number of designs; not for a grid; Sobol rounds up to a power of two")
    parser.add_argument("--seed", type=int, metavar="N", help="seed of all draws (default: 0)")
    parser.add_argument("--want", metavar="OUTPUT:STATISTIC", action="append", default=[],
                        help="a quantity to record, such as left.speed:mean; the final value without a statistic")
    parser.add_argument("--condition", metavar="CONDITION", action="append", default=[],
                        help="a condition that a feasible design meets, such as \"safety.root_min >= 1.2\"")
    parser.add_argument("--from", dest="start", metavar="TIME", help="quantities count from this time on, such as \"0.14 s\"")
    parser.add_argument("--plan-file", metavar="FILE", help=f"all of this as TOML, with the keys {', '.join(KEYS)}")
    add_file(parser, "--out", "Parquet file", "results; --resume continues from this file")
    add_files(parser, "all runs as a table", "quantities over varied values, and the Pareto front of the objectives")
    parser.add_argument("--objective", metavar="OBJECTIVE", action="append", default=[],
                        help="a wanted quantity to \"maximise OUTPUT:STATISTIC\" or \"minimise …\"; the picture shows the Pareto front of two or "
                             "more")
    parser.add_argument("--resume", action="store_true", help="run only the designs that are missing in the results")
    parser.add_argument("--force", action="store_true", help="overwrite existing results")
    add_units(parser)
    add_farm(parser)
    add_fmu(parser)


def run(arguments: argparse.Namespace) -> int:
    """Runs the sweep and prints its results. Failed runs, and a sweep without a feasible design, are findings. Raises
    `DifferentialError`, `KeyboardInterrupt`."""
    from ..designs.sweep import sweep, text
    from ..extras import matplotlib
    from ..optimise.problem import Objective
    from ..scene import Scene
    from ..records import write
    from ..values import DifferentialError

    given = _merged(arguments)
    if arguments.plot:
        # before the work, because it needs further packages
        from ..designs.picture import draw

        matplotlib("plot")
    if not given.get("scene"):
        raise DifferentialError("name a scene: --scene NAME")
    with Scene.load(given["scene"], arguments.fmu, given.get("stop"), arguments.unit) as scene:
        scene.set(given["set"])
        objectives = [Objective.parse(scene.fmu, text) for text in arguments.objective]
        given["want"] += [str(each.want) for each in objectives if str(each.want) not in given["want"]]
        result = sweep(scene, given["vary"], given["plan"], given.get("runs"), given["seed"], given["want"], given["condition"],
                       given["start"], arguments.out, arguments.resume, arguments.force, **farm(arguments), progress=True)
        scene.fmu.check_shown(arguments.unit, [*result.metadata["vary"], *(name.partition(":")[0] for name in result.metadata["figures"])])
        print(text(result, given.get("runs"), scene.fmu, arguments.csv is not None))
        if arguments.csv:
            columns = result.displayed(scene.fmu)
            print(f"written: {write(arguments.csv, columns, zip(*columns.values()))}")
        if arguments.plot:
            print(f"written: {draw(result, scene.fmu, arguments.plot, objectives)}")
    return FINDING if result.failures() or result.undefined() or not any(result.table["feasible"].to_pylist()) else DONE


def _merged(arguments):
    """Values of the plan file. Values of the command line replace or extend them."""
    given = {**DEFAULTS, **(_read(arguments.plan_file) if arguments.plan_file else {})}
    for name in ("scene", "stop", "plan", "runs", "seed", "start"):
        if getattr(arguments, name) is not None:
            given[name] = getattr(arguments, name)
    for name in ("set", "vary"):
        given[name] = {**given.get(name, {}), **once(f"--{name}", getattr(arguments, name))}
    for name in ("want", "condition"):
        given[name] = [*given.get(name, []), *getattr(arguments, name)]
    return given


def _read(file):
    from ..curve import beside
    from ..scene_file import flat, read_toml
    from ..values import DifferentialError, suggestion

    found = read_toml(Path(file))
    for key in found:
        if key not in KEYS:
            raise DifferentialError(f"{file}: {key}: there is no such key{suggestion(key, KEYS)}; known: {', '.join(KEYS)}")
    for kind, written, keys in [(dict, "a table", ("set", "vary")), (list, "a list", ("want", "condition")),
                                (str, "a text", ("scene", "plan")), (int, "a whole number", ("runs", "seed"))]:
        for key in keys:
            if not isinstance(found.get(key, kind()), kind):
                raise DifferentialError(f"{file}: {key} is {written}")
    for key in ("want", "condition"):
        if not all(isinstance(entry, str) for entry in found.get(key, [])):
            raise DifferentialError(f"{file}: {key} is a list of texts, such as \"left.speed:mean\"")
    read = {"set": lambda values: beside(flat(values), Path(file)), "vary": flat}
    return {KEYS[key]: read[key](value) if key in read else value for key, value in found.items()}
