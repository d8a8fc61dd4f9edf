"""The whole drivetrain as one set of differential equations, integrated together: no signals are exchanged at steps.

The equations are written here again and share no code with the parts. The differential is Willis' equation (`Ideal`) or
the teeth of this program (`Teeth`), whose rates the library foreign-solvers offers to any solver.
States: torque and speed of the engine, twist of the prop shaft, speed of each wheel, deflection of each tyre in relaxation lengths, speed,
differential.
"""

import sys
from math import atan, sin, sqrt, tanh
from pathlib import Path

import numpy as np
from scipy.integrate import solve_ivp

from parameters import AT_REST, CONTACT, DIFFERENTIAL, FRICTION

sys.path.append(str(Path(__file__).parents[2] / "benches" / "foreign"))
from library import Library, Run  # noqa: E402

GEAR, FINAL, ENGINE_INERTIA, PROP_STIFFNESS, PROP_DAMPING = 3.5, 3.9, 0.15, 7500.0, 8.0
WHEEL_INERTIA, RADIUS, LOAD, SLIP_STIFFNESS, SHAPE, RELAXATION = 1.0, 0.334, 3568.0, 70000.0, 1.4, 0.4
TYRE_DAMPING, WALK = 1000.0, 2.5
# damping over stiffness of a tyre against motion of the car at standstill [s], speed at which it is halved [m/s]
ROCKING, ROCKING_SPEED = 0.003, 0.5
# fraction of the deflection of a sliding patch up to which it adheres
ADHESION = 2.0 / 3.0
MASS, DRAG, ROLLING, BREAKAWAY, GRAVITY = 1455.0, 0.4, 0.012, 0.2, 9.80665
SIDES = ("left", "right")
STIFFNESS = [DIFFERENTIAL[f"half_shaft.{side}_stiffness"] for side in SIDES]
DAMPING = [DIFFERENTIAL[f"half_shaft.{side}_damping"] for side in SIDES]
# teeth of side gear over teeth of planet
TEETH = 16.0 / 10.0


def smooth(s):
    s = min(max(s, 0.0), 1.0)
    return s**4 * (35.0 + s * (-84.0 + s * (70.0 - 20.0 * s)))


def engine_rate(t, torque, speed):
    asked = 110.0 * smooth(t / 0.15) - 75.0 * smooth((t - 0.35) / 0.1)
    return (asked / sqrt(1.0 + (speed / 300.0) ** 2) - torque) / 0.03


def adhering(side, deflection):
    """Fraction of a sliding speed that deflects the tyre further."""
    sliding = 3.0 * FRICTION[side] * LOAD / SLIP_STIFFNESS
    return 1.0 - (min(max(abs(deflection) / sliding - ADHESION, 0.0) / (1.0 - ADHESION), 1.0)) ** 2


def deflection_rate(side, speed, deflection, v):
    creep = RADIUS * speed - v
    return (creep * (adhering(side, deflection) if creep * deflection > 0.0 else 1.0) - abs(v) * deflection) / RELAXATION


def tyre(side, speed, deflection, v):
    peak = FRICTION[side] * LOAD
    # a wheel that spins while the car stands would have an infinite slip
    slip = deflection / max(adhering(side, deflection), 0.01 * abs(deflection))
    slip += TYRE_DAMPING / (1.0 + (v / WALK) ** 2) / SLIP_STIFFNESS * (RADIUS * speed - v)
    slip -= ROCKING / (1.0 + (v / ROCKING_SPEED) ** 2) * v / RELAXATION
    return peak * sin(SHAPE * atan(SLIP_STIFFNESS / (SHAPE * peak) * slip))


class Ideal:
    """Side gears, carrier and planets on Willis' equation: ω_c = (ω_L + ω_R)/2, ψ̇ = (z_s/z_p)(ω_L − ω_R)/2."""

    def __init__(self, library):
        run = Teeth(library, "ideal")
        carrier, side, planets = run.inertias()
        run.close()
        both, apart = 0.25 * carrier, 0.25 * planets * TEETH**2
        # mass matrix: kinetic energy as a function of the speeds of the sides
        mass = np.array([[side + both + apart, both - apart], [both - apart, side + both + apart]])
        self.inverse = np.linalg.inv(mass)
        # twists of the half-shafts, speeds of the sides
        self.start = np.zeros(4)

    def carrier_speed(self, x):
        return 0.5 * (x[2] + x[3])

    def sides(self, x):
        return x[2], x[3]

    def torques(self, x, wheels):
        return [STIFFNESS[s] * x[s] + DAMPING[s] * (x[2 + s] - wheels[s]) for s in range(2)]

    def rates(self, x, carrier_torque, wheels):
        left, right = self.torques(x, wheels)
        a, b = 0.5 * carrier_torque - left, 0.5 * carrier_torque - right
        m = self.inverse
        return [x[2] - wheels[0], x[3] - wheels[1], m[0, 0] * a + m[0, 1] * b, m[1, 0] * a + m[1, 1] * b]

    def close(self):
        pass


class Teeth(Run):
    """The program's own equations: positions and velocities of side gears, carrier, planets, ends of half-shafts."""

    def __init__(self, library, contact):
        still = AT_REST | {"left.load_torque": 0.0, "right.load_torque": 0.0}
        super().__init__(library, DIFFERENTIAL | still | {"scene.gear_contact": CONTACT[contact]})
        self.start = self.u0
        self.n = self.size // 2
        # order of the states: side gears, carrier, planets, ends
        self.twists = slice(self.n - 2, self.n)
        self.ends = slice(2 * self.n - 2, 2 * self.n)
        self.rhs = self.python_rhs()

    def carrier_speed(self, x):
        return x[self.n + 2]

    def sides(self, x):
        return x[self.n], x[self.n + 1]

    def torques(self, x, wheels):
        twists, sides = x[self.twists], self.sides(x)
        return [STIFFNESS[s] * twists[s] + DAMPING[s] * (sides[s] - wheels[s]) for s in range(2)]

    def rates(self, x, carrier_torque, wheels):
        self.lib.foreign_drive(self.handle, carrier_torque, *wheels)
        x = np.array(x)
        x[self.ends] = wheels
        rate = self.rhs(0.0, x)
        rate[self.ends] = 0.0
        return rate


class Whole:
    """All equations, with `differential` between prop shaft and wheels."""

    def __init__(self, differential):
        self.differential = differential
        self.start = np.concatenate((np.zeros(8), differential.start))

    def prop_shaft(self, x):
        rate = x[1] / GEAR - FINAL * self.differential.carrier_speed(x[8:])
        return PROP_STIFFNESS * x[2] + PROP_DAMPING * rate, rate

    def rates(self, t, x):
        gears, wheels, deflections, v = x[8:], x[3:5], x[5:7], x[7]
        prop, twist_rate = self.prop_shaft(x)
        torques = self.differential.torques(gears, wheels)
        forces = [tyre(side, *state, v) for side, state in zip(SIDES, zip(wheels, deflections))]
        resistance = DRAG * v * abs(v) + ROLLING * MASS * GRAVITY * tanh(v / BREAKAWAY)
        return np.concatenate((
            [engine_rate(t, x[0], x[1]), (x[0] - prop / GEAR) / ENGINE_INERTIA, twist_rate],
            [(torques[s] - RADIUS * forces[s]) / WHEEL_INERTIA for s in range(2)],
            [deflection_rate(side, *state, v) for side, state in zip(SIDES, zip(wheels, deflections))],
            [(forces[0] + forces[1] - resistance) / MASS],
            self.differential.rates(gears, FINAL * prop, wheels)))

    def output_values(self, x):
        """Outputs in the order of the system's signals."""
        wheels = x[3:5]
        torques = self.differential.torques(x[8:], wheels)
        return {("engine", "torque"): x[0], ("final_drive", "engine_speed"): x[1],
                ("final_drive", "carrier_torque"): FINAL * self.prop_shaft(x)[0],
                ("differential", "carrier.speed"): self.differential.carrier_speed(x[8:]),
                ("differential", "left.shaft_torque"): torques[0], ("differential", "right.shaft_torque"): torques[1],
                ("left_wheel", "speed"): wheels[0], ("right_wheel", "speed"): wheels[1],
                ("left_wheel", "force"): tyre("left", x[3], x[5], x[7]),
                ("right_wheel", "force"): tyre("right", x[4], x[6], x[7]),
                ("vehicle", "speed"): x[7]}

    def solution(self, times, method, tolerance):
        """Outputs at `times` and the result of scipy's `method`."""
        result = solve_ivp(self.rates, (0.0, times[-1]), self.start, method=method, t_eval=times, rtol=tolerance,
                           atol=tolerance * 1e-2)
        if not result.success:
            raise RuntimeError(f"the reference cannot be integrated: {result.message}")
        return [self.output_values(x) for x in result.y.T], result


def reference(library_path, contact, times, signals, method, tolerance):
    """Outputs at `times`, one row each, in the order of `signals`, and the number of evaluations."""
    library = Library(library_path)
    differential = Ideal(library) if contact == "ideal" else Teeth(library, contact)
    rows, result = Whole(differential).solution(times, method, tolerance)
    differential.close()
    return np.array([[row[signal] for signal in signals] for row in rows]), result.nfev
