"""Motor, the tyres of any number of driven axles, and a body that moves straight ahead."""

from collections.abc import Sequence

from .equations import resistance, tyre_full_slide
from .parts import Body, Motor, Tyre
from .rolling import Rolling


class Straight(Rolling):
    """State: torque of the motor (N.m), speed of the car (m/s), deflections of the tyres (relaxation lengths).

    The car has no yaw rate, so all wheels have its speed, and a steering angle has no influence."""

    def __init__(self, motor: Motor, tyres: Sequence[Tyre], body: Body, speed: float = 0.0):
        self.motor, self.tyres, self.body = motor, tyres, body
        self.x = [0.0, speed, *(0.0 for _ in tyres)]
        self.deflections = range(2, len(self.x))
        self.patches = [(tyre_full_slide(tyre), tyre.relaxation) for tyre in tyres]

    def wheel_centres(self, x: Sequence[float]) -> list[float]:
        """Speeds of the centres of the wheels, m/s."""
        return [x[1]] * len(self.tyres)

    def creeps(self, x: Sequence[float], speeds: Sequence[float], steer: float = 0.0) -> list[float]:
        """Speeds of the tyres relative to the road, m/s."""
        return [tyre.radius * speed - x[1] for tyre, speed in zip(self.tyres, speeds[1:])]

    def rates(self, x: Sequence[float], speeds: Sequence[float], request: float, steer: float = 0.0) -> list[float]:
        """Rates of all states, at the torque `request` of the motor (N.m)."""
        centres = self.wheel_centres(x)
        forces = self.forces(self.slips(x), speeds, centres)
        return [self.torque_rate(x, speeds, request), (sum(forces) - resistance(self.body, x[1])) / self.body.mass,
                *self.deflecting(x, self.creeps(x, speeds), centres)]
