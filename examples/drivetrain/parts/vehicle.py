"""Vehicle straight ahead: mass and drag."""

from equations import resistance
from part import Part


class Vehicle(Part):
    description = "Vehicle straight ahead: mass, drag of the air, rolling resistance"
    parameters = {
        "mass": (1455.0, "Mass, kg"),
        "drag": (0.4, "Half the air's density times drag coefficient and area, kg/m"),
        "rolling": (0.012, "Rolling resistance by weight"),
        "breakaway": (0.2, "Speed from which rolling resistance is full, m/s"),
    }
    states = ("speed",)
    inputs = (("left_force", "Force of the left wheel, N"), ("right_force", "Force of the right wheel, N"))
    outputs = (("speed", "Speed, m/s"),)

    def rates(self, t, x, u):
        return [(sum(u) - resistance(self, x[0])) / self.mass]

    def output_values(self, x, u):
        return {"speed": x[0]}
