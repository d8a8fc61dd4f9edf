"""What accuracy costs, after `lab cost` has measured methods and couplings: the ladder of fidelities, pictures, and the summary.

usage: cost.py FMU FOLDER [--quick]
"""

import sys
from pathlib import Path

from bevel_differential import Fmu, style
from cost_figures.communication_step import communication_step
from cost_figures.fidelity_ladder import fidelity_ladder
from cost_figures.other_solvers import other_solvers
from cost_figures.work_precision import counts, forces, speeds
from cost_summary import summary
from ladder import measure
from tools import say

PICTURES = [speeds, forces, counts, other_solvers, fidelity_ladder, communication_step]
# parts of the command's bar: where the ladder begins, and the pictures
BEGIN, DRAWING = 0.85, 0.95


def main():
    folder = Path(sys.argv[2])
    measure(Fmu.of(sys.argv[1]), folder, "--quick" in sys.argv, BEGIN, DRAWING)
    style.apply()
    for done, draw in enumerate(PICTURES):
        say(DRAWING + (1.0 - DRAWING) * done / len(PICTURES), f"drawing {draw.__name__.replace('_', ' ')}")
        draw(folder)
    print(summary(folder))


if __name__ == "__main__":
    main()
