"""Separate calculation of a universal joint and of a propeller shaft behind it, from spatial geometry and an explicit method of order 8.

The joint's cross has two arms at right angles. One is held by the fork of the driven end, whose axis is inclined to the shaft's axis
by the joint angle; the other is held by the fork of the shaft."""

from dataclasses import dataclass
from math import atan2, cos, pi, sin

import numpy as np
from scipy.integrate import solve_ivp

TOLERANCE = 1e-11


def output_angle(angle, joint, quarter=False):
    """Angle of the shaft's fork, from the condition that both arms of the cross are square to each other."""
    before = angle - (pi / 2.0 if quarter else 0.0)
    # arm of the driven fork: it turns in the plane across the driven axis, and lies in the plane of both axes at before = -pi/2
    arm = np.array([-sin(before) * cos(joint), cos(before), sin(before) * sin(joint)])
    # the shaft turns about z; its arm lies across z and across the first arm
    other = np.cross(arm, [0.0, 0.0, 1.0])
    after = atan2(other[1], other[0]) + (pi / 2.0 if quarter else 0.0)
    return after + 2.0 * pi * round((angle - after) / (2.0 * pi))


def speed_ratio(angle, joint, quarter=False):
    """Speed of the shaft over that of the driven end, in the usual closed form."""
    across = cos(angle) if quarter else sin(angle)
    return cos(joint) / (1.0 - (sin(joint) * across) ** 2)


@dataclass
class Propeller:
    """Driven end, joint, elastic shaft, and a pinion with a rigid final drive and ideal gears behind it."""

    end: float          # inertia [kg.m2]
    pinion: float       # inertia of all that turns with the pinion, at its speed [kg.m2]
    stiffness: float
    damping: float
    joint: float
    quarter: bool
    load: float         # on the pinion [N.m]

    def shaft(self, y):
        """Torque of the shaft [N.m] and the ratio of the joint."""
        first, pinion, speed, pinion_speed = y
        ratio = speed_ratio(first, self.joint, self.quarter)
        twist = output_angle(first, self.joint, self.quarter) - pinion
        return self.stiffness * twist + self.damping * (ratio * speed - pinion_speed), ratio

    def follow(self, state, torque, times):
        """States (angles of driven end and pinion, their speeds) at `times`; `torque`: on the driven end, as a function of time, or None
        if it turns steadily."""
        def rates(t, y):
            shaft, ratio = self.shaft(y)
            driven = (torque(t) - shaft * ratio) / self.end if torque else 0.0
            return [y[2], y[3], driven, (shaft - self.load) / self.pinion]

        found = solve_ivp(rates, (times[0], times[-1]), state, "DOP853", times, rtol=TOLERANCE, atol=1e-13)
        return found.y.T


def closed_angle(angle, joint, quarter=False):
    """Angle behind the joint by tan b = cos(joint) tan a, or tan b = tan a / cos(joint) after a quarter turn, without branches."""
    q = (1.0 - cos(joint)) / (1.0 + cos(joint)) * (-1.0 if quarter else 1.0)
    return angle - atan2(q * sin(2.0 * angle), 1.0 + q * cos(2.0 * angle))
