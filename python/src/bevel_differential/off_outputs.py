"""Outputs that no effect computes in a run, because all effects with these outputs are off. The library of answers finds them from the
declarations of the effects."""

from collections.abc import Iterable, Iterator, Mapping
from dataclasses import dataclass
from typing import TYPE_CHECKING

from .answers import ask
from .quantities import outputs_of
from .values import DifferentialError, Number

if TYPE_CHECKING:
    from .designs.space import Dimension
    from .fmu import Fmu


@dataclass(frozen=True)
class OffOutputs:
    """Outputs that are not computed: `names`, and `texts` for warnings and errors, one for each reason."""

    names: tuple[str, ...] = ()
    texts: tuple[str, ...] = ()

    @classmethod
    def of(cls, fmu: "Fmu", outputs: Iterable[str], values: Mapping[str, Number]) -> "OffOutputs":
        """Outputs that are not computed in a run with these values. An input has its value of the largest magnitude."""
        needed = dict.fromkeys(other for name in outputs for other in outputs_of(name))
        names = [name for name in needed if name in fmu.variables and fmu.variable(name).causality == "output"]
        if not names:
            return cls()
        given = {"description": "", "stop_time": 0.0, "step": 1.0, "outputs": [fmu.variable(name).name for name in names],
                 "set": {name: fmu.variable(name).written(value) for name, value in values.items()}}
        try:
            found = ask({"ask": "off", "of": {"name": "run", "given": given}})
        except DifferentialError:
            # the run itself reports values that are refused
            return cls()
        return cls(tuple(found["names"]), tuple(found["texts"]))


@dataclass(frozen=True)
class OffInDesigns:
    """Outputs that are not computed in designs. `always`: in none of the designs; `sometimes`: in some of them."""

    always: OffOutputs
    sometimes: OffOutputs

    @classmethod
    def of(cls, fmu: "Fmu", outputs: Iterable[str], values: Mapping[str, Number], dimensions: Iterable["Dimension"]) -> "OffInDesigns":
        """Outputs that are not computed in designs that differ from `values` in the dimensions."""
        names = list(outputs)
        variants = [OffOutputs.of(fmu, names, {**values, **more}) for more in _variants(list(dimensions))]
        worst = max(variants, key=lambda each: len(each.names))
        common = set.intersection(*(set(each.names) for each in variants))
        return cls(OffOutputs.of(fmu, common, values), worst)


def _variants(dimensions: "list[Dimension]") -> Iterator[dict[str, Number]]:
    """Values that switch effects on and off in designs: each listed value, and the largest and smallest values of all dimensions."""
    yield {each.variable: max(each.numbers, key=abs) for each in dimensions}
    yield {each.variable: min(each.numbers, key=abs) for each in dimensions}
    for each in dimensions:
        if each.kind == "list":
            yield from ({each.variable: number} for number in dict.fromkeys(each.numbers))


def largest(*courses: Iterable[tuple[str, Number]]) -> dict[str, Number]:
    """Value of the largest magnitude by name, from pairs (name, value)."""
    found: dict[str, Number] = {}
    for course in courses:
        for name, value in course:
            if name not in found or abs(value) > abs(found[name]):
                found[name] = value
    return found
