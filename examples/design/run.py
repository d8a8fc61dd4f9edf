"""Optimises planets and side gears for the study's car: see README.md. With --write, it updates docs/design.md."""

import argparse
import re
import shutil
import sys
from pathlib import Path

from bevel_differential.command import main

HERE = Path(__file__).resolve().parent
DOCS = HERE.parents[1] / "docs"
BEGIN, END = "<!-- choice begin -->", "<!-- choice end -->"
# rows that the page leaves out: models, whose ranges are below the table, and further checks
LEFT_OUT = ("| …", "| pin.", "| washer.", "| shaft.", "| teeth.", "| face.")


def run() -> int:
    """Runs the command `optimise` with the problem file of this folder. Returns its exit status."""
    parser = argparse.ArgumentParser(description=__doc__, epilog="Other arguments are those of the command optimise.")
    parser.add_argument("--write", action="store_true", help="update the table and picture of docs/design.md")
    parser.add_argument("--out", type=Path, default=Path("target/optimise/study_gears"), help="folder of the results")
    given, others = parser.parse_known_args()
    status = main(["optimise", str(HERE / "study_gears.toml"), "--out", str(given.out), *others])
    if given.write and status == 0:
        page = DOCS / "design.md"
        lines = (given.out / "choice.md").read_text(encoding="utf-8").splitlines(keepends=True)
        table = "".join(line for line in lines if not line.startswith(LEFT_OUT))
        text = re.sub(f"{BEGIN}.*{END}", lambda _: f"{BEGIN}\n{table}{END}", page.read_text(encoding="utf-8"), flags=re.DOTALL)
        page.write_text(text, encoding="utf-8")
        shutil.copy(given.out / "front.png", DOCS / "figures/optimisation.png")
    return status


if __name__ == "__main__":
    sys.exit(run())
