"""Launch with ice under the left wheel and a dry road under the right: open differential, limited slip, a clutch on command, and a lock.

    python launch.py [PICTURE]

The open differential gives the dry wheel no more torque than the ice transmits. Clutch packs add their preload. An electronic
limited slip presses its clutch the more, the faster the left wheel is than the right one. A lock that closes at a speed difference of
5 rad/s gives the dry wheel all the torque.
"""

import sys
from math import pi

from bevel_differential.panel import Axis, Panel, layered, picture, time_axis
from bevel_differential.vehicle import Car, Motor, Tyre

HALF_SHAFTS = {"effects.half_shaft": True, "half_shaft.left_stiffness": "9000 N.m/rad", "half_shaft.right_stiffness": "12000 N.m/rad"}
# torque of the motor over time: s, N.m
PEDAL, STOP = ([0.0, 0.3], [0.0, 120.0]), 1.0
OUTPUTS = ["left.wheel_speed", "right.wheel_speed", "left.shaft_torque", "right.shaft_torque", "body.speed"]


# torque of the clutch, N.m, and difference of the wheel speeds at which its command is full, rad/s
TORQUE, FULL = 800.0, 20.0


def press_the_clutch(_time, values):
    """Presses the clutch between left side gear and carrier in proportion to the difference of the wheel speeds."""
    return {"left.clutch_command": min(abs(values["left.wheel_speed"] - values["right.wheel_speed"]) / FULL, 1.0)}


def close_the_lock(_time, values):
    """Locks while one wheel is faster than the other by more than 5 rad/s."""
    return {"lock.command": 1.0} if abs(values["left.wheel_speed"] - values["right.wheel_speed"]) > 5.0 else None


CASES = {
    "open": ({}, None),
    "limited slip": ({"effects.limited_slip": True, "limited_slip.preload": "150 N.m",
                      "limited_slip.torque_coefficient": 0.1}, None),
    "electronic": ({"effects.clutches": True, "clutches.torque": TORQUE}, press_the_clutch),
    "lock": ({"lock.torque": "2000 N.m"}, close_the_lock),
}


def launched(name, fmu=None):
    """Record of a case."""
    parameters, controller = CASES[name]
    car = Car(HALF_SHAFTS | parameters, motor=Motor(), left=Tyre(friction=0.15), right=Tyre(friction=0.9), fmu=fmu)
    return car.run(OUTPUTS, stop=STOP, request=PEDAL, controller=controller)


def draw(records, file):
    """Draws all cases in each panel."""
    time, rpm = time_axis(STOP), 30.0 / pi

    def panel(label, output, factor=1.0, legend=""):
        curves = {name: (record["time"], factor * record[output]) for name, record in records.items()}
        return [Panel(time, Axis(label), layered(curves, "Real", 1.2), legend=legend, xlim=(0.0, STOP))]

    picture([panel("left wheel, rpm", "left.wheel_speed", rpm, "upper left"), panel("left shaft, N·m", "left.shaft_torque"),
             panel("right shaft, N·m", "right.shaft_torque"), panel("car, m/s", "body.speed")],
            "With the open differential, both shafts transmit the torque that the ice and the inertia of the left wheel resist. "
            "Limited slip moves a nearly constant torque to the right shaft. The electronic clutch moves more while the left "
            "wheel spins, until this wheel hardly gains on the right one. The lock closes with a blow.",
            file, 9.0, title="Launch with ice under the left wheel")


def main():
    print(f"{'differential':<14}{'speed after 1 s, m/s':>22}{'right shaft, N.m':>18}")
    records = {name: launched(name) for name in CASES}
    for name, record in records.items():
        late = record["time"] > 0.8
        print(f"{name:<14}{record['body.speed'][-1]:>22.2f}{record['right.shaft_torque'][late].mean():>18.0f}")
    if len(sys.argv) > 1:
        draw(records, sys.argv[1])


if __name__ == "__main__":
    main()
