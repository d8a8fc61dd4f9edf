"""The manifest of FMI-LS-REF: which experiments an FMU carries.

Manifests of other units may have small faults. They are reported; what can be read is read."""

from pathlib import Path

from lxml import etree

from ..values import DifferentialError
from .experiment import Experiment, Unit
from .files import Broken, attribute_number, local

NAME = "org.fmi-standard.fmi-ls-ref"
VERSION = "1.0.0-alpha.1"
DESCRIPTION = "Parameter sets, inputs and results of experiments with this unit"
NAMESPACE = "http://fmi-standard.org/fmi-ls-manifest"
FOLDER = f"extra/{NAME}"
MANIFEST = "fmi-ls-manifest.xml"
# an attribute of the element `Experiment`, and the field of `Experiment` that it fills
FILES = {"parameterSet": "parameters", "input": "inputs", "result": "result", "tolerances": "tolerances"}
TIMES = {"startTime": "start", "stopTime": "stop", "stepSize": "step"}


class Evidence:
    """The experiments of an FMU, and the `faults` of its manifest."""

    def __init__(self, experiments: list[Experiment], faults: list[str]):
        self.experiments, self.faults = experiments, faults

    @classmethod
    def of(cls, unit: Unit) -> "Evidence":
        """What the manifest of an extracted FMU names. Raises `DifferentialError` where there is none, or nothing in it."""
        faults: list[str] = []
        manifest = _manifest(unit, faults)
        root = _parsed(manifest, unit, faults)
        _check_root(root, faults)
        experiments = [_experiment(element, manifest.parent, faults) for element in root.iter() if local(element) == "experiment"]
        experiments = experiments or _results_alone(root, manifest.parent, faults)
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


def _parsed(manifest, unit, faults):
    content = manifest.read_bytes()
    try:
        return etree.fromstring(content)
    except etree.XMLSyntaxError as error:
        faults.append(f"{MANIFEST}: it is no valid XML ({error})")
    root = etree.fromstring(content, etree.XMLParser(recover=True))
    if root is None:
        raise DifferentialError(f"{unit.shown(manifest)}: nothing in it can be read")
    return root


def _check_root(root, faults):
    given = {local(name): value for name, value in root.attrib.items()}
    for key in ("fmi-ls-name", "fmi-ls-version", "fmi-ls-description"):
        if key not in given:
            faults.append(f"{MANIFEST}: the attribute {key} is missing")
        elif f"{{{NAMESPACE}}}{key}" not in root.attrib:
            faults.append(f"{MANIFEST}: the attribute {key} is not in the namespace {NAMESPACE}")
    for key, known in (("fmi-ls-name", NAME), ("fmi-ls-version", VERSION)):
        if given.get(key, known) != known:
            faults.append(f"{MANIFEST}: {key} is {given[key]!r}; it is read as {known}")


def _experiment(element, folder, faults):
    given = dict(element.attrib)
    name = given.get("name") or Path(given.get("result", "without a name")).stem
    experiment = Experiment(name, folder, kind=given.get("kind", "validation"), description=given.get("description", ""))
    for key, field in FILES.items():
        setattr(experiment, field, given.get(key))
    for key, field in TIMES.items():
        try:
            setattr(experiment, field, attribute_number(given.get(key)))
        except Broken as error:
            faults.append(f"{MANIFEST}, experiment {name}: {key} {error}; the default experiment's is taken")
    return experiment


def _results_alone(root, folder, faults):
    """A result without an experiment belongs to the default experiment."""
    files = []
    for element in root.iter():
        if not isinstance(element.tag, str):
            continue
        given = {local(name): value for name, value in element.attrib.items()}
        if local(element) == "result":
            files.append(next((given[key] for key in ("source", "file", "href", "name") if given.get(key)), element.text or ""))
        elif "result" in given:
            files.append(given["result"])
    files = [file.strip() for file in files if file.strip()]
    if files:
        faults.append(f"{MANIFEST}: it names no experiment; results are compared with the default experiment")
    return [Experiment(Path(file).stem, folder, kind="default experiment", result=file) for file in files]
