"""Factors: variables that vary in production, and their tolerances."""

import re
from dataclasses import dataclass

import numpy as np

from ..designs import Dimension
from ..designs.space import Given as GivenValues
from ..scene import Scene
from ..values import BAND, DifferentialError, Number
from .laws import Fixed, Gear, Given, Law, PitchGrade, RunoutGrade, band, gears, grade

PITCH = "tooth_errors.accuracy_grade"
RUNOUT = {"tooth_errors.planet_runout": "planet", "tooth_errors.side_runout": "side"}
_GRADE = re.compile(r"grade\s+(\S+)$")
_USAGE = ("write \"grade 7\", \"0.1 mm +- 0.02 mm\", normal(MEAN, SD), uniform(A, B), triangular(A, PEAK, B), "
          "lognormal(MEDIAN, FACTOR), \"A..B\", a list or one value")
# effect of each word: factor of the spread, steps of the grade, and the factor in words
WORDS = {"finer": (0.5, -1, "half the spread of"), "coarser": (2.0, 1, "twice the spread of")}


@dataclass(frozen=True)
class Factor:
    """Variable and the law of its values; `text` is the tolerance as written."""

    variable: str
    text: str
    law: Law

    def at(self, shares: np.ndarray) -> list[Number]:
        """Values (SI) at shares of probability, shape (runs,)."""
        return self.law.at(np.clip(shares, 1e-9, 1.0 - 1e-9))


class Reader:
    """Reads tolerances for the gears of a scene. `capability`: C_p of bands and grades; with 1, a tolerance is ± 3 standard
    deviations."""

    def __init__(self, scene: Scene, capability: float = 1.0):
        if isinstance(capability, bool) or not isinstance(capability, (int, float)) or not 0.1 <= capability <= 10.0:
            raise DifferentialError(f"capability = {capability!r}: it is a number from 0.1 to 10, the C_p of the process")
        self.fmu, self.capability = scene.fmu, float(capability)
        self._scene = scene
        self._gears: dict[str, Gear] | None = None

    def read(self, name: str, given: GivenValues) -> Factor:
        """Factor of a tolerance as written in a file."""
        variable = self.fmu.variable(name)
        if variable.causality not in ("parameter", "input"):
            raise DifferentialError(f"{name}: it is calculated and has no tolerance")
        text = given.strip() if isinstance(given, str) else given
        try:
            return Factor(variable.name, str(text), self._law(variable, text))
        except ValueError as error:
            known = str(error).startswith(name)
            raise DifferentialError(f"{'' if known else name + ': '}{error}") from None

    def other(self, factor: Factor, given: GivenValues) -> Factor:
        """Factor with another tolerance, written as in a file, or as "finer" or "coarser" (a grade, or half and twice the spread)."""
        if not isinstance(given, str) or given not in WORDS:
            return self.read(factor.variable, given)
        ratio, steps, said = WORDS[given]
        try:
            law = factor.law.graded(steps) or factor.law.scaled(ratio)
        except DifferentialError as error:
            raise DifferentialError(f"{factor.variable} = {given}: {error}") from None
        return Factor(factor.variable, f"grade {law.number}" if hasattr(law, "number") else f"{said} {factor.text}", law)

    def _law(self, variable, text):
        if isinstance(text, str):
            found = _GRADE.match(text)
            if found:
                return self._grade(variable.name, found[1])
            parts = BAND.split(text)
            if len(parts) > 1:
                return self._band(variable, text, [part.strip() for part in parts])
        dimension = Dimension.parse(self.fmu, variable.name, text)
        if dimension.kind == "list" and len(set(dimension.numbers)) == 1:
            return Fixed(dimension.numbers[0])
        return Given(dimension)

    def _grade(self, name, written):
        if name != PITCH and name not in RUNOUT:
            raise DifferentialError(f"{name}: it has no accuracy grade; {PITCH} and {', '.join(RUNOUT)} have; {_USAGE}")
        if not written.lstrip("-").isdecimal():
            raise DifferentialError(f"{name} = grade {written}: a grade is a whole number")
        number = grade(name, int(written))
        self._gears = self._gears or gears(self._scene)
        for gear in self._gears.values() if name == PITCH else [self._gears[RUNOUT[name]]]:
            gear.check(name)
        return PitchGrade(number) if name == PITCH else RunoutGrade(number, self._gears[RUNOUT[name]], self.capability)

    def _band(self, variable, text, parts):
        if len(parts) != 2 or not all(parts):
            raise DifferentialError(f"{variable.name} = {text}: {_USAGE}")
        if variable.kind != "Real":
            raise DifferentialError(f"{variable.name} = {text}: only real variables have a band; {_USAGE}")
        return band(variable.name, *variable.numbers(parts, text), self.capability)
