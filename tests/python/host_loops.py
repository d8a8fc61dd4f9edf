"""Runs of the unit with hosts at its ports, and the longest stable step that they show. Hosts are written here from the definitions of
docs/coupling.md, without the package's own prediction.

    python tests/python/host_loops.py FROM TO     compares both for the random combinations FROM to TO - 1
"""

import sys
import warnings
from dataclasses import dataclass
from math import exp, inf, log, sqrt

import numpy as np
from scipy.linalg import expm

from bevel_differential import DifferentialError, Fmu, Scene
from bevel_differential.coupling import HELD, LINES, Host, coupling

INPUT = {"carrier": ("carrier.torque_command", -1.0), "left": ("left.load_torque", 1.0), "right": ("right.load_torque", 1.0)}
# carrier and wheels turn together, so the same teeth stay in contact
SPEED = 10.0
STEPS = 3000
# first disturbance, which is so small that the gears hardly roll on, and the size at which a run counts as unstable, as fractions of the
# torque of a wheel
PUSH, LARGE = 2e-5, 0.3
# disturbances below this fraction of the first one have died away
GONE = 0.05
# ratio of successive steps of the search
FINER = 1.02


@dataclass
class Spring:
    """Host: spring, damper, and an inertia on the far side of both."""

    port: str
    k: float
    c: float
    inertia: float
    reads: str

    def begin(self, angle):
        # twist or angle of the inertia, and its speed
        self.x = np.array([0.0 if self.reads == "speed" else angle, SPEED])
        self.angle, self.speed, self.slope = angle, SPEED, SPEED
        self.cache = {}

    def motion(self, held, size):
        """Exact motion of the host's inertia over a step: x, and an input with its slope, to x at the end."""
        if (held, size) not in self.cache:
            k, c, j = self.k, self.c, self.inertia
            if held == "torque":
                a, b = [[0, 1], [0, 0]], [[0], [1 / j]]
            elif self.reads == "speed":
                a, b = [[0, -1], [k / j, -c / j]], [[1], [c / j]]
            else:
                a, b = [[0, 1], [-k / j, -c / j]], [[0, 0], [k / j, c / j]]
            n = len(b[0])
            whole = np.block([[np.array(a, float), np.array(b, float), np.zeros((2, n))], [np.zeros((n, 2 + n)), np.eye(n)],
                              [np.zeros((n, 2 + 2 * n))]])
            self.cache[held, size] = expm(whole * size)[:2]
        return self.cache[held, size]

    def torque(self, angle, speed):
        twist = self.x[0] if self.reads == "speed" else angle - self.x[0]
        return self.k * twist + self.c * (speed - self.x[1])

    def move(self, held, size, inputs, slopes):
        self.x = self.motion(held, size) @ np.concatenate([self.x, inputs, slopes])

    def step(self, size, lines, end):
        """Torque after a step of the host. `end`: angle and speed of the port there, or None if the host reads only those at the start."""
        start = self.angle, self.speed
        before, slope = self.before, self.slope
        if end:
            self.take(end, size)
        if lines:
            # the line through the last two points, or through both ends
            rate = (self.angle - before[0]) / size, (self.speed - before[1]) / size
            first = start
            if end:
                rate = (end[0] - start[0]) / size, (end[1] - start[1]) / size
            last = first[0] + size * rate[0], first[1] + size * rate[1]
            if self.reads == "speed":
                self.move("line", size, first[1:], rate[1:])
            elif self.reads == "angle":
                # the speed of a line of the angle is its slope
                self.move("line", size, [first[0], rate[0]], [rate[0], 0.0])
                last = last[0], rate[0]
            else:
                self.move("line", size, first, rate)
            return self.torque(*last)
        if self.reads == "speed":
            speed = end[1] if end else start[1]
            self.move("held", size, [speed], [0.0])
            return self.torque(0.0, speed)
        own = self.torque(start[0], slope if self.reads == "angle" else start[1])
        self.move("torque", size, [own], [0.0])
        return self.torque(end[0], self.slope if self.reads == "angle" else end[1]) if end else own

    def take(self, values, size):
        """Receives angle and speed of the port at a communication point."""
        self.before = self.angle, self.speed
        self.slope = (values[0] - self.angle) / size
        self.angle, self.speed = values


def run(instance, scene, hosts, master, lines, size):
    """Typical torque that hosts add in the third and in the last quarter of the run; infinite if it becomes large. The median leaves out
    tooth pairs that come into contact as the gears roll on, because their disturbances are short."""
    load = scene["left.load_torque"]
    instance.initialise(scene)
    names = [f"{host.port}.{'' if host.port == 'carrier' else 'wheel_'}{what}" for host in hosts for what in ("angle", "speed")]
    port = instance.port([INPUT[host.port][0] for host in hosts], names)
    signs = np.array([INPUT[host.port][1] for host in hosts])
    rest = np.array([scene[INPUT[host.port][0]] for host in hosts])
    values = port.read()
    for i, host in enumerate(hosts):
        host.begin(values[2 * i])
        # before the start, the port turned at the same speed
        host.before, host.angle = (host.angle - SPEED * size, SPEED), host.angle
    added = before = np.array([PUSH * load * (1.0 - 0.4 * i) for i in range(len(hosts))])
    found = np.empty((STEPS, len(hosts)))
    for n in range(STEPS):
        slope = (added - before) / size if lines else None
        answers = None
        if master == "jacobi":
            answers = [host.step(size, lines, None) for host in hosts]
        values = port.do_step((rest + signs * added).tolist(), n * size, size, None if slope is None else (signs * slope).tolist())
        if master == "jacobi":
            for i, host in enumerate(hosts):
                host.take(tuple(values[2 * i:2 * i + 2]), size)
        else:
            answers = [host.step(size, lines, tuple(values[2 * i:2 * i + 2])) for i, host in enumerate(hosts)]
        added, before = np.array(answers), added
        found[n] = added
        if not np.all(np.abs(added) < LARGE * load):
            return inf, inf
    sizes = np.max(np.abs(found), axis=1)
    return np.median(sizes[STEPS // 2:3 * STEPS // 4]), np.median(sizes[3 * STEPS // 4:])


def grows(instance, scene, hosts, master, lines, size):
    """True if a disturbance grows in steps of this size."""
    try:
        earlier, later = run(instance, scene, hosts, master, lines, size)
    except DifferentialError:
        return True
    push = PUSH * scene["left.load_torque"]
    # loaded teeth may limit the growth by leaving each other
    return later > 5.0 * push or later > max(earlier, GONE * push)


def found(grows_at, guess):
    """Shortest step at which a disturbance grows, from half to twice `guess`: a search upward, and bisection. Infinite if none grows."""
    good = 0.5 * guess
    while not grows_at(good * FINER):
        good *= FINER
        if good > 2.0 * guess:
            return inf
    bad = good * FINER
    while bad / good > 1.002:
        middle = sqrt(good * bad)
        good, bad = (good, middle) if grows_at(middle) else (middle, bad)
    return sqrt(good * bad)


def drawn(seed):
    """Random combination: scene, hosts, master, and true for lines."""
    random = np.random.default_rng(seed)

    def between(low, high):
        return exp(random.uniform(log(low), log(high)))

    load = random.uniform(200.0, 800.0)
    inertias = {port: between(0.02, 2.0) for port in INPUT}
    scene = {"scene.gear_contact": str(random.choice(["ideal", "lumped", "tooth"])), "scene.carrier_drive": "torque",
             "scene.start": "equilibrium", "carrier.speed_command": SPEED, "carrier.torque_command": 2.0 * load,
             "left.load_torque": load, "right.load_torque": load, "inertia.carrier": inertias["carrier"],
             "inertia.left_end": inertias["left"], "inertia.right_end": inertias["right"], "solver.relative_tolerance": 1e-9}
    ports = random.choice(list(INPUT), 1 + int(random.random() < 0.35), replace=False)
    hosts = []
    for port in ports:
        k, inertia = between(1e2, 1e5), between(0.05, 20.0)
        both = 1.0 / (1.0 / inertia + 1.0 / inertias[port])
        c = 2.0 * between(0.05, 0.7) * sqrt(k * both)
        hosts.append(Spring(str(port), k, c, inertia, str(random.choice(["speed", "angle", "both"]))))
    return scene, hosts, str(random.choice(["jacobi", "gauss-seidel"])), bool(random.random() < 0.5)


def predicted(scene, hosts, master, lines, fmu):
    """The package's stability of a combination."""
    springs = [Host.spring(host.port, host.k, host.c, host.inertia, host.reads) for host in hosts]
    with Scene("coupled", stop=1.0, step=1e-3, outputs=["carrier.speed"], set=scene, fmu=fmu) as opened:
        return coupling(opened, springs, master, LINES if lines else HELD)


def main(begin, end):
    fmu = Fmu.of()
    with fmu.open() as instance:
        for seed in range(begin, end):
            scene, hosts, master, lines = drawn(seed)
            limit = predicted(scene, hosts, master, lines, fmu).limit
            words = ", ".join(f"{host.port} {host.reads}" for host in hosts)
            head = f"{seed}: {scene['scene.gear_contact']}, {words}, {master}, {'lines' if lines else 'held'}: predicted {limit * 1e3:.4g} ms"
            if limit == inf:
                print(head, flush=True)
                continue
            seen = found(lambda step: grows(instance, scene, hosts, master, lines, step), limit)
            print(f"{head}, found {seen * 1e3:.4g} ms, ratio {seen / limit:.4f}", flush=True)


if __name__ == "__main__":
    warnings.simplefilter("ignore")
    main(*map(int, sys.argv[1:]))
