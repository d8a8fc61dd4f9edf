"""Longest communication step: stability of the coupled linearised parts under the same masters that run the FMUs.

The drivetrain is at rest, tyres grip, gears are ideal. Each part is ẋ = A x + B u, o = C x + D u, and steps exactly
(matrix exponential) with inputs held or on a line. The matrices of the differential are its own directional derivatives. One
step of a master is then a matrix, and a disturbance grows if its largest eigenvalue is above 1. If a master repeats its step,
the matrix of one repetition decides on convergence.

`bevel_differential.coupling` does the same for hosts at the ports of the differential. Here, further parts are between them.
"""

import numpy as np
from bevel_differential.coupling import Linear, linearised, longest
from scipy.linalg import expm

import reference as r
from masters import IteratedHeld
from parameters import settings
from slaves import FmuPart, System


# range in which the limit is searched [s]
RANGE = (1e-5, 1e-2)


class LinearPart:
    """A part that steps by the matrix exponential."""

    def __init__(self, linear, follows_lines):
        self.linear, self.follows_lines = linear, follows_lines
        self.a, self.b, self.c, self.d = linear.a, linear.b, linear.c, linear.d
        self.x, self.u = np.zeros(len(self.a)), np.zeros(self.b.shape[1])

    def step(self, time, size, u, slope=None):
        if slope is not None and not self.follows_lines:
            u, slope = u + 0.5 * size * slope, None
        free, held, line = self.linear.exact(size)
        self.x = free @ self.x + held @ u
        self.u = u
        if slope is not None:
            self.x, self.u = self.x + line @ slope, u + size * slope

    def put(self, u):
        self.u = u

    def read(self):
        return self.c @ self.x + self.d @ self.u

    def save(self):
        return self.x, self.u

    def restore(self, saved):
        self.x, self.u = saved

    def drop(self, saved):
        pass


def parts(grip):
    """Matrices A, B, C, D of all parts but the differential; `grip` of the left tyre: 1, or 0 if it slides."""
    k, c, ratio = r.PROP_STIFFNESS, r.PROP_DAMPING, r.GEAR

    def wheel(grip):
        force, damping, arm = grip * r.SLIP_STIFFNESS, grip * r.TYRE_DAMPING, r.RADIUS / r.WHEEL_INERTIA
        # against motion of the car
        rocking = damping + force * r.ROCKING / r.RELAXATION
        return ([[-arm * damping * r.RADIUS, -arm * force], [r.RADIUS / r.RELAXATION, 0]],
                [[1 / r.WHEEL_INERTIA, arm * rocking], [0, -1 / r.RELAXATION]],
                [[1, 0], [damping * r.RADIUS, force]], [[0, 0], [0, -rocking]])

    rolling = r.ROLLING * r.GRAVITY / r.BREAKAWAY
    return {
        "engine": ([[-1 / 0.03]], [[0]], [[1]], [[0]]),
        "final_drive": ([[-c / ratio**2 / r.ENGINE_INERTIA, -k / ratio / r.ENGINE_INERTIA], [1 / ratio, 0]],
                        [[1 / r.ENGINE_INERTIA, c * r.FINAL / ratio / r.ENGINE_INERTIA], [0, -r.FINAL]],
                        [[1, 0], [r.FINAL * c / ratio, r.FINAL * k]], [[0, 0], [0, -c * r.FINAL**2]]),
        "left_wheel": wheel(grip), "right_wheel": wheel(1.0),
        "vehicle": ([[-rolling]], [[1 / r.MASS, 1 / r.MASS]], [[1]], [[0, 0]]),
    }


def linear_system(fmu, interpolates, grip=1.0):
    """System of linear parts; `fmu`: the differential; `interpolates`: true if it follows lines."""
    matrices = parts(grip)

    def make_part(name, inputs, outputs):
        if name == "differential":
            values = {variable: value for (owner, variable), value in settings("ideal").items() if owner == name}
            part = FmuPart(name, fmu, inputs, outputs, values)
            linear = linearised(part.instance, inputs, outputs)
            part.close()
            return LinearPart(linear, interpolates)
        a, b, c, d = matrices[name]
        if name == "final_drive" and outputs[0] == "carrier_torque":
            c, d = c[::-1], d[::-1]
        return LinearPart(Linear.of(a, b, c, d), True)

    return System(make_part)


def growth(system, master, size):
    """Largest eigenvalue, by magnitude, of one step of `master`, or of one repetition if the master repeats its step."""
    count, y = sum(len(part.x) for part in system.parts), len(system.signals)
    if isinstance(master, IteratedHeld):
        columns = []
        for guess in np.eye(y):
            system.restore([(0.0 * part.x, 0.0 * part.u) for part in system.parts])
            columns.append(master.again(system, 0.0, size, np.zeros(y), guess))
        return np.max(np.abs(np.linalg.eigvals(np.array(columns).T)))
    columns = []
    for z in np.eye(count + 2 * y):
        begin = 0
        for part in system.parts:
            part.x, part.u = z[begin:begin + len(part.x)], 0.0 * part.u
            begin += len(part.x)
        now = z[begin:begin + y]
        after = master.step(system, 0.0, size, now, z[begin + y:])
        columns.append(np.concatenate([*(part.x for part in system.parts), after, now]))
    return np.max(np.abs(np.linalg.eigvals(np.array(columns).T)))


def limit(system, master):
    """Longest communication step [s] below which no disturbance grows, or every repetition converges."""
    return longest(lambda size: growth(system, master, size), *RANGE)


def whole(system):
    """Matrices M and N of the coupled linear parts: ẋ = M x, o = N x."""
    count, y = sum(len(part.x) for part in system.parts), len(system.signals)
    a, b, c, d = np.zeros((count, count)), np.zeros((count, y)), np.zeros((y, count)), np.zeros((y, y))
    begin = 0
    for part, feeds, gives in zip(system.parts, system.feeds, system.gives):
        own = slice(begin, begin + len(part.x))
        a[own, own], c[gives, own] = part.a, part.c
        for j, feed in enumerate(feeds):
            b[own, feed] += part.b[:, j]
            d[gives, feed] += part.d[:, j]
        begin = own.stop
    outputs = np.linalg.solve(np.eye(y) - d, c)
    return a + b @ outputs, outputs


def frequency(system):
    """Highest frequency at which the coupled system oscillates [rad/s]."""
    poles = np.linalg.eigvals(whole(system)[0])
    return max(abs(pole) for pole in poles if abs(pole.imag) > 1e-6 * abs(pole))


def order(system, make_master, end=0.02, sizes=(1e-4, 5e-5)):
    """Order of convergence of `make_master` on the linear parts while the torque of the engine decays."""
    rates, outputs = whole(system)
    begin = np.zeros(len(rates))
    begin[0] = 1.0
    exact = outputs @ expm(rates * end) @ begin
    errors = []
    for size in sizes:
        place = 0
        for part in system.parts:
            part.x, part.u = begin[place:place + len(part.x)], 0.0 * part.u
            place += len(part.x)
        y = outputs @ begin
        # outputs one step before the start, on the exact solution
        master, before = make_master(), outputs @ expm(-rates * size) @ begin
        for k in range(round(end / size)):
            y, before = master.step(system, k * size, size, y, before), y
        errors.append(np.max(np.abs(y - exact) / np.maximum(np.abs(exact), 1e-3 * np.max(np.abs(exact)))))
    return np.log(errors[0] / errors[1]) / np.log(sizes[0] / sizes[1])
