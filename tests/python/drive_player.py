"""Plays ordinary drives on the FMU, by FMI 2.0 or 3.0, like a simple host: inputs are sampled, and held through each step."""

from ctypes import c_double, c_uint
from dataclasses import dataclass

import numpy as np
import ordinary_drives
from bevel_differential import DifferentialError
from bevel_differential.batches import Batches
from fmi3 import Unit3
from fmpy.fmi1 import FMICallException

SIDES = ("left", "right")
BODIES = ("carrier.speed", *(f"{side}.{what}" for side in SIDES for what in ("speed", "wheel_speed")),
          *(f"planet[{i}].spin_speed" for i in range(1, 5)), "pinion.speed", "propeller.speed")
# outputs that are read at every communication point
READ = (*BODIES, *(f"{side}.{what}" for side in SIDES for what in ("wheel_angle", "twist", "shaft_torque")), "held.wheels",
        "mesh.frequency", "power.in", "power.out", "solver.steps", "solver.rejected", "solver.energy_residual")
# maximum number of communication points at which all outputs are read
LOOKS = 100
# Attempts at steps after which a drive is aborted: a constant number plus one per simulated second. Both are far above the limits, but
# leave room for gears that rattle: at 14 kHz, 20 steps per period.
GIVEN_UP, GIVEN_UP_PER_SECOND = 500_000, 300_000


@dataclass
class Played:
    """Record of a drive until it finished or failed.

    `time`: communication points that were reached [s]; `values`: values at these points by the names that were read; `failure`: the
    message of the failed call, None if the drive finished; `not_finite`: outputs that were not finite numbers; `heat`: sum of all heat
    at the end [J]."""

    time: np.ndarray
    values: dict
    failure: str | None
    not_finite: list
    heat: float


class Two:
    """Instance of FMI 2.0."""

    def __init__(self, fmu, drive):
        self.instance, self.names = fmu.open(), list(drive["inputs"])
        self.inputs = Batches(fmu.named(self.names))

    def start(self, values):
        self.instance.initialise(values)

    def read(self, names):
        return self.instance.read(names)

    def set(self, values, slopes):
        self.inputs.set(self.instance, values)
        if slopes is not None:
            self.instance.set_slopes(dict(zip(self.names, slopes)))

    def step(self, time, size):
        self.instance.do_step(time, size)

    def messages(self):
        return self.instance.messages

    def close(self):
        self.instance.close()


class Three:
    """Instance of FMI 3.0, with or without event mode."""

    def __init__(self, fmu, drive, **options):
        self.fmu, self.inputs, self.events = fmu, list(drive["inputs"]), drive["event_mode"]
        file = fmu.file.with_name("BevelDifferential3.fmu")
        self.unit = Unit3(file, eventModeUsed=self.events, earlyReturnAllowed=self.events, **options)
        self.buffers = {}

    def start(self, values):
        self.unit.begin({variable.name: number for variable, number in self.fmu.numbers(values)})

    def _buffer(self, names):
        """References and buffer of some variables, cached because they are used at every communication point."""
        if names not in self.buffers:
            references = (c_uint * len(names))(*(self.unit.variables[name].valueReference for name in names))
            self.buffers[names] = references, (c_double * len(names))()
        return self.buffers[names]

    def read(self, names):
        references, values = self._buffer(tuple(names))
        self.unit.raw.fmi3GetFloat64(self.unit.raw.component, references, len(values), values, len(values))
        return list(values)

    def set(self, numbers, _slopes):
        references, values = self._buffer(tuple(self.inputs))
        values[:] = numbers
        self.unit.raw.fmi3SetFloat64(self.unit.raw.component, references, len(values), values, len(values))

    def step(self, time, size):
        end = time + size
        while True:
            event, _, early, reached = self.unit.step(time, end - time)
            if event:
                self.unit.handle_event()
            if not early:
                return
            time = reached

    def messages(self):
        return [message for status, message in self.unit.messages if status > 0]

    def close(self):
        self.unit.raw.freeInstance()


def play(fmu, drive, names=READ, host=None):
    """Plays a drive to its end, or until it fails, on the given host or on the host of the drive's FMI version.

    With `READ` all outputs are also read at some points, and each of them must be a finite number."""
    times, sampled = ordinary_drives.times(drive), ordinary_drives.sampled(drive)
    rows = np.column_stack(list(sampled.values()))
    changed = np.append(True, np.any(np.diff(rows, axis=0) != 0.0, axis=1))
    slopes = np.diff(rows, axis=0) / drive["step"] if drive["slopes"] else None
    outputs = [v.name for v in fmu.variables.values() if v.causality == "output" and v.kind == "Real"]
    every = max(len(times) // LOOKS, 1)
    limit = GIVEN_UP + GIVEN_UP_PER_SECOND * drive["stop"]
    host = host or (Two if drive["fmi"] == "2.0" else Three)(fmu, drive)
    failure, record, strange, heat = None, [], {}, 0.0
    try:
        host.start(drive["start"] | {name: float(values[0]) for name, values in sampled.items()})
        for k, time in enumerate(times.tolist()):
            record.append(host.read(names))
            if names is READ:
                attempts = sum(record[-1][READ.index(name)] for name in ("solver.steps", "solver.rejected"))
                if attempts > limit:
                    raise DifferentialError(f"given up at {time:g} s after {attempts:.0f} attempts at steps")
                if k % every == 0 or k + 1 == len(times):
                    strange |= {name: None for name, value in zip(outputs, host.read(outputs)) if not np.isfinite(value)}
            if k + 1 < len(times):
                if slopes is not None or changed[k]:
                    host.set(rows[k].tolist(), None if slopes is None else slopes[k].tolist())
                host.step(time, times[k + 1] - time)
        heat = sum(host.read([name for name in outputs if name.startswith("heat.")]))
    except (DifferentialError, FMICallException) as error:
        said = host.messages()
        failure = said[-1] if said and isinstance(error, FMICallException) else str(error)
    finally:
        host.close()
    values = dict(zip(names, np.array(record, dtype=float).reshape(len(record), len(names)).T))
    return Played(times[: len(record)], values, failure, list(strange), heat)


def mesh_forces(fmu, drive):
    """Normal force of each mesh at each solver step, a column for each mesh. Identical planets share a column.

    The drive is repeated with FMI 3.0, whose intermediate updates do not change the bits of the motion. Inputs are held, because
    FMI 3.0 has no derivatives of inputs."""
    planets = drive["start"].get("geometry.planet_count", 2)
    names = [f"planet[{i}].{side}_normal_force" for i in range(1, planets + 1) for side in SIDES]
    rows = []
    host = Three(fmu, drive | {"event_mode": False}, intermediateUpdate=lambda *_: rows.append(host.read(names)))
    play(fmu, drive | {"slopes": False}, (), host)
    return np.unique(np.array(rows).reshape(len(rows), len(names)), axis=1)
