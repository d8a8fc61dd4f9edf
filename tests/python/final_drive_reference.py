"""Separate calculations of the final drive's mesh, written from its equations: forced motion in closed form between touches, and two
lashes in series with an explicit method of order 8 and an event at each touch.

Angles, speeds and torques are those at the carrier: the pinion's angle divided by the ratio, its torque times the ratio."""

from dataclasses import dataclass
from math import cos, pi, sin, sqrt

import numpy as np
import theory
from plain import Differential, Scene
from scipy.integrate import solve_ivp
from scipy.optimize import brentq

TOLERANCE = 1e-12


def forced_amplitude(stiffness, damping, inertia, error, frequency):
    """Amplitude of the mesh torque [N.m] under a harmonic error [rad] at the angular frequency [rad/s], without loss of contact: a
    carrier on a spring whose other end turns steadily."""
    rho, zeta = frequency / sqrt(stiffness / inertia), damping / (2.0 * sqrt(stiffness * inertia))
    passed = (1.0 + 4.0 * zeta**2 * rho**2) / ((1.0 - rho**2) ** 2 + 4.0 * zeta**2 * rho**2)
    return stiffness * error * rho**2 * sqrt(passed)


@dataclass
class Rattle:
    """A carrier with lash under a steady load and a harmonic error, x'' + f(x, x') = F_m + F_a W^2 cos W t.

    x is the deviation in half lashes, and time is in units of 1/Omega_n. The flanks touch at x > 1 and x < -1. Between touches, the
    motion is a closed form. `damps_in_gap`: the damping 2 zeta x' acts always, and flanks touch by position only."""

    zeta: float
    mean: float
    excitation: float
    damps_in_gap: bool = False
    x: float = 0.0
    v: float = 0.0

    # spacing of the search for touches, in shares of a period of the excitation
    GRID = 1.0 / 60.0

    def __post_init__(self):
        self.x = self.x or 1.0 + self.mean

    def side(self):
        """Flank that presses: 1, -1, or 0 for none."""
        way = 1 if self.x > 0.0 else -1
        return way if self.pressing(0, self.x, self.v) < 0.0 else 0

    def motion(self, way, frequency, t0):
        """x(t) and v(t) from the present state at the time t0, while the flank `way` presses."""
        force, w = self.excitation * frequency**2, frequency
        if way == 0 and not self.damps_in_gap:
            a, b = force / w**2, force / w
            x1, v1 = self.x + a * cos(w * t0), self.v - b * sin(w * t0)
            return (lambda t: x1 + v1 * (t - t0) + 0.5 * self.mean * (t - t0) ** 2 - a * np.cos(w * t),
                    lambda t: v1 + self.mean * (t - t0) + b * np.sin(w * t))
        stiff, zeta = float(way != 0), self.zeta
        # steady part: amplitude of exp(i w t)
        z = force / (stiff - w * w + 2j * zeta * w)
        steady = lambda t: (z * np.exp(1j * w * t)).real  # noqa: E731
        rate = lambda t: (1j * w * z * np.exp(1j * w * t)).real  # noqa: E731
        if way == 0:
            drift = self.mean / (2.0 * zeta)
            c = self.v - rate(t0) - drift
            d = self.x - steady(t0) + c / (2.0 * zeta)
            fall = lambda t: c * np.exp(-2.0 * zeta * (t - t0))  # noqa: E731
            return lambda t: d - fall(t) / (2.0 * zeta) + drift * (t - t0) + steady(t), lambda t: fall(t) + drift + rate(t)
        rest, wd = way + self.mean, sqrt(1.0 - zeta**2)
        c = self.x - rest - steady(t0)
        s = (self.v - rate(t0) + zeta * c) / wd

        def x(t):
            u = t - t0
            return rest + steady(t) + np.exp(-zeta * u) * (c * np.cos(wd * u) + s * np.sin(wd * u))

        def v(t):
            u = t - t0
            return rate(t) + np.exp(-zeta * u) * ((s * wd - zeta * c) * np.cos(wd * u) - (c * wd + zeta * s) * np.sin(wd * u))

        return x, v

    def pressing(self, way, x, v):
        """Positive while a piece of motion lasts, in which the flank `way` presses, or none."""
        if way:
            return way * x - 1.0 + (0.0 if self.damps_in_gap else 2.0 * self.zeta * way * v)
        depths = [s * x - 1.0 for s in (1, -1)]
        if not self.damps_in_gap:
            depths = [np.minimum(deep, deep + 2.0 * self.zeta * s * v) for deep, s in zip(depths, (1, -1))]
        return -np.maximum(*depths)

    def run(self, frequency, periods, samples=0):
        """Advances by whole periods; returns `samples` deviations of each period, at its beginning and equal times after it."""
        period, seen = 2.0 * pi / frequency, []
        for _ in range(periods):
            wanted, t, way = np.arange(samples) * period / max(samples, 1), 0.0, self.side()
            while t < period:
                x, v = self.motion(way, frequency, t)
                stays = lambda at, way=way, x=x, v=v: float(self.pressing(way, x(at), v(at)))  # noqa: E731
                grid = np.append(np.arange(t, period, self.GRID * period), period)
                # at a touch the function is zero but for rounding
                inside = self.pressing(way, x(grid), v(grid))[1:] > 0.0
                end = period
                if not inside.all():
                    k = int(np.argmin(inside))
                    low = grid[k] if k else t + 1e-9 * period
                    end = brentq(stays, low, grid[k + 1], xtol=1e-14) if stays(low) > 0.0 else low
                if samples:
                    now = wanted[(wanted >= t) & (wanted < end)]
                    seen.extend(x(now))
                self.x, self.v, t = float(x(end)), float(v(end)), end
                if end < period:
                    # a flank separates, or one touches
                    way = 0 if way else 1 if self.x > 0.0 else -1
        return np.array(seen)


@dataclass
class LumpedMesh:
    """One spring with lash and step damping between planets that do not spin and a side gear: default gears."""

    stiffness: float    # per face width [N/m2]
    damping: float      # [N.s/m]
    depth: float        # of full damping [m]
    backlash: float     # at the outer pitch circle [m]
    planets: int = theory.PLANETS
    deepest: float = np.inf    # penetration up to which the law is valid [m]

    def __post_init__(self):
        self.base, self.radius = theory.SIDE_LEVER, theory.RESULTANT
        self.spring = self.stiffness * theory.FACE_MOMENT / self.radius**2
        self.half_lash = 0.5 * self.backlash * cos(theory.PRESSURE_ANGLE) / theory.OUTER_CONE
        # angle through which the carrier turns freely, with both side gears held
        self.lash = 2.0 * self.half_lash / self.base

    def depth_and_rate(self, way, ahead, rate):
        """Penetration [m] and its rate; `ahead`: angle by which the carrier is ahead of the side gear."""
        return (self.radius * (way * self.base * ahead - self.half_lash), self.radius * way * self.base * rate)

    def force(self, depth, rate):
        """Force of a tooth pair [N], before it is limited to zero."""
        u = min(depth / self.depth, 1.0)
        return self.spring * depth + self.damping * u * u * (3.0 - 2.0 * u) * rate

    def depth_under(self, force):
        """Penetration under a steady force of a planet."""
        return force / self.spring

    def torque(self, way, ahead, rate):
        """Torque of all planets on one side gear [N.m] while the flank `way` presses (0: none)."""
        return way * self.planets * self.base * self.radius * self.force(*self.depth_and_rate(way, ahead, rate)) if way else 0.0


class ToothMesh(LumpedMesh):
    """Pairs of teeth with the law IMPACT between planets that do not spin and a side gear. No tip corner touches."""

    def __init__(self, stiffness, damping, depth, backlash):
        super().__init__(stiffness, damping, depth, backlash)
        still = Differential(Scene(stiffness=stiffness, damping=damping, full_damping=depth, backlash=backlash))
        # arc between the flanks up to which the same pairs touch
        deepest = 1e-3
        found = [[pair[:2] for pair in still.pairs(arc, 0.0, 0.0, 0.0)] for arc in (1e-6, deepest)]
        assert found[0] == found[1] and all(place == 0 for _, place in found[0])
        self.pairs, self.exponent, self.radius, self.deepest = len(found[0]), theory.EXPONENT, theory.MEAN_CONE, deepest * theory.MEAN_CONE

    def force(self, depth, rate):
        """Force of all pairs of a planet [N], before it is limited to zero."""
        u = min(max(depth / self.depth, 0.0), 1.0)
        spring = self.stiffness * abs(depth) ** self.exponent * (1.0 if depth > 0.0 else -1.0)
        return self.pairs * (spring + self.damping * u * u * (3.0 - 2.0 * u) * rate)

    def depth_under(self, force):
        """Penetration under a steady force of a planet."""
        return (force / self.pairs / self.stiffness) ** (1.0 / self.exponent)


@dataclass
class TwoLashes:
    """Pinion, carrier and two equal side gears behind half-shafts whose wheels stand still: lash in the final drive and in the
    differential.

    State: angles of pinion, carrier and side gears, and their speeds. Each mesh has a flank that presses: 1, -1, or 0."""

    differential: LumpedMesh
    stiffness: float    # of the final drive's mesh [N.m/rad]
    damping: float      # [N.m.s/rad]
    lash: float         # [rad]
    pinion: float       # inertias [kg.m2]
    carrier: float
    side: float
    shaft: tuple        # stiffness and damping of a half-shaft
    state: np.ndarray = None
    touches: int = 0

    def final_drive(self, way, y):
        """Torque that a pressing flank would give, and the depth of the flank."""
        depth = way * (y[0] - y[1]) - 0.5 * self.lash
        return self.stiffness * depth + self.damping * way * (y[3] - y[4]), depth

    def in_differential(self, way, y):
        depth, rate = self.differential.depth_and_rate(way, y[1] - y[2], y[4] - y[5])
        return self.differential.force(depth, rate), depth

    def rates(self, y, ways, torque):
        y = y.tolist()
        mesh = ways[0] * self.final_drive(ways[0], y)[0] if ways[0] else 0.0
        side = self.differential.torque(ways[1], y[1] - y[2], y[4] - y[5])
        shaft = self.shaft[0] * y[2] + self.shaft[1] * y[5]
        return [*y[3:], (torque - mesh) / self.pinion, (mesh - 2.0 * side) / self.carrier, (side - shaft) / self.side]

    @staticmethod
    def presses(mesh, way, y):
        """Positive if a flank touches and would not pull."""
        return min(mesh(way, y))

    def events(self, ways):
        """Functions that fall through zero where a mesh changes, with the mesh's number and the flank after it."""
        for k, mesh in enumerate([self.final_drive, self.in_differential]):
            if ways[k]:
                yield (lambda y, mesh=mesh, way=ways[k]: mesh(way, y)[0]), k, 0
            else:
                for way in (1, -1):
                    yield (lambda y, mesh=mesh, way=way: -self.presses(mesh, way, y)), k, way

    def follow(self, torque, times):
        """States at `times`, which begin at the present one, under a constant torque."""
        ways = [next((way for way in (1, -1) if self.presses(mesh, way, self.state) > 0.0), 0)
                for mesh in (self.final_drive, self.in_differential)]
        found, time = [self.state], times[0]
        while time < times[-1]:
            functions, after = [], []
            for function, k, way in self.events(ways):
                event = lambda _, y, function=function: function(y)  # noqa: E731
                event.terminal, event.direction = True, -1.0
                functions.append(event)
                after.append((k, way))
            piece = solve_ivp(lambda _, y, ways=ways: self.rates(y, ways, torque), (time, times[-1]), self.state, "DOP853",
                              events=functions, rtol=TOLERANCE, atol=1e-14, dense_output=True)
            time, self.state = piece.t[-1], piece.y[:, -1].copy()
            inside = times[(times > piece.t[0]) & (times <= time)]
            found.extend(piece.sol(inside).T if len(inside) else [])
            for (k, way), at in zip(after, piece.t_events):
                if len(at):
                    ways = [*ways[:k], way, *ways[k + 1:]]
                    self.touches += 1
        return np.array(found)

    def at_rest(self, torque):
        """State of rest under a torque."""
        way = 1 if torque > 0.0 else -1
        side = 0.5 * torque / self.shaft[0]
        d = self.differential
        depth = d.depth_under(0.5 * abs(torque) / (d.planets * d.base * d.radius))
        carrier = side + way * (depth / d.radius + d.half_lash) / d.base
        return np.array([carrier + torque / self.stiffness + way * 0.5 * self.lash, carrier, side, 0.0, 0.0, 0.0])


def port_torque(speed, torque, ratio, friction, loss, viscous):
    """Torque at a pinion that turns steadily [N.m], under the torque on the ring gear; `loss`: (drive, coast)."""
    way = np.sign(speed)
    share = loss[0] if torque > 0.0 else loss[1]
    return torque / ratio + way * (friction + share * abs(torque) / ratio) + viscous * speed

