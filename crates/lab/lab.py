#!/usr/bin/env python3
"""Program of the laboratory, which measures and checks the library: `python3 crates/lab/lab.py --help` lists its commands.

It needs only Python's standard library, and what `cargo build --release` builds. The scripts of its commands run in Python environments
that it creates."""

import argparse
import difflib
import inspect
import sys
from pathlib import Path

sys.path.append(str(Path(__file__).resolve().with_name("python")))
from laboratory import checking, everything, measuring  # noqa: E402
from laboratory.command import COMMANDS, Wrong  # noqa: E402
from laboratory.paths import CALL, version  # noqa: E402
from laboratory.terminal import Failure  # noqa: E402
from laboratory.work import Work  # noqa: E402

GROUPS = {"Measuring:": measuring, "Checking:": checking}
# exit statuses of wrong use and of a stop by Ctrl-C, as in the commands of the Python package
WRONG, INTERRUPTED = 2, 130


class Parser(argparse.ArgumentParser):
    """Parser of a command that reports errors in one line."""

    def __init__(self, command):
        super().__init__(prog=f"{CALL} {command.name}", description=inspect.getdoc(command.function), allow_abbrev=False,
                         formatter_class=argparse.RawDescriptionHelpFormatter)
        for option in command.options:
            self.add_argument(*option.names, **option.settings)
        self.command = command

    def error(self, message):
        raise Wrong(f"{message} (see {self.prog} --help)")

    def parsed(self, words):
        """Values of the options. The command `test-python` passes unknown words on."""
        values, values.more = self.parse_known_args(words)
        if values.more and not self.command.passes_on:
            known = [name for option in self.command.options for name in option.names]
            self.error(f"unexpected argument '{values.more[0]}' found{similar(values.more[0], known)}")
        for option in self.command.options:
            for other in option.without if getattr(values, option.key) else ():
                if getattr(values, other):
                    self.error(f"the argument '--{option.key}' cannot be used with '--{other}'")
        return values


def similar(word, known):
    """Suggestion for an unknown word, if a known one is similar."""
    found = difflib.get_close_matches(word, known, 1)
    return f"; a similar one exists: '{found[0]}'" if found else ""


def overview():
    """All commands by group, one line for each."""
    width = max(map(len, COMMANDS))
    lines = [f"Usage: {CALL} [COMMAND] [OPTIONS]"]
    for title, module in GROUPS.items():
        lines += ["", title]
        lines += [f"  {name:{width}}  {command.sentence}" for name, command in COMMANDS.items() if command.function.__module__ == module.__name__]
    return "\n".join([*lines, "", f"All commands in short form, with one table of the results: {CALL} {everything.NAME}",
                      f"Options of a command: {CALL} COMMAND --help"])


def run(words):
    """Runs the command in `words`. Without a command, the overview is printed."""
    if words[:1] in (["help"], ["--help"], ["-h"]):
        words = [*words[1:2], "--help"] if words[1:] else []
    if words[:1] in (["--version"], ["-V"]):
        print(f"lab {version()}")
    elif not words:
        print(overview())
    elif words[0] in COMMANDS:
        command = COMMANDS[words[0]]
        with Work(Parser(command).parsed(words[1:])) as work:
            command.function(work)
    else:
        raise Wrong(f"unrecognized subcommand '{words[0]}'{similar(words[0], COMMANDS)} (see {CALL} --help)")


def main(words):
    """Runs a command and returns the exit status: 0 done, 1 failed, 2 wrong use, 3 done with a finding."""
    for stream in (sys.stdout, sys.stderr):
        stream.reconfigure(encoding="utf-8")
    try:
        run(words)
    except Wrong as error:
        print(f"error: {error}", file=sys.stderr)
        return WRONG
    except Failure as failure:
        print(f"error: {failure}", file=sys.stderr)
        return failure.status
    except KeyboardInterrupt:
        return INTERRUPTED
    return 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
