"""Planets and side gears for the study's car: searches, confirms, and with --write renews table and picture of
docs/optimisation.md. See README.md."""

import argparse
import re
import shutil
import sys
from pathlib import Path

from bevel_differential import DifferentialError
from bevel_differential.optimise import command

HERE = Path(__file__).resolve().parent
PAGE = HERE.parents[1] / "docs/optimisation.md"
PICTURE = HERE.parents[1] / "docs/figures/optimisation.png"
BEGIN, END = "<!-- choice begin -->", "<!-- choice end -->"


def main() -> int:
    """Runs the command with the problem file of this folder."""
    parser = argparse.ArgumentParser(description=__doc__)
    command.add_arguments(parser)
    parser.add_argument("--write", action="store_true", help="renew table and picture of docs/optimisation.md")
    words = sys.argv[1:]
    arguments = parser.parse_args([str(HERE / "study_gears.toml"), *words])
    arguments.out = arguments.out or Path("target/optimise/study_gears")
    try:
        status = command.run(arguments)
    except DifferentialError as error:
        print(error, file=sys.stderr)
        return 2
    if arguments.write and status == 0:
        table = (arguments.out / "choice.md").read_text(encoding="utf-8")
        page = PAGE.read_text(encoding="utf-8")
        page = re.sub(f"{BEGIN}.*{END}", lambda _: f"{BEGIN}\n{table}{END}", page, flags=re.DOTALL)
        PAGE.write_text(page, encoding="utf-8")
        shutil.copy(arguments.out / "front.png", PICTURE)
    return status


if __name__ == "__main__":
    sys.exit(main())
