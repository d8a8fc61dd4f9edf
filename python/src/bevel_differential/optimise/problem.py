"""Problem files: the gears to choose from, the objectives, and the conditions."""

import hashlib
import json
from collections.abc import Mapping
from dataclasses import dataclass, field, replace
from pathlib import Path
from typing import Any

from ..curve import beside
from ..designs.space import Space
from ..fmu import Fmu
from ..off_outputs import OffInDesigns
from ..quantities import QUANTITIES
from ..scene import Scene
from ..scene_file import find_beside, flat, read_toml
from ..values import DifferentialError, FileName, Number, Value, Variables, suggestion
from ..want import Condition, Want

KEYS = {"description", "scene", "objectives", "conditions", "population", "generations", "starts", "seed", "front", "set", "vary",
        "follow", "compare", "confirm"}
# keys of an entry of [follow]
FOLLOW = {"from", "factor", "plus", "table"}
NEEDED = ("description", "scene", "objectives", "vary")
SENSES = {"minimise": 1.0, "maximise": -1.0, "minimize": 1.0, "maximize": -1.0}
# outputs that sum up, or keep the worst value, since rating began
RATED = ("safety.", "damage.")
# smallest effort; with fewer than four designs, a generation has no parents to choose from
EFFORT = {"population": 4, "generations": 1, "starts": 1, "seed": 0, "front": 1}


@dataclass(frozen=True)
class Objective:
    """Quantity to optimise. `sign`: 1 if smaller values are better, -1 if larger values are better."""

    want: Want
    sign: float

    @classmethod
    def parse(cls, fmu: Variables, text: str) -> "Objective":
        """Reads "maximise safety.root_min" or "minimise gears.mass"."""
        sense, _, what = text.strip().partition(" ")
        if sense not in SENSES:
            raise DifferentialError(f"objective {text!r}: write \"maximise OUTPUT\" or \"minimise OUTPUT\"")
        return cls(Want.parse(fmu, what), SENSES[sense])

    def __str__(self) -> str:
        return f"{'minimise' if self.sign > 0.0 else 'maximise'} {self.want}"


@dataclass(frozen=True)
class Follower:
    """Dependent parameter: factor · another parameter + plus, or a table of the other parameter's values. SI."""

    name: str
    source: str
    factor: float = 1.0
    plus: float = 0.0
    table: dict[Number, Number] | None = None

    @classmethod
    def parse(cls, fmu: Fmu, name: str, given: Mapping[str, Any]) -> "Follower":
        """Reads { from = "NAME", factor = 4.0, plus = 0.0 } or { from = "NAME", table = { 2 = 1.0 } }."""
        unknown = set(given) - FOLLOW if isinstance(given, Mapping) else {"?"}
        if unknown or "from" not in given or ("table" in given and len(given) > 2):
            raise DifferentialError(f"[follow] {name}: write {{ from = \"NAME\", factor = 1.0, plus = 0.0 }} or "
                                    "{ from = \"NAME\", table = { VALUE = VALUE } }")
        variable, source = fmu.variable(name), fmu.variable(given["from"])
        table = given.get("table")
        if table is not None:
            table = {source.number(key): variable.number(value) for key, value in table.items()}
        return cls(variable.name, source.name, float(given.get("factor", 1.0)), float(given.get("plus", 0.0)), table)

    def of(self, values: Mapping[str, Number]) -> Number:
        """Value of the parameter. Raises `DifferentialError` if the table has no entry."""
        given = values[self.source]
        if self.table is None:
            return self.factor * given + self.plus
        if given not in self.table:
            raise DifferentialError(f"[follow] {self.name}: its table has no entry for {self.source} = {given}")
        return self.table[given]


@dataclass(frozen=True)
class Model:
    """Richer model: settings of the scene, and conditions that replace those on the same figure. `only_chosen`: true if only the chosen
    designs run with it, instead of the whole front."""

    settings: dict[str, Value]
    conditions: list[Condition] = field(default_factory=list)
    only_chosen: bool = False


@dataclass(frozen=True)
class Problem:
    """Contents of a problem file. `compare`: settings by name; `confirm`: models by name. `front`: number of designs of the front that
    are confirmed and shown, spread over the front."""

    description: str
    scene: Scene
    space: Space
    objectives: list[Objective]
    conditions: list[Condition]
    followers: list[Follower] = field(default_factory=list)
    compare: dict[str, dict[str, Number]] = field(default_factory=dict)
    confirm: dict[str, Model] = field(default_factory=dict)
    population: int = 96
    generations: int = 100
    starts: int = 1
    seed: int = 1
    front: int = 64

    @classmethod
    def load(cls, file: FileName, fmu: FileName | Fmu | None = None, stop: str | None = None) -> "Problem":
        """Reads the problem from a file; `stop`: another end of its scene. All errors in the file are reported together."""
        return _Reader(Path(file), Fmu.of(fmu), stop).problem()

    def known(self, values: Mapping[str, Number]) -> dict[str, Number]:
        """All parameters by name, SI: these values, or else those of the scene, or else those of the FMU."""
        return {**self.scene.fmu.starts(), **self.scene.values, **values}

    def complete(self, values: Mapping[str, Number]) -> dict[str, Number]:
        """Design with the parameters that follow from it."""
        known = self.known(values)
        followed = {}
        for follower in self.followers:
            followed[follower.name] = known[follower.name] = follower.of(known)
        return {**followed, **values}

    def at(self, model: Model) -> "Problem":
        """Copy of the problem with a richer model. Parameters that the model sets do not follow others."""
        state = self.scene.__getstate__()
        instead = {(each.want, each.relation): each for each in model.conditions}
        return replace(self, scene=Scene(**{**state, "set": {**state["set"], **model.settings}}),
                       followers=[each for each in self.followers if each.name not in model.settings],
                       conditions=[instead.get((each.want, each.relation), each) for each in self.conditions])

    def sized(self, **effort: int) -> "Problem":
        """Copy of the problem with another population, generations, starts, seed or front."""
        problem = replace(self, **effort)
        for key, least in EFFORT.items():
            if getattr(problem, key) < least:
                raise DifferentialError(f"{key} = {getattr(problem, key)}: it is {least} or more")
        return problem

    @property
    def wants(self) -> list[Want]:
        """Wants of objectives and conditions, each once."""
        return list(dict.fromkeys(each.want for each in (*self.objectives, *self.conditions)))

    def not_computed(self) -> list[str]:
        """Reasons for which wanted outputs are not computed in some designs, or in those of a richer model."""
        names = [want.name for want in self.wants]
        values, dimensions = {**self.scene.all_values(), **self.complete({})}, self.space.dimensions
        models = [{name: self.scene.fmu.variable(name).number(value) for name, value in model.settings.items()}
                  for model in self.confirm.values()]
        found = [OffInDesigns.of(self.scene.fmu, names, {**values, **settings}, dimensions).sometimes.texts for settings in [{}, *models]]
        return list(dict.fromkeys(text for texts in found for text in texts))

    def start_warning(self) -> str:
        """Warning about wanted figures that belong to a start out of equilibrium, with the remedy; empty if there are none."""
        rated = list(dict.fromkeys(want.name for want in self.wants if want.name.startswith(RATED)
                                   or want.name in QUANTITIES and QUANTITIES[want.name].loads))
        known = self.known({})
        settled = known["scene.start"] == self.scene.fmu.variable("scene.start").literals["equilibrium"]
        chosen = {each.variable for each in self.space.dimensions} | {each.name for each in self.followers}
        if not rated or settled or known["strength.rate_from"] > 0.0 or "strength.rate_from" in chosen:
            return ""
        return (f"{', '.join(rated)}: the scene does not start in equilibrium, so these values are those of the impact with which "
                "teeth meet their load; set strength.rate_from after the run-in, or scene.start = \"equilibrium\"")

    @property
    def key(self) -> str:
        """Hash of everything that determines the results, except the number of generations, so that a search can continue."""
        state = self.scene.__getstate__()
        state["fmu"] = self.scene.fmu.description.guid
        decisive = [state, *map(str, self.objectives), *map(str, self.conditions), *map(repr, self.space.dimensions),
                    *map(repr, self.followers), self.population, self.starts, self.seed]
        return hashlib.sha256(json.dumps(decisive, default=str, sort_keys=True).encode()).hexdigest()


class _Reader:
    """Reads a file and collects its errors."""

    def __init__(self, file: Path, fmu: Fmu, stop: str | None):
        self.file, self.fmu, self.stop = file, fmu, stop
        self.found = read_toml(file)
        self.problems = [f"{key}: there is no such key{suggestion(key, KEYS)}" for key in sorted(self.found.keys() - KEYS)]
        self.problems += [f"{key} is missing" for key in NEEDED if not self.found.get(key)]

    def problem(self) -> Problem:
        """Problem of the file. If there are errors, all are raised as one."""
        scene = self.attempt(self.scene)
        vary = flat(self.found.get("vary", {}))
        dimensions = [self.attempt(self.dimension, name, given) for name, given in vary.items()]
        followers = [self.attempt(Follower.parse, self.fmu, name, given)
                     for name, given in flat(self.found.get("follow", {}), ends=FOLLOW).items()]
        objectives = [self.attempt(Objective.parse, self.fmu, text) for text in self.found.get("objectives", [])]
        if len(objectives) == 1:
            self.problems.append("objectives: name two or more; a single objective has no front")
        conditions = [self.attempt(Condition.parse, self.fmu, text) for text in self.found.get("conditions", [])]
        self.problems += [f"{want}: {want.name} is one number of a design, without a statistic"
                          for want in (each.want for each in [*objectives, *conditions] if each)
                          if want.name in QUANTITIES and want.statistic.word != "final"]
        self.problems += [f"[follow] {each.name}: it varies as well; remove one of them" for each in followers
                          if each and each.name in vary]
        compare, confirm = self.named("compare"), self.models(conditions)
        effort = {key: self.found[key] for key in EFFORT if key in self.found}
        self.problems += [f"{key} = {value!r}: it is a whole number" for key, value in effort.items() if type(value) is not int]
        if self.problems:
            raise DifferentialError("\n".join(f"{self.file}: {problem}" for problem in self.problems))
        problem = Problem(self.found["description"], scene, Space(tuple(dimensions)), objectives, conditions, followers, compare,
                          confirm)
        if not_computed := problem.not_computed():
            raise DifferentialError("\n".join(f"{self.file}: {text} under [set]" for text in not_computed))
        return problem.sized(**effort)

    def attempt(self, function, *arguments):
        try:
            return function(*arguments)
        except DifferentialError as error:
            self.problems.append(str(error))
            return None

    def scene(self):
        """Scene of the file, with its changes. It is also searched for next to the file."""
        scene = Scene.load(find_beside(self.file, self.found.get("scene", "")), self.fmu, self.stop)
        return scene.set(beside(flat(self.found.get("set", {})), self.file))

    def dimension(self, name, given):
        found = Space.parse(self.fmu, {name: given}).dimensions[0]
        if found.kind not in ("list", "range"):
            raise DifferentialError(f"{name} = {given}: an optimisation varies over FROM..TO or a list, not over a distribution")
        if found.count is not None:
            raise DifferentialError(f"{name} = {given}: a search uses all values of a range; leave the count out, or "
                                    "write a list")
        return found

    def named(self, key, others=()):
        """Settings in the entries of a key, by name, SI; `others`: keys of an entry that are not settings."""
        found = {}
        for entry in self.found.get(key, []):
            values = {each: value for each, value in flat(entry).items() if each not in others}
            name = values.pop("name", None)
            if not name or name in found:
                self.problems.append(f"[[{key}]] name = {name!r}: each entry needs a unique name")
            found[name] = {each: self.attempt(self.number, each, value) for each, value in values.items()}
        return found

    def models(self, conditions):
        """Models of [[confirm]] by name."""
        found, all_settings = {}, self.named("confirm", ("conditions", "only_chosen"))
        known = {(each.want, each.relation) for each in conditions if each}
        for entry in self.found.get("confirm", []):
            name = entry.get("name")
            instead = [self.attempt(Condition.parse, self.fmu, text) for text in entry.get("conditions", [])]
            self.problems += [f"[[confirm]] {name}: {each} replaces no condition of the problem" for each in instead
                              if each and (each.want, each.relation) not in known]
            found[name] = Model(all_settings[name], instead, bool(entry.get("only_chosen")))
        return found

    def number(self, name, value):
        return self.fmu.variable(name).number(value)
