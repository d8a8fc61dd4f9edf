"""Tolerance files: a scene, tolerances, wanted figures, limits and alternatives."""

import contextlib
from pathlib import Path

import numpy as np

from ..curve import beside
from ..designs import Farm, Task
from ..fmu import Fmu
from ..points import seconds
from ..scene import Scene
from ..scene_file import find_beside, flat, read_toml
from ..values import DifferentialError, FileName, suggestion
from ..want import Condition, Want
from .factor import PITCH, RUNOUT, Factor, Reader
from .study import Alternative, Result, Study

KEYS = {"description", "scene", "set", "from", "factors", "capability", "wants", "limits", "runs", "seed", "alternative"}
NEEDED = ("description", "scene", "factors", "wants")
KINDS = {str: ("text", ("description", "scene")), dict: ("a table", ("set", "factors")),
         list: ("a list", ("wants", "limits", "alternative"))}
INDIVIDUAL = "tooth_errors.seed"
# number of draws for which the FMU reports values without effect
TRIED = 4


class Plan:
    """Tolerance file that has been read.

    `scene`, `task` and `study` are its contents; `notes` are remarks for readers of the results."""

    def __init__(self, name: str, description: str, scene: Scene, task: Task, study: Study):
        self.name, self.description, self.scene, self.task, self.study = name, description, scene, task, study
        self._check_ranges()
        self._check_effect()
        self._check_computed()
        self.notes = self._remarks()

    @classmethod
    def load(cls, file: FileName, fmu: FileName | Fmu | None = None, runs: int | None = None, seed: int | None = None,
             indices: bool = True, stop: str | None = None) -> "Plan":
        """Reads a plan from a file; `runs` and `seed` replace those of the file, `stop` the end of its scene. All errors of the factors are
        reported together."""
        file, fmu = Path(file), Fmu.of(fmu)
        if not file.is_file():
            raise DifferentialError(f"{file}: there is no such file; `bevel-differential examples` writes one to begin with")
        found = read_toml(file)
        problems = [f"{key}: there is no such key{suggestion(key, KEYS)}" for key in sorted(found.keys() - KEYS)]
        problems += [f"{key} is missing" for key in NEEDED if key not in found]
        problems += [f"{key} = {found[key]!r}: it is {what}" for kind, (what, keys) in KINDS.items() for key in keys
                     if key in found and not isinstance(found[key], kind)]
        problems += [f"{key}: it contains only texts, such as \"torque_bias_ratio:mean\"" for key in ("wants", "limits")
                     if not all(isinstance(entry, str) for entry in found.get(key, []))]
        if problems:
            raise DifferentialError("\n".join(f"{file}: {problem}" for problem in problems))
        scene = Scene.load(find_beside(file, str(found["scene"])), fmu, stop)
        try:
            scene.set(beside(flat(found.get("set", {})), file))
            scene.check_settable(flat(found["factors"]))
            study = _study(_Reading(scene, found), found, runs, seed, indices)
            task = Task(scene, study.wants, study.limits, seconds("from", found.get("from", 0.0)))
            return cls(file.stem, found["description"], scene, task, study)
        except DifferentialError as error:
            raise DifferentialError("\n".join(f"{file}: {line}" for line in str(error).splitlines())) from None

    def run(self, farm: Farm) -> Result:
        """Result of the study, whose runs a `Farm` evaluates."""
        return self.study.run(lambda designs: farm.evaluate(self.task, designs))

    def _check_effect(self):
        """Refuses a factor that has no effect in any draw."""
        without_effect = []
        for _, values in self.study.designs()[:TRIED]:
            # the results show a design that the FMU refuses
            with contextlib.suppress(DifferentialError):
                without_effect.append(self.scene.unfelt_of(values))
        for name in self.study.factors:
            if without_effect and all(name in each for each in without_effect):
                raise DifferentialError(f"{name} has a tolerance, but {without_effect[0][name]}; set that in the scene or in [set], "
                                        "or leave the factor out")

    def _check_computed(self):
        """Refuses wanted outputs that no effect computes in one of the first draws."""
        names = [want.name for want in self.study.wants]
        for _, values in self.study.designs()[:TRIED]:
            if off := self.scene.off_outputs(names, values).texts:
                raise DifferentialError("\n".join(f"{text} in the scene or in [set]" for text in off))

    def _remarks(self):
        factors = self.study.factors
        individual = [name for name in (PITCH, *RUNOUT) if name in factors]
        if individual and INDIVIDUAL not in factors:
            return [f"all gears have the same teeth and phases of runout, because {INDIVIDUAL} is not a factor: give it \"seed\""]
        return []

    def _check_ranges(self):
        """Refuses tolerances with draws that the FMU would refuse."""
        designs = [values for _, values in self.study.designs()]
        for name in self.study.factors:
            variable = self.scene.fmu.variable(name)
            if variable.kind not in ("Real", "Integer"):
                continue
            drawn = np.array([values[name] for values in designs], float)
            ends = (variable.minimum, variable.maximum)
            bounds = [default if bound is None else float(bound) for bound, default in zip(ends, (-np.inf, np.inf))]
            outside = (drawn < bounds[0]) | (drawn > bounds[1])
            if np.any(outside):
                least, greatest, worst = (variable.text(number) for number in (*bounds, drawn[outside][0]))
                raise DifferentialError(f"{name}: {np.sum(outside)} of {len(drawn)} draws are outside {least} to {greatest}, "
                                        f"such as {worst}: make the tolerance narrower, or give a law that ends there, such as "
                                        "uniform(A, B)")


class _Reading:
    """Reads factors and collects their errors."""

    def __init__(self, scene, found):
        self.reader, self.problems = Reader(scene, found.get("capability", 1.0)), []
        self.factors = {name: self.attempt("[factors]", self.reader.read, name, given)
                        for name, given in flat(found["factors"]).items()}
        self.alternatives = [self.alternative(dict(entry)) for entry in found.get("alternative", [])]
        if self.problems:
            raise DifferentialError("\n".join(self.problems))

    def attempt(self, where, function, *arguments):
        try:
            return function(*arguments)
        except DifferentialError as error:
            self.problems.append(f"{where} {error}")
            return None

    def alternative(self, entry):
        name, cost = entry.pop("name", None), entry.pop("cost", None)
        where = "[[alternative]]"
        if cost is not None and (isinstance(cost, bool) or not isinstance(cost, (int, float)) or not -1.0 < cost < 100.0):
            self.problems.append(f"{where} cost = {cost!r}: it is a fraction of the price of a differential, such as 0.02")
        given = flat(entry)
        if not given:
            self.problems.append(f"{where} changes no tolerance: name a factor, such as tooth_errors.side_runout = \"finer\"")
        # errors of the factor itself have already been reported
        sound = {variable: text for variable, text in given.items() if self.factors.get(variable, True) is not None}
        others = {variable: self.attempt(where, self.other, variable, text) for variable, text in sound.items()}
        written = ", ".join(f"{variable} = {other.text}" for variable, other in others.items() if other)
        return Alternative(str(name or written), others, cost)

    def other(self, variable, text) -> Factor:
        if variable not in self.factors:
            raise DifferentialError(f"{variable}: it is not one of the factors{suggestion(variable, self.factors)}")
        return self.reader.other(self.factors[variable], text)


def _study(reading, found, runs, seed, indices):
    fmu = reading.reader.fmu
    wants = [Want.parse(fmu, text) for text in found["wants"]]
    limits = [Condition.parse(fmu, text) for text in found.get("limits", [])]
    return Study(list(reading.factors.values()), wants, limits, reading.alternatives,
                 found.get("runs", 512) if runs is None else runs, found.get("seed", 1) if seed is None else seed, indices)
