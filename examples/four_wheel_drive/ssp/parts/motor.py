"""Motor with a gear to the carrier of the centre differential, and the driver's pedal."""

from equations import motor_torque
from part import Part


class Motor(Part):
    description = "Motor: the torque of the pedal behind a lag, limited in torque and power, and a gear"
    parameters = {
        "high": (100.0, "Torque of the pressed pedal, N.m"),
        "rise": (0.2, "Time from rest to the high torque, s"),
        "release": (0.8, "Time at which the driver begins to release the pedal, s"),
        "fall": (0.1, "Duration of the release, s"),
        "ratio": (2.2, "Speed of the motor over the speed of the carrier"),
        "peak": (250.0, "Largest torque, in either direction, N.m"),
        "knee": (500.0, "Speed of the motor above which its power is constant, rad/s"),
        "lag": (0.03, "Time constant of the torque, s"),
    }
    states = ("torque",)
    inputs = (("carrier_speed", "Speed of the carrier, rad/s"),)
    outputs = (("carrier_torque", "Torque on the carrier, N.m"), ("torque", "Torque of the motor, N.m"))

    def rates(self, t, x, u):
        pressed = min(t / self.rise, 1.0) - min(max((t - self.release) / self.fall, 0.0), 1.0)
        return [(motor_torque(self, self.high * pressed, self.ratio * u[0]) - x[0]) / self.lag]

    def output_values(self, x, u):
        torque = motor_torque(self, x[0], self.ratio * u[0])
        return {"carrier_torque": self.ratio * torque, "torque": torque}
