"""Planet and side gear in closed form: cones, heights, lands and contact, by the formulas of src/geometry, and its checks, graded.

The FMU decides what can be built, and says only that a design is refused or warned of. A search needs to know which of two designs
is nearer to a good one: these formulas say by how much a design misses it, and dimension what stands around the gears. Terms of
ISO 23509:2016. Planet first, then side gear, in all pairs of values."""

import math
from collections.abc import Mapping
from dataclasses import dataclass
from math import atan2, cos, pi, sin, tan

# addendum systems of the FMU
STANDARD, GLEASON, ISO_23509, EXPLICIT = 1, 2, 3, 4
# Gleason's constant part of the clearance, m
GLEASON_CLEARANCE = 0.05e-3
NAMES = ("planet", "side gear")
# limits of src/geometry/checks.rs: face width over R_e, tip land in modules, rim at the toe over the tooth depth there
FACE_WIDTH, LAND, RIM = 0.5, 0.2, 0.5
LEAST_INNER_CONE, LEAST_ROOT_ANGLE = 0.1, 0.02


@dataclass(frozen=True)
class Gear:
    """A gear on the unit sphere: angles in rad, heights at the heel in m."""

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
        """Arc ψ along the line of action from the base circle to a polar angle φ: cos φ = cos δ_b cos ψ; 0 below the base."""
        squared = sin(polar - self.base) * sin(polar + self.base)
        return atan2(math.sqrt(squared), cos(polar)) if squared > 0.0 else 0.0

    def involute(self, polar: float) -> float:
        """Azimuth by which the flank has bent from its base point: ψ/sin δ_b − atan2(tan ψ, sin δ_b)."""
        arc, base = self.arc(polar), sin(self.base)
        return arc / base - atan2(tan(arc), base)

    def half_angle(self, polar: float) -> float:
        """Half of the tooth's angle about its axis at a polar angle."""
        return self.half_pitch + self.involute(self.pitch) - self.involute(polar)


@dataclass(frozen=True)
class Pair:
    """A planet and a side gear at right angles. Lengths in m, angles in rad."""

    gears: tuple[Gear, Gear]
    module: float
    pressure_angle: float
    face_width: float
    planets: int
    outer_cone: float

    @classmethod
    def of(cls, values: Mapping) -> "Pair":
        """From the FMU's parameters `geometry.*`, by name, SI."""
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
            # planar thickness at the outer pitch circle, each tooth thinned by half of the backlash
            half = (0.5 * pi + 2.0 * sign * shift * tan(alpha) - given["backlash"] / (2.0 * module)) / teeth[i]
            gears.append(Gear(teeth[i], pitch[i], math.asin(sin(pitch[i]) * cos(alpha)), pitch[i] + atan2(addenda[i], outer),
                              pitch[i] - atan2(dedenda[i], outer), half, addenda[i], dedenda[i],
                              given[("planet_bore", "side_bore")[i]]))
        return cls((gears[0], gears[1]), module, alpha, given["face_width"], given["planet_count"], outer)

    @property
    def inner_cone(self) -> float:
        """R_i, to the toe."""
        return self.outer_cone - self.face_width

    @property
    def contact_ratio(self) -> float:
        """ε_α: path of contact over base pitch. The path ends where a tip or a base circle ends it."""
        arcs = [gear.arc(gear.pitch) for gear in self.gears]
        tips = [gear.arc(gear.tip) for gear in self.gears]
        low, high = max(arcs[1] - tips[1], -arcs[0]), min(tips[0] - arcs[0], arcs[1])
        return (high - low) * self.gears[0].teeth / (2.0 * pi * sin(self.gears[0].base))

    def land(self, i: int) -> float:
        """Width of gear i's tip at the heel; negative where its flanks meet below."""
        gear = self.gears[i]
        return 2.0 * gear.half_angle(gear.tip) * sin(gear.tip) * self.outer_cone

    def addendum_over_limit(self, i: int) -> float:
        """How far gear i's tip reaches past its mate's base circle, arc of the line of action; negative where it does not."""
        return self.gears[i].arc(self.gears[i].tip) - sum(gear.arc(gear.pitch) for gear in self.gears)

    def toe_root(self, i: int) -> float:
        """Radius of gear i's root circle at the toe, where it is thinnest."""
        return self.inner_cone * sin(self.gears[i].root)

    def back_face(self, i: int) -> float:
        """Radius of gear i's back face: that of the root circle at the heel."""
        return self.outer_cone * sin(self.gears[i].root)

    def rim(self, i: int) -> float:
        """Thickness of gear i at the toe, from its bore square to its root cone."""
        return (self.toe_root(i) - 0.5 * self.gears[i].bore) / cos(self.gears[i].root)

    def between_planets(self) -> float:
        """Angle between the tip cones of neighbouring planets; negative where they strike each other."""
        return 2.0 * pi / self.planets - 2.0 * self.gears[0].tip


def heights(given: Mapping) -> tuple[tuple[float, float], tuple[float, float]]:
    """Addenda and dedenda at the heel (planet, side gear), m, by the addendum system."""
    module, system = given["module"], given["addendum_system"]
    if system == EXPLICIT:
        return ((given["planet_addendum"] * module, given["side_addendum"] * module),
                (given["planet_dedendum"] * module, given["side_dedendum"] * module))
    if system == STANDARD:
        return (module, module), (1.25 * module, 1.25 * module)
    # long and short addenda by the ratio of virtual teeth, which is the square of that of the teeth at 90 degrees
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
    """Excess over each limit that is broken, relative to it or to the module, by name of the check; empty for a sound pair."""
    module, found = pair.module, {}
    if 2 * pair.gears[1].teeth % pair.planets:
        # whole numbers have no near miss
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
        # the side gear's tip undercuts the planet, and the other way round
        _note(found, f"undercut of the {NAMES[1 - i]}", pair.addendum_over_limit(i) * pair.outer_cone / module)
    _note(found, "planets strike each other", -pair.between_planets())
    _note(found, "face width", pair.face_width / pair.outer_cone / FACE_WIDTH - 1.0)
    _note(found, "contact ratio", 1.0 - pair.contact_ratio)
    return found


def tool_room(pair: Pair, tool_radius: float) -> float:
    """Room for the rounded tip of the tool that cuts the roots, in modules; below 0 a tip radius of ρ modules does not fit.

    Of a basic rack with pressure angle α, clearance c and depth h below the pitch line (ISO 53): the straight flank must reach
    down to the working depth, ρ ≤ c/(m (1 − sin α)), and the tip be wide enough, ρ ≤ (π/4 − h/m tan α) cos α/(1 − sin α)."""
    planet, side = pair.gears
    alpha, shift = pair.pressure_angle, 0.5 * (planet.addendum - side.addendum)
    clearance = min(planet.dedendum - side.addendum, side.dedendum - planet.addendum) / pair.module
    depth = max(planet.dedendum + shift, side.dedendum - shift) / pair.module
    widest = (0.25 * pi - depth * tan(alpha)) * cos(alpha)
    return min(clearance, widest) / (1.0 - sin(alpha)) - tool_radius


def _note(found, name, excess, closed=False):
    """Notes an excess above 0; `closed`: equality breaks the limit too."""
    if excess > 0.0 or (closed and excess == 0.0):
        found[name] = max(excess, 1e-9)
