"""Equations of tyre, motor and body. They need only `math`, so that FMUs of the parts can contain this file too.

`tyre`, `motor` and `body` are objects with the parameters of `Tyre`, `Motor` and `Body`. SI units.

A contact patch deflects by u along its force, and slides at the speed c of the tyre relative to the road. While the patch adheres,
du/dt = c - |v| u/σ, with the speed v of the wheel's centre and the relaxation length σ (Pacejka, *Tyre and Vehicle Dynamics*, 3rd edition
2012, chapter 7; Bernard and Clover, SAE 950311). Its deflection cannot exceed that at which the whole patch slides. The fraction a(u) of c
therefore becomes sliding, as in the single-state elastoplastic model: du/dt = c (1 - a) - |v| u/σ (Dupont, Hayward, Armstrong and Altpeter,
IEEE Transactions on Automatic Control 47(5), 2002). If c reduces the deflection, a is 0, so the patch springs back. The force depends on the
slip u/(σ (1 - a)). At constant speeds, this slip becomes c/|v| for each c.
"""

from math import atan, sin, tanh
from typing import Any

# standard gravity, m/s2
GRAVITY = 9.80665
# The patch adheres up to this fraction of the deflection at which all of it slides. Pacejka's formula then gives 97 % of its peak if its
# shape is 1.4.
ADHESION = 2.0 / 3.0
# Damping over stiffness of a patch against the motion of the body at standstill, s. The car rocks on its tyres with about 15 rad/s, so the
# loss factor is 0.18. Damping of rubber falls with frequency. `Tyre.damping` also resists the fast motion of the wheel, so it is smaller.
ROCKING = 0.012
# Speed of the car at which this damping is halved, m/s.
ROCKING_SPEED = 0.5
# Largest slip that a patch can have. A wheel that spins while the car stands has no finite slip.
LARGEST_SLIP = 100.0


def full_slide(stiffness: float, limit: float) -> float:
    """Deflection over relaxation length at which a whole patch slides. It is the slip 3 μ F_z/C at which all bristles of the brush
    model slide (Pacejka, section 3.2). `stiffness`: slope of the force by slip, N; `limit`: friction coefficient times load, N."""
    return 3.0 * limit / stiffness


def sliding_rate(full: float, relaxation: float) -> float:
    """Largest rate at which a patch approaches full sliding, for each m/s of its sliding speed, 1/m."""
    return 2.0 / ((1.0 - ADHESION) * full * relaxation)


def sliding_part(deflection: float, full: float) -> float:
    """Fraction of the sliding speed that does not deflect the patch: 0 in adhesion, 1 if the whole patch slides."""
    above = min(max(abs(deflection) / full - ADHESION, 0.0) / (1.0 - ADHESION), 1.0)
    return above * above


def patch_slip(deflection: float, full: float) -> float:
    """Slip that corresponds to the `deflection` of a patch, which is a fraction of the relaxation length, as is `full`."""
    return deflection / max(1.0 - sliding_part(deflection, full), abs(deflection) / LARGEST_SLIP)


def patch_rate(deflection: float, full: float, relaxation: float, creep: float, speed: float) -> float:
    """Rate of the deflection over relaxation length, 1/s. `creep`: speed of the tyre relative to the road, m/s; `speed`: speed of the
    wheel's centre, m/s."""
    deflecting = 1.0 - sliding_part(deflection, full) if creep * deflection > 0.0 else 1.0
    return (deflecting * creep - abs(speed) * deflection) / relaxation


def rocking_slip(relaxation: float, motion: float, ahead: float) -> float:
    """Slip by which the force of a patch increases while the body moves relative to the road. `motion`: speed along the force, m/s;
    `ahead`: speed of the car, m/s."""
    return ROCKING / (1.0 + (ahead / ROCKING_SPEED) ** 2) * motion / relaxation


def tyre_full_slide(tyre: Any) -> float:
    """Deflection over relaxation length at which the patch of a tyre slides along its plane."""
    return full_slide(tyre.slip_stiffness, tyre.friction * tyre.load)


def tyre_force(tyre: Any, slip: float, rolling: float, speed: float) -> float:
    """Force of the road on the tyre along its plane, N.

    Pacejka's magic formula with E = 0 (*Tyre and Vehicle Dynamics*, 3rd edition 2012, section 4.3). `slip`: `patch_slip` of its
    deflection; `rolling`: radius times speed of the wheel, m/s; `speed`: speed of the wheel's centre, m/s. Both dampings fade with speed."""
    peak = tyre.friction * tyre.load
    damping = tyre.damping / (1.0 + (speed / tyre.walk) ** 2)
    total = slip + damping / tyre.slip_stiffness * (rolling - speed) + rocking_slip(tyre.relaxation, -speed, speed)
    return peak * sin(tyre.shape * atan(tyre.slip_stiffness / (tyre.shape * peak) * total))


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
