"""Structure of a system of FMUs: parts, connections and values. SI units."""

from dataclasses import dataclass


@dataclass(frozen=True)
class Structure:
    """System with its `name` and `description`, which ends at the time `end` [s].

    `parts`: class of each part, in the order of the power flow, which Gauss-Seidel follows; `connections`: source of each input, both as
    (part, variable); `values`: parameters and start values of inputs that differ from those of the FMUs, by (part, variable)."""

    name: str
    description: str
    parts: dict
    connections: dict
    values: dict
    end: float

    def of(self, part):
        """Values of a part by variable."""
        return {variable: value for (owner, variable), value in self.values.items() if owner == part}
