"""What accuracy costs, after `lab cost` has measured methods and couplings: decisions, the ladder of fidelities, pictures, and the
summary.

usage: cost.py FMU FOLDER [--quick]
       cost.py FOLDER                  the decisions alone

Writes the table of decisions into FOLDER/decisions.md, and prints the summary."""

import sys
from pathlib import Path

from bevel_differential import Fmu, style
from cost_figures.communication_step import communication_step
from cost_figures.fidelity_ladder import fidelity_ladder
from cost_figures.other_solvers import other_solvers
from cost_figures.work_precision import counts, forces, speeds
from cost_decisions import ALL, decisions
from cost_summary import summary
from ladder import measure
from tools import say

PICTURES = [speeds, forces, counts, other_solvers, fidelity_ladder, communication_step]
# parts of the command's bar: where decisions begin, the ladder and the pictures
BEGIN, LADDER, DRAWING = 0.7, 0.85, 0.95


def main():
    quick, alone = "--quick" in sys.argv, len(sys.argv) == 2
    folder = Path(sys.argv[1 if alone else 2])
    table = decisions(folder, 1 if quick else len(ALL), not quick, 0.3 if alone else BEGIN, 1.0 if alone else LADDER)
    (folder / "decisions.md").write_text(table, encoding="utf-8")
    if alone:
        return
    measure(Fmu.of(sys.argv[1]), folder, quick, LADDER, DRAWING)
    style.apply()
    for done, draw in enumerate(PICTURES):
        say(DRAWING + (1.0 - DRAWING) * done / len(PICTURES), f"drawing {draw.__name__.replace('_', ' ')}")
        draw(folder)
    print(summary(folder))


if __name__ == "__main__":
    main()
