"""Equations of tyre, motor and body. They need only `math`, so that FMUs of the parts can contain this file too.

`tyre`, `motor` and `body` are objects with the parameters of `Tyre`, `Motor` and `Body`. SI units.

A contact patch deflects by u. The tyre moves relative to the road with the creep c, and the wheel's centre with the speed v. While the patch
adheres, du/dt = c - |v| u/σ, with the relaxation length σ (Pacejka, *Tyre and Vehicle Dynamics*, 3rd edition 2012, chapter 7; Bernard and
Clover, SAE 950311). The deflection cannot exceed that at which the whole patch slides. The fraction a(u) of the creep therefore becomes
sliding, as in the elastoplastic model: du/dt = c (1 - a) - |v| u/σ (Dupont, Hayward, Armstrong and Altpeter, IEEE Transactions on Automatic
Control 47(5), 2002). If the creep reduces the deflection, nothing slides, so a is 0 in this equation. The force follows from the slip
u/(σ (1 - a)), which tends to c/|v|. The code counts u in relaxation lengths.
"""

from math import atan, sin, tanh
from typing import Any

# standard gravity, m/s2
GRAVITY = 9.80665
# The whole patch adheres up to this fraction of the deflection at which all of it slides. Pacejka's formula with shape 1.4 then gives 97 %
# of its peak, so the wheel does not spin before.
ADHESION = 2.0 / 3.0
# Largest slip of a patch: a wheel that spins while the car stands has an infinite slip.
LARGEST_SLIP = 100.0
# Damping over stiffness of a patch against motion of the body, along and across the plane of the wheel, s. It lets a car settle within 3 s
# after a stop. `Tyre.damping` contributes another 0.006 s along the plane. The body rocks on its tyres with 15 rad/s, so its loss factors
# are 0.13 and 0.23.
ROCKING_ALONG, ROCKING_ACROSS = 0.003, 0.015
# Speed of the car at which this damping is halved, m/s.
ROCKING_SPEED = 0.5


def full_slide(stiffness: float, limit: float) -> float:
    """Deflection in relaxation lengths at which a whole patch slides, 3 μ F_z/C. All bristles of the brush model slide at this slip
    (Pacejka, section 3.2). `stiffness`: slope of the force by slip, N; `limit`: friction coefficient times load, N."""
    return 3.0 * limit / stiffness


def sliding_rate(full: float, relaxation: float) -> float:
    """Largest rate at which the deflection of a patch settles, divided by its creep, 1/m."""
    return 2.0 / ((1.0 - ADHESION) * full * relaxation)


def sliding_part(deflection: float, full: float) -> float:
    """Fraction a of the creep that slides: 0 in adhesion, 1 if the whole patch slides."""
    above = (abs(deflection) / full - ADHESION) / (1.0 - ADHESION)
    return 0.0 if above <= 0.0 else min(above * above, 1.0)


def patch_slip(deflection: float, full: float) -> float:
    """Slip of a patch at its deflection. Both are in relaxation lengths, as is `full`, the deflection at which all of it slides."""
    sliding = sliding_part(deflection, full)
    return deflection / max(1.0 - sliding, abs(deflection) / LARGEST_SLIP) if sliding else deflection


def patch_rate(deflection: float, full: float, relaxation: float, creep: float, speed: float) -> float:
    """Rate of a patch's deflection, in relaxation lengths per second. `creep`: speed of the tyre relative to the road, m/s; `speed`: speed
    of the wheel's centre, m/s."""
    deflecting = 1.0 - sliding_part(deflection, full) if creep * deflection > 0.0 else 1.0
    return (deflecting * creep - abs(speed) * deflection) / relaxation


def rocking_slip(rocking: float, relaxation: float, motion: float, ahead: float) -> float:
    """Slip that a patch gains while the body rocks, by the damping `rocking`. `motion`: speed of the body against the force, m/s;
    `ahead`: speed of the car, m/s. It only depends on the body, so it does not shorten the steps that a wheel allows."""
    return rocking * motion / (relaxation * (1.0 + (ahead / ROCKING_SPEED) ** 2))


def tyre_full_slide(tyre: Any) -> float:
    """Deflection in relaxation lengths at which the whole patch of a tyre slides along its plane."""
    return full_slide(tyre.slip_stiffness, tyre.friction * tyre.load)


def tyre_force(tyre: Any, slip: float, rolling: float, speed: float) -> float:
    """Force of the road on the tyre along its plane, N.

    Pacejka's magic formula with E = 0 (*Tyre and Vehicle Dynamics*, 3rd edition 2012, section 4.3). `slip`: `patch_slip` of its
    deflection; `rolling`: radius times speed of the wheel, m/s; `speed`: speed of the wheel's centre, m/s. Damping fades with speed."""
    peak = tyre.friction * tyre.load
    damping = tyre.damping / (1.0 + (speed / tyre.walk) ** 2)
    total = slip + damping / tyre.slip_stiffness * (rolling - speed) - rocking_slip(ROCKING_ALONG, tyre.relaxation, speed, speed)
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
