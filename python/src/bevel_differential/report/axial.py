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
        for sense in (1.0, -1.0):
            # a gear in its own half plane: radius across, axis along
            _gear(axes, pair, 1, lambda radius, axis, sense=sense: (-sense * axis, radius), SIDE)
            _gear(axes, pair, 0, lambda radius, axis, sense=sense: (radius, sense * axis), PLANET)
        reach = MM * pair.outer_cone
        for sense in (1.0, -1.0):
            _line(axes, (-1.12 * reach, 0.0), (1.12 * reach, 0.0), "-.") if sense > 0.0 else _line(
                axes, (0.0, -1.12 * reach), (0.0, 1.12 * reach), "-.")
            tilt = pair.gears[1].pitch
            _line(axes, (0.0, 0.0), (sense * reach * math.cos(tilt), reach * math.sin(tilt)), "--")
            _line(axes, (0.0, 0.0), (sense * reach * math.cos(tilt), -reach * math.sin(tilt)), "--")
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
    body = [point(inner, gear.root), point(outer, gear.root), (bore, outer * math.cos(gear.root)), (bore, inner * math.cos(gear.root))]
    for mirror in (1.0, -1.0):
        for shape, alpha in ((body, 0.28), (teeth, 0.75)):
            points = np.array([place(mirror * radius, axis) for radius, axis in shape])
            axes.fill(*points.T, facecolor=colour, alpha=alpha, lw=0)
            axes.plot(*np.vstack([points, points[:1]]).T, color=colour, lw=1.0)


def _line(axes, begin, end, dash):
    axes.plot(*zip(begin, end), color=style.INK, lw=0.8, ls=dash, alpha=0.7)


def _dimensions(axes, pair):
    """Cone distance and face along the pitch line, diameters outside."""
    planet, side = pair.gears
    reach = MM * pair.outer_cone
    along = np.array([math.cos(side.pitch), math.sin(side.pitch)])
    across = np.array([-along[1], along[0]])
    # beside the upper right pitch line, outside the planet's tip cone
    far = reach * math.sin(side.tip - side.pitch) + 6.0
    _between(axes, along * MM * pair.inner_cone, along * reach, across * -far, f"b = {_mm(pair.face_width)}")
    _between(axes, np.zeros(2), along * reach, across * -(far + 9.0), f"R_e = {_mm(pair.outer_cone)}")
    top = reach * math.cos(planet.root) + 7.0
    width = reach * math.sin(planet.pitch)
    _between(axes, np.array([-width, reach * math.cos(planet.pitch)]), np.array([width, reach * math.cos(planet.pitch)]),
             np.array([0.0, top - reach * math.cos(planet.pitch)]), f"planet d_e = {_mm(pair.module * planet.teeth)}")
    left = reach * math.cos(side.root) + 9.0
    half = reach * math.sin(side.pitch)
    _between(axes, np.array([-reach * math.cos(side.pitch), -half]), np.array([-reach * math.cos(side.pitch), half]),
             np.array([-left + reach * math.cos(side.pitch), 0.0]), f"side gear d_e = {_mm(pair.module * side.teeth)}")
    for angle, gear, name in ((side.pitch, side, "side gear"), (0.5 * math.pi, planet, "planet")):
        begin = 0.0 if name == "side gear" else side.pitch
        turn = np.linspace(begin, angle, 40)
        radius = 0.36 * reach if name == "side gear" else 0.28 * reach
        axes.plot(radius * np.cos(turn), radius * np.sin(turn), color=style.INK, lw=0.8)
        middle = 0.5 * (begin + angle)
        axes.text((radius + 1.5) * math.cos(middle), (radius + 1.5) * math.sin(middle), f"δ = {math.degrees(gear.pitch):.2f}°", fontsize=8.5)
    for gear, place in ((side, (-reach * math.cos(side.root) * 0.93, 0.0)), (planet, (0.0, reach * math.cos(planet.root) * 0.9))):
        if gear.bore > 0.0:
            axes.text(*place, f"⌀ {_mm(gear.bore)}", ha="center", va="center", fontsize=8.5)
    axes.text(-reach * math.cos(side.pitch) * 0.86, -2.0, "left side gear", fontsize=9, ha="left", va="top")
    axes.text(reach * math.cos(side.pitch) * 0.86, -2.0, "right side gear", fontsize=9, ha="right", va="top")
    axes.text(2.0, -reach * math.cos(planet.pitch) * 0.9, "planet", fontsize=9)


def _between(axes, begin, end, offset, text):
    """A dimension from point to point, moved aside, with its extension lines."""
    for point in (begin, end):
        axes.plot(*zip(point, point + 1.04 * offset), color=style.INK, lw=0.5, alpha=0.6)
    first, last = begin + offset, end + offset
    axes.annotate("", first, last, arrowprops={"arrowstyle": "<->", "color": style.INK, "lw": 0.8, "shrinkA": 0, "shrinkB": 0})
    turned = math.degrees(math.atan2(*(last - first)[::-1]))
    turned = (turned + 90.0) % 180.0 - 90.0
    middle = 0.5 * (first + last)
    axes.text(*middle, text, rotation=turned, rotation_mode="anchor", ha="center", va="bottom", fontsize=8.5)


def _mm(length):
    return words.quantity(MM * length, "mm")
