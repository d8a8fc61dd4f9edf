"""Events of a duty cycle, and the damage of an event by the FMU."""

from dataclasses import dataclass, field
from math import isfinite, nan
from typing import Any, Self

import numpy as np

from ..values import DifferentialError, Value
from .passes import Roll

# outputs of damage, in the order of all arrays of modes
MODES = ("damage.planet", "damage.side", "damage.planet_flank", "damage.side_flank")
OUTPUTS = (*MODES, "safety.root_min", "safety.flank_min", "stress.root_planet_max", "stress.root_side_max", "stress.contact_rated",
           "left.tangential_force", "right.tangential_force", "planet[1].spin_angle")


@dataclass(frozen=True)
class Event:
    """Event of a duty cycle.

    `count`: number of occurrences in a cycle, 0 or more; `duration` [s] and `distance` [m, NaN if not known] of one occurrence;
    `values`: inputs and parameters of the FMU that it sets, as for `Differential`; `signals`: inputs over time
    {name: (times [s], values)} of an event that is a time history, from 0 to `duration`; `step`: communication step of its
    simulation [s]."""

    name: str
    count: float
    duration: float
    distance: float = nan
    values: dict[str, Value] = field(default_factory=dict)
    signals: dict[str, tuple[np.ndarray, np.ndarray]] = field(default_factory=dict)
    step: float = 0.01

    def __post_init__(self) -> None:
        if not (isfinite(self.count) and self.count >= 0.0):
            raise DifferentialError(f"count = {self.count!r}: event {self.name!r} occurs 0 times or more")
        if not (isfinite(self.duration) and self.duration > 0.0):
            raise DifferentialError(f"duration = {self.duration!r}: event {self.name!r} takes more than 0 s")
        if self.distance < 0.0:
            raise DifferentialError(f"distance = {self.distance!r}: event {self.name!r} covers 0 m or more")


@dataclass(frozen=True)
class EventDamage:
    """Damage of one occurrence of an event to the gears.

    `roll`: steady rolling, whose passes are counted tooth by tooth, or `None`; `rolls`: true if other teeth come into mesh; `advance`:
    pitches by which the planets roll relative to the carrier, signed; `meshing`: Miner sums of all other load cycles while teeth roll or
    swing, shape (4,), in the order of `MODES`; `standing`: root stress of planet and side gear [Pa] by the left and the right mesh while
    the same teeth stay in mesh, positive if the mesh drives, shape (2, 2, points), without points if teeth roll all the time;
    `root_stress`: largest root stress of planets and side gears [Pa], shape (2,); `safety_root`, `safety_flank`: smallest factors of all
    gears; `warnings` of the FMU."""

    event: Event
    roll: Roll | None
    rolls: bool
    advance: float
    meshing: np.ndarray
    standing: np.ndarray
    root_stress: np.ndarray
    safety_root: float
    safety_flank: float
    warnings: tuple[str, ...]

    @classmethod
    def of(cls, event: Event, record: np.ndarray, warnings: tuple[str, ...], **found: Any) -> Self:
        """Damage with the stresses and the smallest safety factors of a `record` of `OUTPUTS`; `found`: all other fields."""
        return cls(event, root_stress=np.max(root_stress(record), axis=1), safety_root=float(record["safety.root_min"][-1]),
                   safety_flank=float(record["safety.flank_min"][-1]), warnings=warnings, **found)


def damage_of(record: np.ndarray) -> np.ndarray:
    """Miner sums of a record of `OUTPUTS`, shape (points, 4)."""
    return np.stack([record[name] for name in MODES], axis=1)


def root_stress(record: np.ndarray) -> np.ndarray:
    """Root stress of planets and side gears [Pa], shape (2, points)."""
    return np.stack([record["stress.root_planet_max"], record["stress.root_side_max"]])


def mesh_stress(record: np.ndarray) -> np.ndarray:
    """Root stress of planets and side gears [Pa] by the left and the right mesh, positive if the mesh drives, shape (2, 2, points)."""
    forces = np.stack([record["left.tangential_force"], record["right.tangential_force"]])
    return root_stress(record)[:, None] * forces / np.maximum(np.max(abs(forces), axis=0), np.finfo(float).tiny)


def load_signs(record: np.ndarray) -> np.ndarray:
    """1 while the drive flanks of the more loaded side are loaded, −1 while its coast flanks are, 0 without load; shape (points,)."""
    left, right = record["left.tangential_force"], record["right.tangential_force"]
    return np.sign(np.where(abs(left) >= abs(right), left, right))
