"""Extracted archive of the FMU and its variables. `Fmu.of` extracts a file once per process."""

import atexit
import hashlib
import os
import shutil
import tempfile
import threading
from collections.abc import Iterable, Mapping, Sequence
from functools import cached_property
from pathlib import Path
from typing import Any
from zipfile import BadZipFile

from fmpy import extract, read_model_description

from .answers import about, ask
from .curve import expanded
from .instance import Instance
from .quantities import QUANTITIES
from .quantities import variable as quantity
from .values import DifferentialError, FileName, Number, Value, Variable, variable_suggestion
from .warned import warn

_shared: dict[tuple[int, Path], "Fmu"] = {}
# pairs of a process id and a folder that this process has extracted
_extracted: list[tuple[int, str]] = []
_lock = threading.Lock()

SETTABLE = ("parameter", "input")
NO_FMU = "{}: not an FMU ({}); name a file that ends with .fmu"


class Fmu:
    """Extracted FMU and its variables.

    `Fmu.of(path)` returns the `Fmu` of this file, which the process shares. Without a path, the file is that of the environment
    variable BEVEL_DIFFERENTIAL_FMU, or else the FMU of the package. `Fmu(path)` always extracts the file again; the path may also be
    a folder with an extracted FMU.

    Attributes: `file`, `folder`; `variables`, by name; `description`, the model description as read by fmpy; `display_units`,
    preferred units by SI unit, see `displaying`."""

    def __init__(self, file: FileName):
        self.file = Path(file)
        self.folder = str(file) if self.file.is_dir() else extracted(file)
        if not self.file.is_dir():
            _extracted.append((os.getpid(), self.folder))
        self.description = read_model_description(self.folder)
        units = {unit.name: unit for unit in self.description.unitDefinitions}
        self.variables = {each.name: Variable(each, units) for each in self.description.modelVariables}
        self.display_units: dict[str, str] = {}
        self._displaying: dict[tuple[str, ...], "Fmu"] = {}

    @classmethod
    def of(cls, file: "FileName | Fmu | None" = None) -> "Fmu":
        """Shared `Fmu` of `file`, extracted at the first call. An `Fmu` is returned unchanged."""
        if isinstance(file, Fmu):
            return file
        file = Path(file or usual()).resolve()
        key = (os.getpid(), file)
        with _lock:
            if key not in _shared:
                if file.is_dir():
                    raise DifferentialError(f"{file}: it is a folder; name the .fmu file, or use Fmu(folder)")
                if not file.is_file():
                    raise DifferentialError(f"{file}: there is no such FMU")
                try:
                    _shared[key] = cls(file)
                except OSError as error:
                    raise DifferentialError(NO_FMU.format(file, error)) from None
            return _shared[key]

    @classmethod
    def by_hash(cls, file: str, sha256: str, display_units: Sequence[str] = ()) -> "Fmu":
        """FMU with this SHA-256: `file`, or else the default FMU of this machine. It shows values in `display_units`."""
        for path in (Path(file), Path(usual())):
            if path.is_file() and cls.of(path).sha256 == sha256:
                return cls.of(path).displaying(display_units)
        raise DifferentialError(f"{file}: neither this file nor the default FMU of this machine, {usual()}, is the requested one "
                                f"(SHA-256 {sha256[:12]}…); install the same wheel on all machines, or set BEVEL_DIFFERENTIAL_FMU")

    def __reduce__(self) -> tuple:
        # another process or machine finds the FMU by its hash, because paths may differ there
        return Fmu.by_hash, (str(self.file), self.sha256, tuple(self.display_units.values()))

    def displaying(self, units: Sequence[str]) -> "Fmu":
        """Copy of this FMU that shows values in `units`, such as ["rpm", "kN"]. Each unit replaces the usual unit of all variables of its
        dimension; other variables are shown as before. Numbers that are set or read stay in SI."""
        preferred = {**self.display_units, **self._preferred(units)}
        if preferred == self.display_units:
            return self
        # cached, so that all runs in these units have the same variables
        key = tuple(preferred.values())
        if key not in self._displaying:
            # `copy.copy` would use `__reduce__`
            other = object.__new__(type(self))
            other.__dict__.update(self.__dict__, display_units=preferred, variables={
                name: each.shown_in(preferred.get(each.unit or "")) for name, each in self.variables.items()})
            self._displaying[key] = other
        return self._displaying[key]

    def check_shown(self, units: Sequence[str], names: Iterable[str]) -> None:
        """Warns of each of the display `units` that has the dimension of no shown variable; `names`: their names."""
        dimensions = {self.variable(name).unit for name in names}
        warn(f"--unit {unit}: no shown value has this unit; their units are {', '.join(sorted(each for each in dimensions if each))}"
             for unit in units if not dimensions & set(self._preferred([unit])))

    def _preferred(self, units):
        """Preferred units by the SI units of their dimensions."""
        if isinstance(units, str):
            raise DifferentialError(f"{units!r}: display units are a list, such as [{units!r}]")
        return ask({"ask": "display_units", "names": list(units)})["units"] if units else {}

    @cached_property
    def sha256(self) -> str:
        """SHA-256 of the file. A folder has none, so an `Fmu` of a folder cannot be sent to other processes."""
        if self.file.is_dir():
            raise DifferentialError(f"{self.file}: an extracted folder has no hash by which another process could find it; open the .fmu "
                                    "file")
        return hashlib.sha256(self.file.read_bytes()).hexdigest()

    def variable(self, name: str) -> Variable:
        """Variable `name`."""
        if not isinstance(name, str):
            raise DifferentialError(f"{name!r}: the name of a variable is text, such as \"left.speed\"")
        return self._variable(name, lambda _: True)

    def starts(self) -> dict[str, Number]:
        """Start values of all parameters by name, SI, as the FMU declares them."""
        return {each.name: each.start for each in self.variables.values() if each.causality == "parameter" and each.start is not None}

    def output(self, name: str) -> Variable:
        """Variable or quantity `name` for a record. Suggestions for an unknown name are outputs, inputs and quantities."""
        return self._variable(name, lambda each: each.causality != "parameter")

    def _variable(self, name, similar, quantities=QUANTITIES):
        """Variable `name`, or a quantity. `similar(variable)`: true for variables that may be suggested, in addition to these `quantities`."""
        try:
            return self.variables[name]
        except KeyError:
            if name in QUANTITIES:
                return quantity(name, self.variables)
            names = [*filter(lambda known: similar(self.variables[known]), self.variables), *quantities]
            raise DifferentialError(f"{name}: there is no such variable{variable_suggestion(name, names)}") from None

    def settable(self, name: str) -> Variable:
        """Parameter or input `name`."""
        if not isinstance(name, str):
            return self.variable(name)
        variable = self._variable(name, lambda each: each.causality in SETTABLE, ())
        if variable.causality not in SETTABLE:
            raise DifferentialError(f"{name}: it is calculated and cannot be set; parameters and inputs can")
        return variable

    def find(self, *words: str, acting: Any = None) -> list[Variable]:
        """Variables with all `words` in name or description; case does not matter. `acting`: a scene file, the name of a shipped scene or a
        `Scene`; only variables that take effect in this scene are listed."""
        names = None if acting is None else set(ask({"ask": "acting", "of": about(acting)})["names"])
        found = self.variables.values() if names is None else (self.variables[name] for name in self.variables if name in names)
        return [each for each in found if all(word.lower() in f"{each.name}\n{each.description}".lower() for word in words)]

    def named(self, names: Iterable[str]) -> tuple[Variable, ...]:
        """Variables of these names, in their order."""
        if isinstance(names, str):
            raise DifferentialError(f"{names!r}: names are a list, such as [{names!r}]")
        for name in names:
            if name in QUANTITIES:
                raise DifferentialError(f"{name}: it is calculated from outputs of a run; single calls cannot read it")
        return tuple(self.variable(name) for name in names)

    def numbers(self, values: Mapping[str, Value] | None = None, **keywords: Value) -> list[tuple[Variable, Number]]:
        """Pairs (variable, number) of parameters and inputs in the form of the FMU; values as in `Differential.set`."""
        named = {name.replace("__", "."): value for name, value in keywords.items()}
        variables = ((self.settable(name), value) for name, value in expanded({**(values or {}), **named}).items())
        return [(variable, variable.checked(value)) for variable, value in variables]

    def open(self, kind: str = "CoSimulation", name: str = "differential") -> Instance:
        """New instance for single calls; `kind` is "CoSimulation" or "ModelExchange", `name` appears in logs.

        A `with` statement frees the instance when it ends."""
        return Instance(self, kind, name)


def extracted(file: FileName) -> str:
    """New temporary folder with the contents of the archive `file`."""
    folder = None
    try:
        folder = tempfile.mkdtemp()
        extract(str(file), folder)
        return folder
    except BaseException as error:
        if folder:
            shutil.rmtree(folder, ignore_errors=True)
        if isinstance(error, BadZipFile) or isinstance(error, OSError) and error.filename == str(file):
            raise DifferentialError(NO_FMU.format(file, error)) from None
        if isinstance(error, OSError):
            raise DifferentialError(f"{file}: it cannot be unpacked into {folder or 'a temporary folder'}: {error.strerror or error}; make "
                                    "room there, or name another place by the environment variable TMPDIR") from None
        raise


def usual() -> FileName:
    """Path of the default FMU."""
    return os.environ.get("BEVEL_DIFFERENTIAL_FMU") or shipped()


def shipped() -> Path:
    """Path of the FMU in this package."""
    return Path(__file__).with_name("BevelDifferential.fmu")


@atexit.register
def _remove_folders():
    for process, folder in _extracted:
        # a forked child has the entries of its parent, and must leave the parent's folders
        if process == os.getpid():
            shutil.rmtree(folder, ignore_errors=True)
