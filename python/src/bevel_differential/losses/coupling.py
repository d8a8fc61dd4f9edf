"""Coupling torque of the block Limited Slip Differential of Powertrain Blockset, over slip speed and over input torque.

The block splits the torque T of the carrier into the torques of its axles, which rotate at ω1 and ω2:

    T1 = T/2 − Tc/2,   T2 = T/2 + Tc/2,   slip (ω1 − ω2)/2

so Tc is the difference of the axle torques. It is the torque of both clutch packs together, or that of a clutch on command, and the slip
is that of one side gear relative to the carrier. A positive Tc at positive slip brakes the fast axle. The mask has the vectors dwT and Tdw for "Slip speed
dependent torque data", and Tin and TTin for "Input torque dependent torque data".

Sources: https://mathworks.com/help/autoblks/ref/limitedslipdifferential.html; factors of slip and torque from code that Simulink Coder
9.8 (R2022b) generated from the block, https://github.com/Tencent/TAD_Sim, TX_DriveLine_EV_Front.cpp."""

import numpy as np

from . import MeasuredMap
from .grid import grid_points, torques_of
from .loss_map import DIFFERENCE, MAPPED, SIGNS
from .point import pressed

SWITCH = "effects.limited_slip"
# smallest number of points of a vector that a look-up table accepts
FEWEST = 2


def left_out(result: MeasuredMap) -> str:
    """Reason why there are no tables of the coupling torque; empty if there are."""
    sides = pressed(result.scene)
    if any(result.scene.value(f"clutches.{side}_ratio") != 1.0 for side in sides):
        return "a clutch whose ratio is not 1 also moves torque to or from the housing, which the block does not have"
    if sides or result.scene.value(SWITCH):
        return ""
    return f"{SWITCH} is off in the scene and no clutch on command is pressed, so no clutch couples the axles"


def middle(result: MeasuredMap) -> list[int]:
    """Lines at which the tables are taken, by axis: the middle ones. Of the torques, it is the middle of those in drive, if there are any,
    because the middle of drive and coast is idling."""
    found = [len(line) // 2 for line in result.lines]
    in_drive = np.flatnonzero(result.lines[0] > 0.0)
    if len(in_drive):
        found[0] = int(in_drive[len(in_drive) // 2])
    return found


def over_slip(result: MeasuredMap) -> tuple[np.ndarray, np.ndarray]:
    """Slips dwT [rad/s], in both directions and 0, and coupling torques Tdw [N·m] at the middle of the other axes. Axle 1 is the left
    one. At slip 0, friction sticks, and the torque is that of the stuck differential, which moves straight ahead."""
    torque, speed, _, warmth = middle(result)
    still = _coupling(result, result.stuck, 0.0)[torque, speed, :, warmth]
    ahead, behind = (_coupling(result, values, sign)[torque, speed, :, warmth] for values, sign in zip(result.slipping, SIGNS))
    slips = 0.5 * result.lines[DIFFERENCE]
    return np.concatenate([-slips[::-1], [0.0], slips]), np.concatenate([behind[::-1], still, ahead])


def over_input(result: MeasuredMap) -> tuple[np.ndarray, np.ndarray]:
    """Torques Tin of the carrier [N·m], and magnitudes TTin of the coupling torque [N·m], which resists slip, at the middle of the other
    axes. TTin is the mean of both directions of slip."""
    _, speed, slip, warmth = middle(result)
    ahead, behind = (_coupling(result, values, sign)[:, speed, slip, warmth] for values, sign in zip(result.slipping, SIGNS))
    return result.lines[0], 0.5 * (ahead - behind)


def _coupling(result, values, sign):
    """Right less left torque, shape (lines of each axis)."""
    slips = sign * result.lines[DIFFERENCE] if sign else np.zeros(1)
    lines = [slips if axis == DIFFERENCE else line for axis, line in enumerate(result.lines)]
    # a difference of 0 has no sign in the file
    return 0.0 - torques_of(values[..., :MAPPED], grid_points(lines))[..., 0]
