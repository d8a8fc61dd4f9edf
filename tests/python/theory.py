"""Closed forms for the default gears, written from the formulas and independent of the program."""

from math import atan2, cos, log10, pi, radians, sin

MODULE, PLANET_TEETH, SIDE_TEETH = 4.5e-3, 10, 16
FACE_WIDTH, PRESSURE_ANGLE, BACKLASH = 20e-3, radians(20.0), 1e-4
LOAD, PLANETS = 835.0, 2
RATIO, TOOTH_PITCH = PLANET_TEETH / SIDE_TEETH, 2.0 * pi / PLANET_TEETH
STIFFNESS, EXPONENT = 5.77e5 * 1000.0**1.5, 1.5

# an axle with clutch packs, and with drag of bearings and oil
CLUTCHES = {"effects.limited_slip": True, "limited_slip.preload": 50.0, "limited_slip.torque_coefficient": 0.1}
DRAG = {"effects.bearing_drag": True, "bearing_drag.carrier_torque": 0.5, "bearing_drag.carrier_viscous": 5e-3,
        "bearing_drag.carrier_churning": 1e-4, "bearing_drag.side_torque": 0.2, "bearing_drag.side_viscous": 1e-3}

PLANET_PITCH = atan2(1.0, SIDE_TEETH / PLANET_TEETH)
SIDE_PITCH = pi / 2.0 - PLANET_PITCH
OUTER_CONE = MODULE * PLANET_TEETH / (2.0 * sin(PLANET_PITCH))
MEAN_CONE, INNER_CONE = OUTER_CONE - FACE_WIDTH / 2.0, OUTER_CONE - FACE_WIDTH
# integral of R² over the face, and cone distance of the resultant of a load in proportion to R
FACE_MOMENT = (OUTER_CONE**3 - INNER_CONE**3) / 3.0
RESULTANT = FACE_MOMENT / (MEAN_CONE * FACE_WIDTH)
# sines of the base angles: lever arms of the normal force per cone distance
PLANET_LEVER, SIDE_LEVER = (sin(pitch) * cos(PRESSURE_ANGLE) for pitch in (PLANET_PITCH, SIDE_PITCH))

# sum T/r of all planets, at the side gear's outer pitch circle
TANGENTIAL_FORCE = LOAD / (MODULE * SIDE_TEETH / 2.0)


def normal_force(planets=PLANETS):
    """Normal force of one mesh at the mean cone distance [N]."""
    return LOAD / (planets * MEAN_CONE * SIDE_LEVER)


def side_speeds(carrier, spin):
    """Speeds of left and right side gear by Willis."""
    difference = spin * PLANET_TEETH / SIDE_TEETH
    return carrier + difference, carrier - difference


def mesh_frequency(spin):
    """Mesh frequency [Hz] at a planet spin [deg/s] relative to the carrier."""
    return PLANET_TEETH * abs(spin) / 360.0


def half_play_arc():
    """Half the normal backlash, as an arc on the unit sphere."""
    return BACKLASH * cos(PRESSURE_ANGLE) / OUTER_CONE / 2.0


def half_play():
    """Rotation of a side gear [rad] from the middle of the gap to contact of the drive flanks, with held planets."""
    return half_play_arc() / SIDE_LEVER


def largest_wind_up():
    """Rotation of a side gear [rad] under the load if a single pair of each mesh carries it."""
    return (normal_force() / STIFFNESS) ** (1.0 / EXPONENT) / MEAN_CONE / SIDE_LEVER


# parameters of the viscosity of an oil, in the order of `viscosity`
OIL = ["viscosity_40", "viscosity_100", "density", "density_fall"]


def kinematic_viscosity(kelvin, at_40=1e-4, at_100=1.5e-5):
    """Kinematic viscosity of an oil at a temperature [m2/s]: ASTM D341 through the values at 40 and 100 degC."""
    ends = [log10(log10(1e6 * of + 0.7)) for of in (at_40, at_100)]
    place = log10(kelvin / 313.15) / log10(373.15 / 313.15)
    return 1e-6 * (10.0 ** 10.0 ** (ends[0] + (ends[1] - ends[0]) * place) - 0.7)


def viscosity(kelvin, at_40=1e-4, at_100=1.5e-5, density=870.0, fall=0.65):
    """Dynamic viscosity of an oil at a temperature [Pa.s], with its density at 15 degC and the decrease of density with temperature."""
    return kinematic_viscosity(kelvin, at_40, at_100) * (density - fall * (kelvin - 288.15))


def churning(kinematic, speed, diameter, width, dip):
    """Churning power of a smooth disc with its rim and sides [W] by ISO/TR 14179-1:2001, which uses kW, mm2/s, 1/min and mm."""
    nu, n, outside, length, arrangement = 1e6 * kinematic, speed * 30.0 / pi, 1e3 * diameter, 1e3 * width, 0.2
    rim = 7.37 * dip * nu * n**3 * outside**4.7 * length / (arrangement * 1e26)
    sides = 1.474 * dip * nu * n**3 * outside**5.7 / (arrangement * 1e26)
    return 1e3 * (rim + sides)
