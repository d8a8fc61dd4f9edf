"""Steady tests of clutch packs: torque difference of the wheels in drive and coast by their ramps, and clutch torque over slip.

While the left wheel is the faster one, the packs shift torque to the right wheel: T_right − T_left = 2 C with the torque C of each
pack. Ramps press the packs by the mesh torque, so 2 C = 2 preload + κ |T| in drive and 2 preload + κ c |T| in coast."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from itertools import product
from pathlib import Path
from typing import Any

import numpy as np

from ..losses import inputs
from ..losses.axes import axes
from ..losses.tables import bias as ratio_of
from ..panel import CYCLE, GREY, INK, PALE_BLUE, RED, Axis, Mark, Panel, curve
from ..report import words
from ..scene import Scene
from ..values import DifferentialError
from .steady import DIFFERENCE, SPEED, largest_torque, means, written

COAST, COEFFICIENT, VISCOUS = "limited_slip.coast_ratio", "limited_slip.torque_coefficient", "limited_slip.viscous_torque"
# carrier torques, fractions of the scene's torque from coast to drive; 0 between them
DRIVE = np.linspace(0.1, 1.0, 19)
TORQUES = np.concatenate([-DRIVE[::-1], [0.0], DRIVE])
RAMP_HEAD = ["coast_ratio [1]", "carrier.torque [N.m]", "left.shaft_torque [N.m]", "right.shaft_torque [N.m]", "torque_difference [N.m]",
             "torque_bias_ratio [1]", "locking_value [%]"]
CURVE_HEAD = ["clutch", "slip [rad/s]", "clutch_torque [N.m]"]
# maximum number of points of a measured curve; number of slips that are run, up to this multiple of the last point
POINTS, STEPS, BEYOND = 8, 50, 1.25
# slips below the first step, in steps: there torques rise fastest
SMALL = [0.02, 0.06, 0.2, 0.4, 0.7]
# smallest error of a torque that is reported [N·m]
RESOLVED = 1e-3
NO_DRY = {"limited_slip.preload": 0.0, COEFFICIENT: 0.0}


def ramps(scene: Scene, out: Path, farm: Mapping[str, Any]) -> str:
    """Measures the torque difference of the wheels from coast to drive, with the scene's ramps and with those of 2-way and 1-way."""
    if scene.value(COEFFICIENT) <= 0.0:
        raise DifferentialError(f"{COEFFICIENT} = 0: the bench of ramps needs packs that mesh torque presses")
    torques, (of_torque, *_) = TORQUES * largest_torque(scene), axes(scene)
    ratios = sorted({1.0, float(scene.value(COAST)), 0.0}, reverse=True)
    points = list(product(ratios, torques.tolist()))
    found = means(scene, [inputs((torque, SPEED, DIFFERENCE, scene.value("oil.temperature"))) | {COAST: ratio}
                          for ratio, torque in points], farm)
    rows = [(*point, left, right, right - left, *ratio_of(left, right)) for point, (left, right, *_) in zip(points, found)]
    largest, (coast, drive) = torques[-1], ({row[0]: row[4] for row in rows if row[1] == torque} for torque in (torques[0], torques[-1]))
    shifted = words.listed(f"{of_torque.text(round(shift, 3), 3)} ({ramp(ratio)})" for ratio, shift in coast.items())
    conclusion = (f"at {of_torque.text(largest)} in drive, the slower wheel has {of_torque.text(max(drive.values()), 3)} more than the faster "
            f"wheel with each ramp; in coast, this difference is {shifted}")
    if scene.value("limited_slip.preload") > 0.0:
        conclusion += (". At small torque only the preload remains, so the ratio of the torques grows there; it has no value where they oppose "
                 "each other")
    return written(scene, out, conclusion, [_ramp_panels(rows, of_torque)], 5.4, "differentiating", RAMP_HEAD, rows)


def ramp(ratio: float) -> str:
    """Usual name of a ramp by its coast ratio."""
    return {1.0: "2-way", 0.0: "1-way"}.get(ratio, "1.5-way" if ratio < 1.0 else f"coast {ratio:g} ×")


def clutch_curve(scene: Scene, out: Path, farm: Mapping[str, Any]) -> str:
    """Measures the torque of a pack over its slip, without dry torque: of the scene's viscous torque, and of its measured curve with and
    without the point at slip 0."""
    (of_torque, _, of_slip, _), given = axes(scene), curves(scene)
    if not given:
        raise DifferentialError(f"the bench of torque over slip needs {VISCOUS}, or points of limited_slip.curve with a torque")
    slips = _slips(scene, given)
    # only a pack that holds is measured without slip, by winding it up
    points = [(curve, slip) for curve in given for slip in [0.0] * curve.holds + slips]
    torque, temperature = largest_torque(scene), scene.value("oil.temperature")
    found = means(scene, [inputs((torque, SPEED, 2.0 * slip, temperature)) | curve.values for curve, slip in points], farm)
    rows = [(curve.name, slip, 0.5 * (right - left if slip else most - least))
            for (curve, slip), (left, right, _, least, most) in zip(points, found)]
    conclusion = _conclusion(rows, given, of_torque, of_slip)
    return written(scene, out, conclusion, [[_curve_panel(rows, given, of_torque, of_slip)]], 5.6, "differentiating", CURVE_HEAD, rows)


@dataclass(frozen=True)
class Curve:
    """Clutch torque over slip. `values`: changes of the scene; `points`: measured slips [rad/s] and torques [N·m]."""

    name: str
    values: Mapping[str, float]
    points: Sequence[tuple[float, float]] = ()

    @property
    def holds(self) -> bool:
        """True if the pack has a breakaway torque."""
        return bool(self.points) and self.points[0][0] == 0.0


def curves(scene: Scene) -> list[Curve]:
    """Curves of the scene: viscous torque and measured points, each without the other and without dry torque."""
    names = [(f"limited_slip.curve[{i}].slip", f"limited_slip.curve[{i}].torque") for i in range(1, POINTS + 1)]
    given = [(float(scene.value(slip)), float(scene.value(torque))) for slip, torque in names]
    # points of two zeros are unset at the end and change nothing at the start; a curve without torque is unset
    while given and not any(given[-1]):
        given.pop()
    given = given[1:] if given and not any(given[0]) else given
    given = given if any(torque for _, torque in given) else []
    found = []
    if scene.value(VISCOUS) > 0.0:
        found.append(Curve("viscous torque", NO_DRY | _point_values(names, ())))
    starts = [point for point in given if point[0] > 0.0]
    for name, points in (("measured curve", starts), ("measured curve with breakaway torque", given)):
        if points and (points is starts or len(starts) < len(given)):
            found.append(Curve(name, NO_DRY | {VISCOUS: 0.0} | _point_values(names, points), points))
    return found


def _point_values(names, points):
    """Values of all points of the FMU; points that are not given are unset."""
    padded = [*points, *[(0.0, 0.0)] * (POINTS - len(points))]
    return {name: value for pair, point in zip(names, padded) for name, value in zip(pair, point)}


def _slips(scene, given):
    """Slips of the runs [rad/s]: small ones, equal steps beyond the last point, and the points."""
    measured = [slip for curve in given for slip, _ in curve.points if slip > 0.0]
    last = max(measured, default=float(scene.value("limited_slip.viscous_speed")))
    steps = np.append(SMALL, np.arange(1, STEPS + 1)) * (BEYOND * last / STEPS)
    # a step that only rounding separates from a point is left out
    return sorted({*measured, *(slip for slip in steps.tolist() if not np.isclose(slip, measured, rtol=1e-9).any())})


def _conclusion(rows, given, of_torque, of_slip):
    sentences = []
    for curve in given:
        torques = {slip: torque for name, slip, torque in rows if name == curve.name}
        (first, least), *_, (last, most) = torques.items()
        ends = f"from {of_torque.text(least, 3)} at {of_slip.text(first, 3)} to {of_torque.text(most, 3)} at {of_slip.text(last, 3)}"
        if curve.holds:
            sentences.append(f"with a point at slip 0, the pack breaks loose at {of_torque.text(least, 3)}")
        elif curve.points:
            error = max(RESOLVED, *(abs(torques[slip] - torque) for slip, torque in curve.points))
            sentences.append(f"the measured curve passes its points within {of_torque.text(error, 1)}, {ends}")
        else:
            sentences.append(f"viscous torque grows {ends}")
    return f"{'; '.join(sentences)}. Only a pack with a breakaway torque has torque without slip"


def _ramp_panels(rows, of_torque):
    looks = ((PALE_BLUE, 7.0, "-"), (RED, 2.8, "-"), (INK, 1.4, "--"))

    def panel(label, column, **look):
        curves = [curve(*zip(*((row[1], row[column]) for row in own)), f"{ramp(ratio)}: coast ratio {ratio:g}", colour, form, linewidth=width)
                  for (ratio, own), (colour, width, form) in zip(_by_ratio(rows), looks)]
        return Panel(Axis(f"{of_torque.label} (coast < 0 < drive)", of_torque.values), label,
                     [*curves, Mark("axvline", 0.0, color=GREY, linewidth=0.8)], **look)

    return [panel(of_torque.named("torque of slower wheel − faster wheel"), 4, legend="upper center", ylim=(0.0, None)),
            panel("torque bias ratio T_high/T_low", 5, legend="", ylim=(1.0, None))]


def _curve_panel(rows, given, of_torque, of_slip):
    # the last curve covers the one before in parts
    marks = [curve(*zip(*(row[1:] for row in rows if row[0] == each.name)), each.name, colour, linewidth=1.7 if each.holds else 3.5)
             for each, colour in zip(given, CYCLE)]
    points = {point for each in given for point in each.points}
    if points:
        marks.append(curve(*zip(*points), "given points", INK, "o", fillstyle="none", markersize=9, clip_on=False))
    return Panel(of_slip.named("slip relative to the carrier"), of_torque.named("torque of a clutch pack"), marks, xlim=(0.0, None),
                 ylim=(0.0, None))


def _by_ratio(rows):
    """Rows of each coast ratio, from large to small."""
    return [(ratio, [row for row in rows if row[0] == ratio]) for ratio in sorted({row[0] for row in rows}, reverse=True)]
