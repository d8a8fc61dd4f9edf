"""Files of experiments by FMI-LS-REF.

In the draft alpha.1 an experiment has its times as attributes; in later ones an element within it has them."""

from pathlib import Path

from lxml import etree

from .experiment import Experiment, Unit
from .files import ANY, PARAMETERS, TABLES, Broken, attribute_number, local, mime, parsed, path_of

# types of the drafts; a file without one is taken
TYPES = ("application/x-ma-ls-experiments", "application/x-ma-hs-experiments", "application/xml", "text/xml", ANY)
# a child of an experiment, the field of `Experiment` that it fills, and what files may be
FILES = {"parameters": ("parameters", PARAMETERS), "stimuli": ("inputs", TABLES), "references": ("result", TABLES)}
NUMBERS = {"startTime": "start", "stopTime": "stop", "stepSize": "step", "tolerance": "solver_tolerance"}
# what later drafts have besides simulations over time
ANALYSES = ("steadystate", "parameteroptimization", "setpointoptimization", "sensitivityanalysis", "trajectoryoptimization",
            "linearization")


def experiments_of(source: str, kind: str, folder: Path, unit: Unit, faults: list[str]) -> list[Experiment]:
    """The experiments of a file; where it cannot be read, one that says so, for what it holds is not tested."""
    file = unit.at(folder, source)
    root = parsed(source, file, faults) if file else None
    found = [] if root is None else [element for element in root.iter() if local(element) == "experiment"]
    if found:
        return [_experiment(element, kind, file.parent, source, faults) for element in found]
    problem = "it is not in the FMU" if file is None else "it holds no experiment"
    return [Experiment(source, folder, kind=kind, problem=f"{source}: {problem}")]


def _experiment(element, kind, folder, source, faults):
    name = element.get("name") or "without a name"
    experiment = Experiment(name, folder, kind=kind, description=element.get("description", ""))
    place = f"{source}, experiment {name}"
    given = dict(element.attrib)
    for child in element:
        what = local(child)
        if what == "transientsimulation":
            given |= child.attrib
        elif what in ANALYSES:
            _refuse(experiment, f"{source}: it is no simulation over time but {etree.QName(child).localname}")
        elif what in FILES:
            _add_file(experiment, child, *FILES[what], source)
    if not element.get("name"):
        faults.append(f"{source}, line {element.sourceline}: the attribute name is missing")
    for key, field in NUMBERS.items():
        try:
            setattr(experiment, field, attribute_number(given.get(key)))
        except Broken as error:
            faults.append(f"{place}: {key} {error}; the default experiment's is taken")
    if not experiment.result and not experiment.problem:
        faults.append(f"{place}: it names no result; that it runs is all that is tested")
    return experiment


def _add_file(experiment, child, field, types, source):
    what, path, kind = etree.QName(child).localname, path_of(child.get("source", "")), mime(child)
    if not path:
        _refuse(experiment, f"{source}, line {child.sourceline}: {what} has no source")
    elif kind not in (*types, ANY):
        _refuse(experiment, f"{path}: the type {kind} is not read")
    elif getattr(experiment, field):
        _refuse(experiment, f"{source}, line {child.sourceline}: {what} stands here twice; one is read")
    else:
        setattr(experiment, field, path)


def _refuse(experiment, problem):
    """Keeps the first problem of an experiment."""
    experiment.problem = experiment.problem or problem
