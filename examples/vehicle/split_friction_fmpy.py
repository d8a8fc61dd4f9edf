"""Electronic limited slip on split friction with plain FMPy: it needs no other package.

    python split_friction_fmpy.py BevelDifferential.fmu

A motor pulls at the carrier. The left wheel is on ice, and the right wheel has grip, so the inertia at its half-shaft includes the car.
In each step, this host reads both wheel speeds. It sets the torque of the ice, and presses the left clutch in proportion to the
difference of the speeds.
"""

import shutil
import sys
from math import tanh

from fmpy import extract, read_model_description
from fmpy.fmi2 import FMU2Slave

STEP, STOP = 1e-3, 1.0
# torque on the carrier, N.m, and time in which it rises, s
DRIVE, RISE = 1000.0, 0.3
# torque of the ice on a sliding wheel, N.m, and slip at which three quarters of it act, rad/s
ICE, SLIDING = 145.0, 1.0
# torque of the clutch, N.m, and difference of the wheel speeds at which its command is full, rad/s
TORQUE, FULL = 800.0, 20.0
START = {
    "scene.carrier_drive": "torque", "scene.start": "rest", "carrier.torque_command": 0.0, "left.load_torque": 0.0,
    "right.load_torque": 0.0, "effects.half_shaft": True, "half_shaft.left_damping": 30.0, "half_shaft.right_damping": 30.0,
    # a wheel, and a wheel with a car of 1455 kg on its radius of 0.334 m, kg.m2
    "inertia.left_end": 1.0, "inertia.right_end": 1.0 + 1455.0 * 0.334**2,
    "effects.clutches": True, "clutches.torque": TORQUE,
}
INPUTS = ["carrier.torque_command", "left.load_torque", "right.load_torque", "left.clutch_command"]
WHEELS = ["left.wheel_speed", "right.wheel_speed"]
OUTPUTS = [*WHEELS, "left.shaft_torque", "right.shaft_torque", "left.clutch_torque"]


def set_start(slave, variable, value):
    """Sets a start value by its type. Enumerations are integers, and `value` is the name of an item."""
    reference = [variable.valueReference]
    if variable.type == "Enumeration":
        slave.setInteger(reference, [next(int(item.value) for item in variable.declaredType.items if item.name == value)])
    elif variable.type == "Boolean":
        slave.setBoolean(reference, [value])
    else:
        slave.setReal(reference, [value])


def simulate(file, full):
    """Values of OUTPUTS after `STOP`; `full`: difference of wheel speeds at full command, rad/s."""
    model = read_model_description(file)
    variables = {variable.name: variable for variable in model.modelVariables}
    inputs, wheels, outputs = ([variables[name].valueReference for name in names] for names in (INPUTS, WHEELS, OUTPUTS))
    folder = extract(file)
    slave = FMU2Slave(guid=model.guid, unzipDirectory=folder, modelIdentifier=model.coSimulation.modelIdentifier)
    slave.instantiate()
    for name, value in START.items():
        set_start(slave, variables[name], value)
    slave.setupExperiment(startTime=0.0, stopTime=STOP)
    slave.enterInitializationMode()
    slave.exitInitializationMode()
    for k in range(round(STOP / STEP)):
        left, right = slave.getReal(wheels)
        ice = ICE * tanh((left - right) / SLIDING)
        command = min(abs(left - right) / full, 1.0)
        # the ice resists its wheel and pushes the car
        slave.setReal(inputs, [DRIVE * min(k * STEP / RISE, 1.0), ice, -ice, command])
        slave.doStep(k * STEP, STEP)
    found = dict(zip(OUTPUTS, slave.getReal(outputs)))
    slave.terminate()
    slave.freeInstance()
    shutil.rmtree(folder)
    return found


def main(file):
    print(f"{'differential':<14}" + "".join(f"{name:>20}" for name in OUTPUTS))
    # without a command, the differential is open
    for name, full in (("open", float("inf")), ("electronic", FULL)):
        print(f"{name:<14}" + "".join(f"{value:>20.1f}" for value in simulate(file, full).values()))


if __name__ == "__main__":
    main(sys.argv[1])
