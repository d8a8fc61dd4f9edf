"""Launch with ice under the left wheel and a dry road under the right: open differential, limited slip, and a controlled lock.

    python launch.py [PICTURE]

The open differential gives the dry wheel no more torque than the ice transmits. Clutch packs add their preload. A lock that closes
at a speed difference of 5 rad/s gives the dry wheel all the torque.
"""

import sys

from bevel_differential import Fmu
from bevel_differential.vehicle import Car, Motor, Tyre

HALF_SHAFTS = {"effects.half_shaft": True, "half_shaft.left_stiffness": "9000 N.m/rad", "half_shaft.right_stiffness": "12000 N.m/rad"}
# torque of the motor over time: s, N.m
PEDAL = ([0.0, 0.3], [0.0, 120.0])
OUTPUTS = ["left.wheel_speed", "right.wheel_speed", "left.shaft_torque", "right.shaft_torque", "body.speed"]


def close_the_lock(_time, values):
    """Locks while one wheel is faster than the other by more than 5 rad/s."""
    return {"lock.command": 1.0} if abs(values["left.wheel_speed"] - values["right.wheel_speed"]) > 5.0 else None


CASES = {
    "open": ({}, None),
    "limited slip": ({"effects.limited_slip": True, "limited_slip.preload": "150 N.m",
                      "limited_slip.torque_coefficient": 0.1}, None),
    "lock": ({"lock.torque": "2000 N.m"}, close_the_lock),
}


def main():
    print(f"{'differential':<14}{'speed after 1 s, m/s':>22}{'right shaft, N.m':>18}")
    for name, (parameters, controller) in CASES.items():
        car = Car(HALF_SHAFTS | parameters, motor=Motor(), left=Tyre(friction=0.15), right=Tyre(friction=0.9),
                  fmu=Fmu.of().displaying(["rpm"]))
        record = car.run(OUTPUTS, stop=1.0, request=PEDAL, controller=controller)
        late = record["time"] > 0.8
        print(f"{name:<14}{record['body.speed'][-1]:>22.2f}{record['right.shaft_torque'][late].mean():>18.0f}")
        if name == "open" and len(sys.argv) > 1:
            car.plot(record, sys.argv[1], "Launch on split friction, open differential",
                     "The left wheel spins up on the ice. Both shafts transmit the same torque, which the ice and the inertia of this "
                     "wheel resist.")


if __name__ == "__main__":
    main()
