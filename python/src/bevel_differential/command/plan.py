"""The command `plan`: describes what a scene simulates, and writes the scene for other hosts."""

import argparse

from . import DONE
from .arguments import DECIMAL, add_file, add_set, add_times, add_units, changes


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Adds the arguments of the command."""
    parser.add_argument("scene", nargs="?", help="a scene file (TOML), or the name of a shipped scene; without it, list the scenes")
    add_set(parser)
    add_times(parser)
    add_units(parser)
    add_file(parser, "--ssv", "parameter set", "write the start values as a parameter set of SSP 1.0, which hosts read")
    add_file(parser, "--python", "Python script", "write a Python script that simulates the scene to the same bits as `run`")


def run(arguments: argparse.Namespace) -> int:
    """Prints the plan and writes files."""
    from ..answers import about, ask
    from ..writing import write_whole

    if arguments.scene is None:
        print(listed("plan", arguments))
        return DONE
    of = about(arguments.scene, changes(arguments), arguments.unit)
    print(ask({"ask": "plan", "of": of})["text"], end="")
    for kind, file in (("ssv", arguments.ssv), ("python", arguments.python)):
        if file:
            write_whole(file, ask({"ask": "export", "of": of, "format": kind})["text"])
            print(f"written: {file}")
    return DONE


def listed(command: str, arguments: argparse.Namespace) -> str:
    """List of the scenes with their descriptions. Raises `DifferentialError` if there are options, because they need a scene."""
    from ..answers import ask, scenes
    from ..text import aligned
    from ..values import DifferentialError

    # the decimal sign has a start value
    given = [f"--{name.replace('_', '-')}" for name, value in vars(arguments).items()
             if name != "fmu" and value and (name, value) != (DECIMAL, "point")]
    if given:
        raise DifferentialError(f"{', '.join(given)}: name a scene; `bevel-differential {command}` lists them", kind="use")
    return "\n".join(aligned([(scene["name"], scene["description"]) for scene in ask({"ask": "scenes", "scenes": scenes()})["scenes"]]))
