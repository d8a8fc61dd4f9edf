"""Dog clutches of a run: share of the time in each phase, and times at which both half-shafts are connected."""

import numpy as np

from ..want import mean_over_time
from . import words
from .simulated import Simulated

SIDES = ("left", "right")
# phases as the outputs number them
PHASES = ("is open", "waits for equal speeds", "waits for a gap", "is closed", "waits for low torque to open")
CLOSED = 3.0


def connected(run: Simulated) -> np.ndarray:
    """True at the points at which both half-shafts transmit torque, so that a bias ratio has a meaning."""
    return np.minimum(*(run.series(f"{side}.dog_phase") for side in SIDES)) >= CLOSED


def phases(run: Simulated) -> str:
    """Sentence about the phases of dog clutches that are not closed all the time; empty if there are none."""
    said = []
    for side in SIDES:
        phase = run.series(f"{side}.dog_phase")
        if np.any(phase != CLOSED):
            shares = [(mean_over_time((phase == number).astype(float), run.time), name) for number, name in enumerate(PHASES)]
            said.append(f"The {side} dog clutch {words.listed([f'{name} {words.percent(share, 2)} of the time' for share, name in shares if share])}.")
    return " ".join(said)


def loose(run: Simulated) -> list[str]:
    """Sides whose dog clutch transmits no torque at the start."""
    if not run.value("effects.disconnect"):
        return []
    sides = run.literal("disconnect.sides")
    return [side for side in SIDES if sides in (side, "both") and run.series(f"{side}.shaft_torque")[0] == 0.0]
