"""Progress on the terminal, tables for readers, and errors."""

import itertools
import shutil
import sys

# exit status of a completed check with a finding, as in the commands of the Python package
FINDING = 3
# length of the bar
BAR = 40
# maximum length of the line under the header of a last column with sentences
LAST_COLUMN = 24


class Failure(Exception):
    """Error of a command."""

    status = 1


class Finding(Failure):
    """Error of a completed check with a finding."""

    status = FINDING


class Progress:
    """Bar on the terminal. Without a terminal, one line per stage is printed."""

    def __init__(self):
        self.is_terminal = sys.stderr.isatty()

    def stage(self, what):
        """Begins the next stage."""
        if self.is_terminal:
            self._draw(what)
        else:
            print(what, file=sys.stderr, flush=True)

    def advance(self, fraction, what):
        """Shows the completed fraction of the stage."""
        done = round(BAR * min(max(fraction, 0.0), 1.0))
        if self.is_terminal:
            self._draw(f"[{'=' * done + '>' * (done < BAR):{BAR}}] {100.0 * fraction:3.0f} % {what}")

    def note(self, text):
        """Prints a remark above the bar."""
        self.finish()
        print(text, file=sys.stderr, flush=True)

    def finish(self):
        """Removes the bar."""
        if self.is_terminal:
            self._draw("")

    def _draw(self, text):
        width = shutil.get_terminal_size().columns
        print(f"\r\x1b[K{text[:width - 1]}", end="", file=sys.stderr, flush=True)


def aligned(rows, left):
    """Lines of a table for a terminal, with the first row as its head; columns in `left` are aligned to the left."""
    widths = [max(map(len, column)) for column in zip(*rows)]
    lines = ["  ".join(cell.ljust(width) if index in left else cell.rjust(width) for index, (cell, width) in enumerate(zip(row, widths))).rstrip()
             for row in rows]
    last = len(widths) - 1
    beyond = max(widths[last] - max(LAST_COLUMN, len(rows[0][last])), 0) if last in left else 0
    return [lines[0], "-" * (sum(widths) + 2 * last - beyond), *lines[1:]]


def for_terminal(page):
    """Formats a page of Markdown for a terminal: tables are aligned, everything else is unchanged."""
    lines = []
    for is_table, part in itertools.groupby(page.splitlines(), lambda line: line.startswith("|")):
        lines += _table(part) if is_table else part
    return "".join(f"{line}\n" for line in lines)


def _table(lines):
    head, dashes, *rows = [[cell.strip().replace("`", "") for cell in line.strip().strip("|").split("|")] for line in lines]
    return aligned([head, *rows], [index for index, cell in enumerate(dashes) if not cell.endswith(":")])
