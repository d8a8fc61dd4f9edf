"""The command `study`."""

import argparse
from pathlib import Path

from ..command import DONE
from ..command.arguments import add_fmu, add_progress, add_quick

# their scenes, for reports
SCENES = ("study_straight", "study_turning")
# share of the work that is simulating, the rest is reports
SIMULATING = 0.3


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Adds the arguments of the command."""
    parser.add_argument("--out", metavar="FOLDER", default="study", help="folder of results, pictures and reports (default: study)")
    add_quick(parser, "without the reports")
    add_fmu(parser)
    add_progress(parser)


def run(arguments: argparse.Namespace) -> int:
    """Simulates, compares, and writes files."""
    from .. import style
    from ..answers import ask
    from ..progress import part, shown
    from ..report.write import write
    from ..scene import Scene
    from ..writing import in_folder, write_whole
    from .simulation import simulate_cases

    scenes = () if arguments.quick else SCENES
    style.apply()
    with in_folder(arguments.out) as folder, shown(arguments.progress) as progress:
        results = simulate_cases(ask({"ask": "study"}), arguments.fmu, folder, part(progress, 0.0, SIMULATING if scenes else 1.0))
        for place, name in enumerate(scenes):
            share = (1.0 - SIMULATING) / len(scenes)
            begin = SIMULATING + place * share
            with Scene.load(name, fmu=arguments.fmu) as scene:
                write(scene, folder / f"{name}.html", False, part(progress, begin, begin + share))
        found = ask({"ask": "study", "results": results})
        write_whole(folder / "table.md", found["document"])
    folder = Path(arguments.out)
    print(found["text"])
    print(f"results: {folder}")
    print(f"reports: {', '.join(str(folder / f'{name}.html') for name in scenes)}" if scenes else "quick: without the reports")
    return DONE
