"""Model `tooth` in plain Python: slow, in SI, and written from the equations of docs/inside/theory.md instead of the program.

It has spherical involute gears, the law of MSC Adams (IMPACT), every planet, both flanks, every pair of teeth, and half-shafts.
Friction and tooth errors are left out. § names a section of docs/inside/theory.md."""

from dataclasses import dataclass
from math import acos, asin, atan, atan2, ceil, cos, pi, radians, sin, sqrt, tan

import theory
from scipy.optimize import brentq

MATE = {"planet": "side", "side": "planet"}
SIGMA = (1.0, -1.0)  # signs of left and right (§3)
RATIO = theory.PLANET_TEETH / theory.SIDE_TEETH
# Arc past the end of the path at which the gap is ten times the deflection of teeth, so that no corner touches beyond it.
REACH = 0.1


class Gears:
    """Geometry of the default pair with a backlash [m] (§1). Arcs are on the unit sphere [rad]."""

    def __init__(self, backlash=theory.BACKLASH):
        side_addendum = (0.54 + 0.46 * RATIO**2) * theory.MODULE  # Gleason: long and short, with the sum 2 m
        addendum = {"planet": 2.0 * theory.MODULE - side_addendum, "side": side_addendum}
        self.pitch = {"planet": theory.PLANET_PITCH, "side": theory.SIDE_PITCH}
        self.lever = {"planet": theory.PLANET_LEVER, "side": theory.SIDE_LEVER}  # sin δ_b
        self.base = {gear: asin(lever) for gear, lever in self.lever.items()}
        self.tip = {gear: self.pitch[gear] + atan(addendum[gear] / theory.OUTER_CONE) for gear in MATE}
        self.pitch_arc = {gear: self.arc(gear, self.pitch[gear]) for gear in MATE}
        self.tip_arc = {gear: self.arc(gear, self.tip[gear]) for gear in MATE}
        # the path of contact is [-end of the side gear, end of the planet], with the pitch point at 0
        self.end = {gear: self.tip_arc[gear] - self.pitch_arc[gear] for gear in MATE}
        self.base_pitch = 2.0 * pi * self.lever["planet"] / theory.PLANET_TEETH
        shift = (addendum["planet"] - addendum["side"]) / 2.0 / theory.MODULE
        thinned = backlash / 2.0 / theory.MODULE
        thickness = pi / 2.0 + 2.0 * shift * tan(theory.PRESSURE_ANGLE)
        self.half_tooth = (thickness - thinned) / theory.PLANET_TEETH  # γ_p at the pitch cone
        self.play = backlash * cos(theory.PRESSURE_ANGLE) / theory.OUTER_CONE  # b_n

    def arc(self, gear, polar):
        """Arc from the tangent point of the line of action to the flank's point at a polar angle."""
        return acos(cos(polar) / cos(self.base[gear]))

    def involute(self, gear, polar):
        """inv(φ): angle of the flank about the axis, relative to its foot on the base circle."""
        arc = self.arc(gear, polar)
        return arc / self.lever[gear] - atan2(tan(arc), self.lever[gear])

    def gap(self, gear, past):
        """Arc between the mate's flank and the tip corner of `gear` at the distance `past` beyond the end of the path, and its
        slope (§2). The axes are at a right angle: x is the mate's axis, z the gear's axis."""
        mate, tip = MATE[gear], self.tip[gear]
        azimuths = [atan2(tan(arc), self.lever[gear]) for arc in (self.pitch_arc[gear], self.tip_arc[gear])]
        turned = azimuths[1] - azimuths[0] + past / self.lever[gear]
        x, y, z = sin(tip) * cos(turned), sin(tip) * sin(turned), cos(tip)
        polar = acos(x)
        touch = atan2(y, z) - self.involute(mate, polar) + self.involute(mate, self.pitch[mate])
        # Corner and flank stay in contact, n·(ω₁ × c) = n·(ω₂ × c), with the flank's normal n. Its moment about the mate's
        # axis is sin δ_b at any point of an involute. Resolved along e_η and e_φ at the corner:
        along, across = self.lever[mate] / sin(polar), sqrt(1.0 - (self.lever[mate] / sin(polar)) ** 2)
        moment = (along * cos(polar) * cos(tip) - across * y) / sin(polar)
        return self.end[gear] + past - self.lever[mate] * touch, 1.0 - moment / self.lever[gear]


@dataclass
class Scene:
    """Simulated scene; the defaults are the study's straight case."""

    carrier_speed: float = radians(2861.0)
    carrier_torque: float | None = None  # None if the speed is imposed
    spin: float = 0.0
    spin_imposed: bool = False
    loads: tuple = (theory.LOAD, theory.LOAD)
    planets: int = theory.PLANETS
    stiffness: float = theory.STIFFNESS
    damping: float = 5e4
    full_damping: float = 1e-4  # penetration at which damping reaches its full value
    backlash: float = theory.BACKLASH
    carrier_inertia: float = 0.02  # including the planets, which move with the carrier
    side_inertia: float = 9e-5
    planet_inertia: float = 2e-5
    end_inertias: tuple = (0.0, 0.0)  # at the side gears, unless shafts are given
    shafts: tuple | None = None  # stiffness of the half-shafts [N·m/rad]


@dataclass
class Mesh:
    """Forces between one planet and one side gear."""

    approach: float  # of the drive flanks
    normal: float  # sum over all pairs [N]
    on_side: float  # torque on the side gear [N·m]
    on_planet: float


class Differential:
    """State: α of both sides, ω of both, ω_c, ψ of all planets, their ψ̇; with shafts also both twists, both ends' ω.

    α and ψ are relative to the carrier, ω absolute."""

    def __init__(self, scene):
        self.scene, self.gears = scene, Gears(scene.backlash)
        gears, azimuth = self.gears, 2.0 * pi / scene.planets
        # distance by which a mesh is ahead of one with a planet's tooth in mid-gap (§3)
        left = [theory.SIDE_TEETH * azimuth * i / (2.0 * pi) % 1.0 * gears.base_pitch for i in range(scene.planets)]
        self.phases = (left, [h + theory.PLANET_TEETH % 2 * gears.base_pitch / 2.0 for h in left])
        shafts = scene.shafts is not None
        self.side_inertias = [scene.side_inertia + (0.0 if shafts else end) for end in scene.end_inertias]
        self.end_at = 5 + 2 * scene.planets
        self.size = self.end_at + (4 if shafts else 0)
        self.angles = [0, 1, *range(5, 5 + scene.planets), *([self.end_at, self.end_at + 1] if shafts else [])]

    def pairs(self, approach, rate, travel, travel_rate):
        """Yields touching pairs of one flank, each with its force and the derivatives of its depth by approach and by travel.

        A pair is (number, place: 0 on the path, ±1 a corner, depth, F, ∂d/∂a / R, ∂d/∂x / R); §3."""
        gears, radius = self.gears, theory.MEAN_CONE
        first = gears.half_tooth * gears.lever["planet"] + travel
        k = ceil((-gears.end["side"] - REACH - first) / gears.base_pitch)
        while (s := first + k * gears.base_pitch) < gears.end["planet"] + REACH:
            place, clear, by_approach, by_travel = 0, 0.0, 1.0, 0.0
            if s > gears.end["planet"]:
                clear, slope = gears.gap("planet", s - gears.end["planet"])
                place, by_travel = 1, -slope
            elif s - approach < -gears.end["side"]:
                # the side gear's corner moves with the side gear
                clear, slope = gears.gap("side", min(approach - s - gears.end["side"], REACH))
                place, by_approach, by_travel = -1, 1.0 - slope, slope
            depth = radius * (approach - clear)
            if depth > 0.0:
                speed = radius * (by_approach * rate + by_travel * travel_rate)
                yield k, place, depth, self.impact(depth, speed), by_approach, by_travel
            k += 1

    def impact(self, depth, speed):
        """IMPACT of MSC Adams: K d^e + C STEP(d, 0, 0, d_max, 1) ḋ, never below zero (§3)."""
        scene, share = self.scene, min(depth / self.scene.full_damping, 1.0)
        damping = scene.damping * share * share * (3.0 - 2.0 * share)
        return max(scene.stiffness * depth**theory.EXPONENT + damping * speed, 0.0)

    def mesh(self, state, side, planet):
        """Forces of one mesh: the gradient of its potential, and damping with the same derivatives (§3)."""
        gears, radius, sigma = self.gears, theory.MEAN_CONE, SIGMA[side]
        n = self.scene.planets
        travel = sigma * gears.lever["planet"] * state[5 + planet]
        travel_rate = sigma * gears.lever["planet"] * state[5 + n + planet]
        relative = gears.lever["side"] * state[side] - travel
        relative_rate = gears.lever["side"] * (state[2 + side] - state[4]) - travel_rate
        travel += self.phases[side][planet]
        normal = by_relative = by_travel = 0.0
        for flank in (1.0, -1.0):  # drive flank, and coast flank as its mirror image
            approach = -flank * relative - gears.play / 2.0
            if approach > 0.0:
                for _, _, _, force, on_approach, on_travel in self.pairs(
                        approach, -flank * relative_rate, flank * travel, flank * travel_rate):
                    normal += force
                    by_relative -= flank * radius * force * on_approach
                    by_travel += flank * radius * force * on_travel
        return Mesh(-relative - gears.play / 2.0, normal, -gears.lever["side"] * by_relative,
                    -sigma * gears.lever["planet"] * (by_travel - by_relative))

    def meshes(self, state):
        """Meshes of both sides, each with all planets."""
        return [[self.mesh(state, side, planet) for planet in range(self.scene.planets)] for side in (0, 1)]

    def rate(self, _time, state):
        """Equations of motion (§6)."""
        scene, n, end = self.scene, self.scene.planets, self.end_at
        state = [float(value) for value in state]
        sides = self.meshes(state)
        rate = [0.0] * self.size
        for side in (0, 1):
            torque = scene.loads[side]
            if scene.shafts is not None:
                torque = scene.shafts[side] * state[end + side]
                rate[end + side] = state[2 + side] - state[end + 2 + side]
                rate[end + 2 + side] = (torque - scene.loads[side]) / scene.end_inertias[side]
            rate[side] = state[2 + side] - state[4]
            rate[2 + side] = (sum(mesh.on_side for mesh in sides[side]) - torque) / self.side_inertias[side]
        if scene.carrier_torque is not None:
            reaction = sum(mesh.on_side for side in sides for mesh in side)
            rate[4] = (scene.carrier_torque - reaction) / scene.carrier_inertia
        for planet in range(n):
            rate[5 + planet] = state[5 + n + planet]
            if not scene.spin_imposed:
                rate[5 + n + planet] = sum(sides[s][planet].on_planet for s in (0, 1)) / scene.planet_inertia
        return rate

    def rolling(self):
        """State with teeth in mid-gap and speeds by Willis (§12)."""
        scene = self.scene
        state = [0.0] * self.size
        state[2:5] = [*theory.side_speeds(scene.carrier_speed, scene.spin), scene.carrier_speed]
        state[5 + scene.planets:5 + 2 * scene.planets] = [scene.spin] * scene.planets
        if scene.shafts is not None:
            state[self.end_at + 2:] = state[2:4]
        return state

    def equilibrium(self):
        """State with planets as assembled, and side gears at the angle where their teeth carry the loads; α̇ follows an imposed
        spin as in statics (§12). Fails if planets would not stay in this position."""
        scene = self.scene

        def torque(side, angle, spin):
            state = [0.0] * self.size
            state[side] = angle
            state[5:5 + scene.planets] = [spin] * scene.planets
            return sum(self.mesh(state, side, planet).on_side for planet in range(scene.planets))

        def balance(side, spin):
            toward = -1.0 if scene.loads[side] > 0.0 else 1.0
            touch = SIGMA[side] * RATIO * spin + toward * self.gears.play / 2.0 / self.gears.lever["side"]
            ends = sorted((touch, touch + toward * 0.02))
            return brentq(lambda angle: torque(side, angle, spin) - scene.loads[side], *ends, xtol=1e-17, rtol=1e-15)

        state = self.rolling()
        for side in (0, 1):
            state[side] = balance(side, 0.0)
            if scene.spin:
                step = 1e-4  # angle of the planets; central differences, exact if both pairs are on the path
                slope = (balance(side, step) - balance(side, -step)) / (2.0 * step)
                state[2 + side] = scene.carrier_speed + slope * scene.spin
            if scene.shafts is not None:
                state[self.end_at + side] = scene.loads[side] / scene.shafts[side]
        still = state[:5 + scene.planets] + [0.0] * (self.size - 5 - scene.planets)
        still[2:5] = [0.0] * 3
        spun = [sum(mesh.on_planet for mesh in planet) for planet in zip(*self.meshes(still))]
        if not scene.spin_imposed and max(map(abs, spun)) > 1e-9 * max(map(abs, scene.loads)):
            raise ValueError(f"planets would turn away from mid-gap by {spun} N·m")
        return state

    def outputs(self, state):
        """Outputs by the names of the FMU."""
        scene = self.scene
        state = [float(value) for value in state]
        sides = self.meshes(state)
        reaction = sum(mesh.on_side for side in sides for mesh in side)
        outputs = {"carrier.speed": state[4], "left.speed": state[2], "right.speed": state[3],
                "carrier.torque": reaction if scene.carrier_torque is None else scene.carrier_torque}
        for side, name in enumerate(("left", "right")):
            outputs[f"{name}.shaft_torque"] = scene.loads[side]
            if scene.shafts is not None:
                outputs[f"{name}.shaft_torque"] = scene.shafts[side] * state[self.end_at + side]
            for planet, mesh in enumerate(sides[side]):
                outputs[f"planet[{planet + 1}].{name}_normal_force"] = mesh.normal
                outputs[f"planet[{planet + 1}].{name}_transmission_error"] = mesh.approach * theory.MEAN_CONE
        for planet in range(scene.planets):
            outputs[f"planet[{planet + 1}].spin_speed"] = state[5 + scene.planets + planet]
        return outputs
