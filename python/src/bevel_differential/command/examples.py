"""The command `examples`: the files of designs, tolerances and duty cycles that the documents speak of."""

import argparse
import shutil
from pathlib import Path

from ..values import DifferentialError


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Adds what the command takes."""
    parser.add_argument("--out", metavar="FOLDER", default="examples/design", help="where to copy them (start value: examples/design)")


def run(arguments: argparse.Namespace) -> int:
    """Copies the files and names them. Returns 0. Raises `DifferentialError` where one is there already."""
    out = Path(arguments.out)
    files = sorted(file for file in folder().iterdir() if file.suffix in (".toml", ".csv"))
    there = [file.name for file in files if (out / file.name).exists()]
    if there:
        raise DifferentialError(f"{out}: {', '.join(there)} {'is' if len(there) == 1 else 'are'} there already; name another folder by --out")
    out.mkdir(parents=True, exist_ok=True)
    for file in files:
        print(f"written: {shutil.copyfile(file, out / file.name)}")
    return 0


def folder() -> Path:
    """Where they are: in this package, or in the repository that it is used from."""
    shipped = Path(__file__).parents[1] / "examples"
    return shipped if shipped.is_dir() else shipped.parents[3] / "examples" / "design"
