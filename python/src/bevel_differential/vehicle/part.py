"""Base class of tyre, motor and body: parameters with units and ranges."""

from dataclasses import dataclass, field, fields
from typing import Any, Self

from ..values import DifferentialError, Quantity, Value


def parameter(value: float, unit: str, text: str, least: float | None = None) -> Any:
    """Parameter of a part with its start value. It must be above `least`, if given."""
    return field(default=value, metadata={"unit": unit, "text": text, "least": least})


@dataclass
class Part:
    """Part with parameters in SI, which may be given with units, such as "372 mm". `described` lists them, `unset` lists those that nobody gave."""

    def __new__(cls, *values: Value, **named: Value) -> Self:
        part = super().__new__(cls)
        part.__dict__["_given"] = {*list(cls.described())[:len(values)], *named}
        return part

    @property
    def unset(self) -> dict[str, float]:
        """Parameters that nobody gave, with their start values."""
        return {name: start for name, (start, _, _) in self.described().items()
                if name not in self._given and getattr(self, name) == start}

    def __post_init__(self) -> None:
        for parameter in fields(self):
            name, value = f"{type(self).__name__}.{parameter.name}", getattr(self, parameter.name)
            unit, least = parameter.metadata["unit"], parameter.metadata["least"]
            number = float(Quantity(name, unit).number(value))
            if least is not None and not number > least:
                raise DifferentialError(f"{name} = {value!r}: it is a finite number above {least:g} {unit}".removesuffix(" 1"))
            setattr(self, parameter.name, number)

    @classmethod
    def described(cls) -> dict[str, tuple[float, str, str]]:
        """Parameters of the part by name: (start value, unit, description)."""
        return {parameter.name: (parameter.default, parameter.metadata["unit"], parameter.metadata["text"]) for parameter in fields(cls)}
