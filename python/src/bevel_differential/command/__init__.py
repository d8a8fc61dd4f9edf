"""The command `bevel-differential`. Each sub-command is a module with HELP (one line), EXTRA (what it needs of this package's
extras, or None), `add_arguments(parser)` and `run(arguments) -> exit status`. Only the module that is asked for is imported."""

import argparse
import importlib
import importlib.util
import os
import sys
import warnings
from collections.abc import Sequence
from typing import NoReturn

from ..extras import install
from ..values import DifferentialError, DifferentialWarning, suggestion

NAME = "bevel-differential"
COMMANDS = {"run": ".command.run", "plan": ".command.plan", "accuracy": ".accuracy.command", "report": ".report.command",
            "loads": ".command.loads", "geometry": ".command.geometry", "pattern": ".pattern.command", "sweep": ".command.sweep",
            "optimise": ".optimise.command", "tolerance": ".tolerance.command", "spectrum": ".spectrum.command",
            "study": ".study.command", "page": ".command.page"}
PACKAGE = __package__.partition(".")[0]
# exit statuses: what fails while running, wrong use, Ctrl-C
FAILED, WRONG_USE, INTERRUPTED = 1, 2, 130


class Parser(argparse.ArgumentParser):
    """Says what is wrong in one line."""

    def error(self, message: str) -> NoReturn:
        self.exit(WRONG_USE, f"{self.prog}: {message}; see {self.prog} --help\n")


def main(argv: Sequence[str] | None = None) -> int:
    """Runs the command with these arguments, or those of the process. Returns its exit status."""
    arguments = list(sys.argv[1:] if argv is None else argv)
    try:
        if not arguments or arguments[0] in ("-h", "--help", "help"):
            print(_overview())
            return 0 if arguments else WRONG_USE
        return _run(arguments[0], arguments[1:])
    except DifferentialError as error:
        return _said(error, WRONG_USE if error.kind == "use" else FAILED)
    except KeyboardInterrupt as interrupt:
        return _said(interrupt if str(interrupt) else "stopped", INTERRUPTED)
    except BrokenPipeError:
        # whoever read has enough; nothing is left to say, also at exit
        os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())
        return FAILED
    except OSError as error:
        return _said(f"{error.filename}: {error.strerror}" if error.filename else error, FAILED)


def _run(name, arguments):
    if name not in COMMANDS:
        return _said(f"there is no command {name!r}{suggestion(name, COMMANDS)}; known: {', '.join(COMMANDS)}", WRONG_USE)
    extra = None
    try:
        module = importlib.import_module(COMMANDS[name], PACKAGE)
        extra = module.EXTRA
        parser = Parser(prog=f"{NAME} {name}", description=module.HELP)
        module.add_arguments(parser)
        try:
            parsed = parser.parse_args(arguments)
        except SystemExit as end:
            return end.code
        with warnings.catch_warnings():
            # commands print what the FMU warns of themselves
            warnings.simplefilter("ignore", DifferentialWarning)
            return module.run(parsed)
    except ModuleNotFoundError as missing:
        if missing.name.partition(".")[0] == PACKAGE:
            raise
        return _said(install(missing.name, extra or "design"), FAILED)


def _overview():
    lines = [(name, _help(module)) for name, module in COMMANDS.items()]
    width = max(len(name) for name in COMMANDS)
    return "\n".join([f"usage: {NAME} COMMAND ...", "", *(f"  {name.ljust(width)}  {text}" for name, text in lines), "",
                      f"{NAME} COMMAND --help says what a command takes."])


def _help(module):
    try:
        return importlib.import_module(module, PACKAGE).HELP
    except ModuleNotFoundError as missing:
        return f"({install(missing.name, 'design')})"


def _said(what, status):
    print(f"{NAME}: {'; '.join(str(what).splitlines()).replace(':; ', ': ')}", file=sys.stderr)
    return status
