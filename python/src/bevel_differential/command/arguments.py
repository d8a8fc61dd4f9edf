"""Arguments shared by several sub-commands."""

import argparse
from collections.abc import Iterable
from typing import Any

from ..output_file import ENDINGS, checked
from ..values import DifferentialError

# name of the decimal sign of CSV files in parsed arguments
DECIMAL = "csv_decimal"


def assignment(text: str) -> tuple[str, str]:
    """Splits NAME=VALUE."""
    name, sign, value = text.partition("=")
    if not (name.strip() and sign and value.strip()):
        raise argparse.ArgumentTypeError(f"{text!r}: write NAME=VALUE")
    return name.strip(), value.strip()


def once(option: str, pairs: Iterable[tuple[str, str]]) -> dict[str, str]:
    """Values by name. Fails if a name is given twice, because one of its values would be lost silently."""
    values: dict[str, str] = {}
    for name, value in pairs:
        if name in values:
            raise DifferentialError(f"{option} {name}: it is given twice; leave one of them out")
        values[name] = value
    return values


class _File(argparse.Action):
    """Option with a file to write, checked before any work: an unknown ending is wrong use, a read-only folder is a failure."""

    def __init__(self, kind: str, **named: Any):
        super().__init__(**named)
        self.kind = kind

    def __call__(self, parser, namespace, values, option_string=None):
        try:
            setattr(namespace, self.dest, checked(values, self.kind))
        except DifferentialError as error:
            if error.kind == "failed":
                raise
            raise argparse.ArgumentError(self, str(error)) from None


def add_file(parser: argparse.ArgumentParser, option: str, kind: str, what: str, **more: Any) -> None:
    """Adds an option with a file to write, of a kind in `output_file.ENDINGS`."""
    parser.add_argument(option, metavar="FILE", action=_File, kind=kind, help=f"{what} ({', '.join(ENDINGS[kind])})", **more)
    if ".csv" in ENDINGS[kind] and parser.get_default(DECIMAL) is None:
        add_decimal(parser)


def add_decimal(parser: argparse.ArgumentParser) -> None:
    """Adds the option for the decimal sign of CSV files."""
    parser.add_argument("--csv-decimal", dest=DECIMAL, choices=("point", "comma"), default="point",
                        help="decimal sign in CSV files (default: point); with commas, semicolons separate the columns")


def add_files(parser: argparse.ArgumentParser, table: str, picture: str) -> None:
    """Adds options with a table and a picture to write."""
    add_file(parser, "--csv", "table", f"write {table}")
    add_file(parser, "--plot", "picture", f"draw {picture}")


def add_fmu(parser: argparse.ArgumentParser) -> None:
    """Adds the option for the FMU."""
    parser.add_argument("--fmu", metavar="FILE", help="the FMU (default: that of the package, or BEVEL_DIFFERENTIAL_FMU)")


def add_units(parser: argparse.ArgumentParser) -> None:
    """Adds the option for the units of displayed values."""
    parser.add_argument("--unit", metavar="UNIT", action="append", default=[],
                        help="show all values of this kind in UNIT, for example `--unit rpm`; may be repeated (default: display_units of "
                             "the scene, else the usual units)")


def add_set(parser: argparse.ArgumentParser) -> None:
    """Adds the option for values that differ from the scene's."""
    parser.add_argument("--set", metavar="NAME=VALUE", type=assignment, action="append", default=[],
                        help="a parameter, or an input at the start, such as \"geometry.module=4.5 mm\"")


def add_stop(parser: argparse.ArgumentParser) -> None:
    """Adds the option for another end of the scene."""
    parser.add_argument("--stop", metavar="TIME", help="another end of the scene, such as \"0.2 s\"")


def add_times(parser: argparse.ArgumentParser) -> None:
    """Adds the options for another end and another communication step of the scene."""
    add_stop(parser)
    parser.add_argument("--step", metavar="TIME", help="another communication step of the scene, such as \"1 ms\"")


def add_quick(parser: argparse.ArgumentParser, what: str) -> None:
    """Adds the option for a coarser answer in less time; `what` describes the difference."""
    parser.add_argument("--quick", action="store_true", help=f"a coarser answer in less time: {what}")


def add_scene(parser: argparse.ArgumentParser) -> None:
    """Adds the scene, and the options for values that differ from its own."""
    parser.add_argument("scene", help="a scene file (TOML), or the name of a shipped scene")
    add_set(parser)
    add_times(parser)


def changes(arguments: argparse.Namespace) -> dict[str, str]:
    """Options --set, --stop and --step as changes of a scene in a question to the library of answers."""
    times = [(name, value) for name, value in (("stop_time", arguments.stop), ("step", arguments.step)) if value is not None]
    return once("--set", [*arguments.set, *times])


def add_farm(parser: argparse.ArgumentParser) -> None:
    """Adds the options for the workers that evaluate designs."""
    parser.add_argument("--workers", type=int, metavar="N", help="number of workers (default: one per core; 0: this process)")
    parser.add_argument("--threads", action="store_true", help="workers are threads, not processes")
    parser.add_argument("--scheduler", metavar="ADDRESS", help="a dask scheduler whose workers run the designs")


def farm(arguments: argparse.Namespace) -> dict[str, Any]:
    """Arguments of `Farm` from the options of `add_farm`."""
    return {"workers": arguments.workers, "processes": not arguments.threads, "scheduler": arguments.scheduler}


def add_progress(parser: argparse.ArgumentParser) -> None:
    """Adds the option for the display of progress."""
    parser.add_argument("--progress", choices=("bar", "lines", "none"), default="bar", help=argparse.SUPPRESS)
