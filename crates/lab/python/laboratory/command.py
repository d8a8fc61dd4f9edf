"""Declaration of commands: `@command(options…)` makes a function a command of the laboratory. The first sentence of its docstring is the
help text."""

import argparse
import inspect
from dataclasses import dataclass
from pathlib import Path
from typing import Callable, Dict, List, Sequence, Tuple


class Wrong(Exception):
    """Wrong use of a command."""


@dataclass(frozen=True)
class Option:
    """An option, or a positional argument; it conflicts with the options `without`."""

    names: Tuple[str, ...]
    settings: dict
    without: Sequence[str] = ()

    @property
    def key(self):
        """Name of the value."""
        return self.names[0].lstrip("-").replace("-", "_")


@dataclass(frozen=True)
class Command:
    """A command; `short`: options of its short run by the command `all`; `passes_on`: True if it accepts unknown words."""

    name: str
    function: Callable
    options: Tuple[Option, ...]
    short: List[str]
    passes_on: bool

    @property
    def sentence(self):
        """Sentence about the command, without a full stop."""
        return " ".join(inspect.getdoc(self.function).partition("\n\n")[0].split()).rstrip(".")


COMMANDS: Dict[str, Command] = {}


def command(*options, name=None, short=None, passes_on=False):
    """Decorator that declares a function as a command. The default of the short run is the option --quick, if there is one."""

    def declare(function):
        named = name or function.__name__.replace("_", "-")
        quick = ["--quick"] if any(option.key == "quick" for option in options) else []
        COMMANDS[named] = Command(named, function, options, quick if short is None else short, passes_on)
        return function

    return declare


def flag(name, help, without=()):
    """An option without a value."""
    return Option((f"--{name}",), {"action": "store_true", "help": help}, without)


def write(what, without=()):
    """The option that also renews documents."""
    return flag("write", f"Also renew {what}", without)


def path(name, metavar, help, without=()):
    """An option with the path of a file or folder."""
    return Option((f"--{name}",), {"type": Path, "metavar": metavar, "help": help}, without)


def number(name, default, help, least=0, most=None, metavar=None):
    """An option with a whole number of at least `least` and at most `most`."""

    def whole(text):
        if not text.isdecimal() or int(text) < least or most is not None and int(text) > most:
            raise argparse.ArgumentTypeError(f"invalid value '{text}': not a whole number from {least}" + (f" to {most}" if most else ""))
        return int(text)

    shown = help if default is None else f"{help} [default: {default}]"
    return Option((f"--{name}",), {"type": whole, "default": default, "metavar": metavar or name.upper(), "help": shown})
