"""Errors and warnings in tests, with the parts of their messages."""

import re
import warnings

import pytest
from bevel_differential import DifferentialError, DifferentialWarning


def pattern(said):
    """Regular expression for parts of a message in their order, which are separated by " … "."""
    return "(?s)" + ".*".join(map(re.escape, said.split(" … ")))


def refused(said):
    """Context that must fail with an error of the package whose message contains these parts; see `pattern`."""
    return pytest.raises(DifferentialError, match=pattern(said))


def warnings_about(said, action):
    """Warnings of an action that contain a text."""
    with warnings.catch_warnings(record=True) as caught:
        warnings.simplefilter("always", DifferentialWarning)
        action()
    return [str(one.message) for one in caught if said in str(one.message)]


def refused_start(fmu, values, said):
    """Asserts that the FMU refuses to start with these values, and that a message contains a text."""
    with fmu.open() as opened:
        opened.set(values)
        with pytest.raises(Exception):
            opened.initialise()
        assert any(said in line for line in opened.messages), opened.messages
