"""Command lines in tests: their exit status, and what they print."""

import re
import shlex
from contextlib import redirect_stderr, redirect_stdout
from dataclasses import dataclass
from io import StringIO

from bevel_differential.command import DONE, main

_WARNING = re.compile(r"^warning: .*\n(?:  .*\n)*", re.MULTILINE)


def without_warnings(text):
    """Text without the lines of warnings."""
    return _WARNING.sub("", text)


@dataclass
class Printed:
    """Text on standard output and on standard error."""

    out: str
    err: str

    @property
    def errors(self):
        """Lines on standard error other than warnings."""
        return without_warnings(self.err).splitlines()

    @property
    def warnings(self):
        """Warnings on standard error. Further lines of a warning are indented."""
        return [text.rstrip("\n") for text in _WARNING.findall(self.err)]


def command(line, status=DONE):
    """Runs a command in this process, checks its exit status, and returns its output."""
    out, err = StringIO(), StringIO()
    with redirect_stdout(out), redirect_stderr(err):
        ended = main(shlex.split(line))
    assert ended == status, f"{line}: exit status {ended}\n{err.getvalue()}"
    return Printed(out.getvalue(), err.getvalue())
