"""Torque vectoring: a car turns in at 15 m/s, and a controller of the yaw rate moves torque to the outer wheel by brakes or by clutches.

    python torque_vectoring.py [PICTURE]

Brakes: the brake of the inner wheel takes B, and the motor adds B to the torque of the carrier. Each wheel then drives with B/2 more
torque, but the inner wheel loses B. Clutches: a shaft that turns 12.5 % faster than the carrier gives C to the outer wheel. The
carrier then needs only 0.125 C more. With B = C, the yaw moment of both is the same.
"""

import sys

from bevel_differential.panel import Panel, layered, picture, time_axis
from bevel_differential.vehicle import Body, Car

SPEED, STEER, STOP = 15.0, 0.06, 2.5
# the driver turns the wheel within 0.3 s
TURN_IN = ([0.2, 0.5], [0.0, STEER])
OUTPUTS = ["body.speed", "body.yaw_rate", "body.steer", "left_tyre.force", "right_tyre.force", "left.shaft_torque", "right.shaft_torque",
           "motor.torque", "heat.brake", "heat.clutch_command"]
# yaw moment per missing yaw rate, N.m.s/rad; maximum torque of a brake or clutch, N.m; speed of the clutches' shafts over the carrier's
GAIN, MOST, FASTER = 40e3, 800.0, 1.125
# the differential has both; without a command, neither has an effect
GEARS = {"effects.wheel_brake": True, "effects.clutches": True, "clutches.torque": MOST, "clutches.left_ratio": FASTER,
         "clutches.right_ratio": FASTER}


def by_brakes(torque):
    """Brake torques that move `torque` (N.m) from the left to the right wheel, and torque that the carrier must add."""
    return {"left.brake_torque": max(torque, 0.0), "right.brake_torque": max(-torque, 0.0)}, abs(torque)


def by_clutches(torque):
    """Commands that move `torque` (N.m) from the left to the right wheel, and torque that the carrier must add."""
    return {"right.clutch_command": max(torque, 0.0) / MOST, "left.clutch_command": max(-torque, 0.0) / MOST}, (FASTER - 1.0) * abs(torque)


CASES = {"off": None, "brakes": by_brakes, "clutches": by_clutches}


class Controller:
    """Controls the yaw rate to that of a car without slip, and the speed to a constant."""

    def __init__(self, car, move):
        self.car, self.move = car, move

    def __call__(self, _time, values):
        body, motor, tyre = self.car.body, self.car.motor, self.car.tyres[0]
        drive, inputs = 3000.0 * (SPEED - values["body.speed"]) * tyre.radius, {}
        if self.move:
            missing = without_slip(self.car, values) - values["body.yaw_rate"]
            # a yaw moment is the difference of the wheels' forces times half the track
            inputs, more = self.move(min(max(GAIN * missing * tyre.radius / (0.5 * body.track), -MOST), MOST))
            drive += more
        return inputs | {"motor.request": drive / motor.ratio}


def without_slip(car, values):
    """Yaw rate of a car whose tyres do not slip, rad/s."""
    return values["body.speed"] * values["body.steer"] / (car.body.front + car.body.rear)


def turned(name, sign=1.0, fmu=None):
    """Car of a case, and its record of a turn to the left, or to the right with `sign` = -1."""
    # a car that understeers: the front axle is softer
    car = Car(GEARS, body=Body(front_stiffness=70e3), fmu=fmu)
    steer = (TURN_IN[0], [sign * angle for angle in TURN_IN[1]])
    return car, car.run(OUTPUTS, stop=STOP, step="1 ms", steer=steer, speed=SPEED, controller=Controller(car, CASES[name]))


def draw(records, file):
    """Draws all cases in each panel."""
    time = time_axis(STOP)

    def panel(label, value, legend=""):
        return [Panel(time, label, layered({name: (record["time"], value(record)) for name, record in records.items()}, "Real", 1.2),
                      legend=legend, xlim=(0.0, STOP))]

    picture([panel("yaw rate, rad/s", lambda record: record["body.yaw_rate"], "lower right"),
             panel("right − left\nshaft, N·m", lambda record: record["right.shaft_torque"] - record["left.shaft_torque"]),
             panel("right − left\ntyre, N", lambda record: record["right_tyre.force"] - record["left_tyre.force"]),
             panel("motor, N·m", lambda record: record["motor.torque"])],
            "Brakes and clutches move the same force to the outer wheel, so the curves of yaw rate and tyre forces coincide. Brakes leave "
            "the torques of the shafts equal, and the motor must replace all that the inner wheel loses. Clutches make the torques "
            "unequal, and the motor adds only an eighth of the difference.",
            file, 9.0, title="Torque vectoring in a turn to the left at 15 m/s")


def main():
    print(f"{'moved by':<10}{'yaw rate, rad/s':>17}{'without slip':>14}{'right - left tyre, N':>22}{'motor, N.m':>12}{'heat, kW':>10}")
    records = {}
    for name in CASES:
        car, record = turned(name)
        records[name], late = record, record[record["time"] > 2.0]
        mean = {output: late[output].mean() for output in OUTPUTS}
        heat = sum(late[output][-1] - late[output][0] for output in ("heat.brake", "heat.clutch_command")) / (STOP - late["time"][0])
        print(f"{name:<10}{mean['body.yaw_rate']:>17.4f}{without_slip(car, mean):>14.4f}"
              f"{mean['right_tyre.force'] - mean['left_tyre.force']:>22.0f}{mean['motor.torque']:>12.1f}{1e-3 * heat:>10.2f}")
    if len(sys.argv) > 1:
        draw(records, sys.argv[1])


if __name__ == "__main__":
    main()
