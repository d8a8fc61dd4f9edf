"""Sections of a report in their order, and the page: one self-contained HTML file."""

from collections.abc import Sequence
from pathlib import Path

from ..answers import Progress
from ..extras import matplotlib, require
from ..progress import part, silent
from ..scene import Scene
from ..values import FileName
from ..writing import write_whole
from . import axle, energy, forces, gears, head, pattern, strength, traces, waterfall, worth
from .blocks import Picture, Section, Table, Text
from .simulated import Simulated

# sections that need no further run, before and after those that do
FIRST = (head.section, head.setup, gears.section, axle.section, traces.key_figures, traces.section, forces.section, forces.transmission_error)
LAST = (pattern.section, strength.section, energy.section)
# fractions of the work at which pictures of the scene, the run-up, further pictures and the other effects begin
PICTURES, RUN_UP, REST, EFFECTS = 0.05, 0.3, 0.5, 0.65


def write(scene: Scene, file: FileName, quick: bool = False, progress: Progress = silent) -> Path:
    """Simulates `scene` and writes its report to `file`; returns its path.

    `quick` leaves out the run-up and the effects that are off, which need other runs. Raises `DifferentialError` with the FMU's
    message if it refuses the scene."""
    need()
    progress(0.0, "the scene")
    run = Simulated.of(scene)
    progress(PICTURES, "pictures")
    sections = [section(run) for section in FIRST]
    if not quick:
        sections.append(waterfall.section(run, part(progress, RUN_UP, REST)))
    progress(REST, "pictures")
    sections += [section(run) for section in LAST]
    if not quick:
        sections.append(worth.section(run, part(progress, EFFECTS, 1.0)))
    write_whole(file, page(scene.name, scene.description, sections))
    progress(1.0, "done")
    return Path(file)


def need() -> None:
    """Fails if a package that writes reports is missing."""
    matplotlib("report")
    require("jinja2", "report")


def page(title: str, description: str, sections: Sequence[Section]) -> str:
    """HTML text of a page."""
    jinja2 = require("jinja2", "report")
    # text of scenes and of the FMU is escaped; a missing name in the template is an error
    environment = jinja2.Environment(loader=jinja2.PackageLoader(__package__, ""), autoescape=True, trim_blocks=True,
                                     lstrip_blocks=True, undefined=jinja2.StrictUndefined)
    environment.tests.update(text=lambda block: isinstance(block, Text), table=lambda block: isinstance(block, Table),
                             picture=lambda block: isinstance(block, Picture))
    return environment.get_template("template.html").render(title=title, description=description, sections=sections) + "\n"
