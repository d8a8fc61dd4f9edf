"""The command `coupling`."""

import argparse
import math

from ..command import DONE, FINDING
from ..command.arguments import add_file, add_fmu, add_set, once

# masters of the command; rollback needs a master that saves states, which Python offers
MASTERS, INPUTS = ("jacobi", "gauss-seidel"), ("held", "lines")


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Adds the arguments of the command."""
    parser.add_argument("scene", help="a scene file (TOML), or the name of a shipped scene")
    add_set(parser)
    parser.add_argument("--host", metavar="HOST", action="append", required=True,
                        help="PORT:k=9000,c=12,J=1,reads=speed: spring, damper and the inertia behind them at the port carrier, left or "
                             "right, in SI; without J a wall; reads is speed, angle or both. At a port driven by speed: PORT:J=1,c=30, "
                             "an inertia and a damper to the ground; or PORT:FILE.toml, the scene of an axle that this half-shaft drives. May be "
                             "repeated")
    parser.add_argument("--master", choices=MASTERS, default=MASTERS[0],
                        help="jacobi: both sides step at the same time; gauss-seidel: the unit steps first (default: jacobi)")
    parser.add_argument("--input", choices=INPUTS, default=INPUTS[0], help="inputs held over a step, or on lines (default: held)")
    parser.add_argument("--at", metavar="TIME", default="0 s", help="time in the scene of the operating point (default: its start)")
    add_file(parser, "--plot", "picture", "draw the growth of a disturbance over the step")
    add_fmu(parser)


def run(arguments: argparse.Namespace) -> int:
    """Prints the longest stable step and writes files. If no step is stable, this is a finding. Raises `DifferentialError`."""
    from ..scene import Scene
    from ..scene_file import find, find_beside
    from ..text import aligned
    from . import Host, coupling, other_unit
    from .picture import draw

    hosts = []
    for text in arguments.host:
        port, _, rest = text.partition(":")
        if rest.endswith(".toml"):
            with Scene.load(find_beside(find(arguments.scene), rest), arguments.fmu) as other:
                hosts.append(other_unit(port, other, arguments.at))
        else:
            hosts.append(Host.parse(text))
    with Scene.load(arguments.scene, arguments.fmu) as scene:
        scene.set(once("--set", arguments.set))
        result = coupling(scene, hosts, arguments.master, arguments.input, at=arguments.at)
    for host in hosts:
        print(f"{host.port}: {host.words}")
    print(f"longest stable step: {step(result.limit)} ({arguments.master}, inputs {'on lines' if arguments.input == 'lines' else 'held'})")
    if departure := result.departure:
        print(f"the teeth do not rest at this time: a disturbance grows by a factor e in {1.0 / departure:.3g} s, also without a cut; "
              "this growth is not counted (effects.thrust_friction and other friction stop it; --at names another time)")
    if lost := result.mode():
        twice = 2.0 * result.step
        doubling = result.doubling(twice)
        pace = f"; in steps of {step(twice)}, it doubles in {doubling:.3g} s" if math.isfinite(doubling) else ""
        print(f"beyond it grows: {lost.frequency:.3g} Hz at the port {lost.port}{pace}")
    print(f"\nas the hosts see the ports in steps of {step(result.step)}:")
    rows = [(port, f"{found.inertia:.4g}", f"{found.stiffness:.4g}") for port, found in result.apparent().items()]
    print("\n".join(aligned([("port", "inertia, kg.m2", "stiffness, N.m/rad"), *rows], 1)))
    limits = result.limits()
    print("\nlongest stable step of each master:")
    masters = dict.fromkeys(master for master, _ in limits)
    print("\n".join(aligned([("master", *(f"inputs {name}" if name == "held" else "on lines" for name in INPUTS)),
                             *((master, *(step(limits[master, name]) for name in INPUTS)) for master in masters)], 1)))
    if arguments.plot:
        print(f"\nwritten: {draw(result, arguments.plot)}")
    return DONE if result.limit else FINDING


def step(limit: float) -> str:
    """A step in words, in ms."""
    return "none" if limit == 0.0 else "any up to 1 s" if limit == float("inf") else f"{limit * 1e3:.3g} ms"
