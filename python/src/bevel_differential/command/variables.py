"""The command `variables`: all variables of the FMU, or those with given words."""

import argparse
import shutil
import textwrap

from ..values import Variable
from . import DONE
from .arguments import add_file, add_fmu

HEAD = ("name", "kind", "type", "unit", "start", "min", "max", "display unit", "literals", "description")
# narrowest column of descriptions; in a narrower terminal each variable has a paragraph
NARROWEST = 30


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Adds the arguments of the command."""
    parser.add_argument("words", nargs="*", metavar="WORD", help="list variables with all these words in name or description")
    parser.add_argument("--acting", metavar="SCENE", help="list variables that take effect in a scene: a file (TOML), or a shipped scene")
    add_file(parser, "--csv", "table", "write the list, in SI")
    add_fmu(parser)


def run(arguments: argparse.Namespace) -> int:
    """Prints the list and writes a file."""
    from ..fmu import Fmu
    from ..records import write
    from ..values import variable_suggestion

    fmu = Fmu.of(arguments.fmu)
    found = fmu.find(*arguments.words, acting=arguments.acting)
    print("\n".join(_table(found)), end="\n" if found else "")
    near = "" if found or not arguments.words else variable_suggestion("_".join(arguments.words), fmu.variables)
    print(f"{len(found)} of {len(fmu.variables)} variables{near}")
    if arguments.csv:
        print(f"written: {write(arguments.csv, HEAD, map(_row, found), f'variables of {fmu.file.name}')}")
    return DONE


def _kind(variable: Variable) -> str:
    if variable.causality == "parameter" and variable.variability == "tunable":
        return "tunable"
    return "calculated" if variable.causality == "calculatedParameter" else variable.causality


def _row(variable):
    """Cells of a row of the file, in SI."""
    ends = (variable.minimum, variable.maximum)
    values = ("" if value is None else _literal(variable, value) for value in (variable.start, *ends))
    return (variable.name, _kind(variable), variable.kind, variable.unit or "", *values, variable.shown(0.0)[0],
            " | ".join(variable.literals), variable.description or "")


def _literal(variable, number):
    return next((name for name, value in variable.literals.items() if value == number), number)


def _table(found):
    """Lines of the table, in display units."""
    from ..text import aligned

    if not found:
        return []
    rows = [("name", "kind", "unit", "start", "range"), *map(_cells, found)]
    texts = ["description", *map(_text, found)]
    lines = aligned(rows, len(rows[0]))
    used, terminal = max(map(len, lines)) + 2, shutil.get_terminal_size((0, 0)).columns
    if not terminal or used + max(map(len, texts)) <= terminal:
        return [f"{line:{used}}{text}".rstrip() for line, text in zip(lines, texts)]
    if terminal - used < NARROWEST:
        return [part for row, text in zip(rows, texts) for part in (row[0], *_indented("; ".join(filter(None, row[1:])), terminal),
                                                                    *_indented(text, terminal))]
    wrapped = (textwrap.wrap(text, terminal - used, break_on_hyphens=False) or [""] for text in texts)
    return [f"{head:{used}}{part}".rstrip() for line, parts in zip(lines, wrapped)
            for head, part in zip([line, *[""] * (len(parts) - 1)], parts)]


def _indented(text, terminal):
    return textwrap.wrap(text, max(terminal, NARROWEST), initial_indent="    ", subsequent_indent="    ", break_on_hyphens=False)


def _cells(variable):
    """Texts of name, kind, unit, start and range, in the display unit."""
    unit, _ = variable.shown(0.0)
    shown = unit if unit == variable.unit or not unit else f"{unit} ({variable.unit})"
    ends = () if variable.literals else (variable.minimum, variable.maximum)
    span = "..".join(_number(variable, end) for end in ends) if any(end is not None for end in ends) else ""
    return variable.name, _kind(variable), shown, _number(variable, variable.start), span


def _number(variable, value):
    if value is None or variable.kind == "Enumeration":
        return "" if value is None else _literal(variable, value)
    return str(value).lower() if variable.kind == "Boolean" else f"{variable.shown(float(value))[1]:.6g}"


def _text(variable):
    """The description, with the literals of an enumeration."""
    words = f"one of {', '.join(variable.literals)}" if variable.literals else ""
    return "; ".join(filter(None, (variable.description, words)))
