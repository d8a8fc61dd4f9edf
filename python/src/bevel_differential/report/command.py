"""The command `report`: a page about a scene."""

import argparse

from ..command.arguments import add_fmu, add_set, once

HELP = "write a report of a scene: one HTML file with figures, tables and what they say"
EXTRA = "report"


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Adds what the command takes."""
    parser.add_argument("--scene", metavar="FILE|NAME", required=True, help="a scene file (TOML), or the name of a shipped scene")
    add_set(parser)
    parser.add_argument("--out", metavar="FILE", help="the page to write (start value: report-NAME.html)")
    parser.add_argument("--quick", action="store_true", help="leave out what needs other runs: the run-up, and effects that are "
                                                             "off")
    add_fmu(parser)


def run(arguments: argparse.Namespace) -> int:
    """Writes the report and says where. Returns 0."""
    from ..extras import needed
    from ..output_file import checked
    from ..scene import Scene
    from .write import write

    tqdm = needed("tqdm", "report").tqdm
    with Scene.load(arguments.scene, fmu=arguments.fmu) as scene:
        scene.set(once("--set", arguments.set))
        file = arguments.out or f"report-{scene.name}.html"
        checked(file)
        with tqdm(total=100, unit="%", dynamic_ncols=True, leave=False, bar_format="{desc}: {percentage:3.0f} %|{bar}|") as bar:

            def progress(done: float, what: str) -> None:
                bar.set_description_str(what)
                bar.update(round(100.0 * done) - bar.n)

            written = write(scene, file, arguments.quick, progress)
        print(f"written: {written}")
    return 0
