"""Planet and side gear in closed form: cones, heights, lands and contact, by the formulas of src/geometry, and its checks with grades.

The FMU decides which gears can be built, but it only refuses a design or warns about it. A search must know which of two designs is
nearer to a good one. These formulas therefore calculate by how much a design misses each limit. They also give dimensions for the
parts around the gears. Terms of ISO 23509:2016. In all pairs of values, the planet is first."""

import math
from collections.abc import Mapping
from dataclasses import dataclass
from math import atan2, cos, pi, sin, tan

# addendum systems of the FMU
STANDARD, GLEASON, ISO_23509, EXPLICIT = 1, 2, 3, 4
# constant term of Gleason's clearance, m
GLEASON_CLEARANCE = 0.05e-3
NAMES = ("planet", "side gear")
# limits of src/geometry/checks.rs: face width over R_e, tip land in modules, rim at the toe over the tooth depth there
FACE_WIDTH, LAND, RIM = 0.5, 0.2, 0.5
LEAST_INNER_CONE, LEAST_ROOT_ANGLE = 0.1, 0.02


@dataclass(frozen=True)
class Gear:
    """Gear on the unit sphere: angles in rad, heights at the heel in m."""

    teeth: int
    pitch: float
    base: float
    tip: float
    root: float
    half_pitch: float
    addendum: float
    dedendum: float
    bore: float

    def arc(self, polar: float) -> float:
        """Arc ψ along the line of action from the base circle to a polar angle φ: cos φ = cos δ_b cos ψ. 0 below the base circle."""
        squared = sin(polar - self.base) * sin(polar + self.base)
        return atan2(math.sqrt(squared), cos(polar)) if squared > 0.0 else 0.0

    def involute(self, polar: float) -> float:
        """Azimuth of the flank relative to its base point: ψ/sin δ_b − atan2(tan ψ, sin δ_b)."""
        arc, base = self.arc(polar), sin(self.base)
        return arc / base - atan2(tan(arc), base)

    def half_angle(self, polar: float) -> float:
        """Half of the tooth's angle about its axis, at a polar angle."""
        return self.half_pitch + self.involute(self.pitch) - self.involute(polar)


@dataclass(frozen=True)
class Pair:
    """Planet and side gear at right angles. Lengths in m, angles in rad."""

    gears: tuple[Gear, Gear]
    module: float
    pressure_angle: float
    face_width: float
    planets: int
    outer_cone: float
    thickness_shift: float

    @classmethod
    def of(cls, values: Mapping) -> "Pair":
        """Reads the FMU's parameters `geometry.*`, by name, SI."""
        given = {name.removeprefix("geometry."): value for name, value in values.items() if name.startswith("geometry.")}
        module, alpha = given["module"], given["pressure_angle"]
        teeth = (given["planet_teeth"], given["side_teeth"])
        first = atan2(teeth[0], teeth[1])
        pitch = (first, 0.5 * pi - first)
        addenda, dedenda = heights(given)
        outer = 0.5 * module * math.hypot(*teeth)
        shift = (addenda[0] - addenda[1]) / (2.0 * module)
        gears = []
        for i, sign in enumerate((1.0, -1.0)):
            # planar thickness at the outer pitch circle; each tooth is thinner by half of the backlash
            moved = sign * (2.0 * shift * tan(alpha) + given["thickness_shift"])
            half = (0.5 * pi + moved - given["backlash"] / (2.0 * module)) / teeth[i]
            gears.append(Gear(teeth[i], pitch[i], math.asin(sin(pitch[i]) * cos(alpha)), pitch[i] + atan2(addenda[i], outer),
                              pitch[i] - atan2(dedenda[i], outer), half, addenda[i], dedenda[i],
                              given[("planet_bore", "side_bore")[i]]))
        return cls((gears[0], gears[1]), module, alpha, given["face_width"], given["planet_count"], outer, given["thickness_shift"])

    @property
    def inner_cone(self) -> float:
        """R_i, cone distance of the toe."""
        return self.outer_cone - self.face_width

    @property
    def contact_ratio(self) -> float:
        """ε_α: path of contact over base pitch. A tip or a base circle limits each end of the path."""
        arcs = [gear.arc(gear.pitch) for gear in self.gears]
        tips = [gear.arc(gear.tip) for gear in self.gears]
        low, high = max(arcs[1] - tips[1], -arcs[0]), min(tips[0] - arcs[0], arcs[1])
        return (high - low) * self.gears[0].teeth / (2.0 * pi * sin(self.gears[0].base))

    def land(self, i: int) -> float:
        """Width of the tip of gear i at the heel; negative if its flanks intersect below the tip."""
        gear = self.gears[i]
        return 2.0 * gear.half_angle(gear.tip) * sin(gear.tip) * self.outer_cone

    def addendum_over_limit(self, i: int) -> float:
        """Length by which the tip of gear i is past its mate's base circle, as an arc of the line of action; negative if it is not."""
        return self.gears[i].arc(self.gears[i].tip) - sum(gear.arc(gear.pitch) for gear in self.gears)

    def toe_root(self, i: int) -> float:
        """Radius of the root circle of gear i at the toe, where the gear is thinnest."""
        return self.inner_cone * sin(self.gears[i].root)

    def back_face(self, i: int) -> float:
        """Radius of the back face of gear i, equal to the radius of the root circle at the heel."""
        return self.outer_cone * sin(self.gears[i].root)

    def rim(self, i: int) -> float:
        """Thickness of gear i at the toe, from its bore perpendicular to its root cone."""
        return (self.toe_root(i) - 0.5 * self.gears[i].bore) / cos(self.gears[i].root)

    def between_planets(self) -> float:
        """Angle between the tip cones of neighbouring planets; negative if they collide."""
        return 2.0 * pi / self.planets - 2.0 * self.gears[0].tip


def heights(given: Mapping) -> tuple[tuple[float, float], tuple[float, float]]:
    """Addenda and dedenda at the heel (planet, side gear), m, by the addendum system."""
    module, system = given["module"], given["addendum_system"]
    if system == EXPLICIT:
        return ((given["planet_addendum"] * module, given["side_addendum"] * module),
                (given["planet_dedendum"] * module, given["side_dedendum"] * module))
    if system == STANDARD:
        return (module, module), (1.25 * module, 1.25 * module)
    # long and short addenda by the ratio of virtual teeth, which is the square of the gear ratio at 90 degrees
    teeth = (given["planet_teeth"], given["side_teeth"])
    ratio = (max(teeth) / min(teeth)) ** 2
    if system == GLEASON:
        large, whole = (0.540 + 0.460 / ratio) * module, 2.188 * module + GLEASON_CLEARANCE
    else:
        large, whole = 2.0 * module * (0.21 + 0.29 / ratio), 2.25 * module
    addenda = (2.0 * module - large, large)
    dedenda = (whole - addenda[0], whole - addenda[1])
    return (addenda, dedenda) if teeth[0] <= teeth[1] else (addenda[::-1], dedenda[::-1])


def violations(pair: Pair) -> dict[str, float]:
    """Excess over each broken limit by the name of the check, relative to the limit or to the module. Empty for a sound pair."""
    module, found = pair.module, {}
    if 2 * pair.gears[1].teeth % pair.planets:
        # whole numbers have no measure of nearness
        found["assembly"] = 1.0
    _note(found, "toe", LEAST_INNER_CONE - pair.inner_cone / pair.outer_cone)
    for i, (gear, mate) in enumerate(zip(pair.gears, pair.gears[::-1])):
        _note(found, f"root cone of the {NAMES[i]}", (LEAST_ROOT_ANGLE - gear.root) / LEAST_ROOT_ANGLE)
        _note(found, f"tip of the {NAMES[i]} strikes a root", (gear.addendum - mate.dedendum) / module, closed=True)
        _note(found, f"thickness of the {NAMES[i]}'s teeth", -gear.half_pitch * gear.teeth, closed=True)
    if found:
        # the shapes below need teeth
        return found
    for i, gear in enumerate(pair.gears):
        _note(found, f"bore of the {NAMES[i]}", (0.5 * gear.bore - pair.toe_root(i)) / module, closed=True)
        _note(found, f"tip land of the {NAMES[i]}", LAND - pair.land(i) / module)
        depth = (gear.addendum + gear.dedendum) * pair.inner_cone / pair.outer_cone
        if gear.bore > 0.0:
            _note(found, f"rim of the {NAMES[i]}", (RIM - pair.rim(i) / depth) / RIM)
        # the tip of the side gear undercuts the planet, and vice versa
        _note(found, f"undercut of the {NAMES[1 - i]}", pair.addendum_over_limit(i) * pair.outer_cone / module)
    _note(found, "planets strike each other", -pair.between_planets())
    _note(found, "face width", pair.face_width / pair.outer_cone / FACE_WIDTH - 1.0)
    _note(found, "contact ratio", 1.0 - pair.contact_ratio)
    return found


def tool_room(pair: Pair, tool_radius: float) -> float:
    """Room for the rounded tip of the tool that cuts the roots, in modules. It is negative if a tip radius of ρ modules does not fit.

    The tool is a basic rack with pressure angle α, clearance c and depth h below the pitch line (ISO 53). Its straight flank must reach
    down to the working depth, ρ ≤ c/(m (1 − sin α)), and its tip must be wide enough, ρ ≤ (π/4 ∓ k/2 − h/m tan α) cos α/(1 − sin α) with the shift k of thickness, − for the planet."""
    planet, side = pair.gears
    alpha, shift = pair.pressure_angle, 0.5 * (planet.addendum - side.addendum)
    clearance = min(planet.dedendum - side.addendum, side.dedendum - planet.addendum) / pair.module
    depths = (planet.dedendum + shift, side.dedendum - shift)
    # a tool for thicker teeth is thinner
    widths = (0.25 * pi - sign * 0.5 * pair.thickness_shift - depth / pair.module * tan(alpha) for sign, depth in zip((1.0, -1.0), depths))
    widest = min(widths) * cos(alpha)
    return min(clearance, widest) / (1.0 - sin(alpha)) - tool_radius


def _note(found, name, excess, closed=False):
    """Adds an excess above 0. If `closed`, equality breaks the limit too."""
    if excess > 0.0 or (closed and excess == 0.0):
        found[name] = max(excess, 1e-9)
