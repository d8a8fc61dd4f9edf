"""One experiment: its files read, and the FMU run through it by fmpy."""

import io
from contextlib import redirect_stdout
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

import numpy as np
from fmpy import simulate_fmu
from fmpy.fmi1 import FMICallException

from ..instance import without_calls
from .files import Broken
from .parameter_sets import parameter_set
from .tables import TEXT, UNKNOWN, table, tolerances_of


@dataclass(frozen=True)
class Unit:
    """An extracted FMU: its `file`, the `folder` with its content, and the model `description` as fmpy reads it."""

    file: Path
    folder: Path
    description: Any

    @property
    def variables(self) -> dict[str, Any]:
        """Variables by name."""
        return {variable.name: variable for variable in self.description.modelVariables}

    def at(self, folder: Path, name: str) -> Path | None:
        """The file of the FMU with this path from a folder, None where there is none."""
        try:
            path = (folder / name).resolve()
            return path if path.is_file() and path.is_relative_to(self.folder.resolve()) else None
        except (OSError, ValueError):
            return None

    def shown(self, path: Path) -> str:
        """A file of the FMU, for messages."""
        return f"{self.file}, {path.relative_to(self.folder).as_posix()}"


@dataclass
class Experiment:
    """What a manifest says of an experiment, and what its files say; files are relative to `folder`.

    `kind`: "smoke test", "validation", "uncertainty analysis", or "default experiment" of a result that stands alone. Times in s;
    None: those of the default experiment. `solver_tolerance`: what the host tells the unit's solver. `problem`: what keeps it from
    being run. `faults`: what is wrong in it and takes nothing from the comparison. `warnings` of the FMU in its run."""

    name: str
    folder: Path
    kind: str = "validation"
    description: str = ""
    parameters: str | None = None
    inputs: str | None = None
    result: str | None = None
    tolerances: str | None = None
    start: float | None = None
    stop: float | None = None
    step: float | None = None
    solver_tolerance: float | None = None
    problem: str = ""
    faults: list[str] = field(default_factory=list)
    warnings: list[str] = field(default_factory=list)
    values: dict[str, Any] = field(default_factory=dict)
    signals: np.ndarray | None = None
    expected: np.ndarray | None = None
    allowed: dict[str, float] = field(default_factory=dict)
    units: dict[str, str] = field(default_factory=dict)

    def read(self, unit: Unit) -> "Experiment":
        """Reads the files. Raises `Broken`, naming what is wrong in which file."""
        variables = unit.variables
        if self.problem:
            raise Broken(self.problem)
        if self.result:
            # units of several versions of FMI may share the result of the default experiment
            left_out = (TEXT, UNKNOWN) if self.kind == "default experiment" else (TEXT,)
            self.expected = table(*self._found(self.result, unit), variables, self.faults, left_out)
        if self.parameters:
            self.values = parameter_set(*self._found(self.parameters, unit), variables)
        if self.inputs:
            self.signals = table(*self._found(self.inputs, unit), variables, self.faults)
        if self.tolerances:
            self.allowed = tolerances_of(*self._found(self.tolerances, unit), self.name, self.columns)
        self.units = {name: variables[name].unit or "" for name in self.columns}
        self._complete(unit.description.defaultExperiment)
        return self

    @property
    def columns(self) -> tuple[str, ...]:
        """The variables of the result."""
        return () if self.expected is None else self.expected.dtype.names[1:]

    def run(self, unit: Unit) -> np.ndarray:
        """The FMU's record of the experiment, by fmpy. Raises `Broken`."""
        said: list[str] = []

        def log(*words):
            # both versions of FMI end with status, category and message; status 1 is a warning, 0 an event
            if words[-3] != 0:
                (self.warnings if words[-3] == 1 else said).append(_text(words[-1]))

        try:
            # fmpy prints inputs that have no signal, and what the FMU says
            with redirect_stdout(io.StringIO()):
                return simulate_fmu(
                    str(unit.folder), model_description=unit.description, start_values=self.values, start_time=self.start,
                    stop_time=self.stop, output_interval=self.step, relative_tolerance=self.solver_tolerance, input=self.signals,
                    output=list(self.columns), logger=log, debug_logging=True)
        except Exception as error:  # noqa: BLE001 - fmpy raises plain exceptions
            # the log says why a call failed; fmpy only says which
            why = said if said and isinstance(error, FMICallException) else [*said, str(error)]
            raise Broken(f"the unit fails: {' '.join('; '.join(map(without_calls, why)).split())}") from None

    def _complete(self, default):
        """Takes times that the evidence does not give from the default experiment, else from the result."""
        times = np.empty(0) if self.expected is None else self.expected["time"]
        spacings = np.diff(times)
        self.stop = _first(self.stop, getattr(default, "stopTime", None), *times[-1:])
        self.step = _first(self.step, getattr(default, "stepSize", None), *np.sort(spacings[spacings > 0.0])[:1])

    def _found(self, name, unit):
        """The name for messages, and the path: where the evidence says, else elsewhere in the FMU, which is a fault."""
        path = unit.at(self.folder, name)
        if path:
            return name, path
        # a name with its folder is that of no file in another folder
        wanted, parent = Path(name).name, Path(name).parent.name
        others = sorted(each for each in unit.folder.rglob("*")
                        if each.is_file() and each.name == wanted and parent in ("", each.parent.name))
        if not others:
            raise Broken(f"{name}: it is not in the FMU")
        self.faults.append(f"{name}: it is not where the evidence says; {others[0].relative_to(unit.folder).as_posix()} is taken")
        return name, others[0]


def _first(*values):
    """The first number that is given."""
    return next((float(value) for value in values if value is not None), None)


def _text(word):
    return word.decode("utf-8", "replace") if isinstance(word, bytes) else str(word)
