"""Draws the pictures of what accuracy costs from the CSV files that `lab cost` measured.

usage: cost.py FOLDER
"""

import sys
from pathlib import Path

from cost_figures.communication_step import communication_step
from cost_figures.fidelity_ladder import fidelity_ladder
from cost_figures.other_solvers import other_solvers
from cost_figures.work_precision import counts, forces, speeds

from bevel_differential import style

PICTURES = [speeds, forces, counts, other_solvers, fidelity_ladder, communication_step]


def main():
    style.apply()
    folder = Path(sys.argv[1])
    for done, draw in enumerate(PICTURES):
        print(f"progress {0.95 + 0.05 * done / len(PICTURES):.3f} drawing {draw.__name__.replace('_', ' ')}", file=sys.stderr,
              flush=True)
        draw(folder)


if __name__ == "__main__":
    main()
