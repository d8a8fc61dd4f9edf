"""The command `examples`: copies the example files of the documentation: designs, tolerances, duty cycles and cars."""

import argparse
from pathlib import Path

from . import DONE
from ..values import DifferentialError
from ..writing import in_folder, write_whole

# folders of examples, and the files of each
FOLDERS = {"design": ("*.toml", "*.csv"), "four_wheel_drive": ("*.py", "*.toml"), "vehicle": ("*.py",)}


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Adds the arguments of the command."""
    parser.add_argument("--out", metavar="FOLDER", default="examples", help="where to copy them (default: examples)")


def run(arguments: argparse.Namespace) -> int:
    """Copies the files and prints their names. Raises `DifferentialError` if one exists already."""
    out = Path(arguments.out)
    copies = {file: out / name / file.name for name, patterns in FOLDERS.items() for pattern in patterns
              for file in sorted((folder() / name).glob(pattern))}
    if not copies:
        raise DifferentialError(f"the examples are missing in {folder()}; install the package again")
    there = [str(copy) for copy in copies.values() if copy.exists()]
    if there:
        raise DifferentialError(f"{', '.join(there)} {'is' if len(there) == 1 else 'are'} there already; name another folder by --out")
    with in_folder(out) as stage:
        for file, copy in copies.items():
            copied = stage / copy.relative_to(out)
            copied.parent.mkdir(exist_ok=True)
            write_whole(copied, file.read_bytes())
    print("\n".join(f"written: {copy}" for copy in copies.values()))
    return DONE


def folder() -> Path:
    """Folder of the examples: in this package, or in the repository that contains it."""
    shipped = Path(__file__).parents[1] / "examples"
    return shipped if shipped.is_dir() else shipped.parents[3] / "examples"
