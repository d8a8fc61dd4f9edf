"""Numbers of the drivetrain that are set from outside, shared by the system and its reference. SI units."""

from structure import Structure

# end of the launch [s]
END = 0.6
# communication step in the SSP [s]
STEP = 2e-4

# ice on the left, dry road on the right
FRICTION = {"left": 0.15, "right": 0.9}

# literals of the differential's enumerations, by number as in its model description
SPEED_DRIVEN = TORQUE_DRIVEN = 2
REST = 3
CONTACT = {"ideal": 1, "tooth": 3}

# the half-shafts are part of the differential: soft ends with the speed of a wheel as input and its torque as output
DIFFERENTIAL = {
    "scene.carrier_drive": TORQUE_DRIVEN,
    "scene.left_drive": SPEED_DRIVEN,
    "scene.right_drive": SPEED_DRIVEN,
    "scene.start": REST,
    # including the ring gear, and the pinion with its shaft times the square of the ratio
    "inertia.carrier": 0.28,
    "half_shaft.left_stiffness": 9000.0,
    "half_shaft.right_stiffness": 12000.0,
    "half_shaft.left_damping": 12.0,
    "half_shaft.right_damping": 12.0,
    # so fine that the error of the differential stays below that of the coupling
    "solver.relative_tolerance": 1e-10,
}

# inputs before the first exchange: the start values of the differential are those of a car at 60 km/h, and a host may
# connect inputs only after initialisation
AT_REST = {name: 0.0 for name in ("carrier.speed_command", "carrier.torque_command", "left.speed_command",
                                  "right.speed_command")}

# parts and the class of each, in the order of the power flow, which Gauss-Seidel follows
PARTS = {"engine": "Engine", "final_drive": "FinalDrive", "differential": "BevelDifferential", "left_wheel": "Wheel",
         "right_wheel": "Wheel", "vehicle": "Vehicle"}

# source of each input
CONNECTIONS = {
    ("engine", "speed"): ("final_drive", "engine_speed"),
    ("final_drive", "engine_torque"): ("engine", "torque"),
    ("final_drive", "carrier_speed"): ("differential", "carrier.speed"),
    ("differential", "carrier.torque_command"): ("final_drive", "carrier_torque"),
    ("differential", "left.speed_command"): ("left_wheel", "speed"),
    ("differential", "right.speed_command"): ("right_wheel", "speed"),
    ("left_wheel", "shaft_torque"): ("differential", "left.shaft_torque"),
    ("right_wheel", "shaft_torque"): ("differential", "right.shaft_torque"),
    ("left_wheel", "vehicle_speed"): ("vehicle", "speed"),
    ("right_wheel", "vehicle_speed"): ("vehicle", "speed"),
    ("vehicle", "left_force"): ("left_wheel", "force"),
    ("vehicle", "right_force"): ("right_wheel", "force"),
}


def settings(contact):
    """Parameters that differ from the parts' start values: (part, variable) → value."""
    values = {("differential", name): value for name, value in (DIFFERENTIAL | AT_REST).items()}
    values["differential", "scene.gear_contact"] = CONTACT[contact]
    for side, friction in FRICTION.items():
        values[f"{side}_wheel", "friction"] = friction
    return values


def structure(contact):
    """The drivetrain with this gear contact, as the archive contains it."""
    return Structure("drivetrain", "Launch of a car with a differential on split friction", PARTS, CONNECTIONS, settings(contact), END)
