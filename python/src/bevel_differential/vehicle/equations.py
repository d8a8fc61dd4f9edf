"""Equations of tyre, motor and body. They need only `math`, so that FMUs of the parts can contain this file too.

`tyre`, `motor` and `body` are objects with the parameters of `Tyre`, `Motor` and `Body`. SI units.
"""

from math import atan, sin, tanh
from typing import Any

# standard gravity, m/s2
GRAVITY = 9.80665


def tyre_force(tyre: Any, slip: float, rolling: float, speed: float) -> float:
    """Force of the road on the tyre along its plane, N.

    Pacejka's magic formula with E = 0 (*Tyre and Vehicle Dynamics*, 3rd edition 2012, section 4.3). `slip`: the slip that has built
    up; `rolling`: radius times speed of the wheel, m/s; `speed`: speed of the wheel's centre, m/s. The damping fades with speed."""
    peak = tyre.friction * tyre.load
    damping = tyre.damping / (1.0 + (speed / tyre.walk) ** 2)
    total = slip + damping / tyre.slip_stiffness * (rolling - speed)
    return peak * sin(tyre.shape * atan(tyre.slip_stiffness / (tyre.shape * peak) * total))


def slip_rate(tyre: Any, slip: float, rolling: float, speed: float) -> float:
    """Rate at which the slip builds up over the relaxation length, 1/s."""
    return (rolling - speed - abs(speed) * slip) / tyre.relaxation


def motor_torque(motor: Any, request: float, speed: float) -> float:
    """Part of the torque `request` that the motor can give at its speed, N.m. In both directions of torque and speed, the limit is the
    torque `peak` below the knee, and the power `peak` times `knee` above it."""
    limit = motor.peak * motor.knee / max(abs(speed), motor.knee)
    return min(max(request, -limit), limit)


def resistance(body: Any, speed: float) -> float:
    """Drag of the air and rolling resistance against the speed, N."""
    return body.drag * speed * abs(speed) + body.rolling * body.mass * GRAVITY * tanh(speed / body.breakaway)


def axle_force(stiffness: float, limit: float, slip: float) -> float:
    """Lateral force of an axle at the slip angle `slip`, N: linear for small angles, at most `limit`."""
    return limit * tanh(stiffness * slip / limit)
