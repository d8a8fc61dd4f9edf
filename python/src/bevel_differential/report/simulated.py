"""Run of the scene of a report."""

import time
from dataclasses import dataclass
from typing import Self

import numpy as np

from ..answers import effect_classes
from ..panel import Axis, time_axis
from ..points import at_times
from ..scene import Scene
from ..values import DifferentialError, Number
from ..want import mean_over_time
from ..warned import warn

# the fastest of several runs counts: maximum number of runs, and the total time after which no further run starts, s
TIMED, SHORT = 3, 0.5
# main speeds and torques, drawn in every report
SPEEDS = ("carrier.speed", "left.speed", "right.speed", "planet[1].spin_speed")
TORQUES = ("carrier.torque", "left.shaft_torque", "right.shaft_torque")
# lines between points are accurate if at most a fraction MISSED of the points in between deviates by more than the fraction LEFT of
# the curve's range; until then steps are halved, up to MOST_POINTS points
LEFT, MISSED, MOST_POINTS = 0.01, 0.02, 6000


@dataclass(frozen=True)
class Simulated:
    """Scene and its record.

    `record`: all inputs, outputs and calculated parameters at the communication points, SI. `seconds`: time of a run of the scene as
    it is written. `plan_text`: the FMU's description of the simulated model. `added`: effects that only add outputs, switched on for the
    record. `refused`: the FMU's reason to refuse such an effect, by effect. `difference`: largest difference between the scene's own
    outputs with and without the added effects, relative to their largest values. `drawn`: the scene's outputs, speeds and torques at
    times so close that lines between them show the oscillations of the shafts."""

    scene: Scene
    record: np.ndarray
    seconds: float
    plan_text: str
    warnings: list[str]
    added: tuple[str, ...]
    refused: dict[str, str]
    difference: float
    drawn: np.ndarray

    @classmethod
    def of(cls, scene: Scene) -> Self:
        """Simulates a scene as it is written, then with all effects that only add outputs."""
        if not scene.stop:
            raise DifferentialError(f"scene {scene.name} has no duration, and a report shows what happens over time: give it a stop_time "
                                    "above 0 s")
        seconds: list[float] = []
        while not seconds or (len(seconds) < TIMED and sum(seconds) < SHORT):
            begin = time.perf_counter()
            as_written = scene.run()
            seconds.append(time.perf_counter() - begin)
        refused: dict[str, str] = {}
        added: dict[str, Number] = {}
        for effect in effect_classes()["outputs"]:
            if not scene.values.get(effect):
                try:
                    scene._record(values={**added, effect: True}, stop=scene.step)
                    added[effect] = True
                except DifferentialError as reason:
                    refused[effect] = reason_of(reason)
        names = [name for name, variable in scene.fmu.variables.items()
                 if variable.causality in ("input", "output", "calculatedParameter")]
        record = scene._record(names, added)
        warn(scene.warnings)
        return cls(scene, record, min(seconds), scene.plan_text(), scene.warnings, tuple(added), refused,
                   _difference(as_written, record), _drawn(scene))

    def value(self, name: str) -> Number:
        """Value of a parameter, or of an input at the start, SI."""
        return self.scene.value(name)

    def literal(self, name: str) -> str:
        """Name of the choice that a parameter is set to."""
        return str(self.scene.fmu.variable(name).written(self.value(name)))

    def series(self, name: str) -> np.ndarray:
        """Output over time, SI, as floats."""
        return self.record[name].astype(float)

    def shown(self, name: str) -> np.ndarray:
        """Output over time in its display unit."""
        return self.scene.fmu.variable(name).shown(self.series(name))[1]

    def unit(self, name: str) -> str:
        """Display unit of a variable."""
        return self.scene.fmu.variable(name).shown(0.0)[0]

    def constant(self, name: str) -> float:
        """Value of a calculated parameter, SI."""
        return float(self.record[name][-1])

    @property
    def time(self) -> np.ndarray:
        """Times of the rows, s: communication points, and jumps of inputs twice."""
        return self.record["time"]

    @property
    def time_axis(self) -> Axis:
        """Axis of times of the run."""
        return time_axis(float(self.time[-1] - self.time[0]))

    def mean(self, name: str) -> float:
        """Mean of an output over time, SI."""
        return mean_over_time(self.series(name), self.time)

    @property
    def has_teeth(self) -> bool:
        """True if forces come from meshes."""
        return self.literal("scene.gear_contact") != "ideal"

    @property
    def has_pairs(self) -> bool:
        """True if forces are calculated for each tooth pair."""
        return self.literal("scene.gear_contact") in ("tooth", "solid")


def reason_of(error: DifferentialError) -> str:
    """Reason of the FMU in a refusal, in one line."""
    lines = str(error).splitlines()
    return "; ".join(lines[1:] if len(lines) > 1 and lines[0].endswith(":") else lines)


def _drawn(scene):
    names = list(dict.fromkeys([*scene.outputs, *SPEEDS, *TORQUES]))
    step, record = scene.step, scene._record(names)
    while True:
        step /= 2.0
        if scene.stop / step > MOST_POINTS:
            return record
        closer = scene._record(names, step=step)
        if _is_straight(record, closer, names):
            return record
        record = closer


def _is_straight(record, closer, names):
    for name in names:
        values = closer[name].astype(float)
        off = np.abs(at_times(closer["time"], record["time"], record[name].astype(float)) - values)
        if np.mean(off > LEFT * np.ptp(values)) > MISSED:
            return False
    return True


def _difference(as_written, record):
    pairs = [(as_written[name].astype(float), record[name].astype(float)) for name in as_written.dtype.names]
    return max(float(np.max(np.abs(old - new)) / (np.max(np.abs(old)) or 1.0)) for old, new in pairs)
