"""The command `plan`: what a scene will simulate, and the scene for other hosts."""

import argparse
from pathlib import Path

from .arguments import add_set, once


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Adds what the command takes."""
    parser.add_argument("scene", nargs="?", help="a scene file (TOML), or the name of a shipped scene; without it, list the scenes")
    add_set(parser)
    parser.add_argument("--ssv", metavar="FILE", help="write the start values as a parameter set of SSP 1.0, which hosts read")
    parser.add_argument("--python", metavar="FILE", help="write a Python script that simulates the scene, with the bits of `run`")


def run(arguments: argparse.Namespace) -> int:
    """Prints the plan and writes files. Returns 0."""
    from ..answers import about, ask, scenes
    from ..output_file import checked
    from ..values import DifferentialError

    if arguments.scene is None:
        if arguments.set or arguments.ssv or arguments.python:
            raise DifferentialError("--set, --ssv and --python need a scene; `bevel-differential plan` lists them")
        found = ask({"ask": "scenes", "scenes": scenes()})["scenes"]
        width = max(len(scene["name"]) for scene in found)
        print("\n".join(f"{scene['name'].ljust(width)}  {scene['description']}" for scene in found))
        return 0
    of = about(arguments.scene, once("--set", arguments.set))
    files = {kind: checked(file) for kind, file in (("ssv", arguments.ssv), ("python", arguments.python)) if file}
    print(ask({"ask": "plan", "of": of})["text"], end="")
    for kind, file in files.items():
        Path(file).write_text(ask({"ask": "export", "of": of, "format": kind})["text"], encoding="utf-8")
        print(f"written: {file}")
    return 0
