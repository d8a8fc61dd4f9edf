"""Cost of accuracy: methods, decisions, the ladder of fidelities, pictures, and the summary.

usage: cost.py FMU FOLDER [--quick | --decisions]

Writes decisions.md, with the laws unless --quick is given, and summary.md unless --decisions is given; prints both."""

import sys
from pathlib import Path

import ladder
import precision
from bevel_differential import Fmu, style
from cost_decisions import ALL, decisions
from cost_figures.fidelity_ladder import fidelity_ladder
from cost_figures.other_solvers import other_solvers
from cost_figures.work_precision import counts, forces, speeds
from cost_laws import laws
from cost_summary import summary
from tools import machine, say, tell

PICTURES = [speeds, forces, counts, other_solvers, fidelity_ladder]
# start of each part on the progress bar
METHODS, LADDER, DECISIONS, DRAWING = 0.1, 0.6, 0.75, 0.95


def main():
    fmu, folder, *how = sys.argv[1:]
    quick, alone = "--quick" in how, "--decisions" in how
    fmu, folder, measured = Fmu.of(fmu), Path(folder), f"\nMeasured on {machine()}.\n"
    of_laws = "" if quick else laws(fmu, 0.0, METHODS)
    if not alone:
        precision.measure(fmu, folder, precision.QUICK if quick else precision.FULL, METHODS, LADDER)
        ladder.measure(fmu, folder, quick, LADDER, DECISIONS)
    table = decisions(folder, 1 if quick else len(ALL), METHODS if alone else DECISIONS, 1.0 if alone else DRAWING)
    tell(f"{table}\n{of_laws}{measured}", folder / "decisions.md")
    if not alone:
        draw(folder)
        print()
        tell(f"{summary(folder)}{measured}", folder / "summary.md")


def draw(folder):
    """Draws all pictures."""
    style.apply()
    for done, picture in enumerate(PICTURES):
        say(DRAWING + (1.0 - DRAWING) * done / len(PICTURES), f"drawing {picture.__name__.replace('_', ' ')}")
        picture(folder)


if __name__ == "__main__":
    main()
