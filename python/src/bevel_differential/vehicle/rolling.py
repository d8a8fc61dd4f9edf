"""Motor and tyres of a car, and their integration over one communication step, whatever the body does."""

from collections.abc import Callable, Sequence

from .equations import motor_torque, patch_rate, patch_slip, sliding_rate, tyre_force
from .parts import Motor, Tyre

# longest step of Runge-Kutta's method of order 4, s
LONGEST = 1e-3
# Largest product of this step and the rate of a patch that slides. The method is stable up to 2.78.
STABLE = 2.0
# speeds of carrier and wheels at a time within the step, rad/s
Speeds = Callable[[float], Sequence[float]]


class Rolling:
    """Motor and tyres on a body that moves, with forces, loads and integration. Subclasses have the states `x` and the motion of the body.

    `deflections`: indices of the states that are deflections of patches, first those of `tyres` along their planes; `patches`: full slide
    (relaxation lengths) and relaxation length (m) of each. The first state is the torque of the motor (N.m)."""

    motor: Motor
    tyres: Sequence[Tyre]
    x: list[float]
    deflections: Sequence[int]
    patches: Sequence[tuple[float, float]]

    def slips(self, x: Sequence[float]) -> list[float]:
        """Slips of the patches, in their order."""
        return [patch_slip(x[index], full) for index, (full, _) in zip(self.deflections, self.patches)]

    def creeps(self, x: Sequence[float], speeds: Sequence[float], steer: float) -> list[float]:
        """Speeds of the tyres at the patches relative to the road, m/s."""
        raise NotImplementedError

    def wheel_centres(self, x: Sequence[float]) -> list[float]:
        """Speeds of the centres of the wheels of `tyres`, m/s."""
        raise NotImplementedError

    def rates(self, x: Sequence[float], speeds: Sequence[float], request: float, steer: float) -> list[float]:
        """Rates of all states, at the torque `request` of the motor (N.m) and the angle `steer` of the front wheels (rad)."""
        raise NotImplementedError

    def forces(self, slips: Sequence[float], speeds: Sequence[float], centres: Sequence[float]) -> list[float]:
        """Forces of the road on the tyres, N. `speeds`: speeds of carrier and wheels, rad/s; `centres`: `wheel_centres`, m/s."""
        return [tyre_force(tyre, slip, tyre.radius * speed, centre)
                for tyre, slip, speed, centre in zip(self.tyres, slips, speeds[1:], centres)]

    def torque(self, speeds: Sequence[float]) -> float:
        """Torque of the motor, N.m. The lagging torque is limited again, because the limit falls immediately when the speed rises."""
        return motor_torque(self.motor, self.x[0], self.motor.ratio * speeds[0])

    def torque_rate(self, x: Sequence[float], speeds: Sequence[float], request: float) -> float:
        """Rate of the first state, N.m/s, at the torque `request` of the motor (N.m)."""
        return (motor_torque(self.motor, request, self.motor.ratio * speeds[0]) - x[0]) / self.motor.lag

    def deflecting(self, x: Sequence[float], creeps: Sequence[float], centres: Sequence[float]) -> list[float]:
        """Rates of the deflections of all patches, in relaxation lengths per second. `creeps` and speeds `centres` of the wheels, m/s."""
        return [patch_rate(x[index], full, relaxation, creep, speed)
                for index, (full, relaxation), creep, speed in zip(self.deflections, self.patches, creeps, centres)]

    def _count(self, size: float, speeds: Speeds, steer: Callable[[float], float]) -> int:
        """Number of steps in which `size` (s) is integrated: more than usual while a patch slides fast."""
        rates = (abs(creep) * sliding_rate(*patch) for time in (0.0, size)
                 for creep, patch in zip(self.creeps(self.x, speeds(time), steer(time)), self.patches))
        return max(1, -int(-size * max(1.0 / LONGEST, max(rates) / STABLE) // 1.0))

    def advance(self, size: float, speeds: Speeds, request: Callable[[float], float],
                steer: Callable[[float], float] = lambda _: 0.0) -> None:
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
        """Loads of the parts on the driveline, N.m: torque on the carrier, loads of the wheels."""
        forces = self.forces(self.slips(self.x), speeds, self.wheel_centres(self.x))
        return [self.motor.ratio * self.torque(speeds), *(tyre.radius * force for tyre, force in zip(self.tyres, forces))]
