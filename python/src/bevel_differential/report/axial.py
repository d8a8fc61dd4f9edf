"""An axial section of the differential: cones, face, bodies and dimensions."""

import math

import numpy as np

from ..optimise.pair import Pair
from . import style, words

MM = 1e3
PLANET, SIDE = style.OCHRE, style.BLUE


def draw_section(pair: Pair) -> str:
    """The section in the plane of the carrier's axis (across the page) and the planets' axes (upright)."""
    with style.styled():
        picture = style.figure(6.0)
        axes = picture.subplots()
        # a gear in its own half plane: radius across, axis along; planets last, as the teeth cover each other in the mesh
        for sense in (1.0, -1.0):
            _gear(axes, pair, 1, lambda radius, axis, sense=sense: (-sense * axis, radius), SIDE)
        for sense in (1.0, -1.0):
            _gear(axes, pair, 0, lambda radius, axis, sense=sense: (radius, sense * axis), PLANET)
        reach, tilt = MM * pair.outer_cone, pair.gears[1].pitch
        along, up = (reach * math.cos(pair.gears[i].root) + 4.0 for i in (1, 0))
        for begin, end in (((-along, 0.0), (along, 0.0)), ((0.0, -up), (0.0, up))):
            axes.plot(*zip(begin, end), color=style.INK, lw=0.8, ls="-.", alpha=0.7)
        for turn in (tilt, math.pi - tilt, math.pi + tilt, -tilt):
            axes.plot([0.0, reach * math.cos(turn)], [0.0, reach * math.sin(turn)], color=style.INK, lw=0.8, ls="--", alpha=0.7)
        _dimensions(axes, pair)
        axes.set_aspect("equal")
        axes.set_axis_off()
        return style.svg(picture, "section")


def _gear(axes, pair, i, place, colour):
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
            points = np.array([place(mirror * radius, axis) for radius, axis in shape])
            axes.fill(*points.T, facecolor=colour, alpha=alpha, lw=0)
            axes.plot(*np.vstack([points, points[:1]]).T, color=colour, lw=1.0)


def _dimensions(axes, pair):
    """Cone distance along a pitch line, face beside it, diameters outside, angles in the middle."""
    planet, side = pair.gears
    reach = MM * pair.outer_cone
    along = np.array([math.cos(side.pitch), math.sin(side.pitch)])
    # beyond the tips of the planet, outside both gears
    beyond = np.array([-along[1], along[0]]) * -(reach * math.sin(planet.tip - planet.pitch) + 7.0)
    _between(axes, along * MM * pair.inner_cone, along * reach, beyond, f"b = {_mm(pair.face_width)}")
    down = along * (1.0, -1.0)
    _between(axes, np.zeros(2), down * reach, np.zeros(2), f"Rₑ = {_mm(pair.outer_cone)}", 0.27)
    top, width = reach * math.cos(planet.pitch), reach * math.sin(planet.pitch)
    _between(axes, np.array([-width, top]), np.array([width, top]), np.array([0.0, reach * math.cos(planet.root) + 7.0 - top]),
             f"planet dₑ = {_mm(pair.module * planet.teeth)}")
    back, half = reach * math.cos(side.pitch), reach * math.sin(side.pitch)
    _between(axes, np.array([-back, -half]), np.array([-back, half]), np.array([back - reach * math.cos(side.root) - 9.0, 0.0]),
             f"side gear dₑ = {_mm(pair.module * side.teeth)}")
    radius = 0.55 * MM * pair.inner_cone
    for begin, end, gear in ((0.0, side.pitch, side), (side.pitch, 0.5 * math.pi, planet)):
        turn = np.linspace(begin, end, 40)
        axes.plot(radius * np.cos(turn), radius * np.sin(turn), color=style.INK, lw=0.8)
        middle = 0.5 * (begin + end)
        axes.text((radius + 0.8) * math.cos(middle), (radius + 0.8) * math.sin(middle), f"{math.degrees(gear.pitch):.1f}°",
                  fontsize=8.5, ha="left", va="bottom")
    middle = 0.5 * (reach + MM * pair.inner_cone)
    for i, gear, name in ((1, side, "side gear"), (0, planet, "planet")):
        name += f", bore {_mm(gear.bore)}" if gear.bore > 0.0 else ""
        for sense, which in ((-1.0, "left "), (1.0, "right ")) if i else ((-1.0, ""),):
            along_axis = sense * middle * math.cos(gear.root)
            place = (along_axis, -0.3 * half) if i else (0.3 * width, along_axis)
            axes.text(*place, which + name, fontsize=9, ha="center", va="center", rotation=90 if i else 0)


def _between(axes, begin, end, offset, text, place=0.5):
    """A dimension from point to point, moved aside, with its extension lines and its text at a place between."""
    for point in (begin, end):
        axes.plot(*zip(point, point + 1.04 * offset), color=style.INK, lw=0.5, alpha=0.6)
    first, last = begin + offset, end + offset
    axes.annotate("", first, last, arrowprops={"arrowstyle": "<->", "color": style.INK, "lw": 0.8, "shrinkA": 0, "shrinkB": 0})
    turned = math.degrees(math.atan2(*(last - first)[::-1]))
    # letters stand upright, or read from below
    turned = 90.0 - (90.0 - turned) % 180.0
    axes.text(*(first + place * (last - first)), text, rotation=turned, rotation_mode="anchor", ha="center", va="bottom",
              fontsize=8.5)


def _mm(length):
    return words.quantity(MM * length, "mm")
