"""The FMU: extracted and loaded once per process."""

import atexit
import importlib.resources
import os
import shutil
import threading
from collections.abc import Mapping
from pathlib import Path

from fmpy import extract, read_model_description

from .instance import Instance
from .values import DifferentialError, Variable, suggestion

_loaded = {}
_lock = threading.Lock()


class Fmu:
    """An extracted FMU and its variables.

    `Fmu.of(path)` gives the one of this process; without a path it is the FMU that came with the package, or the one that the
    environment variable BEVEL_DIFFERENTIAL_FMU names. `Fmu(path)` is a new one; the path may also be that of a folder with an
    FMU that is extracted already.

    Attributes: `file`, `folder`; `variables`, by name; `description`, the model description as fmpy reads it."""

    def __init__(self, file):
        self.file = Path(file)
        self.folder = str(file) if self.file.is_dir() else extract(str(file))
        self.description = read_model_description(self.folder)
        units = {unit.name: unit for unit in self.description.unitDefinitions}
        self.variables = {each.name: Variable(each, units) for each in self.description.modelVariables}

    @classmethod
    def of(cls, file=None):
        """The FMU of `file`, extracted when it is asked for first."""
        file = Path(file or os.environ.get("BEVEL_DIFFERENTIAL_FMU") or shipped()).resolve()
        key = (os.getpid(), file)
        with _lock:
            if key not in _loaded:
                if not file.is_file():
                    raise DifferentialError(f"{file}: there is no such FMU")
                _loaded[key] = cls(file)
            return _loaded[key]

    def variable(self, name):
        """The variable `name`."""
        try:
            return self.variables[name]
        except KeyError:
            raise DifferentialError(f"{name}: there is no such variable{suggestion(name, self.variables)}") from None

    def numbers(self, values: Mapping | None = None, **keywords) -> list[tuple[Variable, float | int | bool]]:
        """Values of parameters and inputs as the FMU takes them, [(variable, number)]; given as to `Differential.set`."""
        named = {name.replace("__", "."): value for name, value in keywords.items()}
        pairs = []
        for name, value in {**(values or {}), **named}.items():
            variable = self.variable(name)
            if variable.causality not in ("parameter", "input"):
                raise DifferentialError(f"{name}: it is calculated and cannot be set")
            pairs.append((variable, variable.number(value)))
        return pairs

    def open(self, kind: str = "CoSimulation", name: str = "differential") -> Instance:
        """A new instance, to be driven call by call; `kind` is "CoSimulation" or "ModelExchange", `name` appears in logs.

        Used in a `with` statement it is freed at the end."""
        return Instance(self, kind, name)


def shipped():
    """The FMU in this package."""
    return Path(str(importlib.resources.files(__package__) / "BevelDifferential.fmu"))


@atexit.register
def _remove_folders():
    for (process, _), fmu in _loaded.items():
        # a child that was forked has the entries of its parent
        if process == os.getpid():
            shutil.rmtree(fmu.folder, ignore_errors=True)
