"""Separate integration of a differential with lumped meshes and clutch packs that stick and slip: equations written from the theory,
an explicit method of order 8, and an event at each switch. The carrier turns at an imposed speed; loads change in steps."""

from dataclasses import dataclass, field
from random import Random

import numpy as np
import theory
from scipy.integrate import solve_ivp
from scipy.interpolate import PchipInterpolator

# modes of a pack that does not slide
STUCK, YIELDS = 0, 2
# damping of a clutch that holds, over its stiffness [s]
HELD = 1e-4
TOLERANCE = 1e-11


@dataclass
class Gears:
    """Default gears without backlash, whose meshes are linear springs with Adams' step damping."""

    stiffness: float    # per face width [N/m2]
    damping: float      # [N·s/m]
    depth: float        # of full damping [m]
    side: float         # inertia of a side gear with its wheel [kg·m2]
    planet: float       # inertia of a planet [kg·m2]
    planets: int = theory.PLANETS

    def __post_init__(self):
        self.spring = self.stiffness * theory.FACE_MOMENT / theory.RESULTANT**2

    def arc_force(self, q, rate):
        """Torque of a mesh about the apex against q [N·m]."""
        depth, closing = theory.RESULTANT * abs(q), theory.RESULTANT * rate * np.sign(q)
        u = min(depth / self.depth, 1.0)
        force = self.spring * depth + self.damping * u * u * (3.0 - 2.0 * u) * closing
        return theory.RESULTANT * max(force, 0.0) * np.sign(q)


    def values(self):
        """The same gears in the FMU: without backlash, behind a carrier with an imposed speed."""
        return {"scene.gear_contact": "lumped", "contact.mesh_stiffness_from_geometry": False, "contact.mesh_stiffness": self.stiffness,
                "contact.damping": self.damping, "contact.penetration_depth": self.depth, "effects.backlash": False,
                "inertia.from_geometry": False, "inertia.side_gear": 1e-4, "inertia.left_end": self.side - 1e-4,
                "inertia.right_end": self.side - 1e-4, "inertia.planet": self.planet, "carrier.speed_command": 30.0,
                "scene.start": "rolling", "left.load_torque": 0.0, "right.load_torque": 0.0}


def alternating_loads():
    """Loads of the wheels [N·m]. Each difference is followed by none, so that packs stick; drive and coast alternate."""
    random = Random(1)
    for k in range(100):
        mean = 200.0 if k // 13 % 2 == 0 else -150.0
        unequal = random.uniform(100.0, 325.0) * (1.0, 0.0, -1.0, 0.0)[k % 4]
        yield mean + unequal, mean - unequal


@dataclass
class Clutches:
    preload: float
    coefficient: float
    coast: float
    both_sides: bool
    points: list
    stiffness: float

    def __post_init__(self):
        slips, torques = zip(*self.points)
        inner = PchipInterpolator(slips, torques)
        self.curve = lambda slip: float(inner(min(abs(slip), slips[-1])))

    def limits(self, torques, slips):
        """Limit torques of both packs [N·m] under the mesh torques on the side gears."""
        loads = [torque if torque > 0.0 else -self.coast * torque for torque in torques]
        if self.both_sides:
            loads = [0.5 * sum(loads)] * 2
        return [self.preload + self.coefficient * load + self.curve(slip) for load, slip in zip(loads, slips)]


@dataclass
class Reference:
    """State: angles of both side gears and the planets, and their rates, relative to the carrier.

    A pack is a spring in series with a slider. It is `STUCK`, slides in one direction (±1), or `YIELDS`: the limit falls faster than
    the spring unwinds, so the slider follows the limit while the side gear moves back."""

    gears: Gears
    clutches: Clutches
    state: np.ndarray = field(default_factory=lambda: np.zeros(6))
    modes: list = field(default_factory=lambda: [STUCK, STUCK])
    # rotation at which the spring is relaxed
    anchors: list = field(default_factory=lambda: [0.0, 0.0])
    switches: int = 0

    def mesh_torques(self, y):
        """Torques of all meshes on left and right side gear and on all planets [N·m]."""
        g, on_sides, on_planets = self.gears, [], 0.0
        for s, sign in enumerate([1.0, -1.0]):
            q = theory.SIDE_LEVER * y[s] - sign * theory.PLANET_LEVER * y[2]
            rate = theory.SIDE_LEVER * y[3 + s] - sign * theory.PLANET_LEVER * y[5]
            force = g.planets * g.arc_force(q, rate)
            on_sides.append(-theory.SIDE_LEVER * force)
            on_planets += sign * theory.PLANET_LEVER * force
        return on_sides, on_planets

    def limits(self, y):
        return self.clutches.limits(self.mesh_torques(y)[0], [y[3 + s] if mode in (1, -1) else 0.0 for s, mode in enumerate(self.modes)])

    def twist(self, y, s):
        return y[s] - self.anchors[s]

    def friction(self, y, s, limit):
        if self.modes[s] in (1, -1):
            return self.modes[s] * limit
        k = self.clutches.stiffness
        spring = k * self.twist(y, s) if self.modes[s] == STUCK else limit * np.sign(self.twist(y, s))
        return spring + k * HELD * y[3 + s]

    def rates(self, y, loads):
        (left, right), planets = self.mesh_torques(y)
        friction = [self.friction(y, s, limit) for s, limit in enumerate(self.limits(y))]
        g = self.gears
        return np.array([*y[3:], (left - loads[0] - friction[0]) / g.side, (right - loads[1] - friction[1]) / g.side,
                         planets / (g.planets * g.planet)])

    def limit_rate(self, y, loads, s):
        """Rate of a limit torque along the motion [N·m/s]."""
        step = 1e-9 * self.rates(y, loads)
        return (self.limits(y + step)[s] - self.limits(y - step)[s]) / 2e-9

    def distances(self, loads, s):
        """Functions of time and state that rise through zero at a switch of pack `s`, each with the mode after it."""
        k, mode, sense = self.clutches.stiffness, self.modes[s], np.sign(self.twist(self.state, s))
        speed = lambda y: y[3 + s]  # noqa: E731
        if mode in (1, -1):
            return [(lambda _, y: -mode * speed(y), STUCK)]
        if mode == YIELDS:
            return [(lambda _, y: sense * speed(y), int(sense)),
                    (lambda _, y: self.limit_rate(y, loads, s) - k * sense * speed(y), STUCK)]
        over = lambda y, way: way * k * self.twist(y, s) - self.limits(y)[s]  # noqa: E731
        slips = [(lambda _, y, way=way: over(y, way) + way * k * HELD * speed(y) if way * speed(y) > 0.0 else -1.0, way)
                 for way in (1, -1)]
        return slips + [(lambda _, y, way=way: over(y, way) if way * speed(y) < 0.0 else -1.0, YIELDS) for way in (1, -1)]

    def advance(self, duration, loads):
        time = 0.0
        while time < duration:
            events, after = [], []
            for s in range(2):
                for event, mode in self.distances(loads, s):
                    rises = lambda t, y, event=event: event(t, y)  # noqa: E731
                    rises.terminal, rises.direction = True, 1.0
                    events.append(rises)
                    after.append((s, mode))
            found = solve_ivp(lambda _, y: self.rates(y, loads), (time, duration), self.state, "DOP853", events=events,
                              rtol=TOLERANCE, atol=1e-13, dense_output=True)
            self.drag(found)
            self.state, time = found.y[:, -1].copy(), found.t[-1]
            for (s, mode), at in zip(after, found.t_events):
                if len(at):
                    self.switch(s, mode)

    def drag(self, found):
        """Springs of packs whose sliders move are wound to at most the limit torque, so they drag their anchors along."""
        times = np.concatenate([np.linspace(a, b, 8, endpoint=False) for a, b in zip(found.t, found.t[1:])] + [found.t[-1:]])
        for y in found.sol(times).T:
            limits = self.limits(y)
            for s, mode in enumerate(self.modes):
                if mode != STUCK:
                    way = mode if mode != YIELDS else np.sign(self.twist(y, s))
                    behind = way * y[s] - limits[s] / self.clutches.stiffness
                    self.anchors[s] = way * max(way * self.anchors[s], behind)

    def switch(self, s, mode):
        self.switches += YIELDS not in (mode, self.modes[s])
        if mode == STUCK and self.modes[s] != YIELDS:
            self.state[3 + s] = 0.0
        self.modes[s] = mode
