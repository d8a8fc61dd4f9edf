"""The study's gears for programs that need solids: straight teeth with faceted spherical-involute flanks. SI units.

All axes meet in the apex, which is the origin. A gear's axis is z, from the apex to the heel. A point is given by its cone
distance R, its polar angle about the axis and its azimuth. The teeth have this program's default geometry: Gleason's long
and short addenda, and a backlash of 0.1 mm at the outer pitch circle.
"""

from dataclasses import dataclass

import numpy as np

PLANET_TEETH, SIDE_TEETH, PLANETS = 10, 16, 2
MODULE, PRESSURE_ANGLE, FACE_WIDTH, BACKLASH = 4.5e-3, np.radians(20.0), 20e-3, 0.1e-3
ROOT_FILLET = 0.40 * MODULE
DENSITY = 7800.0
OUTER_CONE = 0.5 * MODULE * np.hypot(PLANET_TEETH, SIDE_TEETH)
INNER_CONE = OUTER_CONE - FACE_WIDTH
MEAN_CONE = OUTER_CONE - 0.5 * FACE_WIDTH

# Gleason: the larger gear's addendum from the ratio of virtual teeth, which is u² for axes at 90°
RATIO = SIDE_TEETH / PLANET_TEETH
SIDE_ADDENDUM = (0.540 + 0.460 / RATIO**2) * MODULE
PLANET_ADDENDUM = 2.0 * MODULE - SIDE_ADDENDUM
WHOLE_DEPTH = 2.188 * MODULE + 0.05e-3
# half of the difference between the long addendum and the module, which moves tooth thickness from the side gear to the planet
SHIFT = (PLANET_ADDENDUM - SIDE_ADDENDUM) / (2.0 * MODULE)


def arc(base, polar):
    """Arc along the line of action from the base circle to a flank point: cos φ = cos δ_b cos ψ."""
    return np.arccos(np.clip(np.cos(polar) / np.cos(base), -1.0, 1.0))


def involute(base, polar):
    """Azimuth of the flank relative to its foot on the base circle."""
    psi = arc(base, np.maximum(polar, base))
    return psi / np.sin(base) - np.arctan2(np.tan(psi), np.sin(base))


def direction(polar, azimuth):
    """Unit vectors from polar angle and azimuth."""
    return np.stack([np.sin(polar) * np.cos(azimuth), np.sin(polar) * np.sin(azimuth), np.cos(polar)], axis=-1)


@dataclass(frozen=True)
class Gear:
    """A gear on the unit sphere, with a tooth centred on azimuth 0."""

    teeth: int
    pitch: float
    base: float
    tip: float
    root: float
    half_pitch: float
    """Half the angle of a tooth at the pitch circle."""

    def half_angle(self, polar):
        """Half the angle of a tooth; below the base circle the flank is a meridian."""
        return self.half_pitch + involute(self.base, self.pitch) - involute(self.base, polar)

    def flank(self, facets):
        """Polar angle and azimuth of a flank, root to tip: `facets` chords of the involute with nearly equal errors."""
        foot = max(self.base, self.root)
        steps = np.linspace(arc(self.base, foot), arc(self.base, self.tip), facets + 1)
        polar = np.arccos(np.cos(self.base) * np.cos(steps))
        azimuth = self.half_angle(polar)
        if self.root < self.base:
            polar, azimuth = np.append(self.root, polar), np.append(azimuth[0], azimuth)
        return polar, azimuth

    def teeth_points(self, facets, gap_first):
        """Corners of each tooth, whose solid is their convex hull. With `gap_first`, a gap instead of a tooth is at azimuth 0."""
        polar, azimuth = self.flank(facets)
        offset = np.pi / self.teeth if gap_first else 0.0
        centres = offset + 2.0 * np.pi * np.arange(self.teeth) / self.teeth
        outline = [np.concatenate([direction(polar, c - azimuth), direction(polar, c + azimuth)]) for c in centres]
        return [np.concatenate([INNER_CONE * rays, OUTER_CONE * rays]) for rays in outline]

    def fillet(self, facets):
        """Polar angle and azimuth of the fillet between root circle and flank, starting at the root.

        It is a small circle of angular radius ρ about a point of polar angle c = δ_f + ρ, tangent to the flank, or to the
        meridian below it. Normals of the flank are great circles tangent to the base circle, so the arc of the centre is ρ
        longer than that of the touching point."""
        radius = ROOT_FILLET / OUTER_CONE
        centre, foot = self.root + radius, self.half_angle(self.base)
        touching = arc(self.base, centre) - radius
        if centre > self.base and touching > 0.0:
            end = np.arccos(np.cos(self.base) * np.cos(touching))
            azimuth = foot - involute(self.base, centre) + radius / np.sin(self.base)
        else:
            azimuth = foot + np.arcsin(np.sin(radius) / np.sin(centre))
            end = np.arctan(np.tan(centre) * np.cos(azimuth - foot))
        polar = self.root + (end - self.root) * np.linspace(0.0, 1.0, facets + 1) ** 2
        beside = (np.cos(radius) - np.cos(polar) * np.cos(centre)) / (np.sin(polar) * np.sin(centre))
        return polar, azimuth - np.arccos(np.clip(beside, -1.0, 1.0))

    def inertia(self):
        """Moment of inertia about the axis of the gear without bore, with this program's solid.

        The solid is a frustum of the root cone with flat ends, and teeth whose ends are ruled from the outline down to the
        root circle. At each azimuth, ∫∫ ρ³ dρ dz over the triangle apex, outline (a = sin φ), root (b = sin δ_f) is
        sin(φ − δ_f) (a³ + a²b + ab² + b³) / 20, times the difference of the cone distances' fifth powers."""
        polar, azimuth = self.fillet(4000)
        flank, half = self.flank(4000)
        above = flank > polar[-1]
        polar, azimuth = np.append(polar, flank[above]), np.append(azimuth, half[above])

        def triangle(polar):
            a, b = np.sin(polar), np.sin(self.root)
            return np.sin(polar - self.root) * (a**3 + a**2 * b + a * b**2 + b**3) / 20.0

        sides = np.sum(0.5 * (triangle(polar[1:]) + triangle(polar[:-1])) * (azimuth[:-1] - azimuth[1:]))
        teeth = 2.0 * self.teeth * (sides + azimuth[-1] * triangle(self.tip))
        frustum = np.pi / 10.0 * np.cos(self.root) * np.sin(self.root) ** 4
        return DENSITY * (frustum + teeth) * (OUTER_CONE**5 - INNER_CONE**5)


def _gear(teeth, mate, addendum, shift):
    pitch = np.arctan2(teeth, mate)
    return Gear(
        teeth=teeth,
        pitch=pitch,
        base=np.arcsin(np.sin(pitch) * np.cos(PRESSURE_ANGLE)),
        tip=pitch + np.arctan2(addendum, OUTER_CONE),
        root=pitch - np.arctan2(WHOLE_DEPTH - addendum, OUTER_CONE),
        half_pitch=(0.5 * np.pi + 2.0 * shift * np.tan(PRESSURE_ANGLE) - 0.5 * BACKLASH / MODULE) / teeth)


PLANET = _gear(PLANET_TEETH, SIDE_TEETH, PLANET_ADDENDUM, SHIFT)
SIDE = _gear(SIDE_TEETH, PLANET_TEETH, SIDE_ADDENDUM, -SHIFT)


def frame(axis, first):
    """Rotation matrix of a gear with the axis `axis` and the azimuth 0 along `first`."""
    axis, first = np.array(axis, float), np.array(first, float)
    return np.column_stack([first, np.cross(axis, first), axis])


# the carrier turns about x; a planet's tooth points along x into a gap of each side gear
SIDE_FRAMES = {"left": frame([1, 0, 0], [0, 1, 0]), "right": frame([-1, 0, 0], [0, 1, 0])}
PLANET_FRAMES = [frame([0, 1, 0], [1, 0, 0]), frame([0, -1, 0], [1, 0, 0])]
# sense of counted angles about a gear's own axis: both sides about +x, planets so that positive spin accelerates the left
SIDE_SENSE = {"left": 1.0, "right": -1.0}
PLANET_SENSE = -1.0
