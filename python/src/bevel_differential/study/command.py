"""The command `study`."""

import argparse
from pathlib import Path

from ..command import DONE
from ..command.arguments import add_fmu, add_progress, add_quick

# fractions of the work at which simulation and drawing end; the rest is reports
SIMULATED, DRAWN = 0.25, 0.3


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Adds the arguments of the command."""
    parser.add_argument("--out", metavar="FOLDER", default="study", help="folder of results, pictures and reports (default: study)")
    add_quick(parser, "without the reports")
    add_fmu(parser)
    add_progress(parser)


def run(arguments: argparse.Namespace) -> int:
    """Simulates, compares, and writes files."""
    from ..fmu import Fmu
    from ..progress import part, shown
    from ..report.write import need, write
    from ..scene import Scene
    from ..writing import in_folder, write_whole

    need()
    from .comparison import Comparison
    from .figures import draw
    from .simulation import simulate_cases, start_values
    from .stated import CASES

    scenes = () if arguments.quick else [case.scene for case in CASES.values()]
    whole = DRAWN if scenes else 1.0
    fmu = Fmu.of(arguments.fmu)
    with in_folder(arguments.out) as folder, shown(arguments.progress) as progress:
        runs = simulate_cases(fmu, folder, part(progress, 0.0, SIMULATED / DRAWN * whole))
        draw(folder, runs, part(progress, SIMULATED / DRAWN * whole, whole))
        for index, name in enumerate(scenes):
            share = (1.0 - DRAWN) / len(scenes)
            begin = DRAWN + index * share
            with Scene.load(name, fmu=fmu) as scene:
                write(scene, folder / f"{name}.html", False, part(progress, begin, begin + share))
        found = Comparison(start_values(fmu), runs)
        write_whole(folder / "table.md", found.document())
    folder = Path(arguments.out)
    print(found.terminal())
    print(f"results: {folder}")
    print(f"reports: {', '.join(str(folder / f'{name}.html') for name in scenes)}" if scenes else "quick: without the reports")
    return DONE
