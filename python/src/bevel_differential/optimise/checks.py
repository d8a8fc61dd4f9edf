"""By how much a pair misses what the FMU builds or leaves without a warning: the checks of src/geometry, graded.

A search needs to know which of two designs is nearer to a good one. The FMU says only that a design is refused or warned of."""

from math import cos, pi, sin, tan

from .pair import Pair

NAMES = ("planet", "side gear")
# limits of src/geometry/checks.rs: face width over R_e by ISO 23509 practice, tip land and rim in modules
FACE_WIDTH, LAND, RIM = 1.0 / 3.0, 0.2, 2.0
LEAST_INNER_CONE, LEAST_ROOT_ANGLE = 0.1, 0.02


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
        toe_module = module * pair.inner_cone / pair.outer_cone
        if gear.bore > 0.0:
            _note(found, f"rim of the {NAMES[i]}", (RIM - pair.rim(i) / toe_module) / RIM)
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
