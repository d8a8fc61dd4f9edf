"""The command `plan`: what a scene will simulate, and the scene for other hosts."""

import argparse

from .arguments import add_set, add_units, once


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Adds the arguments of the command."""
    parser.add_argument("scene", nargs="?", help="a scene file (TOML), or the name of a shipped scene; without it, list the scenes")
    add_set(parser)
    add_units(parser)
    parser.add_argument("--ssv", metavar="FILE", help="write the start values as a parameter set of SSP 1.0, which hosts read")
    parser.add_argument("--python", metavar="FILE", help="write a Python script that simulates the scene, with the bits of `run`")


def run(arguments: argparse.Namespace) -> int:
    """Prints the plan and writes files. Returns 0."""
    from ..answers import about, ask
    from ..output_file import checked
    from ..writing import write_whole

    if arguments.scene is None:
        print(listed("plan", arguments))
        return 0
    of = about(arguments.scene, once("--set", arguments.set), arguments.unit)
    files = {kind: checked(file) for kind, file in (("ssv", arguments.ssv), ("python", arguments.python)) if file}
    print(ask({"ask": "plan", "of": of})["text"], end="")
    for kind, file in files.items():
        write_whole(file, ask({"ask": "export", "of": of, "format": kind})["text"])
        print(f"written: {file}")
    return 0


def listed(command: str, arguments: argparse.Namespace) -> str:
    """The scenes with what they are; options are wrong where there is no scene."""
    from ..answers import ask, scenes
    from ..text import aligned
    from ..values import DifferentialError

    given = [f"--{name}" for name, value in vars(arguments).items() if name != "fmu" and value]
    if given:
        raise DifferentialError(f"{', '.join(given)}: name a scene; `bevel-differential {command}` lists them", kind="use")
    return "\n".join(aligned([(scene["name"], scene["description"]) for scene in ask({"ask": "scenes", "scenes": scenes()})["scenes"]]))
