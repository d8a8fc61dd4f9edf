"""Tyre of a wheel that is inside the unit of its axle: it reads the speed of the wheel and returns the load."""

from equations import patch_rate, patch_slip, tyre_force, tyre_full_slide
from wheel import Wheel


class Tyre(Wheel):
    description = "Tyre of a driven wheel that is inside another part: Pacejka's magic formula along the road, with relaxation length"
    parameters = {name: given for name, given in Wheel.parameters.items() if name != "inertia"}
    # in relaxation lengths
    states = ("deflection",)
    inputs = (("wheel_speed", "Speed of the wheel, rad/s"), ("vehicle_speed", "Speed of the vehicle, m/s"))
    outputs = (("load", "Torque of the road on the wheel, against its rotation, N.m"), ("force", "Force of the road on the tyre, N"))

    def rates(self, t, x, u):
        wheel, v = u
        return [patch_rate(x[0], tyre_full_slide(self), self.relaxation, self.radius * wheel - v, v)]

    def output_values(self, x, u):
        force = tyre_force(self, patch_slip(x[0], tyre_full_slide(self)), self.radius * u[0], u[1])
        return {"load": self.radius * force, "force": force}
