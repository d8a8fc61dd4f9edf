"""Gearbox, prop shaft and final drive: inertia on the engine's side, torsion of the shaft, ratio to the carrier."""

from part import Part


class FinalDrive(Part):
    description = "Gearbox with the inertia of the engine, prop shaft, final drive up to the ring gear"
    parameters = {
        "inertia": (0.15, "Engine, clutch and gearbox at the speed of the engine, kg.m2"),
        "gear": (3.5, "Ratio of the gearbox"),
        "final": (3.9, "Ratio of the final drive"),
        "stiffness": (7500.0, "Torsion of the prop shaft, N.m/rad"),
        "damping": (8.0, "Damping of the prop shaft, N.m.s/rad"),
    }
    states = ("engine_speed", "twist")
    inputs = (("engine_torque", "Torque of the engine, N.m"), ("carrier_speed", "Speed of the carrier, rad/s"))
    outputs = (("carrier_torque", "Torque on the carrier, N.m"), ("engine_speed", "Speed of the engine, rad/s"))

    def shaft(self, x, u):
        """Torque in the prop shaft and the rate of its twist."""
        rate = x[0] / self.gear - self.final * u[1]
        return self.stiffness * x[1] + self.damping * rate, rate

    def rates(self, t, x, u):
        torque, rate = self.shaft(x, u)
        return [(u[0] - torque / self.gear) / self.inertia, rate]

    def output_values(self, x, u):
        return {"carrier_torque": self.final * self.shaft(x, u)[0], "engine_speed": x[0]}
