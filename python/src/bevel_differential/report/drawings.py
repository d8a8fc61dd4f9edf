"""Drawings of the gears. One is an axial section with cones, face, bodies and dimensions. The other shows teeth in mesh at the heel:
closed forms of the spherical involute, unrolled about the pitch point."""

import math

import numpy as np

from ..pair import Gear, Pair
from ..panel import Mark, Panel, curve
from . import words
from .simulated import Simulated
from .svg_style import BLUE, OCHRE, RED, TEXT_COLOUR

MM = 1e3
PLANET, SIDE = OCHRE, BLUE
NODES = 24
# number of teeth drawn on either side of the middle, and half the width of the picture in pitches
NEIGHBOURS, SHOWN = 3, 2.3


def section(pair: Pair) -> Panel:
    """Section in the plane of the carrier's axis (horizontal) and the planets' axes (vertical)."""
    return Panel("", "", [*_section(pair), *_dimensions(pair), Mark("set_axis_off")], aspect="equal")


def _section(pair):
    # each gear is drawn in its half plane: radius across, axis along; planets last, because teeth overlap in the mesh
    for sense in (1.0, -1.0):
        yield from _gear(pair, 1, lambda radius, axis, sense=sense: (-sense * axis, radius), SIDE)
    for sense in (1.0, -1.0):
        yield from _gear(pair, 0, lambda radius, axis, sense=sense: (radius, sense * axis), PLANET)
    reach, tilt = MM * pair.outer_cone, pair.gears[1].pitch
    along, up = (reach * math.cos(pair.gears[i].root) + 4.0 for i in (1, 0))
    for begin, end in (((-along, 0.0), (along, 0.0)), ((0.0, -up), (0.0, up))):
        yield curve(*zip(begin, end), None, TEXT_COLOUR, "-.", lw=0.8, alpha=0.7)
    for turn in (tilt, math.pi - tilt, math.pi + tilt, -tilt):
        yield curve([0.0, reach * math.cos(turn)], [0.0, reach * math.sin(turn)], None, TEXT_COLOUR, "--", lw=0.8, alpha=0.7)


def _gear(pair, i, position, colour):
    """Teeth and body on both sides of the axis, mirrored."""
    gear = pair.gears[i]
    inner, outer = MM * pair.inner_cone, MM * pair.outer_cone
    bore = 0.5 * MM * gear.bore

    def point(cone, angle):
        return cone * math.sin(angle), cone * math.cos(angle)

    turn = np.linspace(gear.root, gear.tip, 12)
    teeth = [point(inner, angle) for angle in turn] + [point(outer, angle) for angle in turn[::-1]]
    back, front = outer * math.cos(gear.root), inner * math.cos(gear.root)
    body = [point(inner, gear.root), point(outer, gear.root), (bore, back), (bore, front)]
    for mirror in (1.0, -1.0):
        for shape, alpha in ((body, 0.28), (teeth, 0.75)):
            points = np.array([position(mirror * radius, axis) for radius, axis in shape])
            yield Mark("fill", *points.T, facecolor=colour, alpha=alpha, lw=0)
            yield curve(*np.vstack([points, points[:1]]).T, None, colour, lw=1.0)


def _dimensions(pair):
    """Cone distance along a pitch line, face next to it, diameters outside, and angles in the middle."""
    planet, side = pair.gears
    reach = MM * pair.outer_cone
    along = np.array([math.cos(side.pitch), math.sin(side.pitch)])
    # outside both gears, past the tips of the planet
    beyond = np.array([-along[1], along[0]]) * -(reach * math.sin(planet.tip - planet.pitch) + 7.0)
    yield from _between(along * MM * pair.inner_cone, along * reach, beyond, f"b = {words.mm(pair.face_width)}")
    down = along * (1.0, -1.0)
    yield from _between(np.zeros(2), down * reach, np.zeros(2), f"Rₑ = {words.mm(pair.outer_cone)}", 0.27)
    top, width = reach * math.cos(planet.pitch), reach * math.sin(planet.pitch)
    yield from _between(np.array([-width, top]), np.array([width, top]), np.array([0.0, reach * math.cos(planet.root) + 7.0 - top]),
             f"planet dₑ = {words.mm(pair.module * planet.teeth)}")
    back, half = reach * math.cos(side.pitch), reach * math.sin(side.pitch)
    yield from _between(np.array([-back, -half]), np.array([-back, half]), np.array([back - reach * math.cos(side.root) - 9.0, 0.0]),
             f"side gear dₑ = {words.mm(pair.module * side.teeth)}")
    radius = 0.55 * MM * pair.inner_cone
    for begin, end, gear in ((0.0, side.pitch, side), (side.pitch, 0.5 * math.pi, planet)):
        turn = np.linspace(begin, end, 40)
        yield curve(radius * np.cos(turn), radius * np.sin(turn), None, TEXT_COLOUR, lw=0.8)
        middle = 0.5 * (begin + end)
        yield Mark("text", (radius + 0.8) * math.cos(middle), (radius + 0.8) * math.sin(middle), f"{math.degrees(gear.pitch):.1f}°", fontsize=8.5,
                   ha="left", va="bottom")
    middle = 0.5 * (reach + MM * pair.inner_cone)
    for i, gear, name in ((1, side, "side gear"), (0, planet, "planet")):
        name += f", bore {words.mm(gear.bore)}" if gear.bore > 0.0 else ""
        for sense, which in ((-1.0, "left "), (1.0, "right ")) if i else ((-1.0, ""),):
            along_axis = sense * middle * math.cos(gear.root)
            position = (along_axis, -0.3 * half) if i else (0.3 * width, along_axis)
            yield Mark("text", *position, which + name, fontsize=9, ha="center", va="center", rotation=90 if i else 0)


def _between(begin, end, offset, text, position=0.5):
    """Offset dimension between two points, with extension lines. Its text is at the fraction `position` of its length."""
    for point in (begin, end):
        yield curve(*zip(point, point + 1.04 * offset), None, TEXT_COLOUR, lw=0.5, alpha=0.6)
    first, last = begin + offset, end + offset
    yield Mark("annotate", "", first, last, arrowprops={"arrowstyle": "<->", "color": TEXT_COLOUR, "lw": 0.8, "shrinkA": 0, "shrinkB": 0})
    turned = math.degrees(math.atan2(*(last - first)[::-1]))
    # text is upright, or readable from below
    turned = 90.0 - (90.0 - turned) % 180.0
    yield Mark("text", *(first + position * (last - first)), text, rotation=turned, rotation_mode="anchor", ha="center", va="bottom",
               fontsize=8.5)


def teeth(run: Simulated, pair: Pair) -> Panel:
    """Planet 1 and the left side gear at the end of the run, in the carrier's frame."""
    last = run.record[-1]
    planet_turn = float(last["planet[1].spin_angle"])
    side_turn = float(last["left.angle"] - last["carrier.angle"])
    planet, side = pair.gears
    # tooth 0 of the planet faces a gap of the left side gear
    marks = [*_teeth(pair, planet, 0.0, lambda polar, azimuth: _planet(polar, azimuth - planet_turn), PLANET, "planet 1"),
             *_teeth(pair, side, math.pi / side.teeth, lambda polar, azimuth: _side(polar, azimuth + side_turn), SIDE, "left side gear"),
             *_action(pair)]
    half = SHOWN * math.pi * pair.module * MM
    return Panel("along the pitch circles at the heel, mm", "toward the planet's axis, mm", marks, legend="above", columns=5,
                 xlim=(-half, half), ylim=(-0.36 * half, 0.36 * half), aspect="equal")


def outline(gear: Gear) -> np.ndarray:
    """Polar angles and azimuths (rad) of one tooth with half a gap on each side, shape (points, 2). They are in this order: root land,
    straight line to the base circle if it is above the root, involute, tip land, and back."""
    foot = max(gear.root, gear.base)
    flank = np.linspace(foot, gear.tip, NODES)
    halves = np.array([gear.half_angle(polar) for polar in flank])
    pitch = math.pi / gear.teeth
    root = np.linspace(-pitch, -halves[0], 4)
    tip = np.linspace(-halves[-1], halves[-1], 6)[1:-1]
    left = np.concatenate([np.column_stack([np.full(4, gear.root), root]), np.column_stack([flank, -halves])])
    right = left[::-1] * (1.0, -1.0)
    return np.vstack([left, np.column_stack([np.full(4, gear.tip), tip]), right])


def _teeth(pair, gear, first, position, colour, label):
    """Teeth near the pitch point as one closed shape, and the pitch circle."""
    step = 2.0 * math.pi / gear.teeth
    # tooth nearest to the pitch point
    middle = min(range(gear.teeth), key=lambda k: math.hypot(*unrolled(pair, position(gear.pitch, first + k * step))))
    points = np.vstack([outline(gear) + (0.0, first + (middle + k) * step) for k in range(-NEIGHBOURS, NEIGHBOURS + 1)])
    first_end, last_end = (unrolled(pair, position(*points[k]))[0] for k in (0, -1))
    if last_end < first_end:
        points = points[::-1]
    profile = np.array([unrolled(pair, position(polar, azimuth)) for polar, azimuth in points])
    below = np.array([unrolled(pair, position(gear.root - 0.35 * (gear.tip - gear.root), azimuth)) for azimuth in points[::-1, 1]])
    shape = np.vstack([profile, below])
    yield Mark("fill", *shape.T, color=colour, alpha=0.4, lw=0, label=label)
    yield curve(*profile.T, None, colour, lw=1.5)
    circle = np.array([unrolled(pair, position(gear.pitch, azimuth)) for azimuth in np.linspace(*points[[0, -1], 1], 60)])
    yield curve(*circle.T, f"pitch circle, {label}", colour, "-.", lw=0.8)


def _planet(polar, azimuth):
    """Direction in the planet's frame (tooth 0 at azimuth 0) as (along the left half-shaft, along the planet's axis, third)."""
    return math.sin(polar) * math.cos(azimuth), math.cos(polar), -math.sin(polar) * math.sin(azimuth)


def _side(polar, azimuth):
    """Direction in the left side gear's frame (azimuth 0 at the planet's axis), in the components of `_planet`."""
    return math.cos(polar), math.sin(polar) * math.cos(azimuth), math.sin(polar) * math.sin(azimuth)


def unrolled(pair: Pair, direction: tuple[float, float, float]) -> tuple[float, float]:
    """Position of a direction from the apex on the heel, mm from the pitch point, as seen from outside. Its distance on the sphere and its
    direction are kept."""
    along, up, third = direction
    sine, cosine = math.sin(pair.gears[0].pitch), math.cos(pair.gears[0].pitch)
    depth = sine * along + cosine * up
    rise = sine * up - cosine * along
    flat = math.hypot(rise, third)
    angle = math.atan2(flat, depth)
    scale = MM * pair.outer_cone * (angle / flat if flat > 0.0 else 1.0)
    return -scale * third, scale * rise


def _action(pair):
    """Great circle through the pitch point that is tangent to both base circles."""
    planet, side = pair.gears
    ends = [MM * pair.outer_cone * planet.arc(planet.pitch), -MM * pair.outer_cone * side.arc(side.pitch)]
    slope = np.array([math.cos(pair.pressure_angle), math.sin(pair.pressure_angle)])
    yield curve(*np.outer(slope, ends), "line of action", RED, "--", lw=1.1)
    yield curve(0.0, 0.0, None, RED, "o", ms=4)
