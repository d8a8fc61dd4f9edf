"""Warnings in the output of commands."""

import re

from bevel_differential.values import NOBODY_SET

# a warning; that about values that nobody set has more lines
_WARNING = re.compile(rf"^warning: (?:{re.escape(NOBODY_SET.strip())}\n(?:  .*\n)*|.*\n)", re.MULTILINE)


def without_warnings(text):
    """Text without the lines of warnings."""
    return _WARNING.sub("", text)
