"""Test of clutches on command: torque over command at rest, and the response to a step of the command.

Only one clutch is pressed, while its wheel is slower and then faster than the clutch's shaft. The test measures the torques of the wheels,
relative to the same run without a command. Without other friction, they give the torque C of the clutch:

    T_L - T_R = C_L - C_R        T_L + T_R = T_c + (1 - σ_L) C_L + (1 - σ_R) C_R

Friction of teeth, washers and pins depends on their loads, which the clutch changes. The moved torque then differs from C.
"""

from collections.abc import Mapping
from itertools import product
from pathlib import Path
from typing import Any

import numpy as np

from ..losses import inputs
from ..losses.axes import axes
from ..panel import CYCLE, Panel, curve
from ..scene import Scene
from ..values import DifferentialError
from .steady import DIFFERENCE, SPEED, largest_torque, means, written
from .step_response import SLIP, step_response

SIDES = ("left", "right")
COMMANDS = np.arange(21) / 20.0
# slips of a clutch [rad/s], with the state of its wheel relative to its shaft
SLIPS = {0.5 * DIFFERENCE: "slower", -0.5 * DIFFERENCE: "faster"}
# smallest torque that is reported [N·m]
RESOLVED = 1e-3
HEAD = ["clutch", "slip [rad/s]", "clutch_command [1]", "left.shaft_torque [N.m]", "right.shaft_torque [N.m]", "moved_torque [N.m]",
        "housing_torque [N.m]"]


def clutch_command(scene: Scene, out: Path, farm: Mapping[str, Any]) -> str:
    """Measures the torque that each clutch moves to its wheel, and the torque of its gearing on the housing, over the command."""
    if not scene.value("effects.clutches"):
        raise DifferentialError("effects.clutches = false: the bench of torque over command needs clutches on command")
    of_torque, torque, temperature = axes(scene)[0], largest_torque(scene), scene.value("oil.temperature")
    ratios = {side: float(scene.value(f"clutches.{side}_ratio")) for side in SIDES}
    points = list(product(SIDES, SLIPS, COMMANDS.tolist()))
    found = means(scene, [inputs((torque, SPEED, _difference(side, ratios[side], slip), temperature))
                          | {f"{each}.clutch_command": command if each == side else 0.0 for each in SIDES}
                          for side, slip, command in points], farm)
    rows = []
    for (side, slip, command), (left, right, *_) in zip(points, found):
        if command == 0.0:
            open_left, open_right = left, right
        moved = (left - right) - (open_left - open_right)
        rows.append((side, slip, command, left, right, moved if side == "left" else -moved, open_left + open_right - left - right))
    panels = [_panel(rows, of_torque.named("torque moved to the wheel"), 5)]
    if any(ratio != 1.0 for ratio in ratios.values()):
        panels.append(_panel(rows, of_torque.named("torque on the housing"), 6))
    drive = inputs((torque, SPEED, _difference("left", ratios["left"], SLIP), temperature))
    response, below = step_response(scene, drive, out.with_name(f"{out.name}_step.csv"), of_torque)
    # one panel is as wide as two
    rows_of_panels = [panels * (2 if below and len(panels) == 1 else 1), *below]
    return written(scene, out, f"{_conclusion(rows, of_torque)}. {response}", rows_of_panels, 5.4 + 3.6 * len(below), "clutch pressed", HEAD, rows)


def _difference(side, ratio, slip):
    """Difference of the wheel speeds at which the clutch of a side has a slip, while the carrier turns with SPEED."""
    return 2.0 * ((ratio * SPEED - slip) - SPEED) * (1.0 if side == "left" else -1.0)


def _curves(rows):
    """Rows of each clutch and slip."""
    return {(side, slip): [row for row in rows if row[:2] == (side, slip)] for side, slip in product(SIDES, SLIPS)}


def _conclusion(rows, of_torque):
    found, bend = {}, 0.0
    for side in SIDES:
        torques, housing = np.array([[row[5:] for row in _curves(rows)[side, slip]] for slip in SLIPS]).transpose(2, 0, 1)
        last, held = ([of_torque.text(round(end, 2) + 0.0) for end in ends[:, -1].tolist()] for ends in (torques, housing))
        found[side] = f"{last[0]} to a slower wheel and {last[1]} to a faster one (housing: {held[0]} and {held[1]})"
        bend = max(bend, np.abs(torques - COMMANDS * torques[:, -1:]).max() / max(np.abs(torques).max(), RESOLVED))
    sentences = [f"the {side} clutch moves {moves}" for side, moves in found.items()]
    if len(set(found.values())) == 1:
        sentences = [f"each clutch moves {found[SIDES[0]]}"]
    return (f"at full command, {'; '.join(sentences)}. Slower and faster are relative to the clutch's shaft. The torque deviates from proportion "
            f"to the command by up to {100.0 * bend:.1f} %")


def _panel(rows, label, column):
    curves = []
    for ((side, slip), own), colour, form in zip(_curves(rows).items(), (CYCLE[0], CYCLE[0], CYCLE[1], CYCLE[1]), ("-", "--") * 2):
        commands, torques = zip(*((row[2], row[column]) for row in own))
        curves.append(curve(commands, torques, f"{side} clutch, {SLIPS[slip]} wheel", colour, form,
                            linewidth=3.0 if side == "left" else 1.4))
    return Panel("command", label, curves, xlim=(0.0, 1.0), legend="best" if column == 5 else "")
