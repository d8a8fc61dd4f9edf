"""Moments of inertia of the gears as solids, by integrals over the outline, independent of the program.

A gear is a frustum of the root cone between its ends at the cone distances R_i and R_e, with teeth that rays through the apex
generate from one end to the other. At each azimuth, a half-plane from the axis intersects this shape in a triangle of the apex, a
point P = (sin φ, cos φ) of the outline and the root circle Q. A moment of degree n over the triangle is |P × Q|/(n + 2) times its
mean along PQ, and is proportional to R^(n+2)."""

from dataclasses import dataclass

import numpy as np

STEPS = 4000


def mean(function, p, q):
    """Mean along a line from p to q by Simpson's rule, which is exact for cubics."""
    (a, b), (c, d) = p, q
    return (function(a, b) + 4.0 * function(0.5 * (a + c), 0.5 * (b + d)) + function(c, d)) / 6.0


def triangle(p, q):
    """Integrals over the triangle of the apex, p and q, each (ρ, z): ∫∫ ρ·ρ² and ∫∫ ρ(ρ²/2 + z²), about the axis and across it."""
    double = np.abs(p[0] * q[1] - p[1] * q[0])
    return np.array([double / 5.0 * mean(lambda r, z: r**3, p, q),
                     double / 5.0 * mean(lambda r, z: r * (0.5 * r * r + z * z), p, q)])


@dataclass(frozen=True)
class Gear:
    """Gear on the unit sphere."""

    teeth: int
    pitch: float
    base: float
    tip: float
    root: float
    half_pitch: float
    fillet: float

    def arc(self, polar):
        return np.arccos(np.clip(np.cos(polar) / np.cos(self.base), -1.0, 1.0))

    def involute(self, polar):
        psi = self.arc(np.maximum(polar, self.base))
        return psi / np.sin(self.base) - np.arctan2(np.tan(psi), np.sin(self.base))

    def half_angle(self, polar):
        return self.half_pitch + self.involute(self.pitch) - self.involute(polar)

    def foot(self):
        """Polar angle and azimuth of the fillet from the root circle to its end: a small circle that touches the flank, or the
        meridian below the base circle."""
        centre, low = self.root + self.fillet, self.half_angle(self.base)
        touching = self.arc(centre) - self.fillet
        if centre > self.base and touching > 0.0:
            end = np.arccos(np.cos(self.base) * np.cos(touching))
            azimuth = low - self.involute(centre) + self.fillet / np.sin(self.base)
        else:
            azimuth = low + np.arcsin(np.sin(self.fillet) / np.sin(centre))
            end = np.arctan(np.tan(centre) * np.cos(azimuth - low))
        if azimuth > np.pi / self.teeth or end > self.pitch:
            raise ValueError("the fillet does not fit into the tooth space")
        polar = self.root + (end - self.root) * np.linspace(0.0, 1.0, STEPS + 1) ** 2
        beside = (np.cos(self.fillet) - np.cos(polar) * np.cos(centre)) / (np.sin(polar) * np.sin(centre))
        return polar, azimuth - np.arccos(np.clip(beside, -1.0, 1.0))

    def outline(self):
        """Polar angle and azimuth of half a tooth, root to tip."""
        polar, azimuth = self.foot()
        arcs = np.linspace(self.arc(max(self.base, polar[-1])), self.arc(self.tip), STEPS + 1)
        above = np.arccos(np.cos(self.base) * np.cos(arcs))
        return np.append(polar, above), np.append(azimuth, self.half_angle(above))

    def inertias(self, cones, bore, density):
        """Inertias about the axis, and about the apex across the axis."""
        inner, outer = cones
        foot = (np.sin(self.root), np.cos(self.root))
        polar, azimuth = self.outline()
        cut = triangle((np.sin(polar), np.cos(polar)), foot)
        sides = np.sum(0.5 * (cut[:, 1:] + cut[:, :-1]) * (azimuth[:-1] - azimuth[1:]), axis=1)
        tip = azimuth[-1] * triangle((np.sin(self.tip), np.cos(self.tip)), foot)
        whole = 2.0 * self.teeth * (sides + tip) + 2.0 * np.pi * triangle(foot, (0.0, foot[1]))
        ends, hub = foot[1] * np.array(cones), 0.5 * bore
        volume = np.pi * hub**2 * (ends[1] - ends[0])
        along = np.pi * hub**2 * (ends[1] ** 3 - ends[0] ** 3) / 3.0
        bored = np.array([0.5 * hub**2 * volume, 0.25 * hub**2 * volume + along])
        return density * (whole * (outer**5 - inner**5) - bored)


def depths(system, of, teeth):
    """Addenda and dedenda of planet and side gear in modules (docs/inside/theory.md, section 1)."""
    if system == "explicit":
        return [[of(f"{gear}_{what}") for gear in ["planet", "side"]] for what in ["addendum", "dedendum"]]
    virtual = (max(teeth) / min(teeth)) ** 2
    large, whole = {"standard": (1.0, 2.25), "iso23509": (2.0 * (0.21 + 0.29 / virtual), 2.25),
                    "gleason": (0.540 + 0.460 / virtual, 2.188 + 0.05e-3 / of("module"))}[system]
    addenda = [2.0 - large, large] if teeth[0] <= teeth[1] else [large, 2.0 - large]
    return addenda, [whole - addendum for addendum in addenda]


def gears(system, of):
    """Planet and side gear of an addendum system from values `of(name)` of geometry, with the cone distances of both ends."""
    teeth = [of("planet_teeth"), of("side_teeth")]
    module, pressure, backlash = of("module"), of("pressure_angle"), of("backlash")
    outer = 0.5 * module * np.hypot(*teeth)
    addenda, dedenda = depths(system, of, teeth)
    shift = (addenda[0] - addenda[1]) / 2.0

    def gear(i):
        pitch = np.arctan2(teeth[i], teeth[1 - i])
        moved = (1.0, -1.0)[i] * (2.0 * shift * np.tan(pressure) + of("thickness_shift"))
        thickness = 0.5 * np.pi + moved - 0.5 * backlash / module
        return Gear(teeth[i], pitch, np.arcsin(np.sin(pitch) * np.cos(pressure)), pitch + np.arctan(addenda[i] * module / outer),
                    pitch - np.arctan(dedenda[i] * module / outer), thickness / teeth[i],
                    of("root_fillet") * module / outer)

    return [gear(0), gear(1)], (outer - of("face_width"), outer)
