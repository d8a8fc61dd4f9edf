"""Teeth in mesh at the heel: closed forms of the spherical involute, unrolled about the pitch point."""

import math

import numpy as np

from ..optimise.pair import Gear, Pair
from . import style
from .simulated import Simulated

MM = 1e3
NODES = 24
# teeth that are drawn on either side of the middle, and half the width of the picture in pitches
NEIGHBOURS, SHOWN = 3, 2.3


def draw_teeth(run: Simulated, pair: Pair) -> str:
    """Planet 1 and the left side gear as they stand at the end of the run, in the carrier's frame."""
    last = run.record[-1]
    planet_turn = float(last["planet[1].spin_angle"])
    side_turn = float(last["left.angle"] - last["carrier.angle"])
    planet, side = pair.gears
    with style.styled():
        picture = style.figure(4.3)
        axes = picture.subplots()
        # the planet's tooth 0 faces the left side gear, which has a gap there
        _draw(axes, pair, planet, 0.0, lambda polar, azimuth: _planet(polar, azimuth - planet_turn), style.OCHRE, "planet 1")
        _draw(axes, pair, side, math.pi / side.teeth, lambda polar, azimuth: _side(polar, azimuth + side_turn), style.BLUE,
              "left side gear")
        _action(axes, pair)
        half = SHOWN * math.pi * pair.module * MM
        axes.set(xlim=(-half, half), ylim=(-0.36 * half, 0.36 * half), xlabel="along the pitch circles at the heel, mm",
                 ylabel="toward the planet's axis, mm")
        axes.set_aspect("equal")
        axes.legend(loc="lower left", bbox_to_anchor=(0.0, 1.0), ncols=5)
        return style.svg(picture, "teeth")


def outline(gear: Gear) -> np.ndarray:
    """Polar angles and azimuths (rad) of one tooth with half a gap on each side, shape (points, 2): root land, straight to the base
    circle where it lies above, involute, tip land, and back."""
    foot = max(gear.root, gear.base)
    flank = np.linspace(foot, gear.tip, NODES)
    halves = np.array([gear.half_angle(polar) for polar in flank])
    pitch = math.pi / gear.teeth
    root = np.linspace(-pitch, -halves[0], 4)
    tip = np.linspace(-halves[-1], halves[-1], 6)[1:-1]
    left = np.concatenate([np.column_stack([np.full(4, gear.root), root]), np.column_stack([flank, -halves])])
    right = left[::-1] * (1.0, -1.0)
    return np.vstack([left, np.column_stack([np.full(4, gear.tip), tip]), right])


def _draw(axes, pair, gear, first, place, colour, label):
    """The teeth near the pitch point as one closed shape, and the pitch circle."""
    step = 2.0 * math.pi / gear.teeth
    # the tooth that stands nearest to the pitch point
    middle = min(range(gear.teeth), key=lambda k: math.hypot(*unrolled(pair, place(gear.pitch, first + k * step))))
    points = np.vstack([outline(gear) + (0.0, first + (middle + k) * step) for k in range(-NEIGHBOURS, NEIGHBOURS + 1)])
    if _falls(pair, place, points):
        points = points[::-1]
    curve = np.array([unrolled(pair, place(polar, azimuth)) for polar, azimuth in points])
    below = np.array([unrolled(pair, place(gear.root - 0.35 * (gear.tip - gear.root), azimuth)) for azimuth in points[::-1, 1]])
    shape = np.vstack([curve, below])
    axes.fill(*shape.T, color=colour, alpha=0.4, lw=0, label=label)
    axes.plot(*curve.T, color=colour, lw=1.5)
    circle = np.array([unrolled(pair, place(gear.pitch, azimuth)) for azimuth in np.linspace(*points[[0, -1], 1], 60)])
    axes.plot(*circle.T, color=colour, lw=0.8, ls="-.", label=f"pitch circle, {label}")


def _falls(pair, place, points):
    ends = [unrolled(pair, place(*points[k]))[0] for k in (0, -1)]
    return ends[1] < ends[0]


def _planet(polar, azimuth):
    """A direction in the planet's frame (tooth 0 at azimuth 0) as (along the left half-shaft, along the planet's axis, third)."""
    return math.sin(polar) * math.cos(azimuth), math.cos(polar), -math.sin(polar) * math.sin(azimuth)


def _side(polar, azimuth):
    """The same for the left side gear, whose azimuth 0 is at the planet's axis."""
    return math.cos(polar), math.sin(polar) * math.cos(azimuth), math.sin(polar) * math.sin(azimuth)


def unrolled(pair: Pair, direction: tuple[float, float, float]) -> tuple[float, float]:
    """Where a direction from the apex lies at the heel, mm from the pitch point: its distance on the sphere, in its direction, as
    one sees it from outside."""
    along, up, third = direction
    sine, cosine = math.sin(pair.gears[0].pitch), math.cos(pair.gears[0].pitch)
    depth = sine * along + cosine * up
    rise = sine * up - cosine * along
    flat = math.hypot(rise, third)
    angle = math.atan2(flat, depth)
    scale = MM * pair.outer_cone * (angle / flat if flat > 0.0 else 1.0)
    return -scale * third, scale * rise


def _action(axes, pair):
    """The great circle through the pitch point that is tangent to both base circles."""
    planet, side = pair.gears
    ends = [MM * pair.outer_cone * planet.arc(planet.pitch), -MM * pair.outer_cone * side.arc(side.pitch)]
    slope = np.array([math.cos(pair.pressure_angle), math.sin(pair.pressure_angle)])
    axes.plot(*np.outer(slope, ends), color=style.RED, ls="--", lw=1.1, label="line of action")
    axes.plot(0.0, 0.0, "o", color=style.RED, ms=4)
