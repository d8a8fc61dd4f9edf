"""The study's two cases for all tools, and the measurements of a run. SI units."""

import json
import sys
from dataclasses import dataclass

import numpy as np

import gears

LOAD = 835.0
LENGTH = 0.5
# interval at which tools are called, equal to the study's output interval
STEP = 1e-3
# duration of the rise of the peers' load: an immediate load may move a side gear over several teeth in one step
RISE = 0.1
# number of communication steps between sums of forces, because evaluating forces costs some tools a step
FORCES_EVERY = 10


@dataclass(frozen=True)
class Case:
    name: str
    carrier: float
    spin: float | None
    """Imposed spin of the planets; None if they are free."""
    settled: float
    """Time from which a run is measured."""

    @property
    def sides(self):
        """Speeds of left and right from the gear law."""
        difference = (self.spin or 0.0) * gears.PLANET_TEETH / gears.SIDE_TEETH
        return np.array([self.carrier + difference, self.carrier - difference])


CASES = {
    # late enough for most oscillations of the start to decay
    "straight": Case("straight", np.radians(2861.0), None, 0.3),
    # two complete tooth cycles, 2 · 0.18 s
    "turn": Case("turn", np.radians(954.0), np.radians(200.0), 0.14),
}


def load(time, at_once=False):
    """Load of the peers: a cubic rise, then constant, or constant from the start."""
    s = 1.0 if at_once else np.clip(time / RISE, 0.0, 1.0)
    return LOAD * s * s * (3.0 - 2.0 * s)


def counts(step):
    """Number of communication steps of a run, and of steps within one."""
    within = round(STEP / step)
    if within < 1 or abs(within * step / STEP - 1.0) > 1e-9:
        raise SystemExit(f"a step of {step} s does not divide the communication step of {STEP} s; choose STEP / n")
    return round(LENGTH / STEP), within


def measures(case, time, speeds, angles, forces, cpu):
    """Compared values.

    time: ends of the completed steps; speeds: of left and right at these times; angles: of left, right, carrier and first
    planet at the end; forces: sums of the normal forces on left and right by communication step, NaN if not evaluated;
    cpu: CPU time of all steps.
    """
    deviation = 100.0 * (speeds[time > case.settled + 1e-9] / case.sides - 1.0)
    left, right, carrier, planet = angles
    rolled = planet * gears.PLANET_TEETH / gears.SIDE_TEETH
    return {
        "cost": cpu / LENGTH,
        "speed_error": np.mean(deviation, axis=0).tolist(),
        "ripple": np.ptp(deviation, axis=0).tolist(),
        "ripple_rms": np.std(deviation, axis=0).tolist(),
        "slip": np.degrees([left - carrier - rolled, right - carrier + rolled]).tolist(),
        "planet": float(np.degrees(planet)),
        "force": np.nanmean(forces[round(case.settled / STEP):], axis=0).tolist(),
    }


def settings():
    """Settings from run.py: a JSON object as the only argument."""
    if len(sys.argv) != 2:
        raise SystemExit("this is started by run.py with its settings as JSON; use: python3 crates/lab/lab.py compare-simulators")
    return json.loads(sys.argv[1])


def report(result):
    """Returns the result to run.py."""
    print(json.dumps(result))
