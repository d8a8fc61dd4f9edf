"""Equations of motion of motor, tyres and body, and their integration over one communication step."""

from collections.abc import Callable, Sequence

from .equations import (GRAVITY, ROCKING_ACROSS, axle_force, full_slide, motor_torque, patch_rate, patch_slip, resistance, rocking_slip,
                        sliding_rate, tyre_force, tyre_full_slide)
from .parts import Body, Motor, Tyre

# states: torque of the motor (N.m), deflections of both tyres (relaxation lengths), speed ahead and lateral speed (m/s), yaw rate (rad/s),
# lateral deflections of both axles (relaxation lengths)
STATES = 8
# longest step of Runge-Kutta's method of order 4, s
LONGEST = 1e-3
# Largest product of this step and the rate of a patch that slides. The method is stable up to 2.78.
STABLE = 2.0
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
        # full slide and relaxation length (m) of the patches: left and right tyre along their planes, front and driven axle to the side
        self._patches = [*((tyre_full_slide(tyre), tyre.relaxation) for tyre in tyres),
                         *((full_slide(*axle), body.relaxation) for axle in zip(self._stiffness(), self._limits))]

    def _stiffness(self) -> tuple[float, float]:
        """Cornering stiffness of front and driven axle, N/rad."""
        return self.body.front_stiffness, self.body.rear_stiffness

    def slips(self, x: Sequence[float]) -> list[float]:
        """Slips of the patches, in their order."""
        return [patch_slip(deflection, full) for deflection, (full, _) in zip((x[1], x[2], x[6], x[7]), self._patches)]

    def creeps(self, x: Sequence[float], speeds: Sequence[float], steer: float) -> list[float]:
        """Speeds of the tyres at the patches relative to the road, m/s."""
        (left, right), (left_centre, right_centre) = self.tyres, self.wheel_centres(x)
        return [left.radius * speeds[1] - left_centre, right.radius * speeds[2] - right_centre,
                x[3] * steer - x[4] - self.body.front * x[5], self.body.rear * x[5] - x[4]]

    def wheel_centres(self, x: Sequence[float]) -> list[float]:
        """Speeds of the centres of left and right wheel, m/s."""
        half = 0.5 * self.body.track * x[5]
        return [x[3] - half, x[3] + half]

    def forces(self, slips: Sequence[float], speeds: Sequence[float], centres: Sequence[float]) -> list[float]:
        """Forces of the road on left and right tyre, N. `speeds`: speeds of carrier and wheels, rad/s; `centres`: `wheel_centres`, m/s."""
        return [tyre_force(tyre, slip, tyre.radius * speed, centre)
                for tyre, slip, speed, centre in zip(self.tyres, slips, speeds[1:], centres)]

    def lateral_forces(self, slips: Sequence[float], creeps: Sequence[float], ahead: float) -> list[float]:
        """Lateral forces of front and driven axle, N, positive to the left. `ahead`: speed of the car, m/s."""
        damping = rocking_slip(ROCKING_ACROSS, self.body.relaxation, 1.0, ahead)
        return [axle_force(stiffness, limit, slip + damping * creep)
                for stiffness, limit, slip, creep in zip(self._stiffness(), self._limits, slips[2:], creeps[2:])]

    def torque(self, speeds: Sequence[float]) -> float:
        """Torque of the motor, N.m. The lagging torque is limited again, because the limit falls immediately when the speed rises."""
        return motor_torque(self.motor, self.x[0], self.motor.ratio * speeds[0])

    def rates(self, x: Sequence[float], speeds: Sequence[float], request: float, steer: float) -> list[float]:
        """Rates of all states, at the torque `request` of the motor (N.m) and the angle `steer` of the front wheels (rad)."""
        motor, body = self.motor, self.body
        torque, _, _, ahead, aside, yaw, _, _ = x
        slips, creeps, centres = self.slips(x), self.creeps(x, speeds, steer), self.wheel_centres(x)
        left, right = self.forces(slips, speeds, centres)
        front_force, rear_force = self.lateral_forces(slips, creeps, ahead)
        deflecting = [patch_rate(deflection, full, relaxation, creep, speed) for deflection, (full, relaxation), creep, speed
                      in zip((x[1], x[2], x[6], x[7]), self._patches, creeps, (*centres, ahead, ahead))]
        return [
            (motor_torque(motor, request, motor.ratio * speeds[0]) - torque) / motor.lag,
            *deflecting[:2],
            (left + right - front_force * steer - resistance(body, ahead)) / body.mass + aside * yaw,
            (front_force + rear_force) / body.mass - ahead * yaw,
            (body.front * front_force - body.rear * rear_force + 0.5 * body.track * (right - left)) / body.yaw_inertia,
            *deflecting[2:],
        ]

    def _count(self, size: float, speeds: Speeds, steer: Callable[[float], float]) -> int:
        """Number of steps in which `size` (s) is integrated: more than usual while a patch slides fast."""
        rates = (abs(creep) * sliding_rate(*patch) for time in (0.0, size)
                 for creep, patch in zip(self.creeps(self.x, speeds(time), steer(time)), self._patches))
        return max(1, -int(-size * max(1.0 / LONGEST, max(rates) / STABLE) // 1.0))

    def advance(self, size: float, speeds: Speeds, request: Callable[[float], float], steer: Callable[[float], float]) -> None:
        """Integrates over `size` (s). `speeds` (carrier and wheels), `request` and `steer` count time from the start of the step."""
        count = self._count(size, speeds, steer)
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
        forces = self.forces(self.slips(self.x), speeds, self.wheel_centres(self.x))
        return [self.motor.ratio * self.torque(speeds), *(tyre.radius * force for tyre, force in zip(self.tyres, forces))]

    def outputs(self, speeds: Sequence[float], steer: float) -> dict[str, float]:
        """All outputs of the parts, by name."""
        (ahead, aside, yaw), slips = self.x[3:6], self.slips(self.x)
        left, right = self.forces(slips, speeds, self.wheel_centres(self.x))
        lateral = self.lateral_forces(slips, self.creeps(self.x, speeds, steer), ahead)
        return {"motor.torque": self.torque(speeds), "motor.speed": self.motor.ratio * speeds[0],
                "left_tyre.force": left, "right_tyre.force": right, "left_tyre.slip": slips[0], "right_tyre.slip": slips[1],
                "body.speed": ahead, "body.lateral_speed": aside, "body.yaw_rate": yaw,
                "body.lateral_acceleration": sum(lateral) / self.body.mass, "body.steer": steer}
