"""What accuracy costs: methods, the communication step, decisions, the ladder of fidelities, pictures, and the summary.

usage: cost.py FMU FOLDER [--quick]
       cost.py FOLDER                  the decisions alone

Writes the decisions into FOLDER/decisions.md, with LAWS where `lab cost` has a table of its own, and prints the summary."""

import sys
from pathlib import Path

import coupling
import ladder
import precision
from bevel_differential import Fmu, style
from cost_decisions import ALL, decisions
from cost_figures.communication_step import communication_step
from cost_figures.fidelity_ladder import fidelity_ladder
from cost_figures.other_solvers import other_solvers
from cost_figures.work_precision import counts, forces, speeds
from cost_summary import summary
from tools import machine, say

PICTURES = [speeds, forces, counts, other_solvers, fidelity_ladder, communication_step]
# where the parts of the bar begin
METHODS, COUPLING, LADDER, DECISIONS, DRAWING = 0.1, 0.5, 0.65, 0.75, 0.95


def main():
    quick, alone = "--quick" in sys.argv, len(sys.argv) == 2
    folder, measured = Path(sys.argv[1 if alone else 2]), f"\nMeasured on {machine()}.\n"
    if not alone:
        fmu = Fmu.of(sys.argv[1])
        precision.measure(fmu, folder, precision.QUICK if quick else precision.FULL, METHODS, COUPLING)
        coupling.measure(fmu, folder, coupling.QUICK if quick else coupling.FULL, 1 if quick else 3, COUPLING, LADDER)
        ladder.measure(fmu, folder, quick, LADDER, DECISIONS)
    table = decisions(folder, 1 if quick else len(ALL), not quick, METHODS if alone else DECISIONS, 1.0 if alone else DRAWING)
    (folder / "decisions.md").write_text(f"{table}\nLAWS\n{measured}", encoding="utf-8")
    if alone:
        return
    style.apply()
    for done, draw in enumerate(PICTURES):
        say(DRAWING + (1.0 - DRAWING) * done / len(PICTURES), f"drawing {draw.__name__.replace('_', ' ')}")
        draw(folder)
    print(f"{summary(folder)}{measured}", end="")


if __name__ == "__main__":
    main()
