"""Closed forms of the quantities that the study compares. They follow from start values of the FMU and share no code with it."""

from collections.abc import Mapping
from dataclasses import dataclass
from math import acos, cos, degrees, pi, sin, sqrt, tan
from typing import Any

from ..pair import STANDARD, Pair
from . import stated
from .stated import Case

# 1 m/s [km/h]
KMH = 3.6


def carrier_speed(case: Case) -> float:
    """Speed of the carrier if the wheels roll at the vehicle's speed [deg/s]."""
    return degrees(case.vehicle_speed / KMH / stated.TYRE_RADIUS)


def load_torque() -> float:
    """Load on one half-shaft at the limit of adhesion [N·m]: half of weight on the axle · adhesion · tyre radius."""
    return stated.CAR_MASS * stated.GRAVITY * stated.FRONT_SHARE * stated.ADHESION * stated.TYRE_RADIUS / 2.0


@dataclass(frozen=True)
class Expected:
    """Theoretical values of a case: speeds of left and right side gear [deg/s], tangential force of all planets on a side gear at its
    outer pitch circle [N], normal force of one mesh [N], mesh frequency [Hz]."""

    side_speeds: tuple[float, float]
    tangential_force: float
    normal_force: float
    mesh_frequency: float


class Theory:
    """Closed forms for the differential with the start values `start`, SI, by name."""

    def __init__(self, start: Mapping[str, Any]):
        self.start, self.pair = start, Pair.of(start)

    @property
    def side_radius(self) -> float:
        """Outer pitch radius of a side gear [m]."""
        return self.pair.module * self.pair.gears[1].teeth / 2.0

    @property
    def hertz_stiffness(self) -> float:
        """K = 4/3 √R E* of two spheres with the outer pitch radii of planet and side gear [N/m^1.5]."""
        first, second = (self.pair.module * gear.teeth / 2.0 for gear in self.pair.gears)
        modulus = self.start["material.young_modulus"] / (2.0 * (1.0 - self.start["material.poisson_ratio"] ** 2))
        return 4.0 / 3.0 * sqrt(first * second / (first + second)) * modulus

    @property
    def normal_force(self) -> float:
        """Normal force of one mesh at the mean cone distance [N]: T / (N R_m sin δ_b), with N planets and δ_b of the side gear."""
        mean_cone = self.pair.outer_cone - self.pair.face_width / 2.0
        return stated.LOAD / (self.pair.planets * mean_cone * sin(self.pair.gears[1].base))

    def expected(self, case: Case) -> Expected:
        """Theoretical values of a case. Side gears turn at ω_c ± ω_p z_p/z_s, and a tooth meshes z_p |ω_p|/360° times a second."""
        planet, side = (gear.teeth for gear in self.pair.gears)
        difference = case.planet_spin * planet / side
        return Expected((case.carrier_speed + difference, case.carrier_speed - difference), stated.LOAD / self.side_radius,
                        self.normal_force, planet * abs(case.planet_spin) / 360.0)

    @property
    def addendum_limit(self) -> float:
        """Largest addendum of the side gear without interference at the planet's base circle [modules]."""
        side = self.pair.gears[1]
        tip = acos(cos(side.base) * cos(sum(gear.arc(gear.pitch) for gear in self.pair.gears)))
        return self.pair.outer_cone * tan(tip - side.pitch) / self.pair.module

    @property
    def standard_addenda_interfere(self) -> tuple[bool, bool]:
        """Two truths: standard addenda undercut the planet, and they jam in the side gear."""
        standard = Pair.of({**self.start, "geometry.addendum_system": STANDARD})
        return standard.addendum_over_limit(1) > 0.0, standard.addendum_over_limit(0) > 0.0

    @property
    def planar_contact_ratio(self) -> float:
        """Contact ratio by Tredgold's approximation with virtual spur gears of z/cos δ teeth."""
        pair, alpha, length = self.pair, self.pair.pressure_angle, 0.0
        for gear in pair.gears:
            radius = gear.teeth / cos(gear.pitch) * pair.module / 2.0
            # from the base circle to the tip, less the part before the pitch point
            tip, base = radius + gear.addendum, radius * cos(alpha)
            length += sqrt((tip - base) * (tip + base)) - radius * sin(alpha)
        return length / (pi * pair.module * cos(alpha))
