"""Torque vectoring by braking: a car turns in at 15 m/s, a controller brakes the inner wheel and raises the motor torque.

    python torque_vectoring.py [PICTURE]

The differential halves the motor's torque. A brake on the inner wheel takes the share of that side, so that only the outer wheel
drives. This yaw moment turns the car into the bend.
"""

import sys

from bevel_differential.vehicle import Body, Car

SPEED, STEER = 15.0, 0.06
# the driver turns the wheel within 0.3 s
TURN_IN = ([0.2, 0.5], [0.0, STEER])
OUTPUTS = ["body.speed", "body.yaw_rate", "body.steer", "left_tyre.force", "right_tyre.force", "left.brake_torque", "motor.torque"]
# yaw moment per missing yaw rate, N.m.s/rad, and maximum torque of a brake, N.m
GAIN, MOST_BRAKE = 40e3, 800.0


class Controller:
    """Controls the yaw rate to that of a car without slip, and the speed to a constant."""

    def __init__(self, car, vectoring):
        self.car, self.vectoring = car, vectoring

    def __call__(self, _time, values):
        body, motor, tyre = self.car.body, self.car.motor, self.car.tyres[0]
        wanted = values["body.speed"] * values["body.steer"] / (body.front + body.rear)
        missing = wanted - values["body.yaw_rate"] if self.vectoring else 0.0
        # yaw moment: one wheel's force times half the track; brake torque: this force times the radius
        brake = min(max(GAIN * missing * tyre.radius / (0.5 * body.track), -MOST_BRAKE), MOST_BRAKE)
        hold = 3000.0 * (SPEED - values["body.speed"]) * tyre.radius
        return {"left.brake_torque": max(brake, 0.0), "right.brake_torque": max(-brake, 0.0),
                "motor.request": (hold + abs(brake)) / motor.ratio}


def main():
    print(f"{'brakes':<12}{'yaw rate, rad/s':>17}{'without slip':>14}{'right - left tyre, N':>22}")
    for vectoring in (False, True):
        # a car that understeers: the front axle is softer
        car = Car({"effects.wheel_brake": True}, body=Body(front_stiffness=70e3))
        record = car.run(OUTPUTS, stop=2.5, step="1 ms", steer=TURN_IN, speed=SPEED, controller=Controller(car, vectoring))
        late = record[record["time"] > 2.0]
        without_slip = (late["body.speed"] * late["body.steer"]).mean() / (car.body.front + car.body.rear)
        difference = (late["right_tyre.force"] - late["left_tyre.force"]).mean()
        print(f"{'on' if vectoring else 'off':<12}{late['body.yaw_rate'].mean():>17.4f}{without_slip:>14.4f}{difference:>22.0f}")
        if vectoring and len(sys.argv) > 1:
            car.plot(record, sys.argv[1], "Torque vectoring by the brake of the inner wheel",
                     "The motor's torque rises with the brake's: the outer wheel keeps what the inner one loses.")


if __name__ == "__main__":
    main()
