"""A case of the study in this program: the packaged FMU, whose C functions are called from Python.

There are two passes. The first one measures the cost of communication steps of 1 ms and of reading both speeds, with the C
functions called through ctypes and nothing else. The second one reads speeds every 0.1 ms, so that no peak of the ripple is
missed between samples, and the forces. Loads act in full from the start, as in the study. The start is otherwise that of
the peers: speeds from the gear law, and teeth in the middle of the tooth spaces.
"""

import ctypes
import statistics
import time as clock

import numpy as np
from bevel_differential import Fmu
from bevel_differential.batches import Batches

import cases

FINE = 1e-4
# number of timed runs, because one takes only milliseconds; the median is used
TIMED_RUNS = 21
SPEEDS, FORCES = ["left.speed", "right.speed"], ["left.normal_force", "right.normal_force"]
ANGLES = ["left.angle", "right.angle", "carrier.angle", "planet[1].spin_angle"]


class Program:
    """The FMU with the settings of the case."""

    def __init__(self, wanted):
        self.wanted, self.case = wanted, cases.CASES[wanted["case"]]
        self.fmu = Fmu.of(wanted["fmu"])

    def start(self):
        """Creates an instance at time 0 of the case."""
        values = {"scene.gear_contact": self.wanted["contact"], "scene.start": "rolling",
                  "carrier.speed_command": self.case.carrier, "solver.relative_tolerance": self.wanted["tolerance"],
                  "left.load_torque": cases.LOAD, "right.load_torque": cases.LOAD}
        if self.wanted["contact"] == "tooth":
            values["contact.law"] = self.wanted["law"]
        if self.case.spin is not None:
            values |= {"scene.planet_spin": "imposed", "spin.command": self.case.spin}
        return self.fmu.open().initialise(values)

    def timed(self, working):
        """CPU time of a run [s], or of equal calls without work if not `working`."""
        opened = self.start()
        count, read = round(cases.LENGTH / cases.STEP), Batches([self.fmu.variable(name) for name in SPEEDS])
        record = read.record(count)
        (get, component, references, length, first, width), = read.readers(opened, record)
        times, rows = [k * cases.STEP for k in range(count)], [first + k * width for k in range(count)]
        step, interval, status = opened.raw.dll["fmi2DoStep"], cases.STEP, 0
        step.argtypes = [ctypes.c_void_p, ctypes.c_double, ctypes.c_double, ctypes.c_int]
        if not working:
            # no values are requested, and a read replaces the step
            length, interval = 0, 0
            step = opened.raw.dll["fmi2GetInteger"]
            step.argtypes = [ctypes.c_void_p, ctypes.c_void_p, ctypes.c_size_t, ctypes.c_void_p]
            times = rows
        begin = clock.process_time()
        for time, row in zip(times, rows):
            status |= step(component, time, interval, 1)
            status |= get(component, references, length, row)
        spent = clock.process_time() - begin
        opened.close()
        if status:
            raise RuntimeError(f"the FMU refuses a step of {self.wanted}")
        return spent

    def recorded(self):
        """Times, speeds, last angles and forces of a run in fine steps."""
        opened, count = self.start(), round(cases.LENGTH / FINE)
        within = round(cases.STEP / FINE)
        speeds, forces = np.zeros((count, 2)), np.full((count // within, 2), np.nan)
        for k in range(count):
            opened.do_step(k * FINE, FINE)
            speeds[k] = opened.read(SPEEDS)
            if k % (within * cases.FORCES_EVERY) == 0:
                forces[k // within] = opened.read(FORCES)
        angles = opened.read(ANGLES)
        opened.close()
        return FINE * np.arange(1, count + 1), speeds, angles, forces


def run(wanted):
    program = Program(wanted)
    spent = statistics.median(program.timed(True) for _ in range(TIMED_RUNS))
    idle = statistics.median(program.timed(False) for _ in range(TIMED_RUNS))
    time, speeds, angles, forces = program.recorded()
    found = cases.measures(program.case, time, speeds, angles, forces, spent)
    return found | {"calls": idle / cases.LENGTH}


if __name__ == "__main__":
    cases.report(run(cases.settings()))
