"""The FMU: an extracted archive and its variables. `Fmu.of` extracts a file once per process."""

import atexit
import hashlib
import os
import shutil
import threading
from collections.abc import Iterable, Mapping
from functools import cached_property
from pathlib import Path
from typing import Any
from zipfile import BadZipFile

from fmpy import extract, read_model_description

from .answers import about, ask
from .instance import Instance
from .values import DifferentialError, FileName, Number, Value, Variable, variable_suggestion

_shared: dict[tuple[int, Path], "Fmu"] = {}
# process numbers, each with a folder that this process has extracted
_extracted: list[tuple[int, str]] = []
_lock = threading.Lock()


class Fmu:
    """An extracted FMU and its variables.

    `Fmu.of(path)` returns the `Fmu` of this file that the process shares. Without a path the file is that of the environment
    variable BEVEL_DIFFERENTIAL_FMU, else the FMU of the package. `Fmu(path)` extracts the file anew; the path may also be that of
    a folder with an extracted FMU.

    Attributes: `file`, `folder`; `variables`, by name; `description`, the model description as fmpy reads it."""

    def __init__(self, file: FileName):
        self.file = Path(file)
        self.folder = str(file) if self.file.is_dir() else extract(str(file))
        if not self.file.is_dir():
            _extracted.append((os.getpid(), self.folder))
        self.description = read_model_description(self.folder)
        units = {unit.name: unit for unit in self.description.unitDefinitions}
        self.variables = {each.name: Variable(each, units) for each in self.description.modelVariables}

    @classmethod
    def of(cls, file: "FileName | Fmu | None" = None) -> "Fmu":
        """The shared `Fmu` of `file`, extracted at the first call. An `Fmu` is returned as it is."""
        if isinstance(file, Fmu):
            return file
        file = Path(file or usual()).resolve()
        key = (os.getpid(), file)
        with _lock:
            if key not in _shared:
                if file.is_dir():
                    raise DifferentialError(f"{file}: it is a folder; name the .fmu file, or take Fmu(folder)")
                if not file.is_file():
                    raise DifferentialError(f"{file}: there is no such FMU")
                try:
                    _shared[key] = cls(file)
                except (BadZipFile, OSError) as error:
                    raise DifferentialError(f"{file}: not an FMU ({error}); name a file that ends with .fmu") from None
            return _shared[key]

    @classmethod
    def by_hash(cls, file: str, sha256: str) -> "Fmu":
        """The FMU with this SHA-256: `file`, or else the default FMU of this machine."""
        for place in (Path(file), Path(usual())):
            if place.is_file() and cls.of(place).sha256 == sha256:
                return cls.of(place)
        raise DifferentialError(f"{file}: neither this file nor the default FMU of this machine, {usual()}, is the one that was asked for "
                                f"(SHA-256 {sha256[:12]}…); install the same wheel on all machines, or set BEVEL_DIFFERENTIAL_FMU")

    def __reduce__(self) -> tuple:
        # another process or machine finds the FMU by its hash, as its files may be elsewhere
        return Fmu.by_hash, (str(self.file), self.sha256)

    @cached_property
    def sha256(self) -> str:
        """SHA-256 of the file. A folder has none, so that an `Fmu` of one stays in its process."""
        if self.file.is_dir():
            raise DifferentialError(f"{self.file}: an extracted folder has no hash to be found by in another process; open the .fmu file")
        return hashlib.sha256(self.file.read_bytes()).hexdigest()

    def variable(self, name: str) -> Variable:
        """The variable `name`."""
        try:
            return self.variables[name]
        except KeyError:
            raise DifferentialError(f"{name}: there is no such variable{variable_suggestion(name, self.variables)}") from None

    def find(self, *words: str, acting: Any = None) -> list[Variable]:
        """The variables with all `words` in name or description, in small letters or capitals. `acting`: a scene file, the name of a
        shipped scene or a `Scene`; only variables that take effect in it are listed."""
        names = None if acting is None else set(ask({"ask": "acting", "of": about(acting)})["names"])
        found = self.variables.values() if names is None else (self.variables[name] for name in self.variables if name in names)
        return [each for each in found if all(word.lower() in f"{each.name}\n{each.description}".lower() for word in words)]

    def named(self, names: Iterable[str]) -> tuple[Variable, ...]:
        """The variables of these names, in their order."""
        if isinstance(names, str):
            raise DifferentialError(f"{names!r}: names are a list, such as [{names!r}]")
        return tuple(self.variable(name) for name in names)

    def numbers(self, values: Mapping[str, Value] | None = None, **keywords: Value) -> list[tuple[Variable, Number]]:
        """Pairs (variable, number) of parameters and inputs as the FMU takes them; values as in `Differential.set`."""
        named = {name.replace("__", "."): value for name, value in keywords.items()}
        pairs = []
        for name, value in {**(values or {}), **named}.items():
            variable = self.variable(name)
            if variable.causality not in ("parameter", "input"):
                raise DifferentialError(f"{name}: it is calculated and cannot be set; parameters and inputs can")
            number = variable.number(value)
            if variable.has_unit(value):
                # the FMU's own message guesses at the unit that was meant
                variable.check_range(number, value)
            pairs.append((variable, number))
        return pairs

    def open(self, kind: str = "CoSimulation", name: str = "differential") -> Instance:
        """A new instance, to be driven call by call; `kind` is "CoSimulation" or "ModelExchange", `name` appears in logs.

        A `with` statement frees the instance at its end."""
        return Instance(self, kind, name)


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
