"""The command `page`: the differential live in a browser."""

import argparse
import importlib.resources
import webbrowser
from pathlib import Path

from . import DONE
from ..values import DifferentialError

FILE = "BevelDifferential.html"


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Adds the arguments of the command."""
    parser.add_argument("--path", action="store_true", help="only print the path of the page")


def run(arguments: argparse.Namespace) -> int:
    """Opens the page and prints its address. Raises `DifferentialError`."""
    page = page_file()
    if arguments.path:
        print(page)
        return DONE
    address = page.as_uri()
    print(address)
    if not webbrowser.open(address):
        raise DifferentialError("no browser can be opened from here: open the address above in one", kind="failed")
    return DONE


def page_file() -> Path:
    """Path of the page: in this package, or in the repository that contains it."""
    package = Path(str(importlib.resources.files(__package__.partition(".")[0])))
    paths = [package / "page" / FILE]
    # in a checkout: src/bevel_differential, src, python, the repository
    if len(package.parents) > 2:
        paths.append(package.parents[2] / "target" / "page" / FILE)
    for path in paths:
        if path.is_file():
            return path.resolve()
    raise DifferentialError("the page is not in this package. It is in wheels that are built where the page exists: in a checkout with "
                            "Rust, run `cargo run --release -- page`, then `cargo run --release -- wheel`", kind="failed")
