"""Values of parameters and inputs of a differential that can be built, loaded and turned.

The interface allows many decades, for gears from watches to ships; here, values are within a band around the start value. Sizes are
proportional to the module. Values that exclude each other by the documentation are drawn consistently."""

import os
from math import atan2, exp, log, pi, sin

import effects_list
from sampling import spread

# the interface's enumerations, by number
EXPLICIT, IMPACT, LINE, IDEAL, LUMPED, TOOTH, TORQUE_CARRIER = 4, 1, 2, 1, 2, 3, 2
ADAPTIVE, FIXED_STEP, RADAU = 1, 2, 3
MODULE = 4.5e-3
# number of points of a measured clutch curve
CURVE_POINTS = 8
# kinds of start
EQUILIBRIUM, STEADY_HEAT = 1, 4

# typical values of parameters whose start value is zero
TYPICAL = {"limited_slip.preload": 50.0, "limited_slip.torque_coefficient": 0.1, "bearing_drag.carrier_torque": 0.5,
           "bearing_drag.carrier_viscous": 5e-3, "bearing_drag.carrier_churning": 1e-4, "bearing_drag.side_torque": 0.2,
           "bearing_drag.side_viscous": 1e-3, "limited_slip.viscous_torque": 30.0}

# factors above and below the start value, within which values are drawn by logarithm
FACTORS = {
    "material.young_modulus": 3.0, "material.density": 2.0, "inertia.carrier": 10.0, "inertia.side_gear": 30.0,
    "inertia.planet": 30.0, "contact.penetration_depth": 30.0, "contact.impact_speed": 30.0,
    "contact.reference_line_load": 10.0, "contact.mesh_stiffness": 100.0, "half_shaft.left_stiffness": 30.0,
    "half_shaft.right_stiffness": 30.0, "pin_compliance.pin_stiffness": 30.0, "pin_compliance.case_stiffness": 30.0,
    "thrust_friction.stiffness": 30.0, "limited_slip.stiffness": 30.0, "lock.stiffness": 30.0, "lock.torque": 30.0,
    "clutches.torque": 10.0, "clutches.stiffness": 30.0, "clutches.friction_area": 3.0, "disconnect.teeth": 3.0, "disconnect.most_speed": 5.0,
    "disconnect.most_torque": 10.0,
    "wheel_brake.stiffness": 30.0, "limited_slip.friction_area": 3.0, "wheel_brake.friction_area": 3.0,
    **{f"thrust_friction.{name}_area": 3.0 for name in ("planet_washer", "side_washer", "pin")},
    "tooth_friction.stribeck_speed": 30.0, "tooth_friction.regularisation_speed": 10.0,
    "tooth_friction.oil_viscosity": 30.0, "bearing_drag.breakaway_speed": 10.0, "strength.bending_strength": 5.0,
    "strength.contact_strength": 5.0, "strength.bending_cycles": 10.0, "strength.contact_cycles": 10.0,
    "limited_slip.viscous_speed": 3.0, "inertia.pinion": 5.0, "inertia.propeller_end": 5.0, "final_drive.stiffness": 5.0,
    "final_drive.holding_stiffness": 5.0, "propeller_shaft.stiffness": 5.0, "solver.fixed_step": 10.0, "strength.thermal_contact_coefficient": 2.0, "warm_up.oil_capacity": 30.0,
    "warm_up.gear_specific_heat": 2.0, "warm_up.clutch_capacity": 30.0, "warm_up.washer_capacity": 30.0, "warm_up.case_capacity": 30.0}
# values from zero (a tenth of the draws) up to this multiple of the start value
MULTIPLES = {
    "contact.damping": 100.0, "half_shaft.left_damping": 10.0, "half_shaft.right_damping": 10.0,
    "limited_slip.preload": 10.0, "limited_slip.coast_ratio": 3.0, "limited_slip.viscous_torque": 10.0, "lock.damping_time": 10.0, "clutches.damping_time": 10.0, "final_drive.damping": 3.0,
    "propeller_shaft.damping": 3.0,
    "pin_compliance.damping_time": 100.0, "bearing_drag.carrier_torque": 30.0,
    "bearing_drag.carrier_viscous": 30.0, "bearing_drag.carrier_churning": 30.0, "bearing_drag.side_torque": 30.0,
    "bearing_drag.side_viscous": 30.0, "tooth_friction.roughness": 10.0,
    **{f"warm_up.{name}": 10.0 for name in ("gears_to_oil", "gears_to_oil_per_speed", "clutch_to_oil", "washers_to_oil", "oil_to_case",
                                           "case_to_ambient", "case_to_ambient_per_speed")}}
# bands within which values are drawn uniformly
BANDS = {
    "geometry.pressure_angle": (0.28, 0.44), "material.poisson_ratio": (0.0, 0.4), "geometry.root_fillet": (0.0, 0.5), "geometry.thickness_shift": (-0.05, 0.05),
    "contact.exponent": (1.0, 2.0), "limited_slip.torque_coefficient": (0.0, 0.5),
    "limited_slip.static_ratio": (1.0, 2.0), "limited_slip.viscous_exponent": (0.3, 2.0), "tooth_friction.static_ratio": (1.0, 2.0),
    "tooth_friction.coefficient": (0.0, 0.15), "thrust_friction.coefficient": (0.0, 0.2),
    "thrust_friction.pin_coefficient": (0.0, 0.2), "tooth_errors.shaft_angle_error": (-1e-3, 1e-3),
    "tooth_fault.onset": (0.0, 0.05), "carrier.speed_command": (-150.0, 150.0), "pinion.speed_command": (-600.0, 600.0),
    "left.speed_command": (-150.0, 150.0), "right.speed_command": (-150.0, 150.0), "spin.command": (-60.0, 60.0),
    "strength.tool_radius": (0.0, 0.3),
    "oil.temperature": (250.0, 400.0), "warm_up.ambient_temperature": (243.0, 323.0), "oil.viscosity_40": (5e-05, 0.0003),
    "oil.viscosity_100": (5e-06, 3e-05), "oil.density": (800.0, 950.0), "oil.density_fall": (0.5, 0.8),
    "bearing_drag.reference_temperature": (330.0, 370.0), "bearing_drag.oil_level": (0.0, 1.0),
    "bearing_drag.seal_torque_per_diameter": (1.0, 6.0), "bearing_drag.bearing_load": (0.0, 5000.0),
    "bearing_drag.bearing_coefficient": (2e-4, 1e-3), "wheel_brake.temperature": (250.0, 900.0), "limited_slip.mean_radius": (0.02, 0.1),
    "clutches.mean_radius": (0.02, 0.1), "clutches.plate_coefficient": (0.05, 0.2), "clutches.static_ratio": (1.0, 2.0),
    "disconnect.lash": (5e-3, 0.05), "disconnect.ratchet_torque": (0.0, 20.0),
    **{f"{effect}.{name}": band for effect in ("clutches", "lock") for name, band in {
        "dead_band": (0.0, 0.2), "stroke_time": (0.0, 0.3), "response_time": (0.0, 0.05), "response_damping": (0.3, 2.0)}.items()},
    "clutches.left_ratio": (0.8, 1.2), "clutches.right_ratio": (0.0, 1.2), "limited_slip.thrust_arm": (0.0, 0.02),
    "wheel_brake.mean_radius": (0.05, 0.2), "thrust_friction.static_ratio": (1.0, 2.0), "wheel_brake.static_ratio": (1.0, 2.0),
    "strength.scuffing_temperature": (450.0, 800.0), "warm_up.cycle": (3e-3, 2e-2), "warm_up.ambient_change": (-20.0, 20.0),
    "warm_up.sump_change": (-20.0, 20.0),
    **{f"warm_up.{node}_above_oil": (-20.0, 20.0) for node in ("gears", "clutch", "washers", "case")},
    "final_drive.drive_pressure_angle": (0.3, 0.4), "final_drive.coast_pressure_angle": (0.3, 0.4), "final_drive.spiral_angle": (0.0, 0.7),
    "final_drive.pitch_angle": (0.0, 1.4), "propeller_shaft.joint_angle": (0.0, 0.3),
    # friction over speed and temperature, with ordered temperature points
    **{f"{effect}.{name}": band for effect in ("limited_slip", "clutches", "thrust_friction", "wheel_brake") for name, band in {
        "stribeck_speed": (0.0, 0.5), "slip_slope": (-0.02, 0.02), "cold_temperature": (230.0, 300.0), "cold_factor": (0.7, 1.5),
        "reference_temperature": (330.0, 360.0), "hot_temperature": (380.0, 480.0), "hot_factor": (0.5, 1.2),
        "pv_limit": (0.0, 1e6), "beyond_limit": (0.5, 2.0)}.items()},
    "limited_slip.plate_coefficient": (0.05, 0.2), "wheel_brake.lining_coefficient": (0.2, 0.6),
    # half of the values are "from the start", and half of the side gears have the mass of their solids
    "strength.rate_from": (-0.02, 0.02), "inertia.side_gear_mass": (-1.0, 1.0)}
# lengths that are proportional to the module, in modules
IN_MODULES = {
    "geometry.backlash": (0.0, 0.05), "geometry.planet_bore": (0.0, 2.0), "geometry.side_bore": (0.0, 4.0),
    "tooth_errors.planet_runout": (0.0, 0.01), "tooth_errors.side_runout": (0.0, 0.01),
    "tooth_errors.planet_tip_relief": (0.0, 0.01), "tooth_errors.side_tip_relief": (0.0, 0.01),
    "tooth_errors.crowning": (0.0, 0.01), "tooth_errors.planet_axial_offset": (-0.01, 0.01),
    "tooth_errors.side_axial_offset": (-0.01, 0.01), "tooth_errors.axis_offset": (-0.01, 0.01),
    "bearing_drag.carrier_diameter": (30.0, 50.0), "bearing_drag.carrier_width": (5.0, 20.0), "bearing_drag.seal_diameter": (0.0, 12.0),
    "final_drive.backlash": (0.0, 0.06), "final_drive.mean_radius": (15.0, 25.0), "final_drive.error_1": (0.0, 2e-3),
    "final_drive.error_2": (0.0, 1e-3), "final_drive.error_3": (0.0, 1e-3), "final_drive.pinion_runout": (0.0, 5e-3),
    "final_drive.ring_runout": (0.0, 0.01), "final_drive.ring_offset": (-10.0, 10.0), "final_drive.left_bearing": (10.0, 25.0),
    "final_drive.right_bearing": (10.0, 25.0), "bearing_drag.bearing_diameter": (10.0, 20.0), "tooth_fault.depth": (0.0, 0.3), "thrust_friction.pin_radius": (0.5, 2.0),
    "thrust_friction.planet_washer_radius": (1.0, 4.0), "thrust_friction.side_washer_radius": (2.0, 6.0)}
# torques relative to the load capacity of teeth of this size
IN_LOADS = {"left.load_torque": 1.0, "right.load_torque": 1.0, "carrier.torque_command": 2.0,
            "left.brake_torque": 1.0, "right.brake_torque": 1.0, "pinion.torque_command": 0.5, "final_drive.friction_torque": 3e-3}
# powers of their size with which quantities of similar final drives grow
GROWTH = {"inertia.pinion": 5, "inertia.propeller_end": 5, "final_drive.stiffness": 1, "final_drive.damping": 2,
          "final_drive.holding_stiffness": 3, "propeller_shaft.stiffness": 3, "propeller_shaft.damping": 4}


def limits(variable):
    """Smallest and largest value of a number. For a time, which may have any value, the drawn range."""
    return BANDS[variable.name] if variable.minimum is None else (variable.minimum, variable.maximum)


def value(variable, u, scene):
    """Value of one variable, given the values on which it depends."""
    name = variable.name
    start = TYPICAL.get(name, variable.start)
    if variable.kind == "Boolean":
        return u < 0.5
    if variable.kind == "Enumeration":
        return 1 + int(u * len(variable.literals))
    low, high = limits(variable)
    if variable.kind == "Integer":
        return int(low + u * (high - low + 1.0))
    size = scene.get("geometry.module", MODULE)
    if name in FACTORS:
        x = start * FACTORS[name] ** (2.0 * u - 1.0)
    elif name in MULTIPLES:
        x = 0.0 if u < 0.1 else start * exp(log(MULTIPLES[name]) * (2.0 * (u - 0.1) / 0.9 - 1.0))
    elif name in BANDS:
        x = BANDS[name][0] + u * (BANDS[name][1] - BANDS[name][0])
    elif name in IN_MODULES:
        x = size * (IN_MODULES[name][0] + u * (IN_MODULES[name][1] - IN_MODULES[name][0]))
    elif name in IN_LOADS:
        # bending of similar teeth is proportional to the third power of their size; a fifth of the loads acts against rotation
        x = IN_LOADS[name] * 1200.0 * (size / MODULE) ** 3 * (u - 0.2)
    else:
        x = spread(u, low, high, start)
    return min(max(x, low), high)


def values(variables, shares):
    """Scene with values of all variables by name."""
    scene = {"geometry.module": MODULE * 4.0 ** (2.0 * shares["geometry.module"] - 1.0)}
    for variable in variables:
        if variable.name not in scene:
            scene[variable.name] = value(variable, shares[variable.name], scene)
    gears(scene, shares)
    contact(scene, shares)
    drives(scene, shares)
    effects(scene, shares)
    final_drive(scene, shares)
    return scene


def gears(scene, u):
    """Sets teeth that mesh, planets that fit in between, and faces within the cone."""
    planet = 9 + int(u["geometry.planet_teeth"] * 12)
    side = planet + int(u["geometry.side_teeth"] * 14)
    fitting = [n for n in (2, 3, 4) if 2 * side % n == 0]
    scene.update({
        "geometry.planet_teeth": planet, "geometry.side_teeth": side,
        "geometry.planet_count": fitting[int(u["geometry.planet_count"] * len(fitting))],
        "geometry.shaft_angle": pi / 2.0})
    cone = scene["geometry.module"] * planet / (2.0 * sin(atan2(planet, side)))
    scene["geometry.face_width"] = cone * (0.1 + 0.35 * u["geometry.face_width"])
    # the tip of each gear clears the root of its mate
    for gear, mate in (("planet", "side"), ("side", "planet")):
        addendum = 0.7 + 0.3 * u[f"geometry.{gear}_addendum"]
        scene[f"geometry.{gear}_addendum"] = addendum
        scene[f"geometry.{mate}_dedendum"] = addendum + 0.15 + 0.2 * u[f"geometry.{mate}_dedendum"]
    # inertia of similar bodies is proportional to the fifth power of their size
    growth = (scene["geometry.module"] / MODULE) ** 5
    for name in ("inertia.carrier", "inertia.side_gear", "inertia.planet"):
        scene[name] *= growth
    # a tenth of the half-shafts has no end inertia; the others have that of wheels, so that unequal loads do not accelerate light gears
    for name in ("inertia.left_end", "inertia.right_end"):
        scene[name] = 0.0 if u[name] < 0.1 else growth * 10.0 ** (-1.5 + 2.0 * u[name])


def contact(scene, u):
    """Sets a stiffness at which a tooth of this size bends by 0.01 to 1 % of the module under its design load."""
    force = 16e3 * (scene["geometry.module"] / MODULE) ** 2
    exponent = 1.5 if scene["contact.stiffness_from_hertz"] else scene["contact.exponent"]
    deflection = scene["geometry.module"] * 10.0 ** (-4.0 + 2.0 * u["contact.stiffness"])
    scene["contact.exponent"] = exponent
    scene["contact.stiffness"] = force / deflection**exponent
    # mostly the default method; the last entry keeps the scenes for which the seeds were chosen
    scene["solver.method"] = ([ADAPTIVE] * 8 + [FIXED_STEP, RADAU, ADAPTIVE])[int(11 * u["solver.method"])]
    scene["solver.relative_tolerance"] = 10.0 ** (-7.0 + 3.0 * u["solver.relative_tolerance"])


def drives(scene, u):
    """Sets at most two imposed speeds, and consistent speeds at the start."""
    choices = [{"carrier"}, {"carrier", "spin"}, set(), {"left"}, {"right", "carrier"}, {"left", "right"}, {"spin"}]
    imposed = choices[int(u["scene.carrier_drive"] * len(choices))]
    scene["scene.carrier_drive"] = 1 if "carrier" in imposed else TORQUE_CARRIER
    for side in ("left", "right"):
        scene[f"scene.{side}_drive"] = 2 if side in imposed else 1
    scene["scene.planet_spin"] = 2 if "spin" in imposed else 1


def final_drive(scene, u):
    """Sets the ratio of a car or a truck, bodies of the size of the gears, and commands of the pinion that fit those of the carrier."""
    scene["effects.final_drive"] |= scene["effects.propeller_shaft"]
    scene["final_drive.pinion_teeth"] = 8 + int(u["final_drive.pinion_teeth"] * 7)
    scene["final_drive.ring_teeth"] = 31 + int(u["final_drive.ring_teeth"] * 15)
    ratio = scene["final_drive.ring_teeth"] / scene["final_drive.pinion_teeth"]
    for name, power in GROWTH.items():
        scene[name] *= (scene["geometry.module"] / MODULE) ** power
    # oil takes up to a few percent of the torque at usual speeds
    scene["final_drive.viscous"] = 1e-5 * u["final_drive.viscous"] * abs(scene["carrier.torque_command"])
    scene["pinion.speed_command"] = ratio * scene["carrier.speed_command"]
    scene["pinion.torque_command"] = scene["carrier.torque_command"] / ratio


def effects(scene, u):
    """Sets effects, only with levels of contact that accept them."""
    gear_contact = [IDEAL, LUMPED, TOOTH, TOOTH, TOOTH][int(u["scene.gear_contact"] * 5)]
    scene["scene.gear_contact"] = gear_contact
    for name in u:
        # one or two effects at a time, so that the cause of a failure is visible
        if name.startswith("effects.") and name not in ("effects.backlash", "effects.corner_contact"):
            scene[name] = u[name] < 0.15
    scene["effects.corner_contact"] = u["effects.corner_contact"] < 0.95
    level = {IDEAL: "ideal", LUMPED: "lumped", TOOTH: "tooth"}[gear_contact]
    known = effects_list.effects(os.environ["FMU"])
    scene.update({effect.switch: False for effect in known if effect.switch and level not in effect.contact})
    # steady heat needs the effect warm_up
    if scene["scene.start"] == STEADY_HEAT and not scene["effects.warm_up"]:
        scene["scene.start"] = EQUILIBRIUM
    if gear_contact == IDEAL:
        scene["limited_slip.torque_coefficient"] = 0.0
    if gear_contact not in (LUMPED, TOOTH) or u["limited_slip.thrust_arm"] < 0.5:
        scene["limited_slip.thrust_arm"] = 0.0
    clutches(scene, u)
    # a dog clutch needs a wheel that turns apart from its side gear
    apart = [s for s, side in ((1, "left"), (2, "right"))
             if scene[f"scene.{side}_drive"] == 2 or scene["effects.half_shaft"] and scene[f"inertia.{side}_end"] > 0.0]
    scene["effects.disconnect"] &= bool(apart)
    if len(apart) == 1:
        scene["disconnect.sides"] = apart[0]
    grade = int(u["tooth_errors.accuracy_grade"] * 10)
    scene["tooth_errors.accuracy_grade"] = grade + 1 if grade else 0
    scene["tooth_errors.runout_by_grade"] = bool(grade and scene["tooth_errors.runout_by_grade"])
    scene["tooth_fault.index"] = int(u["tooth_fault.index"] * 2)
    scene["tooth_fault.tooth"] = int(u["tooth_fault.tooth"] * scene["geometry.planet_teeth"])
    if scene["contact.law"] == IMPACT:
        scene["effects.body_compliance"] = False
        scene["tooth_fault.missing_fraction"] = 0.55 + 0.45 * u["tooth_fault.missing_fraction"]


def clutches(scene, u):
    """Sets sheared oil in half of the clutches, and a measured curve in half of them, with slips that rise from point to point."""
    if u["limited_slip.viscous_torque"] < 0.5:
        scene["limited_slip.viscous_torque"] = 0.0
    # number of points, from 0 to all; half of the curves start with a breakaway torque
    points, slip = max(0, int(18 * u["limited_slip.curve[1].torque"]) - 9), 0.0
    for i in range(1, CURVE_POINTS + 1):
        name = f"limited_slip.curve[{i}]"
        slip += 0.0 if i == 1 and u[f"{name}.slip"] < 0.5 else 10.0 * 0.1 ** (1.0 - u[f"{name}.slip"])
        scene[f"{name}.slip"], scene[f"{name}.torque"] = (slip, 80.0 * u[f"{name}.torque"]) if i <= points else (0.0, 0.0)
