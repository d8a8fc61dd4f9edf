"""What a sweep found, as text."""

import pyarrow.compute as pc

from ..text import aligned
from .sweep import SweepResult

# messages that are listed
MOST_MESSAGES = 5


def text(result: SweepResult, asked: int | None = None) -> str:
    """Runs, failures by message, feasible designs, range of each figure, rate. `asked`: runs that were asked for."""
    table, metadata = result.table, result.metadata
    lines = [f"runs      {table.num_rows}"]
    if asked is not None and asked != table.num_rows:
        lines[0] += f" ({asked} asked for; a Sobol sequence has a power of two)"
    failures = result.failures()
    lines.append(f"failed    {failures.total()}")
    common = failures.most_common()
    lines += [f"  {count:>6}  {' '.join(message.split())}" for message, count in common[:MOST_MESSAGES]]
    if len(common) > MOST_MESSAGES:
        lines.append(f"  {sum(count for _, count in common[MOST_MESSAGES:]):>6}  {len(common) - MOST_MESSAGES} other messages")
    lines.append(f"feasible  {pc.sum(table['feasible']).as_py() or 0}")
    if metadata["conditions"]:
        lines[-1] += f" ({'; '.join(metadata['conditions'])})"
    lines += ["", *_ranges(result), ""]
    if result.new:
        lines.append(f"{result.new} runs in {result.seconds:.1f} s: {result.new / result.seconds:.1f} designs/s")
    if result.new < table.num_rows:
        lines.append(f"{table.num_rows - result.new} runs were kept from before")
    lines.append("rows are not kept: name a file by --out" if result.file is None else f"written: {result.file}")
    return "\n".join(lines)


def _ranges(result):
    """Least, mean and greatest value of each figure, SI, aligned."""
    rows = [("figure", "unit", "min", "mean", "max")]
    for name in result.metadata["figures"]:
        column, unit = result.table[name], result.unit(name)
        found = [pc.min(column).as_py(), pc.mean(column).as_py(), pc.max(column).as_py()]
        rows.append((name, "" if unit == "1" else unit, *("-" if one is None else f"{one:.6g}" for one in found)))
    return aligned(rows)
