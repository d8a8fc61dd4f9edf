"""All sections of a report, in their order."""

from collections.abc import Callable
from pathlib import Path

from ..extras import needed
from ..scene import Scene
from ..values import FileName
from . import energy, errors, forces, gears, head, pattern, setup, strength, summary, traces, waterfall, worth
from .page import page
from .page import write as write_page
from .simulated import Simulated

# (part of the work that is done, what comes next)
Progress = Callable[[float, str], object]

# sections that need no other run, before and after those that do
FIRST = (head.section, setup.section, gears.section, summary.section, traces.section, forces.section, errors.section)
LAST = (pattern.section, strength.section, energy.section)
# parts of the work when pictures of the scene, the run-up and the other effects begin
PICTURES, RUN_UP, REST, EFFECTS = 0.05, 0.3, 0.5, 0.65


def write(scene: Scene, file: FileName, quick: bool = False, progress: Progress = lambda done, what: None) -> Path:
    """Simulates `scene` and writes its report to `file`; returns its path.

    `quick` leaves out the run-up and the effects that are off, which need other runs. Raises `DifferentialError` with the FMU's
    message where it refuses the scene."""
    for module in ("matplotlib", "jinja2"):
        needed(module, "report")
    progress(0.0, "the scene")
    run = Simulated.of(scene)
    progress(PICTURES, "pictures")
    sections = [section(run) for section in FIRST]
    if not quick:
        progress(RUN_UP, "the run-up")
        sections.append(waterfall.section(run, lambda done: progress(RUN_UP + done * (REST - RUN_UP), "the run-up")))
    progress(REST, "pictures")
    sections += [section(run) for section in LAST]
    if not quick:
        progress(EFFECTS, "effects that are off")
        sections.append(worth.section(run, lambda done: progress(EFFECTS + done * (1.0 - EFFECTS), "effects that are off")))
    written = write_page(page(run, sections), file)
    progress(1.0, "done")
    return written
