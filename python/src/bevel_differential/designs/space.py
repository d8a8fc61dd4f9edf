"""Parameters and inputs that vary, each with its distribution."""

import itertools
import re
from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import dataclass
from typing import TypeAlias

import numpy as np

from ..extras import require
from ..fmu import Fmu
from ..values import DifferentialError, Number, Value, Variable

# values in the form that users write: text such as "4 mm..5 mm:11", a sequence of values, or one value
Given: TypeAlias = Number | str | Iterable[Value]

_CALL = re.compile(r"(uniform|normal|triangular|lognormal)\((.*)\)$")
_USAGE = ("write FROM..TO, FROM..TO:COUNT, a list A, B, C, uniform(A, B), normal(MEAN, SD), triangular(A, PEAK, B), "
          "lognormal(MEDIAN, FACTOR) or, for whole numbers, seed")
# smallest share of a distribution without bounds: share 0 would give an infinite value
_LEAST = 2.0**-53


@dataclass(frozen=True)
class Dimension:
    """A variable and its values.

    `variable`: its name. `kind`: "list", "range", a distribution, or "seed" (each run draws its own seed, with any plan). `numbers`: in
    SI, the values of a list, both ends of a range or of seeds, or the parameters of a distribution. `count`: number of values of a
    range on a grid, or None. `whole`: true for whole numbers only."""

    variable: str
    kind: str
    numbers: tuple[Number, ...]
    count: int | None = None
    whole: bool = False

    @classmethod
    def parse(cls, fmu: Fmu, name: str, given: Given) -> "Dimension":
        """Reads text ("4 mm..5 mm:11", "line, line_weber", "normal(0.05, 0.005)") or a sequence of values."""
        variable = fmu.variable(name)
        if variable.causality not in ("parameter", "input"):
            raise DifferentialError(f"{name}: it is calculated and cannot be varied")
        text = given.strip() if isinstance(given, str) else None
        if text is None:
            values = given if isinstance(given, Iterable) else [given]
            return cls._list(variable, tuple(variable.number(value) for value in values))
        if text == "seed":
            return cls._seed(variable)
        call = _CALL.match(text)
        if call:
            return cls._distribution(variable, call[1], [part.strip() for part in call[2].split(",")], text)
        if ".." in text:
            return cls._range(variable, text)
        return cls._list(variable, variable.numbers([part.strip() for part in text.split(",")], text))

    @classmethod
    def _list(cls, variable: Variable, numbers: tuple[Number, ...]) -> "Dimension":
        if not numbers:
            raise DifferentialError(f"{variable.name}: no values; {_USAGE}")
        return cls(variable.name, "list", numbers)

    @classmethod
    def _range(cls, variable: Variable, text: str) -> "Dimension":
        bounds, _, count = text.partition(":")
        if variable.kind not in ("Real", "Integer"):
            raise DifferentialError(f"{variable.name}: it has no ranges; list its values")
        low, high = variable.numbers([part.strip() for part in bounds.split("..", 1)], text)
        if not low < high:
            raise DifferentialError(f"{variable.name} = {text}: the range ends at or before its beginning")
        try:
            number = int(count) if count else None
        except ValueError:
            number = 0
        if number is not None and number < 2:
            raise DifferentialError(f"{variable.name} = {text}: a range has 2 values or more")
        if number is not None and variable.kind == "Integer" and number > high - low + 1:
            raise DifferentialError(f"{variable.name} = {text}: there are only {high - low + 1} whole numbers in it")
        return cls(variable.name, "range", (low, high), number, variable.kind == "Integer")

    @classmethod
    def _seed(cls, variable: Variable) -> "Dimension":
        if variable.kind != "Integer":
            raise DifferentialError(f"{variable.name}: only whole numbers can be seeds")
        bounds = zip((variable.minimum, variable.maximum), (0, 2**31 - 1))
        low, high = (default if bound is None else bound for bound, default in bounds)
        return cls(variable.name, "seed", (low, high), whole=True)

    @classmethod
    def _distribution(cls, variable: Variable, kind: str, parts: Sequence[str], text: str) -> "Dimension":
        if variable.kind != "Real":
            raise DifferentialError(f"{variable.name}: only real variables have distributions")
        wanted = {"uniform": 2, "normal": 2, "triangular": 3, "lognormal": 2}[kind]
        if len(parts) != wanted:
            raise DifferentialError(f"{variable.name} = {text}: {kind} needs {wanted} numbers; {_USAGE}")
        numbers: tuple[Number, ...]
        if kind == "lognormal":
            # the factor has no unit
            numbers = (variable.number(parts[0]), _plain(variable, parts[1], text))
        else:
            numbers = variable.numbers(parts, text)
        sane: dict[str, Callable[..., bool]] = {
            "uniform": lambda a, b: a < b, "normal": lambda m, s: s > 0.0,
            "triangular": lambda a, c, b: a <= c <= b and a < b, "lognormal": lambda m, f: m > 0.0 and f > 1.0}
        if not sane[kind](*numbers):
            raise DifferentialError(f"{variable.name} = {text}: these numbers do not define a distribution; {_USAGE}")
        return cls(variable.name, kind, numbers)

    def at(self, share: np.ndarray) -> list[Number]:
        """Values at `share`, shares of probability in [0, 1), shape (runs,). SI."""
        share, numbers = np.asarray(share, float), self.numbers
        if self.kind == "list":
            return [numbers[i] for i in np.minimum((share * len(numbers)).astype(int), len(numbers) - 1)]
        if self.whole:
            low, high = int(numbers[0]), int(numbers[1])
            return [low + int(i) for i in np.minimum(share * (high - low + 1), high - low)]
        return _quantile(self.kind, numbers, share).tolist()

    def size(self) -> int:
        """Number of values on a grid."""
        if self.kind == "list":
            return len(self.numbers)
        if self.kind != "range":
            raise DifferentialError(f"{self.variable}: a grid needs a list or a range, not {self.kind}")
        if self.count is None and not self.whole:
            raise DifferentialError(f"{self.variable}: a grid needs the number of values, such as FROM..TO:11")
        return self.count or int(self.numbers[1] - self.numbers[0]) + 1

    def levels(self) -> list[Number]:
        """Values on a grid, in SI."""
        size = self.size()
        if self.kind == "list":
            return list(self.numbers)
        # between the ends, rounding removes the last bits that the interpolation adds: 0.04 instead of 0.039999999999999994
        values = [self.numbers[0], *(float(f"{value:.15g}") for value in np.linspace(*self.numbers, size)[1:-1]), self.numbers[-1]]
        return [round(value) for value in values] if self.whole else values

    def __str__(self) -> str:
        count = f":{self.count}" if self.count else ""
        return f"{self.kind}({', '.join(map(repr, self.numbers))}){count}"


def _plain(variable, number, text):
    try:
        return float(number)
    except ValueError:
        raise DifferentialError(f"{variable.name} = {text}: {number!r} is not a plain number") from None


def _quantile(kind, numbers, share):
    if kind in ("range", "uniform"):
        return numbers[0] + share * (numbers[1] - numbers[0])
    share = np.maximum(share, _LEAST)
    # this import takes a second, so workers that do not need it skip it
    stats = require("scipy.stats", "sweep")
    if kind == "normal":
        return stats.norm.ppf(share, *numbers)
    if kind == "lognormal":
        return stats.lognorm.ppf(share, np.log(numbers[1]), scale=numbers[0])
    low, peak, high = numbers
    return stats.triang.ppf(share, (peak - low) / (high - low), low, high - low)


@dataclass(frozen=True)
class Space:
    """All dimensions of a plan."""

    dimensions: tuple[Dimension, ...]

    @classmethod
    def parse(cls, fmu: Fmu, given: Mapping[str, Given]) -> "Space":
        """Reads a mapping of names to values; `Dimension.parse` describes the values."""
        if not given:
            raise DifferentialError("nothing varies: name a variable and its values")
        return cls(tuple(Dimension.parse(fmu, name, values) for name, values in given.items()))

    @property
    def names(self) -> list[str]:
        """Names of the variables."""
        return [dimension.variable for dimension in self.dimensions]

    def at(self, shares: np.ndarray) -> list[dict[str, Number]]:
        """Designs at points of the unit cube. `shares`: shape (runs, dimensions)."""
        shares = np.asarray(shares, float)
        columns = [dimension.at(column) for dimension, column in zip(self.dimensions, shares.T)]
        return self.designs(zip(*columns) if columns else [()] * len(shares))

    def grid(self) -> list[dict[str, Number]]:
        """All combinations of the levels of all dimensions; the last one changes fastest."""
        return self.designs(itertools.product(*(dimension.levels() for dimension in self.dimensions)))

    def designs(self, rows: Iterable[Sequence[Number]]) -> list[dict[str, Number]]:
        """Designs from rows of values, SI."""
        return [dict(zip(self.names, row)) for row in rows]
