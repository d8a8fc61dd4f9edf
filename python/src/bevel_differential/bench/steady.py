"""Steady tests: torque bias and breakaway over torque, at three temperatures, in both directions."""

from collections.abc import Iterable, Mapping, Sequence
from itertools import product
from pathlib import Path
from typing import Any

import numpy as np

from ..designs import Farm
from ..losses import inputs
from ..losses.axes import axes
from ..losses.point import FIGURES, PointTask, benched
from ..losses.tables import bias as ratio_of
from ..panel import CYCLE, Panel, curve, picture
from ..records import write
from ..drive_port import TORQUE, drive_ratio, port_command
from ..scene import Scene
from ..values import DifferentialError, Number

# fractions of the scene's torque; temperatures, K; carrier speed and difference of wheel speeds, rad/s
SHARES = np.array([0.15, 0.25, 0.4, 0.6, 0.8, 1.0])
TEMPERATURES = (253.15, 313.15, 393.15)
SPEED, DIFFERENCE = 50.0, 5.0
# torque bias ratio above 1 that is no bias
NO_BIAS = 1e-3
HEAD = ["carrier.torque [N.m]", "speed_difference [rad/s]", "oil.temperature [K]", "left.shaft_torque [N.m]", "right.shaft_torque [N.m]",
        "torque_bias_ratio [1]", "locking_value [%]"]


def bias(scene: Scene, out: Path, farm: Mapping[str, Any]) -> str:
    """Measures TBR over torque while the differential differentiates."""
    torques, (of_torque, *_) = SHARES * largest_torque(scene), axes(scene)
    found = _measured(scene, torques, (DIFFERENCE, -DIFFERENCE), farm)
    rows = [(*point[:1], *point[2:], *figures[:2], *ratio_of(*figures[:2])) for point, figures in found.items()]
    small, large = (max(row[5] or np.inf for row in rows if row[0] == torque) for torque in (torques[0], torques[-1]))
    least, most = (f"{_range(rows, torque)} at {of_torque.text(torque, 3)}" for torque in (torques[0], torques[-1]))
    if max(small, large) <= 1.0 + NO_BIAS:
        conclusion = f"TBR is {most}, because nothing in the scene biases the torque"
    elif small > large + NO_BIAS:
        conclusion = (f"TBR falls from {least} to {most}: preload determines it at small torque, friction that grows with the torque at large "
                      "torque")
    else:
        conclusion = f"TBR is {least} and {most}: friction that grows with the torque determines it"
    conclusion += ". Left and right agree where solid and dashed lines meet"
    return written(scene, out, conclusion, [[_panel(scene, rows, "torque bias ratio T_high/T_low", 5)]], 5.6, "differentiating", HEAD, rows)


def breakaway(scene: Scene, out: Path, farm: Mapping[str, Any]) -> str:
    """Measures LE at breakaway over torque."""
    torques, (of_torque, _, of_slip, _) = SHARES * largest_torque(scene), axes(scene)
    found = _measured(scene, torques, (0.0, DIFFERENCE), farm)
    rows, over = [], []
    for (torque, speed, difference, temperature), figures in found.items():
        if difference:
            continue
        total = figures[0] + figures[1]
        # torque of the left wheel when it is about to become the faster one, and the slower one
        for left, sign in ((figures[3], 1.0), (figures[4], -1.0)):
            rows.append((torque, sign, temperature, left, total - left, *ratio_of(left, total - left)))
        slipping = found[torque, speed, DIFFERENCE, temperature]
        over.append((total - 2.0 * figures[3]) / (slipping[1] - slipping[0]))
    held = [row[6] for row in rows if row[0] == torques[-1] and row[6] is not None]
    conclusion = (f"it holds up to {f'an LE of {min(held):.0f} to {max(held):.0f} %' if held else 'torques that oppose each other'} at "
            f"{of_torque.text(torques[-1])}; breakaway needs {min(over):.2f} to "
            f"{max(over):.2f} times the difference of torques that it has at {of_slip.text(DIFFERENCE)}. This is not a TBR, because "
            "nothing differentiates")
    return written(scene, out, conclusion, [[_panel(scene, rows, "locking value, %", 6)]], 5.6, "breaking loose", HEAD, rows)


def largest_torque(scene: Scene) -> float:
    """Largest carrier torque of the bench [N·m]: the largest magnitude in the scene."""
    name = port_command(scene.value, TORQUE)
    command = abs(float(scene.all_values().get(name, scene.value(name))))
    if command == 0.0:
        raise DifferentialError(f"{name} = 0 N.m: the bench needs its largest torque here")
    return command * drive_ratio(scene.value)


def means(scene: Scene, runs: Sequence[Mapping[str, Number]], farm: Mapping[str, Any]) -> list[list[float]]:
    """FIGURES of each run of the scene on the bench; `runs`: values of a point, and others that differ from the scene."""
    with Farm(**farm) as workers:
        rows = workers.evaluate(PointTask(benched(scene, runs[0])), list(enumerate(runs)))
    for row in rows:
        if row.message:
            raise DifferentialError(row.message, kind=row.kind)
    return [[float(row.figures[name]) for name in FIGURES] for row in rows]


def _measured(scene, torques, differences, farm):
    """Figures by point: {(torque, speed, difference, temperature): figures}."""
    points = list(product(torques.tolist(), (SPEED,), differences, TEMPERATURES))
    return dict(zip(points, means(scene, [inputs(point) for point in points], farm)))


def _range(rows, torque):
    ratios = [row[5] for row in rows if row[0] == torque]
    known = [ratio for ratio in ratios if ratio is not None]
    text = " to ".join(dict.fromkeys(f"{limit(known):.2f}" for limit in (min, max))) if known else "none"
    return f"{text} or none" if known and len(known) < len(ratios) else text


def _panel(scene, rows, label, column):
    of_torque, _, _, warmth = axes(scene)
    curves = []
    for temperature, colour in zip(TEMPERATURES, CYCLE):
        for sign, side, form in ((1.0, "left", "o-"), (-1.0, "right", "o--")):
            torques, values = zip(*((row[0], row[column]) for row in rows if row[2] == temperature and row[1] * sign > 0.0))
            curves.append(curve(torques, values, f"{warmth.text(temperature)}, {side} wheel faster", colour, form))
    return Panel(of_torque, label, curves)


def written(scene: Scene, out: Path, conclusion: str, panels: Iterable[Iterable[Panel]], height: float, doing: str, head: Sequence[str],
            rows: Iterable[Sequence[Any]]) -> str:
    """Writes the numbers and the figure of a test; returns its conclusion, which is also the caption. `doing`: what the differential does."""
    write(out.with_suffix(".csv"), head, [["" if cell is None else cell for cell in row] for row in rows], conclusion)
    drawn(scene, out, conclusion, panels, height, doing)
    return conclusion


def drawn(scene: Scene, out: Path, conclusion: str, panels: Iterable[Iterable[Panel]], height: float, doing: str = "") -> None:
    """Draws the figure of a test."""
    picture(panels, f"{conclusion[0].upper()}{conclusion[1:]}.", out.with_suffix(".png"), height, 
            title=", ".join(dict.fromkeys(filter(None, (scene.name, doing)))))
