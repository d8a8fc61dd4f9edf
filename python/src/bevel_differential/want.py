"""What is wanted of a run, and what must hold."""

import operator
import re
from dataclasses import dataclass

import numpy as np

from .points import seconds
from .statistic import Statistic
from .values import DifferentialError, Variables

RELATIONS = {"<=": operator.le, ">=": operator.ge, "<": operator.lt, ">": operator.gt}


@dataclass(frozen=True)
class Want:
    """An output by a statistic."""

    name: str
    statistic: Statistic

    @classmethod
    def parse(cls, fmu: Variables, text: str) -> "Want":
        """Of "OUTPUT:STATISTIC"; without a statistic it is the final value."""
        name, _, word = text.strip().partition(":")
        variable = fmu.variable(name.strip())
        if variable.causality == "input":
            raise DifferentialError(f"{variable.name}: it is an input; wanted are outputs")
        return cls(variable.name, Statistic.parse(word or "final"))

    def __str__(self) -> str:
        return f"{self.name}:{self.statistic.word}"

    def unit(self, fmu: Variables) -> str:
        """SI unit of the figure; "1" where it has none."""
        return "s" if self.statistic.word == "time_of_peak" else fmu.variable(self.name).unit or "1"

    def of(self, record: np.ndarray, planet_teeth: int) -> float:
        """The figure of a record (structured array with this output and, for orders, the angle that they are counted by)."""
        angle = self.statistic.angle
        # a pitch of the planet is a period of the mesh
        teeth = planet_teeth if angle == "planet[1].spin_angle" else 1
        return self.statistic.of(record["time"], record[self.name].astype(float),
                                 None if angle is None else record[angle] * teeth)


@dataclass(frozen=True)
class Condition:
    """A bound of a wanted figure, in SI: "safety.root_min >= 1.2", "left.speed:max < 30 rad/s"."""

    want: Want
    relation: str
    limit: float

    @classmethod
    def parse(cls, fmu: Variables, text: str) -> "Condition":
        """Of "OUTPUT:STATISTIC RELATION LIMIT", the limit with or without a unit."""
        parts = re.split(r"(<=|>=|<|>)", text, maxsplit=1)
        if len(parts) != 3:
            raise DifferentialError(f"condition {text!r}: write it as \"safety.root_min >= 1.2\", with one of "
                                    f"{', '.join(RELATIONS)}")
        want = Want.parse(fmu, parts[0])
        written = parts[2].strip()
        is_time = want.statistic.word == "time_of_peak"
        limit = seconds(f"condition {text!r}: the time", written) if is_time else fmu.variable(want.name).number(written)
        return cls(want, parts[1], float(limit))

    def __str__(self) -> str:
        return f"{self.want} {self.relation} {self.limit:g}"

    def holds(self, figure: float) -> bool:
        """Whether it holds for a figure, SI."""
        return bool(RELATIONS[self.relation](figure, self.limit))

    def excess(self, figure: float) -> float:
        """By how much a figure breaks it, relative to the limit; negative where it holds."""
        scale = abs(self.limit) or 1.0
        return (figure - self.limit) / scale * (1.0 if self.relation.startswith("<") else -1.0)
