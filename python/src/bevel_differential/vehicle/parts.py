"""Tyre, motor and body of a car: small models for drivetrain scenes. Start values are those of a passenger car."""

from dataclasses import dataclass

from .part import Part, parameter


@dataclass
class Tyre(Part):
    """Driven wheel and its tyre. The slip builds up over a relaxation length, until the whole contact patch slides. The force follows
    Pacejka's magic formula.

    Torque on the wheel: the differential's shaft torque less `radius` times the force of the road."""

    radius: float = parameter(0.334, "m", "Radius of the rolling tyre", 0.0)
    inertia: float = parameter(1.0, "kg.m2", "Wheel, tyre, hub and brake disc about the axle", 0.0)
    load: float = parameter(3568.0, "N", "Vertical force", 0.0)
    friction: float = parameter(0.9, "1", "Friction coefficient of the road", 0.0)
    slip_stiffness: float = parameter(70000.0, "N", "Slope of the force by slip at no slip", 0.0)
    shape: float = parameter(1.4, "1", "C of the magic formula", 0.0)
    relaxation: float = parameter(0.4, "m", "Relaxation length", 0.0)
    damping: float = parameter(1000.0, "N.s/m", "Damping of the tyre along the road at standstill", 0.0)
    walk: float = parameter(2.5, "m/s", "Speed at which this damping is halved", 0.0)


@dataclass
class Motor(Part):
    """Motor with a gear of fixed ratio to the carrier, of which a final drive is a part. Its torque follows the request with a lag of first order. Below the knee, the torque
    is at most `peak`. Above the knee, the power is at most `peak` times `knee`, driving or braking, forward or backward. With
    `ratio` = 1 the motor represents any source of torque."""

    ratio: float = parameter(9.0, "1", "Speed of the motor over the speed of the carrier", 0.0)
    inertia: float = parameter(0.03, "kg.m2", "Rotor and all that turns with it, at the motor's speed", 0.0)
    peak: float = parameter(250.0, "N.m", "Largest torque, in either direction", 0.0)
    knee: float = parameter(500.0, "rad/s", "Speed of the motor above which its power is constant", 0.0)
    lag: float = parameter(0.03, "s", "Time constant of the torque", 0.0)


@dataclass
class Body(Part):
    """Body of the car in the plane: speed ahead, lateral speed, yaw rate. It is a single-track model with the forces of the driven wheels
    at the two ends of their axle. The driven axle is the rear one. Lateral forces do not reduce the grip of the driven tyres, and wheel
    loads do not change."""

    mass: float = parameter(1455.0, "kg", "Mass", 0.0)
    drag: float = parameter(0.4, "kg/m", "Half the air's density times drag coefficient and area", -1e-300)
    rolling: float = parameter(0.012, "1", "Rolling resistance by weight", -1e-300)
    breakaway: float = parameter(0.02, "m/s", "Speed from which rolling resistance is full", 0.0)
    track: float = parameter(1.5, "m", "Distance of the driven wheels", 0.0)
    front: float = parameter(1.2, "m", "Distance of the front axle from the centre of gravity", 0.0)
    rear: float = parameter(1.4, "m", "Distance of the driven axle from the centre of gravity", 0.0)
    yaw_inertia: float = parameter(2200.0, "kg.m2", "Moment of inertia about the vertical axis", 0.0)
    front_stiffness: float = parameter(90e3, "N/rad", "Cornering stiffness of the front axle", 0.0)
    rear_stiffness: float = parameter(110e3, "N/rad", "Cornering stiffness of the driven axle", 0.0)
    relaxation: float = parameter(0.5, "m", "Relaxation length of the lateral forces", 0.0)
    grip: float = parameter(0.9, "1", "Largest lateral force of an axle by its load", 0.0)
