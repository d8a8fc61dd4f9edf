"""Evidence of an FMU: scenes with start values, inputs, results and tolerances. `verify` simulates each scene with fmpy and compares.

The files are listed in the manifest of FMI-LS-REF. Files of one scene have its name: parameters/NAME.ssv with the role `parameter`,
inputs/NAME.csv (`testcase`) if inputs change, results/NAME.csv (`result`). tolerances.csv (`testcase`) has a line for each output of
each scene."""

import io
from collections.abc import Iterator
from contextlib import redirect_stdout
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np
from fmpy import simulate_fmu
from fmpy.fmi1 import FMICallException
from lxml import etree

from .answers import Progress
from .csv_table import lines_of
from .fmu import Fmu
from .instance import without_calls
from .progress import silent
from .values import DifferentialError, FileName, Number, Quantity
from .warned import by_owner, warn

MODEL = "BevelDifferential"
FOLDER = "extra/org.fmi-standard.fmi-ls-ref"
MANIFEST = "fmi-ls-manifest.xml"
TOLERANCES = "tolerances.csv"
COLUMNS = ("scene", "variable", "unit", "tolerance")
# a run may end this fraction of its length before the last time of the result, because times are rounded
SLACK = 1e-9


@dataclass(frozen=True)
class Deviation:
    """Largest deviation of an output from its result, in the unit of the output; `time` in s."""

    output: str
    unit: str
    time: float
    value: float
    expected: float
    tolerance: float

    @property
    def ratio(self) -> float:
        """Deviation divided by the tolerance; infinite if the value is not a number."""
        size = abs(self.value - self.expected) / self.tolerance
        return float(size) if np.isfinite(size) else np.inf


@dataclass(frozen=True)
class Verdict:
    """Verdict on a scene: "passed", "failed", or "broken" if nothing could be compared for the reason `problem`."""

    scene: str
    deviations: tuple[Deviation, ...] = ()
    problem: str = ""

    @property
    def worst(self) -> Deviation | None:
        """Deviation with the largest ratio."""
        return max(self.deviations, key=lambda each: each.ratio, default=None)

    @property
    def verdict(self) -> str:
        """Verdict in one word."""
        return "broken" if self.worst is None else "passed" if self.worst.ratio <= 1.0 else "failed"


class Evidence:
    """Files of evidence in an extracted FMU. Raises `DifferentialError` if the FMU is another unit or has no results."""

    def __init__(self, file: FileName):
        try:
            self.fmu = Fmu.of(file)
        except DifferentialError:
            raise
        except Exception as error:  # noqa: BLE001 - fmpy raises plain exceptions
            raise DifferentialError(f"{file}: its model description cannot be read ({error})") from None
        if self.fmu.description.modelName != MODEL:
            raise DifferentialError(f"{file}: it is the unit {self.fmu.description.modelName}; name an FMU of {MODEL}")
        self.folder = Path(self.fmu.folder, FOLDER)
        if not (self.folder / MANIFEST).is_file():
            raise DifferentialError(f"{file}: it has no evidence; {FOLDER}/{MANIFEST} is not in it")
        try:
            related = list(etree.parse(self.folder / MANIFEST).iter("Related"))
        except etree.XMLSyntaxError as error:
            raise DifferentialError(f"{file}, {MANIFEST}: it is not valid XML ({error})") from None
        self._files = {(each.get("role"), Path(each.get("source", "")).stem): each.get("source", "") for each in related}
        self.scenes = [name for role, name in self._files if role == "result"]
        if not self.scenes:
            raise DifferentialError(f"{file}, {MANIFEST}: it lists no file with the role result")

    def start(self, scene: str) -> dict[str, Number]:
        """Start values of a scene by name."""
        return start_values(self.fmu, *self._file("parameter", scene))

    def inputs(self, scene: str) -> np.ndarray | None:
        """Inputs of a scene over time; None if they keep their start values."""
        return table(self.fmu, *self._file("testcase", scene)) if ("testcase", scene) in self._files else None

    def result(self, scene: str) -> np.ndarray:
        """Results of a scene. The interval between the first two rows is the communication step."""
        file, shown = self._file("result", scene)
        found = table(self.fmu, file, shown)
        if len(found.dtype) < 2 or len(found) < 2 or not found["time"][1] > found["time"][0]:
            raise DifferentialError(f"{shown}: it needs an output, and two rows at different times at its start")
        return found

    def tolerances(self, scene: str) -> dict[str, float]:
        """Tolerance of each output of a scene, in the unit of the output."""
        file, shown = self._file("testcase", Path(TOLERANCES).stem)
        (_, head), *rows = lines_of(file, shown, COLUMNS[:-1])
        if missing := [name for name in COLUMNS if name not in head]:
            raise DifferentialError(f"{shown}: it has no column {missing[0]}")
        allowed = {}
        for line, cells in rows:
            name, variable, unit, tolerance = (cells[head.index(column)] for column in COLUMNS)
            if name == scene:
                where = f"{shown}, line {line}"
                if unit != (wanted := _at(where, self.fmu.variable, variable).unit or "1"):
                    raise DifferentialError(f"{where}: {variable} has the unit {wanted}, not {unit!r}")
                allowed[variable] = _at(where, Quantity("tolerance", "1").number, tolerance)
                if not allowed[variable] > 0.0:
                    raise DifferentialError(f"{where}: tolerance = {tolerance}: it must be above 0")
        return allowed

    def _file(self, role, name):
        """File with a role and a name, such as that of a scene, and its path for messages."""
        source = self._files.get((role, name))
        if source is None:
            raise DifferentialError(f"{MANIFEST}: it lists no file of {name} with the role {role}")
        if not (self.folder / source).is_file():
            raise DifferentialError(f"{source}: it is not in the FMU")
        return self.folder / source, source


def _at(where, read, text):
    """Returns `read(text)`; errors begin with `where`."""
    try:
        return read(text)
    except DifferentialError as error:
        raise DifferentialError(f"{where}: {error}") from None


def start_values(fmu: Fmu, file: Path, shown: str) -> dict[str, Number]:
    """Start values in a parameter set of SSP; `shown` is its path for messages."""
    try:
        root = etree.parse(file).getroot()
    except etree.XMLSyntaxError as error:
        raise DifferentialError(f"{shown}: it is not valid XML ({error})") from None
    own = {(kind.get("name"), item.get("name")): int(item.get("value")) for kind in root.iter("{*}Enumeration") for item in kind}
    values = {}
    for parameter in root.iter("{*}Parameter"):
        variable, value = _at(shown, fmu.variable, parameter.get("name", "")), parameter.find("*")
        text, unit, kind = ("" if value is None else value.get(key, "") for key in ("value", "unit", "name"))
        if variable.kind == "Integer":
            # a unit without enumerations has integers in their place
            text = own.get((kind, text), text)
        values[variable.name] = _at(shown, variable.number, (text, unit) if unit else text)
    return values


def table(fmu: Fmu, file: Path, shown: str) -> np.ndarray:
    """Table of variables over time as a structured array; its first field is "time" in s."""
    (line, head), *rows = lines_of(file, shown)
    where = f"{shown}, line {line}"
    if head[0] != "time":
        raise DifferentialError(f"{where}: the first column is {head[0]!r}; it must be time")
    if twice := [name for name in head if head.count(name) > 1]:
        raise DifferentialError(f"{where}: the column {twice[0]} appears twice")
    variables = [Quantity("time", "s"), *(_at(where, fmu.variable, name) for name in head[1:])]
    values = [tuple(_at(f"{shown}, line {line}", variable.number, cell) for variable, cell in zip(variables, cells)) for line, cells in rows]
    found = np.array(values, [(name, float) for name in head])
    for (line, _), step in zip(rows[1:], np.diff(found["time"])):
        if step < 0.0:
            raise DifferentialError(f"{shown}, line {line}: times fall; they must rise from line to line")
    return found


def record(fmu: Fmu, start: dict[str, Any], inputs: np.ndarray | None, stop: float, step: float, outputs: list[str],
           warnings: list[str]) -> np.ndarray:
    """Record of a co-simulation with fmpy; warnings of the unit are added to `warnings`."""
    said: list[str] = []

    def log(*words):
        # in both versions of FMI, the last arguments are status, category and message; status 1 is a warning, 0 an event
        if words[-3] != 0:
            text = words[-1]
            (warnings if words[-3] == 1 else said).append(text.decode("utf-8", "replace") if isinstance(text, bytes) else text)

    try:
        # fmpy prints the names of inputs without a signal
        with redirect_stdout(io.StringIO()):
            return simulate_fmu(fmu.folder, model_description=fmu.description, start_values=start, stop_time=stop, output_interval=step,
                                input=inputs, output=outputs, logger=log, debug_logging=True)
    except Exception as error:  # noqa: BLE001 - fmpy raises plain exceptions
        # the log contains the reason for a failure, fmpy reports only the name of the call
        why = said if said and isinstance(error, FMICallException) else [*said, str(error)]
        raise DifferentialError(f"the unit fails: {' '.join('; '.join(map(without_calls, why)).split())}") from None


def verify(file: FileName, progress: Progress = silent) -> list[Verdict]:
    """Simulates the scenes of an FMU's evidence and returns a verdict on each.

    Raises `DifferentialError` if the file is not an FMU of this model or has no evidence."""
    evidence, found = Evidence(file), []
    warnings: dict[str, list[str]] = {name: [] for name in evidence.scenes}
    for number, name in enumerate(evidence.scenes):
        progress(number / len(evidence.scenes), name)
        try:
            found.append(Verdict(name, tuple(_deviations(evidence, name, warnings[name]))))
        except DifferentialError as error:
            found.append(Verdict(name, problem=str(error)))
    warn(by_owner(warnings.items(), "scenes"))
    return found


def _deviations(evidence: Evidence, scene: str, warnings: list[str]) -> Iterator[Deviation]:
    start, inputs, result, allowed = (read(scene) for read in (evidence.start, evidence.inputs, evidence.result, evidence.tolerances))
    outputs, times = list(result.dtype.names[1:]), result["time"]
    if missing := [name for name in outputs if name not in allowed]:
        raise DifferentialError(f"{TOLERANCES}: it has no tolerance of {missing[0]} in {scene}")
    found = record(evidence.fmu, start, inputs, times[-1], times[1] - times[0], outputs, warnings)
    if found["time"][-1] < times[-1] * (1.0 - SLACK):
        raise DifferentialError(f"the run ends at {found['time'][-1]:g} s, before the last time of the result, {times[-1]:g} s")
    for name in outputs:
        values = np.interp(times, found["time"], found[name])
        distance = np.abs(values - result[name])
        worst = int(np.argmax(np.where(np.isfinite(distance), distance, np.inf)))
        yield Deviation(name, evidence.fmu.variable(name).unit or "", times[worst], values[worst], result[name][worst], allowed[name])
