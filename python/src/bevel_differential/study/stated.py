"""Data and results of the study: a passenger car's differential, modelled in SolidWorks and simulated in Adams.

The numbers are those printed in the study. Its gears, loads and contact constants are the start values of the FMU."""

from dataclasses import dataclass

# the car: mass [kg], radius of its tyres [m], adhesion, share of the weight on the driven front axle; gravity [m/s²]
CAR_MASS, TYRE_RADIUS, ADHESION, FRONT_SHARE, GRAVITY = 1455.0, 0.334, 0.7, 0.5, 9.81
# load on each half-shaft [N·m]
LOAD = 835.0
# stiffness by Hertz as printed, and as used [N/mm^1.5]
STIFFNESS_PRINTED, STIFFNESS_USED = 5.47e4, 5.77e5
# ripple of the speeds, either way [%]
RIPPLE = 5.0
# mean meshing force [N]
FORCE = 2.3e4
# meshing frequency claimed for driving straight ahead [Hz]
MESH_FREQUENCY = 79.5
# simulated time and output interval [s]
DURATION, INTERVAL = 0.5, 1e-3


@dataclass(frozen=True)
class Case:
    """Case of the study. `scene`: the shipped scene of the case; speeds of vehicle [km/h], carrier, planet spin, and the study's results
    for left and right side gear [deg/s]."""

    scene: str
    vehicle_speed: float
    carrier_speed: float
    planet_spin: float
    side_speeds: tuple[float, float]


CASES = {"straight": Case("study_straight", 60.0, 2861.0, 0.0, (2858.0, 2859.0)),
         "turning": Case("study_turning", 20.0, 954.0, 200.0, (1082.0, 830.0))}
