"""Progress of long work: a bar on the terminal, or lines for a program that displays the progress."""

import sys
from collections.abc import Iterator
from contextlib import contextmanager

from tqdm import tqdm

from .answers import Progress


@contextmanager
def shown(how: str = "bar") -> Iterator[Progress]:
    """Function that shows the completed fraction of the work, from 0 to 1, and a description of the current work."""
    if how == "lines":
        yield lambda done, what: print(f"progress {done:.4f} {what}", file=sys.stderr, flush=True)
        return
    layout = "{desc}: {percentage:3.0f} %|{bar}| {elapsed}"
    with tqdm(total=100, dynamic_ncols=True, leave=False, bar_format=layout, disable=how == "none" or None) as bar:

        def report(done: float, what: str) -> None:
            bar.set_description_str(what, refresh=False)
            bar.update(max(min(round(100.0 * done), 100) - bar.n, 0))
            bar.refresh()

        yield report


def silent(done: float, what: str) -> None:
    """Shows nothing."""


def part(progress: Progress, begin: float, end: float) -> Progress:
    """Progress of a part of the work that covers the fractions from `begin` to `end` of the whole."""
    return lambda done, what: progress(begin + done * (end - begin), what)
