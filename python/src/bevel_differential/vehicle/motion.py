"""Equations of motion of motor, tyres and a body that moves in the plane."""

from collections.abc import Sequence

from .equations import GRAVITY, ROCKING_ACROSS, axle_force, full_slide, resistance, rocking_slip, tyre_full_slide
from .parts import Body, Motor, Tyre
from .rolling import Rolling

# states: torque of the motor (N.m), deflections of both tyres (relaxation lengths), speed ahead and lateral speed (m/s), yaw rate (rad/s),
# lateral deflections of both axles (relaxation lengths)
STATES = 8


class Motion(Rolling):
    """State of the parts, with forces and outputs.

    The yaw rate is positive in a turn to the left, in which the left wheel has the shorter path."""

    deflections = (1, 2, 6, 7)

    def __init__(self, motor: Motor, tyres: tuple[Tyre, Tyre], body: Body, speed: float):
        self.motor, self.tyres, self.body = motor, tyres, body
        self.x = [0.0] * STATES
        self.x[3] = speed
        weight = body.mass * GRAVITY / (body.front + body.rear)
        self._limits = [body.grip * weight * body.rear, body.grip * weight * body.front]
        # full slide and relaxation length (m) of the patches: left and right tyre along their planes, front and driven axle to the side
        self.patches = [*((tyre_full_slide(tyre), tyre.relaxation) for tyre in tyres),
                        *((full_slide(*axle), body.relaxation) for axle in zip(self._stiffness(), self._limits))]

    def _stiffness(self) -> tuple[float, float]:
        """Cornering stiffness of front and driven axle, N/rad."""
        return self.body.front_stiffness, self.body.rear_stiffness

    def creeps(self, x: Sequence[float], speeds: Sequence[float], steer: float) -> list[float]:
        """Speeds of the tyres at the patches relative to the road, m/s."""
        (left, right), (left_centre, right_centre) = self.tyres, self.wheel_centres(x)
        return [left.radius * speeds[1] - left_centre, right.radius * speeds[2] - right_centre,
                x[3] * steer - x[4] - self.body.front * x[5], self.body.rear * x[5] - x[4]]

    def wheel_centres(self, x: Sequence[float]) -> list[float]:
        """Speeds of the centres of left and right wheel, m/s."""
        half = 0.5 * self.body.track * x[5]
        return [x[3] - half, x[3] + half]

    def lateral_forces(self, slips: Sequence[float], creeps: Sequence[float], ahead: float) -> list[float]:
        """Lateral forces of front and driven axle, N, positive to the left. `ahead`: speed of the car, m/s."""
        damping = rocking_slip(ROCKING_ACROSS, self.body.relaxation, 1.0, ahead)
        return [axle_force(stiffness, limit, slip + damping * creep)
                for stiffness, limit, slip, creep in zip(self._stiffness(), self._limits, slips[2:], creeps[2:])]

    def rates(self, x: Sequence[float], speeds: Sequence[float], request: float, steer: float) -> list[float]:
        """Rates of all states, at the torque `request` of the motor (N.m) and the angle `steer` of the front wheels (rad)."""
        body = self.body
        ahead, aside, yaw = x[3:6]
        slips, creeps, centres = self.slips(x), self.creeps(x, speeds, steer), self.wheel_centres(x)
        left, right = self.forces(slips, speeds, centres)
        front_force, rear_force = self.lateral_forces(slips, creeps, ahead)
        deflecting = self.deflecting(x, creeps, (*centres, ahead, ahead))
        return [
            self.torque_rate(x, speeds, request),
            *deflecting[:2],
            (left + right - front_force * steer - resistance(body, ahead)) / body.mass + aside * yaw,
            (front_force + rear_force) / body.mass - ahead * yaw,
            (body.front * front_force - body.rear * rear_force + 0.5 * body.track * (right - left)) / body.yaw_inertia,
            *deflecting[2:],
        ]

    def outputs(self, speeds: Sequence[float], steer: float) -> dict[str, float]:
        """All outputs of the parts, by name."""
        (ahead, aside, yaw), slips = self.x[3:6], self.slips(self.x)
        left, right = self.forces(slips, speeds, self.wheel_centres(self.x))
        lateral = self.lateral_forces(slips, self.creeps(self.x, speeds, steer), ahead)
        return {"motor.torque": self.torque(speeds), "motor.speed": self.motor.ratio * speeds[0],
                "left_tyre.force": left, "right_tyre.force": right, "left_tyre.slip": slips[0], "right_tyre.slip": slips[1],
                "body.speed": ahead, "body.lateral_speed": aside, "body.yaw_rate": yaw,
                "body.lateral_acceleration": sum(lateral) / self.body.mass, "body.steer": steer}
