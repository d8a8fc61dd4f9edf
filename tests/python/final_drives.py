"""Equations of the final drive and its propeller shaft, independent of the program. Torques, speeds and inertias are referred to
the carrier: speeds are divided by the ratio i, torques multiplied by i, inertias multiplied by i²."""

import numpy as np
from plausible_scenes import FIXED_STEP

# relative rounding error of all terms at an instant
INSTANT = 1e-9
HARMONICS = (1, 2, 3)


def ratio_of(values):
    """Ratio of the speeds of pinion and carrier, from values that include the teeth of both."""
    return values["final_drive.ring_teeth"] / values["final_drive.pinion_teeth"]


def steady_amplitude(stiffness, damping, inertia, error, frequency):
    """Amplitude of the mesh torque on the carrier [N.m] under an `error` [rad] at the angular `frequency`, if the speed of the pinion is
    imposed. The carrier, with its `inertia`, is driven through the mesh with this stiffness and damping."""
    natural = np.sqrt(stiffness / inertia)
    rho, zeta = frequency / natural, 0.5 * damping / np.sqrt(stiffness * inertia)
    damped = 4.0 * zeta**2 * rho**2
    return stiffness * error * rho**2 * np.sqrt((1.0 + damped) / ((1.0 - rho**2) ** 2 + damped))


def joint_slope(angle, joint_angle, is_turned):
    """Speed of a universal joint's output over that of its input, at the angle of the input [rad]."""
    sine, cosine = np.sin(angle) ** 2, np.cos(angle) ** 2
    bend = np.cos(joint_angle)
    return bend / (bend**2 * cosine + sine) if is_turned else bend / (cosine + bend**2 * sine)


class FinalDrive:
    """Pinion and propeller shaft of an initialised instance."""

    def __init__(self, opened):
        self.opened = opened
        names = [name for name in opened.fmu.variables if name.startswith(("final_drive.", "propeller_shaft."))]
        self.of = {name: opened.get(name) for name in names}
        self.ratio = ratio_of(self.of)
        self.elastic, self.shaft = self.of["final_drive.elastic_mesh"], opened.get("effects.propeller_shaft")
        pinion, end = opened.read(["inertia.pinion", "inertia.propeller_end"])
        self.pinion, self.end = self.ratio**2 * pinion, self.ratio**2 * end if self.shaft else 0.0
        errors = [f"error_{n}" for n in HARMONICS] + ["pinion_runout", "ring_runout"]
        self.errs = self.elastic and any(self.of[f"final_drive.{name}"] for name in errors)
        self.bends = self.shaft and self.of["propeller_shaft.joint_angle"] > 0.0

    @property
    def keeps_momentum(self):
        """True if only the drive changes the sum of the momenta: error and joint change the ratio, friction and oil take momentum."""
        return not (self.errs or self.bends or self.of["final_drive.friction_torque"] or self.of["final_drive.viscous"])

    @property
    def bodies(self):
        """Names of the speeds of pinion and driven end."""
        return ["pinion.carrier_speed" if self.elastic else "carrier.speed", "propeller.carrier_speed" if self.shaft else "carrier.speed"]

    def momenta(self):
        return np.array([self.pinion, self.end]) * self.opened.read(self.bodies)

    def command(self):
        return self.ratio * self.opened.get("pinion.torque_command")

    def error_slopes(self):
        """Derivatives of the transmission error [rad] with respect to the angles of carrier and pinion, the second one times i."""
        if not self.errs:
            return 0.0, 0.0
        of = {name.partition(".")[2]: value for name, value in self.of.items()}
        carrier, pinion = self.opened.read(["carrier.angle", "pinion.angle"])
        terms = [(of[f"error_{n}"], n * of["pinion_teeth"], of[f"error_phase_{n}"]) for n in HARMONICS]
        terms.append((of["pinion_runout"], 1, of["pinion_runout_phase"]))
        radius = of["mean_radius"]
        by_pinion = sum(-self.ratio * size / radius * order * np.sin(order * pinion + phase) for size, order, phase in terms)
        return -of["ring_runout"] / radius * np.sin(carrier + of["ring_runout_phase"]), by_pinion

    def check(self, rounding):
        """Asserts that the torque of the drive becomes the torques on pinion and carrier."""
        one = self.opened
        rates = np.array(one.read([f"der({name})" for name in self.bodies]))
        port, before_pinion, on_carrier, speed, angle = one.read(
            ["propeller.torque", "pinion.torque", "carrier.torque", "pinion.speed", "propeller.angle"])
        inertial = [self.pinion, self.end] * rates
        slope = joint_slope(angle, self.of["propeller_shaft.joint_angle"], self.of["propeller_shaft.joint_quarter_turn"]) if self.bends else 1.0
        shaft = (self.ratio * port - inertial[1]) / slope
        # angles of many turns are only known to their rounding error
        allowed = rounding + INSTANT * (self.ratio * abs(port) + np.sum(np.abs(inertial)))
        assert abs(self.ratio * before_pinion - shaft) <= allowed, f"the pinion gets {before_pinion} N.m, not {shaft / self.ratio}"
        by_carrier, by_pinion = self.error_slopes()
        rest = shaft - inertial[0] - self.ratio * self.of["final_drive.viscous"] * speed
        friction = rest - on_carrier * (1.0 - by_pinion) / (1.0 + by_carrier)
        # dry friction that holds the pinion takes any value up to its limit
        torque = on_carrier / (1.0 + by_carrier)
        loss = self.of["final_drive.drive_loss" if torque > 0.0 else "final_drive.coast_loss"]
        limit = self.ratio * self.of["final_drive.friction_torque"] + loss * abs(torque)
        allowed += INSTANT * (abs(rest) + abs(on_carrier))
        # a fixed step may end beyond the standstill, where the damper of the spring that holds the pinion exceeds the limit
        if self.opened.get("solver.method") == FIXED_STEP:
            return
        assert abs(friction) <= limit + allowed, f"the ring gear gives {on_carrier} N.m, and dry friction takes {friction}, at most {limit}"
