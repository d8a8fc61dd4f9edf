"""The command `bevel-differential`. Each sub-command is a module with `add_arguments(parser)` and `run(arguments) -> exit status`.
Only the requested module is imported. Until its `run`, no optional package is imported."""

import argparse
import importlib
import importlib.util
import os
import sys
from collections.abc import Iterator, Sequence
from contextlib import contextmanager, nullcontext, redirect_stdout, suppress
from io import UnsupportedOperation
from typing import Any, NoReturn, TextIO, cast

from ..extras import BACKEND, install, version
from ..letters import replaced
from ..text import aligned
from ..values import DifferentialError, suggestion
from ..warned import printed

NAME = "bevel-differential"
# module, the extra of this package that it needs, what it does
COMMANDS = {
    "run": (".command.run", None, "simulate a scene, or compare several"),
    "plan": (".command.plan", None, "say what a scene simulates, or list the scenes; write a scene for other hosts"),
    "variables": (".command.variables", None, "list all variables, or those with given words, with kind, unit, start, range and description"),
    "accuracy": (".accuracy.command", "plot", "find the cheapest model that gives wanted quantities to an accuracy, and say why"),
    "report": (".report.command", "report", "write a report of a scene: one HTML file with figures, tables and what they say"),
    "loads": (".command.loads", None, "record the force on each loaded tooth pair of a scene, for FEA"),
    "geometry": (".command.geometry", None,
                 "calculate all dimensions of the gears, check them for interference, make files for CAD"),
    "pattern": (".pattern.command", "plot",
                "show the contact pattern of a scene: pressure on the planet's flank over one engagement"),
    "sweep": (".command.sweep", "sweep", "run a scene for many designs: grids, Latin hypercubes, Sobol sequences, Monte Carlo"),
    "optimise": (".optimise.command", "design", "optimise gears by several objectives at once"),
    "tolerance": (".tolerance.command", "design",
                  "calculate the effects of manufacturing tolerances: spread of results, yield, and which tolerance is worth its money"),
    "spectrum": (".spectrum.command", "design",
                 "damage and life of the gears over a duty cycle: events with counts, torque and speeds"),
    "losses": (".losses.command", "sweep", "map power loss and torque bias over torque, speeds and oil temperature, with measured errors"),
    "bench": (".bench.command", "sweep", "put a differential on a virtual bench: torque bias, breakaway, judder, hot lap, winter start"),
    "coupling": (".coupling.command", "plot", "find the longest stable communication step of hosts at the ports, and what limits it"),
    "study": (".study.command", "report", "simulate the two cases of the study and compare the results with the study and with theory"),
    "verify": (".command.verify", None, "simulate the scenes of an FMU's evidence and compare with its results within their tolerances"),
    "examples": (".command.examples", None, "copy the example files of designs, tolerances, duty cycles and cars into a folder"),
    "page": (".command.page", None, "open the differential live in a browser"),
}
PACKAGE = __package__.partition(".")[0]
# exit statuses of all commands, and the words for them
DONE, FAILED, WRONG, FINDING, INTERRUPTED = 0, 1, 2, 3, 130
STATUSES = {DONE: "done", FAILED: "failed", WRONG: "wrong value or use", FINDING: "done, with a finding", INTERRUPTED: "stopped by Ctrl-C"}
# exit statuses by the kind of `DifferentialError`
_STATUS = {"use": WRONG, "finding": FINDING}


class Parser(argparse.ArgumentParser):
    """Parser that reports errors in one line."""

    def error(self, message: str) -> NoReturn:
        self.exit(WRONG, f"{self.prog}: {message}; see {self.prog} --help\n")


class _Output:
    """Standard output up to its first failure. Later text is discarded, so that a command continues and writes its files."""

    def __init__(self, stream: TextIO):
        self._stream = stream
        self.failure: OSError | None = None

    def __getattr__(self, name: str) -> Any:
        return getattr(self._stream, name)

    def write(self, text: str) -> int:
        """Writes the text, unless the output has failed."""
        if self.failure is None:
            try:
                return self._stream.write(text)
            except OSError as error:
                self.failure = error
        return len(text)

    def flush(self) -> None:
        """Flushes the output, unless it has failed."""
        if self.failure is None:
            try:
                self._stream.flush()
            except OSError as error:
                self.failure = error


@contextmanager
def _to_the_end() -> Iterator[None]:
    """Context in which the work continues if standard output fails, as when the reader of a pipe closes it. Raises the failure at the
    end."""
    output = _Output(sys.stdout)
    try:
        with redirect_stdout(cast(TextIO, output)):
            yield
            output.flush()
    finally:
        if output.failure:
            _discard_output()
    if output.failure:
        raise output.failure


def main(argv: Sequence[str] | None = None) -> int:
    """Runs the command with these arguments, by default those of the process. Returns its exit status."""
    if argv is None:
        # the program draws only files; a process started in a notebook inherits its backend, which may not be installed here
        os.environ[BACKEND] = "Agg"
    with replaced():
        return _main(list(sys.argv[1:] if argv is None else argv))


def _main(arguments):
    try:
        if not arguments or arguments[0] in ("-h", "--help", "help"):
            print(_overview())
            return DONE if arguments else WRONG
        if arguments[0] in ("-V", "--version"):
            print(f"{NAME} {version() or 'of sources that are not installed'}")
            return DONE
        status = _run(arguments[0], arguments[1:])
        # if this fails at exit, Python prints a message of its own
        sys.stdout.flush()
        return status
    except DifferentialError as error:
        return _said(error, _STATUS.get(error.kind, FAILED))
    except KeyboardInterrupt as interrupt:
        return _said(interrupt if str(interrupt) else "stopped", INTERRUPTED)
    except BrokenPipeError:
        # the reader has closed the pipe: there is nothing left to say
        _discard_output()
        return FAILED
    except OSError as error:
        if error.filename is None:
            # all written files have names, so this is standard output
            _discard_output()
        return _said(f"{error.filename or 'standard output'}: {error.strerror or error}", FAILED)


def _discard_output():
    """Discards all pending output, also at exit."""
    with suppress(UnsupportedOperation):
        os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())


def _run(name, arguments):
    if name not in COMMANDS:
        return _said(f"there is no command {name!r}{suggestion(name, COMMANDS)}; known: {', '.join(COMMANDS)}", WRONG)
    module_name, extra, what = COMMANDS[name]
    try:
        module = importlib.import_module(module_name, PACKAGE)
        parser = Parser(prog=f"{NAME} {name}", description=what)
        module.add_arguments(parser)
        try:
            parsed = parser.parse_args(arguments)
        except SystemExit as end:
            return end.code
        with printed(), _to_the_end(), _decimal(parsed):
            return module.run(parsed)
    except ModuleNotFoundError as missing:
        if missing.name.partition(".")[0] == PACKAGE:
            raise
        return _said(install(missing.name, extra or "design"), FAILED)


def _decimal(parsed):
    """Context with the decimal sign of CSV files that the user chose."""
    if getattr(parsed, "csv_decimal", "point") == "point":
        return nullcontext()
    from ..records import decimal

    return decimal(parsed.csv_decimal)


def _overview():
    lines = aligned([("", name, what) for name, (_, _, what) in COMMANDS.items()], 3)
    statuses = ", ".join(f"{status} {words}" for status, words in STATUSES.items())
    return "\n".join([f"usage: {NAME} COMMAND ...", "", *lines, "", f"{NAME} COMMAND --help says what a command takes.",
                      f"Exit status: {statuses}."])


def _said(what, status):
    for line in str(what).replace(":\n", ": ").splitlines():
        print(f"{NAME}: {line.strip()}", file=sys.stderr)
    return status
