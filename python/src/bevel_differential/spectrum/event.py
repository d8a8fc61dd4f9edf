"""An event of a duty cycle, as it is simulated."""

from dataclasses import dataclass, field
from math import isfinite, nan

import numpy as np

from ..values import DifferentialError, Value


@dataclass(frozen=True)
class Event:
    """An event of a duty cycle.

    `count`: how often it occurs in a cycle, 0 or more; `duration` [s] and `distance` [m, NaN if not known] of one occurrence;
    `values`: inputs and parameters of the FMU that it sets, as `Differential` takes them; `signals`: inputs over time
    {name: (times [s], values)} of an event that is a time history, from 0 to `duration`; `step` [s]: of its simulation."""

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
