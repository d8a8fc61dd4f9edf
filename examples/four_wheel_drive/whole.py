"""The whole car as one set of differential equations, integrated together: no signals are exchanged at steps.

The equations are written here again and share no code with the units, the package or the master; only the values of the car are the
same. All gears are ideal: ω_carrier = (ω_left + ω_right)/2. A differential has the kinetic energy J ω_carrier²/2 + J_δ δ²/2 with
δ = (ω_left - ω_right)/2, so that

    J dω_carrier/dt = T_carrier - T_left - T_right        J_δ dδ/dt = T_right - T_left

with the torques T of its shafts. The inertias J and J_δ of the gears are those that the unit reports by its accelerations.
States: motor torque, car speed, for each differential carrier speed, δ and twists of both shafts, four wheel speeds, four deflections.
"""

from math import atan, sin, tanh

import numpy as np
from scipy.integrate import solve_ivp

GRAVITY = 9.80665
# damping over stiffness of a tyre against motion of the car at standstill [s], speed at which it is halved [m/s]
ROCKING, ROCKING_SPEED = 0.003, 0.5


def gears(scene):
    """Inertias J and J_δ of carrier, planets and side gears [kg.m2], from the accelerations under a torque."""
    plain = {"scene.gear_contact": "ideal", "scene.carrier_drive": "torque", "scene.start": "rolling", "carrier.speed_command": 0.0,
             **{name: scene.value(name) for name in scene.values if name.split(".")[0] == "geometry" or name == "inertia.carrier"}}
    torque, accelerations = 100.0, []
    for carrier, right in ((torque, 0.0), (0.0, torque)):
        with scene.fmu.open() as instance:
            instance.initialise(plain | {"carrier.torque_command": carrier, "left.load_torque": -right, "right.load_torque": right})
            left, right = instance.read(["left.acceleration", "right.acceleration"])
            accelerations.append((left + right if carrier else left - right) / 2.0)
    return torque / accelerations[0], 2.0 * torque / accelerations[1]


class Shafts:
    """A differential with its two shafts. `ratio` and `pinion` of a final drive are 1 and 0 without one."""

    def __init__(self, scene):
        final = bool(scene.value("effects.final_drive"))
        self.ratio = scene.value("final_drive.ring_teeth") / scene.value("final_drive.pinion_teeth") if final else 1.0
        both, apart = gears(scene)
        self.both, self.apart = both + (self.ratio**2 * scene.value("inertia.pinion") if final else 0.0), apart
        self.stiffness = [scene.value(f"half_shaft.{side}_stiffness") for side in ("left", "right")]
        self.damping = [scene.value(f"half_shaft.{side}_damping") for side in ("left", "right")]

    def torques(self, x, ends):
        """Torques of the shafts, whose far ends turn with the speeds `ends`."""
        sides = x[0] + x[1], x[0] - x[1]
        return [k * twist + c * (side - end) for k, c, twist, side, end in zip(self.stiffness, self.damping, x[2:], sides, ends)]

    def rates(self, x, drive, ends):
        """Rates of its states, with the torque `drive` on the carrier or on the pinion."""
        left, right = self.torques(x, ends)
        return [(self.ratio * drive - left - right) / self.both, (right - left) / self.apart, x[0] + x[1] - ends[0], x[0] - x[1] - ends[1]]


def adhering(tyre, u):
    """Fraction of a creep that deflects the patch further."""
    sliding = 3.0 * tyre.friction * tyre.load / tyre.slip_stiffness
    return 1.0 - min(max(3.0 * abs(u) / sliding - 2.0, 0.0), 1.0) ** 2


def deflecting(tyre, u, creep, v):
    return ((adhering(tyre, u) if creep * u > 0.0 else 1.0) * creep - abs(v) * u) / tyre.relaxation


def force(tyre, u, creep, v):
    """Pacejka's magic formula with E = 0."""
    slip = u / max(adhering(tyre, u), 0.01 * abs(u)) + tyre.damping / (1.0 + (v / tyre.walk) ** 2) / tyre.slip_stiffness * creep
    slip -= ROCKING / (1.0 + (v / ROCKING_SPEED) ** 2) * v / tyre.relaxation
    peak = tyre.friction * tyre.load
    return peak * sin(tyre.shape * atan(tyre.slip_stiffness / (tyre.shape * peak) * slip))


class Whole:
    """All equations of a car with these scenes (`centre`, `front`, `rear`), tyres, motor and body."""

    def __init__(self, scenes, tyres, motor, body, inertias, pedal):
        self.centre, self.front, self.rear = (Shafts(scenes[name]) for name in ("centre", "front", "rear"))
        self.tyres, self.motor, self.body, self.inertias, self.pedal = tyres, motor, body, inertias, pedal

    def limit(self, carrier):
        """Largest torque of the motor at a speed of the centre's carrier."""
        motor = self.motor
        return motor.peak * min(1.0, motor.knee / max(abs(motor.ratio * carrier), 1e-9))

    def parts(self, x):
        """States by part, and the torques of all shafts: centre, front, rear."""
        centre, front, rear, wheels, deflections = x[2:6], x[6:10], x[10:14], x[14:18], x[18:22]
        pinions = self.front.ratio * front[0], self.rear.ratio * rear[0]
        torques = [self.centre.torques(centre, pinions), self.front.torques(front, wheels[:2]), self.rear.torques(rear, wheels[2:])]
        return centre, front, rear, wheels, deflections, pinions, torques

    def rates(self, time, x):
        motor, v = self.motor, x[1]
        centre, front, rear, wheels, deflections, pinions, ((to_front, to_rear), *axles) = self.parts(x)
        limit = self.limit(centre[0])
        asked = float(np.interp(time, *self.pedal))
        creeps = [tyre.radius * wheel - v for tyre, wheel in zip(self.tyres, wheels)]
        forces = [force(tyre, u, creep, v) for tyre, u, creep in zip(self.tyres, deflections, creeps)]
        against = self.body.drag * v * abs(v) + self.body.rolling * self.body.mass * GRAVITY * tanh(v / self.body.breakaway)
        return [(max(min(asked, limit), -limit) - x[0]) / motor.lag, (sum(forces) - against) / self.body.mass,
                *self.centre.rates(centre, motor.ratio * max(min(x[0], limit), -limit), pinions),
                *self.front.rates(front, to_front, wheels[:2]), *self.rear.rates(rear, to_rear, wheels[2:]),
                *((torque - tyre.radius * each) / inertia
                  for torque, tyre, each, inertia in zip([*axles[0], *axles[1]], self.tyres, forces, self.inertias)),
                *(deflecting(tyre, u, creep, v) for tyre, u, creep in zip(self.tyres, deflections, creeps))]

    def outputs(self, x):
        """Wheel speeds, torques of propeller shafts and half-shafts, speed of the car, torque of the motor."""
        centre, _, _, wheels, _, _, torques = self.parts(x)
        limit = self.limit(centre[0])
        return [*wheels, *torques[0], *torques[1], *torques[2], x[1], max(min(x[0], limit), -limit)]

    def solution(self, times, tolerance=1e-9):
        """Outputs at `times`, one row each, by scipy's Radau in pieces between the points of the pedal."""
        rows, x, begin = [], np.zeros(22), 0.0
        for end in sorted({*(time for time in self.pedal[0] if 0.0 < time < times[-1]), times[-1]}):
            inside = times[(times >= begin if not rows else times > begin) & (times <= end)]
            found = solve_ivp(self.rates, (begin, end), x, "Radau", dense_output=True, rtol=tolerance, atol=1e-2 * tolerance)
            if not found.success:
                raise RuntimeError(f"the equations cannot be integrated: {found.message}")
            rows.extend(self.outputs(each) for each in found.sol(inside).T)
            x, begin = found.y[:, -1], end
        return np.array(rows)


def whole(car, times, motor, body, pedal):
    """Outputs of a `FourWheelDrive` at `times`, in the order of its records."""
    inertias = [car.scenes[axle].value(f"inertia.{side}_end") for axle in ("front", "rear") for side in ("left", "right")]
    return Whole(car.scenes, car.tyres, motor, body, inertias, pedal).solution(times)
