"""Errors in tests, with the parts of their messages."""

import re

import pytest
from bevel_differential import DifferentialError


def pattern(said):
    """Regular expression for parts of a message in their order, which are separated by " … "."""
    return "(?s)" + ".*".join(map(re.escape, said.split(" … ")))


def refused(said):
    """Context that must fail with an error of the package whose message contains these parts; see `pattern`."""
    return pytest.raises(DifferentialError, match=pattern(said))
