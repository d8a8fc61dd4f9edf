"""Longest communication step: stability of the coupled linearised parts under the same masters that run the FMUs.

The drivetrain is at rest, tyres grip, gears are ideal. Each part is ẋ = A x + B u, o = C x + D u, and steps exactly
(matrix exponential) with inputs held or on a line. One step of a master is then a matrix, and a disturbance grows if its
largest eigenvalue is above 1. If a master repeats its step, the matrix of one repetition decides on convergence.
"""

import numpy as np
from scipy.linalg import expm

import reference as r
from masters import IteratedHeld
from slaves import System


class LinearPart:
    """A part that steps by the matrix exponential."""

    def __init__(self, matrices, follows_lines):
        self.a, self.b, self.c, self.d = (np.array(m, dtype=float) for m in matrices)
        self.follows_lines = follows_lines
        self.x, self.u = np.zeros(len(self.a)), np.zeros(self.b.shape[1])
        self.cache = {}

    def matrices(self, size):
        if size not in self.cache:
            n, m = self.b.shape
            whole = np.zeros((n + 2 * m, n + 2 * m))
            whole[:n, :n], whole[:n, n:n + m], whole[n:n + m, n + m:] = self.a, self.b, np.eye(m)
            e = expm(whole * size)
            self.cache[size] = e[:n, :n], e[:n, n:n + m], e[:n, n + m:]
        return self.cache[size]

    def step(self, time, size, u, slope=None):
        if slope is not None and not self.follows_lines:
            u, slope = u + 0.5 * size * slope, None
        free, held, line = self.matrices(size)
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


def parts(library, grip):
    """Matrices A, B, C, D by part; `grip` of the left tyre: 1, or 0 if it slides."""
    k, c, ratio = r.PROP_STIFFNESS, r.PROP_DAMPING, r.GEAR
    ideal = r.Ideal(library)
    rows = np.eye(7)
    # x = (twists, speeds of the sides), u = (carrier torque, wheels)
    both = np.array([ideal.rates(row[:4], row[4], row[5:]) for row in rows]).T
    outputs = np.array([[ideal.carrier_speed(row[:4]), *ideal.torques(row[:4], row[5:])] for row in rows]).T

    def wheel(grip):
        force, damping, arm = grip * r.SLIP_STIFFNESS, grip * r.TYRE_DAMPING, r.RADIUS / r.WHEEL_INERTIA
        return ([[-arm * damping * r.RADIUS, -arm * force], [r.RADIUS / r.RELAXATION, 0]],
                [[1 / r.WHEEL_INERTIA, arm * damping], [0, -1 / r.RELAXATION]],
                [[1, 0], [damping * r.RADIUS, force]], [[0, 0], [0, -damping]])

    rolling = r.ROLLING * r.GRAVITY / r.BREAKAWAY
    return {
        "engine": ([[-1 / 0.03]], [[0]], [[1]], [[0]]),
        "final_drive": ([[-c / ratio**2 / r.ENGINE_INERTIA, -k / ratio / r.ENGINE_INERTIA], [1 / ratio, 0]],
                        [[1 / r.ENGINE_INERTIA, c * r.FINAL / ratio / r.ENGINE_INERTIA], [0, -r.FINAL]],
                        [[1, 0], [r.FINAL * c / ratio, r.FINAL * k]], [[0, 0], [0, -c * r.FINAL**2]]),
        "differential": (both[:, :4], both[:, 4:], outputs[:, :4], outputs[:, 4:]),
        "left_wheel": wheel(grip), "right_wheel": wheel(1.0),
        "vehicle": ([[-rolling]], [[1 / r.MASS, 1 / r.MASS]], [[1]], [[0, 0]]),
    }


def linear_system(library, interpolates, grip=1.0):
    """System of linear parts; `interpolates`: true if the differential follows lines."""
    matrices = parts(library, grip)

    def make_part(name, inputs, outputs):
        a, b, c, d = matrices[name]
        if name == "final_drive" and outputs[0] == "carrier_torque":
            c, d = c[::-1], d[::-1]
        return LinearPart((a, b, c, d), interpolates or name != "differential")

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


def limit(system, master, low=1e-4, high=1e-2):
    """Longest communication step [s] below which no disturbance grows, or every repetition converges."""
    sizes = np.geomspace(low, high, 40)
    grows = [growth(system, master, size) > 1.0 + 1e-9 for size in sizes]
    if not any(grows):
        return np.inf
    first = grows.index(True)
    if first == 0:
        return 0.0
    good, bad = sizes[first - 1], sizes[first]
    for _ in range(30):
        middle = 0.5 * (good + bad)
        good, bad = (good, middle) if growth(system, master, middle) > 1.0 + 1e-9 else (middle, bad)
    return good


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
