"""The command `losses`."""

import argparse

from ..command import DONE, FINDING
from ..command.arguments import add_farm, add_file, add_files, add_fmu, add_quick, add_scene, add_units, farm, once

# default values of the axes; those of torque and speed are fractions of the largest values that the scene reaches
TORQUE, SPEED, DIFFERENCE, TEMPERATURE = "torque", "speed", "difference", "temperature"
USUAL = {DIFFERENCE: "0.5 rad/s..20 rad/s", TEMPERATURE: "-20 degC, 20 degC, 80 degC, 120 degC"}
REACHED = "default: a tenth to all of the largest that the scene reaches"
OPTIONS = {TORQUE: f"carrier torque ({REACHED})", SPEED: f"carrier speed ({REACHED})",
           DIFFERENCE: f"difference of the wheel speeds, above 0; both directions run (default: {USUAL[DIFFERENCE]})",
           TEMPERATURE: f"oil temperature (default: {USUAL[TEMPERATURE]})"}

# bound of the error, and number of points that measure it, in a full and in a quick map
BOUND, UNSEEN, QUICK_BOUND, QUICK_UNSEEN = "2,0.1", 300, "10,0.5", 50


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Adds the arguments of the command."""
    add_scene(parser)
    for name, what in OPTIONS.items():
        parser.add_argument(f"--{name}", metavar="VALUES", help=f"{what}; FROM..TO, FROM..TO:COUNT or a list A, B, C")
    parser.add_argument("--within", metavar="PERCENT", help="let `accuracy` choose the cheapest model, such as 1%% (default: the scene's)")
    parser.add_argument("--bound", metavar="PERCENT,TORQUE", help=f"largest error, in %% of the value plus N.m (default: {BOUND})")
    parser.add_argument("--unseen", metavar="N", type=int, help=f"points that measure the error (default: {UNSEEN})")
    add_quick(parser, f"--bound {QUICK_BOUND} --unseen {QUICK_UNSEEN}")
    parser.add_argument("--seed", metavar="N", type=int, default=1, help="seed of these points (default: 1)")
    parser.add_argument("--most", metavar="N", type=int, default=20000, help="maximum number of points in one direction (default: 20000)")
    add_file(parser, "--out", "Parquet file", "all runs; --resume continues from this file")
    parser.add_argument("--resume", action="store_true", help="run only the points that are missing in the file")
    parser.add_argument("--force", action="store_true", help="overwrite existing runs")
    add_units(parser)
    add_files(parser, "the map, in SI with any --unit", "bias, loss and measured error")
    add_file(parser, "--simulink", "MATLAB script", "write the map for blocks of Simulink")
    add_file(parser, "--report", "page", "write a page with figures, tables and the measured error")
    add_farm(parser)
    add_fmu(parser)


def run(arguments: argparse.Namespace) -> int:
    """Measures the map, prints its error and writes files. A map that is worse than its bound is a finding. Raises
    `DifferentialError`, `KeyboardInterrupt`."""
    from ..report.write import need
    from ..scene import Scene
    from . import losses
    from .coupling import left_out
    from .grid import GOAL
    from .picture import draw
    from .report import write as write_report
    from .tables import lossless, save, save_for_simulink

    if arguments.report:
        need()
    bound = arguments.bound or (QUICK_BOUND if arguments.quick else BOUND)
    unseen = arguments.unseen if arguments.unseen is not None else QUICK_UNSEEN if arguments.quick else UNSEEN
    with Scene.load(arguments.scene, arguments.fmu, arguments.stop, arguments.unit, arguments.step) as scene:
        scene.set(once("--set", arguments.set))
        levels = {of.variable: of.levels() for of in _axes(scene, arguments)}
        result = losses(scene, levels, within=arguments.within, bound=_bound(bound), unseen=unseen, seed=arguments.seed,
                      most=arguments.most, out=arguments.out, resume=arguments.resume, force=arguments.force, tell=print, progress=True,
                      **farm(arguments))
    print(result.error)
    if arguments.quick:
        print(f"quick: --bound {bound} --unseen {unseen}; a map has --bound {BOUND} --unseen {UNSEEN}")
    if result.estimate > GOAL:
        print(f"the map stops at --most {arguments.most} points in one direction: the estimated error is still above the bound")
    if result.restless:
        print(f"{result.restless} points do not settle: they have the means of their last cycles")
    print(f"{result.new} runs in {result.seconds:.1f} s")
    for file, write in ((arguments.csv, save), (arguments.simulink, save_for_simulink), (arguments.plot, draw),
                        (arguments.report, write_report)):
        if file:
            print(f"written: {write(result, file)}")
    if arguments.simulink and (why := lossless(result)):
        print(f"{arguments.simulink}: {why}")
    if arguments.simulink and (why := left_out(result)):
        print(f"{arguments.simulink} has no tables of the coupling torque: {why}")
    return FINDING if result.estimate > GOAL else DONE


def _axes(scene, arguments):
    from ..designs import Dimension
    from . import VARIABLES

    usual = dict(USUAL)
    if not (arguments.torque and arguments.speed):
        usual |= {name: f"{0.1 * reached!r}..{reached!r}" for name, reached in zip((TORQUE, SPEED), _reached(scene))}
    for name, variable in zip(OPTIONS, VARIABLES):
        text = getattr(arguments, name) or usual[name]
        # a range without a count starts with only its two ends
        yield Dimension.parse(scene.fmu, variable, f"{text}:2" if ".." in text and ":" not in text else text)


def _reached(scene):
    """Largest magnitudes of the torque of the drive and of its speed in the scene, both referred to the carrier."""
    from ..drive_port import PORT_SPEED, PORT_TORQUE, at_port, drive_ratio
    from ..warned import silenced

    # the runs of the map pass on the warnings of the FMU
    with silenced():
        record = at_port(scene).run([PORT_TORQUE, PORT_SPEED])
    torque, speed = (float(abs(record[name]).max()) for name in (PORT_TORQUE, PORT_SPEED))
    return [torque * drive_ratio(scene.value), speed / drive_ratio(scene.value)]


def _bound(text):
    from ..values import DifferentialError
    from .grid import Bound

    try:
        part, torque = map(float, text.split(","))
    except ValueError:
        part = torque = -1.0
    if part < 0.0 or torque <= 0.0:
        raise DifferentialError(f"--bound {text}: write a percentage and a torque in N.m above 0, such as 2,0.1", kind="use")
    return Bound(part / 100.0, torque)
