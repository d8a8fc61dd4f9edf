"""Warnings of the FMU for the user, in one place for the package and its command.

In Python, each is a warning of the class `DifferentialWarning` with the line that called the package. The command prints each text
once, to standard error."""

import sys
import warnings
from collections.abc import Iterable, Iterator
from contextlib import contextmanager

from .start_values import in_short
from .values import DifferentialWarning

PACKAGE = __name__.partition(".")[0]


def warn(texts: Iterable[str]) -> None:
    """Passes on each text once."""
    level, frame = 2, sys._getframe(1)
    while frame.f_back and frame.f_globals.get("__name__", "").partition(".")[0] == PACKAGE:
        level, frame = level + 1, frame.f_back
    for text in dict.fromkeys(in_short(texts)):
        warnings.warn(text, DifferentialWarning, stacklevel=level)


def by_owner(warnings: Iterable[tuple[str, Iterable[str]]], kind: str) -> list[str]:
    """Each text once, with the name of its owner, or with the number of its owners. `warnings`: pairs (name, texts); `kind`: plural noun
    for the owners."""
    owners: dict[str, list[str]] = {}
    for name, texts in warnings:
        for text in dict.fromkeys(texts):
            owners.setdefault(text, []).append(name)
    return [f"{names[0] if len(names) == 1 else f'{len(names)} {kind}'}: {text}" for text, names in owners.items()]


@contextmanager
def printed() -> Iterator[None]:
    """Prints each different text once to standard error, until the end of the `with` statement."""
    with warnings.catch_warnings():
        show, seen = warnings.showwarning, set()

        def show_once(message, category, *where):
            if not issubclass(category, DifferentialWarning):
                show(message, category, *where)
            elif str(message) not in seen:
                seen.add(str(message))
                print(f"warning: {message}", file=sys.stderr, flush=True)

        warnings.showwarning = show_once
        warnings.simplefilter("always", DifferentialWarning)
        yield


@contextmanager
def silenced() -> Iterator[None]:
    """Suppresses warnings, for trials with values that the user did not set."""
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", DifferentialWarning)
        yield
