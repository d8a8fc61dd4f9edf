"""Warnings in the output of commands."""

import re

_WARNING = re.compile(r"^warning: .*\n", re.MULTILINE)


def without_warnings(text):
    """Text without the lines of warnings."""
    return _WARNING.sub("", text)
