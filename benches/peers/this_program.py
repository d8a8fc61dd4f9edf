"""A case of the study in this program: the packaged FMU, its C functions called from Python.

Two passes. The first is what the cost is taken from: a communication step and reading both speeds, 1 ms after 1 ms, the
C functions called through ctypes and nothing around them. The second reads speeds every 0.1 ms, so that no peak of the
ripple is missed between samples, and the forces. Loads act in full from the start, as in the study; all else starts as
in the peers: speeds by the gear law, teeth in the middle of their gaps.
"""

import ctypes
import shutil
import statistics
import sys
import time as clock
from pathlib import Path

import numpy as np
from fmpy import extract, instantiate_fmu, read_model_description

import cases

sys.path.append(str(Path(__file__).resolve().parents[2] / "fmu-build" / "python"))
from instance import Instance  # noqa: E402

FINE = 1e-4
# a run takes milliseconds: so many of them, of which the median counts
TIMED_RUNS = 21
SPEEDS, FORCES = ["left.speed", "right.speed"], ["left.normal_force", "right.normal_force"]
ANGLES = ["left.angle", "right.angle", "carrier.angle", "planet[1].spin_angle"]


class Program:
    """The unpacked FMU."""

    def __init__(self, wanted):
        self.wanted, self.case = wanted, cases.CASES[wanted["case"]]
        self.description = read_model_description(wanted["fmu"])
        self.folder = extract(wanted["fmu"])

    def start(self):
        """An instance at time 0 of the case."""
        opened = Instance(instantiate_fmu(self.folder, self.description, logger=lambda *_: None), self.description)
        values = {"scene.gear_contact": self.wanted["contact"], "scene.start": "rolling",
                  "carrier.speed_command": self.case.carrier, "solver.relative_tolerance": self.wanted["tolerance"],
                  "left.load_torque": cases.LOAD, "right.load_torque": cases.LOAD}
        if self.wanted["contact"] == "tooth":
            values["contact.law"] = self.wanted["law"]
        if self.case.spin is not None:
            values |= {"scene.planet_spin": "imposed", "planet.spin_command": self.case.spin}
        for name, value in values.items():
            opened.set(name, value)
        opened.initialise()
        return opened

    def timed(self, working):
        """CPU time of a run [s]; not `working`: of the same calls that have nothing to do."""
        opened = self.start()
        fmu = opened.fmu
        step, get, component = fmu.dll.fmi2DoStep, fmu.dll.fmi2GetReal, fmu.component
        get.argtypes = [ctypes.c_void_p, ctypes.c_void_p, ctypes.c_size_t, ctypes.c_void_p]
        step.argtypes = [ctypes.c_void_p, ctypes.c_double, ctypes.c_double, ctypes.c_int]
        references = (ctypes.c_uint32 * 2)(*(opened.variables[name].valueReference for name in SPEEDS))
        count = round(cases.LENGTH / cases.STEP)
        speeds = np.zeros((count, 2))
        times = [k * cases.STEP for k in range(count)]
        rows = [speeds.ctypes.data + k * speeds.strides[0] for k in range(count)]
        length, interval, status = 2, cases.STEP, 0
        if not working:
            # no values are requested, and a read replaces the step
            length, interval = 0, 0
            step = fmu.dll.fmi2GetInteger
            step.argtypes = [ctypes.c_void_p, ctypes.c_void_p, ctypes.c_size_t, ctypes.c_void_p]
            times = rows
        begin = clock.process_time()
        for time, row in zip(times, rows):
            status |= step(component, time, interval, 1)
            status |= get(component, references, length, row)
        spent = clock.process_time() - begin
        fmu.freeInstance()
        if status:
            raise RuntimeError(f"the FMU refuses a step of {self.wanted}")
        return spent

    def recorded(self):
        """Times, speeds, last angles and forces of a run in fine steps, and the integrator's steps in coarse ones."""
        opened, count = self.start(), round(cases.LENGTH / FINE)
        within = round(cases.STEP / FINE)
        speeds, forces = np.zeros((count, 2)), np.full((count // within, 2), np.nan)
        for k in range(count):
            opened.fmu.doStep(k * FINE, FINE)
            speeds[k] = opened.read(SPEEDS)
            if k % (within * cases.FORCES_EVERY) == 0:
                forces[k // within] = opened.read(FORCES)
        angles = opened.read(ANGLES)
        opened.fmu.freeInstance()
        return FINE * np.arange(1, count + 1), speeds, angles, forces


def run(wanted):
    program = Program(wanted)
    try:
        spent = statistics.median(program.timed(True) for _ in range(TIMED_RUNS))
        idle = statistics.median(program.timed(False) for _ in range(TIMED_RUNS))
        time, speeds, angles, forces = program.recorded()
    finally:
        shutil.rmtree(program.folder, ignore_errors=True)
    found = cases.measures(program.case, time, speeds, angles, forces, spent)
    return found | {"calls": idle / cases.LENGTH}


if __name__ == "__main__":
    cases.report(run(cases.settings()))
