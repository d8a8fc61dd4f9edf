"""The run that a report is about."""

import time
from dataclasses import dataclass
from typing import Self

import numpy as np

from ..scene import Scene
from ..values import DifferentialError, Number

# effects that add outputs and change no motion; a test checks that the command `accuracy` has the same list
ONLY_GIVE_OUTPUTS = ("effects.strength", "effects.mesh_history")
# the fastest of several runs counts: most runs, and the time after which no further run begins, s
TIMED, SHORT = 3, 0.5
# main speeds and torques, drawn in every report
SPEEDS = ("carrier.speed", "left.speed", "right.speed", "planet[1].spin_speed")
TORQUES = ("carrier.torque", "left.shaft_torque", "right.shaft_torque")
# a curve is straight between its points if no more than MISSED of the points between leave it by more than LEFT of its range;
# steps are halved until then, to MOST_POINTS points at most
LEFT, MISSED, MOST_POINTS = 0.01, 0.02, 6000


@dataclass(frozen=True)
class Simulated:
    """A scene and its record.

    `record`: all inputs, outputs and calculated parameters at the communication points, SI. `seconds`: time of a run of the scene
    as it is written. `says`: the FMU's own description of the simulated model. `added`: effects that only add outputs, switched
    on for the record. `refused`: by such an effect, the FMU's reason to refuse it. `difference`: largest difference between the
    scene's own outputs with and without the added effects, relative to their largest values. `drawn`: the scene's outputs, speeds and
    torques at times so close that lines between them show how shafts ring."""

    scene: Scene
    record: np.ndarray
    seconds: float
    says: str
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
        for effect in ONLY_GIVE_OUTPUTS:
            if not scene.values.get(effect):
                try:
                    scene._record(values={**added, effect: True}, stop=scene.step)
                    added[effect] = True
                except DifferentialError as reason:
                    refused[effect] = reason_of(reason)
        names = [name for name, variable in scene.fmu.variables.items()
                 if variable.causality in ("input", "output", "calculatedParameter")]
        record = scene.run(names, added)
        return cls(scene, record, min(seconds), scene.says(), scene.warnings, tuple(added), refused,
                   _difference(as_written, record), _drawn(scene))

    def value(self, name: str) -> Number:
        """A parameter or the start of an input, SI."""
        return self.scene.value(name)

    def literal(self, name: str) -> str:
        """The name of the choice that a parameter is set to."""
        return str(self.scene.fmu.variable(name).written(self.value(name)))

    def series(self, name: str) -> np.ndarray:
        """An output over time, SI, as floats."""
        return self.record[name].astype(float)

    def shown(self, name: str) -> np.ndarray:
        """An output over time in the unit that it is usually shown in."""
        return self.scene.fmu.variable(name).shown(self.series(name))[1]

    def unit(self, name: str) -> str:
        """The unit that a variable is usually shown in."""
        return self.scene.fmu.variable(name).shown(0.0)[0]

    def constant(self, name: str) -> float:
        """A calculated parameter, SI."""
        return float(self.record[name][-1])

    @property
    def time(self) -> np.ndarray:
        """Communication points, s."""
        return self.record["time"]

    @property
    def has_teeth(self) -> bool:
        """Whether forces come from meshes."""
        return self.literal("scene.gear_contact") != "ideal"

    @property
    def has_pairs(self) -> bool:
        """Whether teeth touch pair by pair."""
        return self.literal("scene.gear_contact") in ("tooth", "solid")


def reason_of(error: DifferentialError) -> str:
    """The FMU's own reason in a refusal, in one line."""
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
        off = np.abs(np.interp(closer["time"], record["time"], record[name].astype(float)) - values)
        if np.mean(off > LEFT * np.ptp(values)) > MISSED:
            return False
    return True


def _difference(as_written, record):
    pairs = [(as_written[name].astype(float), record[name].astype(float)) for name in as_written.dtype.names]
    return max(float(np.max(np.abs(old - new)) / (np.max(np.abs(old)) or 1.0)) for old, new in pairs)
