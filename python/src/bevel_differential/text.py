"""Tables as text."""

from collections.abc import Collection, Sequence


def aligned(rows: Sequence[Sequence[str]], left: int = 2) -> list[str]:
    """Lines of a table; the first `left` columns are aligned to the left, the others to the right."""
    return ["  ".join(cells).rstrip() for cells in _padded(rows, range(left))]


def markdown(rows: Sequence[Sequence[str]], left: Collection[int] = (0,)) -> str:
    """Table in Markdown, with the first row as its head; columns in `left` are aligned to the left, the others to the right."""
    head, *others = [f"| {' | '.join(cells)} |" for cells in _padded(rows, left)]
    dashes = (f"{'-' * (len(cell) + 1)}{'-' if index in left else ':'}" for index, cell in enumerate(head[2:-2].split(" | ")))
    return "".join(f"{line}\n" for line in [head, f"|{'|'.join(dashes)}|", *others])


def _padded(rows, left):
    """Cells with the same width in each column."""
    widths = [max(map(len, column)) for column in zip(*rows)]
    return [[cell.ljust(width) if index in left else cell.rjust(width) for index, (cell, width) in enumerate(zip(row, widths))]
            for row in rows]
