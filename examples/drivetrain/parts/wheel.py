"""Wheel with a tyre that builds its slip up over a relaxation length, on a road of its own friction."""

from math import atan, sin

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
    }
    states = ("speed", "slip")
    inputs = (("shaft_torque", "Torque of the half-shaft, N.m"), ("vehicle_speed", "Speed of the vehicle, m/s"))
    outputs = (("speed", "Speed of the wheel, rad/s"), ("force", "Force of the road on the tyre, N"),
               ("slip", "Slip of the tyre as it has built up"))

    def force(self, slip):
        peak = self.friction * self.load
        return peak * sin(self.shape * atan(self.slip_stiffness / (self.shape * peak) * slip))

    def rates(self, t, x, u):
        speed, slip = x
        return [(u[0] - self.radius * self.force(slip)) / self.inertia,
                (self.radius * speed - u[1] - abs(u[1]) * slip) / self.relaxation]

    def told(self, x, u):
        return {"speed": x[0], "force": self.force(x[1]), "slip": x[1]}
