"""Wheel with a tyre whose slip builds up over a relaxation length until its patch slides, on a road with given friction."""

from equations import patch_rate, patch_slip, tyre_force, tyre_full_slide
from part import Part


class Wheel(Part):
    description = "Driven wheel: Pacejka's magic formula along the road, with relaxation length"
    parameters = {
        "inertia": (1.0, "Wheel, tyre, hub and brake disc, kg.m2"),
        "radius": (0.334, "Radius of the tyre, m"),
        "load": (3568.0, "Vertical force, N"),
        "friction": (0.9, "Friction coefficient of the road"),
        "slip_stiffness": (70000.0, "Slope of the force by slip at no slip, N"),
        "shape": (1.4, "C of the magic formula"),
        "relaxation": (0.4, "Relaxation length, m"),
        "damping": (1000.0, "Damping of the tyre along the road at standstill, N.s/m"),
        "walk": (2.5, "Speed of the vehicle at which this damping is halved, m/s"),
    }
    # the deflection is in relaxation lengths
    states = ("speed", "deflection")
    inputs = (("shaft_torque", "Torque of the half-shaft, N.m"), ("vehicle_speed", "Speed of the vehicle, m/s"))
    outputs = (("speed", "Speed of the wheel, rad/s"), ("force", "Force of the road on the tyre, N"),
               ("slip", "Slip of the tyre as it has built up"))

    def slip(self, x):
        return patch_slip(x[1], tyre_full_slide(self))

    def force(self, x, v):
        return tyre_force(self, self.slip(x), self.radius * x[0], v)

    def rates(self, t, x, u):
        torque, v = u
        return [(torque - self.radius * self.force(x, v)) / self.inertia,
                patch_rate(x[1], tyre_full_slide(self), self.relaxation, self.radius * x[0] - v, v)]

    def output_values(self, x, u):
        return {"speed": x[0], "force": self.force(x, u[1]), "slip": self.slip(x)}
