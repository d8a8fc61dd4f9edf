"""The manifest of FMI-LS-REF: which files an FMU carries, and which of them hold experiments and results.

Manifests of other units may have small faults. They are reported; what can be read is read."""

from collections.abc import Iterator
from dataclasses import dataclass
from os.path import relpath
from pathlib import Path

from ..values import DifferentialError
from .experiment import Experiment, Unit
from .experiments import TYPES, experiments_of
from .files import ANY, TABLES, local, mime, parsed, path_of

NAME = "org.fmi-standard.fmi-ls-ref"
VERSION = "1.0.0-alpha.1"
# the standard fixes the words
DESCRIPTION = "Layered Standard providing information on related files included in an FMU."
NAMESPACE = "http://fmi-standard.org/fmi-ls-manifest"
ROOT = "fmiReferences"
FOLDER = f"extra/{NAME}"
MANIFEST = "fmi-ls-manifest.xml"
# the file with a tolerance for each variable, for which the standard has no place
TOLERANCES = "tolerances.csv"
# drafts in which all that is read here is the same
VERSIONS = (VERSION, "1.0.0-beta.1")
ROLES = ("document", "requirement", "specification", "model", "parameter", "system", "testcase", "experiment", "result", "method",
         "rationale", "report", "request", "delivery", "configuration", "signature", "serialized-state", "meta-data", "other")
# kinds of experiments by the second part of their file's role
KINDS = {"": "smoke test", "smoke-test": "smoke test", "validation": "validation", "uncertainty-analysis": "uncertainty analysis"}


@dataclass(frozen=True)
class Related:
    """A file that a manifest names: the two parts of its role, its type, and its path from the manifest."""

    role: str
    part: str
    type: str
    source: str


class Evidence:
    """The experiments of an FMU, and the `faults` of its manifest."""

    def __init__(self, experiments: list[Experiment], faults: list[str]):
        self.experiments, self.faults = experiments, faults

    @classmethod
    def of(cls, unit: Unit) -> "Evidence":
        """What the manifest of an extracted FMU names. Raises `DifferentialError` where there is none, or nothing in it."""
        faults: list[str] = []
        manifest = _manifest(unit, faults)
        folder = manifest.parent
        root = parsed(MANIFEST, manifest, faults)
        if root is None:
            raise DifferentialError(f"{unit.shown(manifest)}: nothing in it can be read")
        _check_root(root, faults)
        related = list(_related(root, folder, unit, faults))
        experiments = [experiment for each in related if each.role == "experiment" and _is_one_of(TYPES, each, faults)
                       for experiment in experiments_of(each.source, KINDS[each.part], folder, unit, faults)]
        _add_tolerances(experiments, related, folder)
        experiments += _results_alone(experiments, related, folder, unit, faults)
        if not experiments:
            raise DifferentialError(f"{unit.shown(manifest)}: it names no experiment and no result")
        return cls(experiments, faults)


def _manifest(unit, faults):
    usual = unit.folder / FOLDER / MANIFEST
    if usual.is_file():
        return usual
    others = sorted(unit.folder.glob(f"extra/*ls-ref*/{MANIFEST}"))
    if not others:
        raise DifferentialError(f"{unit.file}: it carries no evidence; {FOLDER}/{MANIFEST} is not in it")
    faults.append(f"{unit.shown(others[0])}: the manifest belongs into {FOLDER}")
    return others[0]


def _check_root(root, faults):
    given = {local(name): value for name, value in root.attrib.items()}
    if root.tag != ROOT:
        faults.append(f"{MANIFEST}: the root element is {root.tag}; it must be {ROOT} without a namespace")
    for key, known in (("fmi-ls-name", (NAME,)), ("fmi-ls-version", VERSIONS), ("fmi-ls-description", (DESCRIPTION,))):
        if key not in given:
            faults.append(f"{MANIFEST}: the attribute {key} is missing")
        elif f"{{{NAMESPACE}}}{key}" not in root.attrib:
            faults.append(f"{MANIFEST}: the attribute {key} is not in the namespace {NAMESPACE}")
        if given.get(key, known[0]) not in known:
            faults.append(f"{MANIFEST}: {key} is {given[key]!r}; it is read as {known[0]!r}")


def _related(root, folder, unit, faults) -> Iterator[Related]:
    for element in root.iter():
        if local(element) != "related":
            continue
        place = f"{MANIFEST}, line {element.sourceline}"
        role, _, part = element.get("role", "").partition("/")
        source = path_of(element.get("source", ""))
        if not role or not source:
            faults.append(f"{place}: the attribute {'source' if role else 'role'} is missing; the file is left out")
        elif role not in ROLES or (role == "experiment" and part not in KINDS):
            faults.append(f"{place}: {element.get('role')!r} is no role; the file is left out")
        else:
            # experiments and results that are missing are told where they are looked for; what lies elsewhere has a scheme
            if role not in ("experiment", "result") and "://" not in source and unit.at(folder, source) is None:
                faults.append(f"{place}: {source} is not in the FMU")
            yield Related(role, part, mime(element), source)


def _is_one_of(types, related, faults):
    if related.type in types:
        return True
    faults.append(f"{MANIFEST}: {related.source}: the type {related.type} is not read; the file is left out")
    return False


def _add_tolerances(experiments, related, folder):
    """Paths of files of experiments are relative to these."""
    for each in related:
        if each.role == "other" and Path(each.source).name == TOLERANCES:
            for experiment in experiments:
                experiment.tolerances = Path(relpath(folder / each.source, experiment.folder)).as_posix()


def _results_alone(experiments, related, folder, unit, faults):
    """Results that belong to no experiment are of the default experiment."""
    used = {unit.at(each.folder, each.result) for each in experiments if each.result} - {None}
    return [Experiment(Path(each.source).stem, folder, kind="default experiment", result=each.source) for each in related
            if each.role == "result" and unit.at(folder, each.source) not in used and _is_one_of((*TABLES, ANY), each, faults)]
