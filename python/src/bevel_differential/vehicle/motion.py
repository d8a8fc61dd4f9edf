"""Equations of motion of motor, tyres and body, and their integration over one communication step."""

from collections.abc import Callable, Sequence

from .equations import GRAVITY, axle_force, motor_torque, resistance, slip_rate, tyre_force
from .parts import Body, Motor, Tyre

# states: torque of the motor (N.m), slip of both tyres, speed ahead and lateral speed (m/s), yaw rate (rad/s), slip angles of both
# axles (rad)
STATES = 8
# longest step of Runge-Kutta's method of order 4, s
LONGEST = 1e-3
# speeds of carrier, left and right wheel at a time within the step, rad/s
Speeds = Callable[[float], Sequence[float]]


class Motion:
    """State of the parts, with forces and outputs.

    The yaw rate is positive in a turn to the left, in which the left wheel has the shorter path."""

    def __init__(self, motor: Motor, tyres: tuple[Tyre, Tyre], body: Body, speed: float):
        self.motor, self.tyres, self.body = motor, tyres, body
        self.x = [0.0] * STATES
        self.x[3] = speed
        weight = body.mass * GRAVITY / (body.front + body.rear)
        self._limits = [body.grip * weight * body.rear, body.grip * weight * body.front]

    def wheel_centres(self, x: Sequence[float]) -> list[float]:
        """Speeds of the centres of left and right wheel, m/s."""
        half = 0.5 * self.body.track * x[5]
        return [x[3] - half, x[3] + half]

    def forces(self, x: Sequence[float], speeds: Sequence[float]) -> list[float]:
        """Forces of the road on left and right tyre, N. `speeds`: speeds of carrier and wheels, rad/s."""
        return [tyre_force(tyre, x[1 + s], tyre.radius * speeds[1 + s], centre)
                for s, (tyre, centre) in enumerate(zip(self.tyres, self.wheel_centres(x)))]

    def lateral_forces(self, x: Sequence[float]) -> list[float]:
        """Lateral forces of front and driven axle, N, positive to the left."""
        body = self.body
        return [axle_force(stiffness, limit, x[6 + i])
                for i, (stiffness, limit) in enumerate(zip((body.front_stiffness, body.rear_stiffness), self._limits))]

    def torque(self, speeds: Sequence[float]) -> float:
        """Torque of the motor, N.m. The lagging torque is limited again, because the limit falls immediately when the speed rises."""
        return motor_torque(self.motor, self.x[0], self.motor.ratio * speeds[0])

    def rates(self, x: Sequence[float], speeds: Sequence[float], request: float, steer: float) -> list[float]:
        """Rates of all states, at the torque `request` of the motor (N.m) and the angle `steer` of the front wheels (rad)."""
        motor, body = self.motor, self.body
        torque, _, _, ahead, aside, yaw, front, rear = x
        left, right = self.forces(x, speeds)
        front_force, rear_force = self.lateral_forces(x)
        centres = self.wheel_centres(x)
        return [
            (motor_torque(motor, request, motor.ratio * speeds[0]) - torque) / motor.lag,
            *(slip_rate(tyre, x[1 + s], tyre.radius * speeds[1 + s], centres[s]) for s, tyre in enumerate(self.tyres)),
            (left + right - front_force * steer - resistance(body, ahead)) / body.mass + aside * yaw,
            (front_force + rear_force) / body.mass - ahead * yaw,
            (body.front * front_force - body.rear * rear_force + 0.5 * body.track * (right - left)) / body.yaw_inertia,
            (ahead * steer - aside - body.front * yaw - abs(ahead) * front) / body.relaxation,
            (body.rear * yaw - aside - abs(ahead) * rear) / body.relaxation,
        ]

    def advance(self, size: float, speeds: Speeds, request: Callable[[float], float], steer: Callable[[float], float]) -> None:
        """Integrates over `size` (s). `speeds` (carrier and wheels), `request` and `steer` count time from the start of the step."""
        count = max(1, -int(-size // LONGEST))
        h, x = size / count, self.x
        for k in range(count):
            times = ((k + part) * h for part in (0.0, 0.5, 1.0))
            begin, middle, end = ((speeds(time), request(time), steer(time)) for time in times)
            k1 = self.rates(x, *begin)
            k2 = self.rates([a + 0.5 * h * b for a, b in zip(x, k1)], *middle)
            k3 = self.rates([a + 0.5 * h * b for a, b in zip(x, k2)], *middle)
            k4 = self.rates([a + h * b for a, b in zip(x, k3)], *end)
            x = [a + h / 6.0 * (b + 2.0 * (c + d) + e) for a, b, c, d, e in zip(x, k1, k2, k3, k4)]
        self.x = x

    def loads(self, speeds: Sequence[float]) -> list[float]:
        """Loads of the parts on the differential, N.m: torque on the carrier, loads on left and right half-shaft."""
        forces = self.forces(self.x, speeds)
        return [self.motor.ratio * self.torque(speeds), *(tyre.radius * force for tyre, force in zip(self.tyres, forces))]

    def outputs(self, speeds: Sequence[float], steer: float) -> dict[str, float]:
        """All outputs of the parts, by name."""
        _, left_slip, right_slip, ahead, aside, yaw, _, _ = self.x
        left, right = self.forces(self.x, speeds)
        return {"motor.torque": self.torque(speeds), "motor.speed": self.motor.ratio * speeds[0],
                "left_tyre.force": left, "right_tyre.force": right, "left_tyre.slip": left_slip, "right_tyre.slip": right_slip,
                "body.speed": ahead, "body.lateral_speed": aside, "body.yaw_rate": yaw,
                "body.lateral_acceleration": sum(self.lateral_forces(self.x)) / self.body.mass, "body.steer": steer}
