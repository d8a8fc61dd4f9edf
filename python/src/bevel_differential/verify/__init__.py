"""Runs an FMU against the evidence that it carries: parameter sets, inputs and results after FMI-LS-REF, by fmpy alone."""

from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from shutil import rmtree
from typing import TypeAlias

from fmpy import read_model_description

from ..answers import Progress
from ..fmu import extracted
from ..progress import silent
from ..values import DifferentialError, FileName
from ..warned import by_owner, warn
from .evidence import Evidence
from .experiment import Experiment, Unit
from .files import Broken
from .judged import Judged, broken, judged

# what is judged, and faults of the evidence that take nothing from the comparison
Found: TypeAlias = tuple[list[Judged], list[str]]


def verify(fmu: FileName, quick: bool = False, progress: Progress = silent) -> Found:
    """Runs the experiments that an FMU carries, and compares results. `quick`: smoke tests alone, where there are any.

    Returns an entry for each experiment, and the faults of the evidence. Raises `DifferentialError` where there is no evidence."""
    with _opened(fmu) as unit:
        evidence = Evidence.of(unit)
        chosen = evidence.experiments
        if quick:
            chosen = [each for each in chosen if each.kind == "smoke test"] or chosen
        found = []
        for number, experiment in enumerate(chosen):
            progress(number / len(chosen), experiment.name)
            found.append(_of(experiment, unit))
        warn(by_owner(((each.name, each.warnings) for each in chosen), "experiments"))
        return found, evidence.faults + list(dict.fromkeys(fault for each in chosen for fault in each.faults))


def _of(experiment: Experiment, unit: Unit) -> Judged:
    try:
        return judged(experiment, experiment.read(unit).run(unit))
    except Broken as problem:
        return broken(experiment, str(problem))


@contextmanager
def _opened(fmu: FileName) -> Iterator[Unit]:
    file = Path(fmu)
    if not file.is_file():
        raise DifferentialError(f"{file}: there is no such FMU")
    folder = Path(extracted(file))
    try:
        yield Unit(file, folder, _description(file, folder))
    finally:
        rmtree(folder, ignore_errors=True)


def _description(file, folder):
    try:
        return read_model_description(str(folder))
    except Exception as error:  # noqa: BLE001 - fmpy raises plain exceptions
        raise DifferentialError(f"{file}: its model description cannot be read ({error})") from None
