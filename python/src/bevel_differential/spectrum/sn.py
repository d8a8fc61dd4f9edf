"""S–N curves of the gears and the effect of mean stress, as the FMU has them (docs/theory.md, section 10).

```text
N_f = N_ref (S/σ)^k,   k = ln(N_ref/N_static)/ln Y_N            ISO 6336-2, -3, -5; the same slope below the knee
D   = Σ n_i/N_f(σ_i)                                            Palmgren and Miner
σ   = 2σ_a/((1 + M) K(σ_m/σ_a)),   M = 2 Y_M − 1                FKM guideline; Y_M idler factor
```"""

from collections.abc import Mapping
from dataclasses import dataclass
from math import log
from typing import Self

import numpy as np

# cycles up to which the standards hold the strength constant: bending (ISO 6336-3), pitting (ISO 6336-2)
STATIC_BENDING, STATIC_PITTING = 1e3, 1e5
# the most of M, as the FMU limits it
MOST_SENSITIVE = 0.99


@dataclass(frozen=True)
class SnCurve:
    """Cycles to failure of a stress: `strength` [Pa] at the knee of `cycles`, with `slope`."""

    strength: float
    cycles: float
    slope: float

    @classmethod
    def through(cls, strength: float, cycles: float, life_factor: float, static_cycles: float) -> Self:
        """The curve through `strength` at `cycles` and `life_factor` times it at `static_cycles`."""
        return cls(strength, cycles, log(cycles / static_cycles) / log(life_factor))

    def damage(self, stress: np.ndarray) -> np.ndarray:
        """Damage of one cycle from 0 to each `stress` [Pa]: 1/N_f, at most 1; 0 without stress. Same shape."""
        ratio = np.maximum(np.asarray(stress, float), 0.0) / self.strength
        return np.minimum(ratio ** self.slope / self.cycles, 1.0)

    def life(self, stress: np.ndarray) -> np.ndarray:
        """Cycles to failure at each `stress` > 0 [Pa]. Same shape."""
        return self.cycles * (self.strength / np.asarray(stress, float)) ** self.slope


@dataclass(frozen=True)
class Strength:
    """Strength of the gears: curves of `bending`, `idler` bending and `pitting`, and the `sensitivity` to mean stress M."""

    bending: SnCurve
    idler: SnCurve
    pitting: SnCurve
    sensitivity: float

    PARAMETERS = tuple(f"strength.{name}" for name in (
        "bending_strength", "bending_cycles", "bending_life_factor", "contact_strength", "contact_cycles",
        "contact_life_factor", "idler_factor"))

    @classmethod
    def of(cls, values: Mapping[str, float]) -> Self:
        """From the FMU's parameters `PARAMETERS`: a mapping from name to number, SI."""
        bending, cycles, factor, contact, contact_cycles, contact_factor, idler = (values[name] for name in cls.PARAMETERS)
        return cls(SnCurve.through(bending, cycles, factor, STATIC_BENDING),
                   SnCurve.through(bending * idler, cycles, factor, STATIC_BENDING),
                   SnCurve.through(contact, contact_cycles, contact_factor, STATIC_PITTING),
                   min(max(2.0 * idler - 1.0, 0.0), MOST_SENSITIVE))

    def pulsating(self, span: np.ndarray, mean: np.ndarray) -> np.ndarray:
        """The cycle from 0 to its peak that does the damage of a cycle of the range `span` > 0 about `mean` [Pa], tension
        positive. Same shape."""
        m, ratio = self.sensitivity, 2.0 * np.asarray(mean) / np.asarray(span)
        permissible = np.select(
            [ratio <= 1.0, ratio < 3.0],
            [1.0 / (1.0 + m * np.maximum(np.minimum(ratio, 1.0), -1.0)), (1.0 + m / 3.0) / ((1.0 + m) * (1.0 + m * ratio / 3.0))],
            (1.0 + m / 3.0) / (1.0 + m) ** 2)
        return span / ((1.0 + m) * permissible)
