"""Engine: torque as a function of time and speed, with a lag."""

from math import sqrt

from part import Part


def ramp(t, begin, end):
    """Ramp from 0 to 1 with three continuous derivatives."""
    s = min(max((t - begin) / (end - begin), 0.0), 1.0)
    return s**4 * (35.0 - 84.0 * s + 70.0 * s**2 - 20.0 * s**3)


class Engine(Part):
    description = "Engine: the pedal's torque over time, less at speed, behind a lag of first order"
    parameters = {
        "high": (110.0, "Requested torque from rise on, N.m"),
        "low": (35.0, "Requested torque after fall, N.m"),
        "rise": (0.15, "Time from rest to the high torque, s"),
        "fall": (0.35, "Time at which the driver begins to release the pedal, s"),
        "release": (0.1, "Duration of the release, s"),
        "lag": (0.03, "Time constant of the torque, s"),
        "knee": (300.0, "Speed around which the torque begins to fall, rad/s"),
    }
    states = ("torque",)
    inputs = (("speed", "Speed of the engine, rad/s"),)
    outputs = (("torque", "Torque of the engine, N.m"),)

    def rates(self, t, x, u):
        asked = self.high * ramp(t, 0.0, self.rise) - (self.high - self.low) * ramp(t, self.fall, self.fall + self.release)
        return [(asked / sqrt(1.0 + (u[0] / self.knee) ** 2) - x[0]) / self.lag]

    def output_values(self, x, u):
        return {"torque": x[0]}
