"""Vehicles of ordinary drives: wheels, gears of matching size, and effects of the differential, drawn at random.

Every drawn start value takes effect in its scene, and no scene is refused."""

from dataclasses import dataclass
from math import sqrt

# inertia at a wheel including its share of the vehicle, from a pedal car to a loaded truck [kg·m²]
LIGHTEST, HEAVIEST = 0.05, 150.0
# side torque for which the default gears are designed, and the highest torque for which they are used [N·m]
RATED, KEPT = 835.0, 1200.0
# size of the smallest gears relative to the default gears
SMALLEST = 0.33
# teeth of planets and side gears, and number of planets, that can be assembled
TEETH = [(10, 16, 2), (10, 16, 4), (9, 14, 4), (11, 15, 2), (10, 18, 3)]
FRICTION_LAWS = ["coulomb_stribeck", "benedict_kelley", "iso_14179", "xu_kahraman"]


@dataclass(frozen=True)
class Vehicle:
    """Vehicle data that matter for its differential.

    `wheel`: inertia at each wheel; `carrier`: inertia at the carrier [kg·m²]. `pull`, `grip`, `slope`: angular accelerations of the
    wheels by the drive, by one brake each, and by a slope, with a sign [rad/s²]. `peak`: highest torque of a half-shaft [N·m]; `size`:
    size of the gears relative to the default; `by_speed`: true if the carrier is speed-driven."""

    wheel: float
    carrier: float
    pull: float
    grip: float
    slope: float
    peak: float
    size: float
    by_speed: bool

    @property
    def bias(self):
        """Torque that friction of the differential may transfer between the wheels if the drive imposes a speed [N·m]."""
        return 2.0 * self.peak if self.by_speed else 0.0


def vehicle(random, by_speed):
    """Vehicle of random size, uniform in the logarithm of its weight."""
    wheel = LIGHTEST * (HEAVIEST / LIGHTEST) ** random.random()
    pull, grip = random.uniform(3.0, 12.0), random.uniform(5.0, 20.0)
    slope = random.uniform(-5.0, 5.0) if random.random() < 0.7 else 0.0
    peak = wheel * (pull + abs(slope))
    # bending of similar teeth is proportional to the third power of their size
    fitting = max((peak / RATED) ** (1.0 / 3.0) * random.uniform(0.9, 1.3), SMALLEST)
    size = 1.0 if peak < KEPT and random.random() < 0.6 else fitting
    return Vehicle(wheel, wheel * 10.0 ** random.uniform(-2.7, -1.0), pull, grip, slope, peak, size, by_speed)


def differential(random, vehicle, contact, law, levels):
    """Start values of gears, contact and effects. `levels`: levels of gear contact that each effect accepts, by its name."""
    values = {"scene.gear_contact": contact, "inertia.carrier": vehicle.carrier, "inertia.left_end": vehicle.wheel,
              "inertia.right_end": vehicle.wheel, "effects.wheel_brake": True} | brake(random, vehicle)
    if contact == "tooth":
        values["contact.law"] = law
    if contact == "solid":
        values["solid.facets"] = int(random.integers(4, 9))
    if contact != "ideal":
        values |= gears(random, vehicle.size) | damping(random, vehicle.size)
    if contact in ("tooth", "solid") and law == "impact":
        values["contact.stiffness"] = 1.8246342e10 * sqrt(vehicle.size)
    for name, (share, drawn) in EFFECTS.items():
        if random.random() < share and contact in levels[name]:
            values |= drawn(random, vehicle, contact, law)
    return values


def gears(random, size):
    """Default gears, or similar ones of another size."""
    planet, side, count = TEETH[int(random.integers(len(TEETH)))] if random.random() < 0.5 else TEETH[0]
    values = {"geometry.planet_teeth": planet, "geometry.side_teeth": side, "geometry.planet_count": count}
    if size != 1.0:
        values |= {"geometry.module": 4.5e-3 * size, "geometry.face_width": 0.02 * size, "geometry.backlash": 1e-4 * size}
    return values


def damping(random, size):
    """Damping of similar teeth by the study's law, or by restitution."""
    if random.random() < 0.3:
        return {"contact.damping_model": "restitution", "contact.restitution": random.uniform(0.3, 0.9)}
    return {"contact.damping": 5e4 * size**2, "contact.penetration_depth": 1e-4 * size}


def brake(random, vehicle):
    """Default stiffness, or a stiffness that yields by 2 to 10 mrad; some linings have higher static friction."""
    values = {} if random.random() < 0.6 else {"wheel_brake.stiffness": vehicle.wheel * vehicle.grip / random.uniform(2e-3, 1e-2)}
    return values | (sticky(random, "wheel_brake") if random.random() < 0.2 else {})


def sticky(random, effect):
    """Friction that is higher at rest, and falls immediately or with the sliding speed."""
    return {f"{effect}.static_ratio": random.uniform(1.05, 1.2), f"{effect}.stribeck_speed": float(random.choice([0.0, 0.05]))}


def half_shaft(random, vehicle, _contact, _law):
    """Default half-shafts, or shafts that twist by 3 to 9 degrees under the peak torque and damp shuffle by 2 to 10 %."""
    values = {"effects.half_shaft": True}
    if 0.1 * RATED < vehicle.peak < KEPT and random.random() < 0.4:
        return values
    stiffness = vehicle.peak / random.uniform(0.05, 0.15)
    damping = 2.0 * random.uniform(0.02, 0.1) * sqrt(stiffness * 0.5 * vehicle.carrier)
    return values | {f"half_shaft.{side}_{what}": value for side in ("left", "right")
                     for what, value in (("stiffness", stiffness), ("damping", damping))}


def bearing_drag(random, vehicle, _contact, _law):
    """Drag in proportion to the torques, given directly or by size and oil."""
    share = vehicle.peak / RATED
    values = {"effects.bearing_drag": True, "bearing_drag.carrier_torque": 0.5 * share, "bearing_drag.side_torque": 0.2 * share,
              "bearing_drag.carrier_viscous": 5e-3 * share, "bearing_drag.side_viscous": 1e-3 * share}
    if random.random() < 0.3:
        return values | {"bearing_drag.churning_from_geometry": True, "bearing_drag.carrier_diameter": 0.2 * vehicle.size}
    return values | {"bearing_drag.carrier_churning": 1e-4 * share}


def thrust_friction(random, vehicle, _contact, _law):
    values = {"effects.thrust_friction": True, "thrust_friction.coefficient": random.uniform(0.03, 0.1)}
    if random.random() < 0.5:
        values["thrust_friction.radii_from_geometry"] = True
    else:
        values |= {f"thrust_friction.{name}_radius": radius * vehicle.size
                   for name, radius in (("pin", 8e-3), ("planet_washer", 14e-3), ("side_washer", 22e-3))}
    return values | (sticky(random, "thrust_friction") if random.random() < 0.2 else {})


def limited_slip(random, vehicle, contact, _law):
    """Plates with preload; some also with torque from the meshes, with sheared oil, or with a measured curve."""
    values = {"effects.limited_slip": True, "limited_slip.preload": vehicle.peak * random.uniform(0.03, 0.3)}
    if contact in ("lumped", "tooth"):
        values |= ramps(random)
    values |= sticky(random, "limited_slip") if random.random() < 0.2 else {}
    values |= viscous(random, vehicle) if random.random() < 0.25 else {}
    return values | (measured(random, vehicle) if random.random() < 0.25 else {})


def ramps(random):
    """Torque from the meshes: none, or with ramps of any kind, some of which lock themselves in one direction."""
    coefficient = float(random.choice([0.0, 0.1, 0.3, 0.6]))
    if coefficient == 0.0:
        return {"limited_slip.torque_coefficient": 0.0}
    return {"limited_slip.torque_coefficient": coefficient, "limited_slip.coast_ratio": float(random.choice([0.0, 0.4, 1.0, 2.0])),
            "limited_slip.pressed_by": str(random.choice(["own_side", "both_sides"]))}


def viscous(random, vehicle):
    """Sheared oil, with less than linear torque as of silicone oil or with more."""
    return {"limited_slip.viscous_torque": vehicle.peak * random.uniform(0.05, 0.3), "limited_slip.viscous_speed": random.uniform(1.0, 20.0),
            "limited_slip.viscous_exponent": random.uniform(0.3, 1.2)}


def measured(random, vehicle):
    """Measured curve of 2 to 8 points; some begin with a breakaway torque, and some fall."""
    count, slip = int(random.integers(2, 9)), 0.0 if random.random() < 0.5 else random.uniform(0.1, 2.0)
    values = {}
    for i in range(1, count + 1):
        values |= {f"limited_slip.curve[{i}].slip": slip, f"limited_slip.curve[{i}].torque": vehicle.peak * random.uniform(0.05, 0.3)}
        slip += random.uniform(0.5, 5.0)
    return values


def tooth_friction(random, _vehicle, _contact, _law):
    law = str(random.choice(FRICTION_LAWS))
    return {"effects.tooth_friction": True, "tooth_friction.law": law}


def pin_compliance(_random, vehicle, _contact, _law):
    return {"effects.pin_compliance": True, "pin_compliance.pin_stiffness": 5e8 * vehicle.size,
            "pin_compliance.case_stiffness": 1e9 * vehicle.size}


def body_compliance(_random, vehicle, _contact, law):
    """Elastic gear bodies, which need a contact law from the tooth shape."""
    bores = {"geometry.planet_bore": 0.009 * vehicle.size, "geometry.side_bore": 0.017 * vehicle.size}
    return {"effects.body_compliance": True, **bores} if law != "impact" else {}


def tooth_errors(random, vehicle, contact, law):
    """Deviations of a grade with tip relief; solid teeth accept only crowning, and `impact` has no face to be crowned."""
    values = {"effects.tooth_errors": True}
    if contact == "solid" or law != "impact":
        values["tooth_errors.crowning"] = random.uniform(5e-6, 20e-6) * vehicle.size
    if contact == "solid":
        return values
    return values | {"tooth_errors.accuracy_grade": int(random.integers(5, 10)), "tooth_errors.seed": int(random.integers(1000)),
                     "tooth_errors.planet_tip_relief": random.uniform(0.0, 30e-6) * vehicle.size,
                     "tooth_errors.runout_by_grade": bool(random.random() < 0.5)}


def final_drive(random, vehicle, _contact, _law):
    """Final drive of matching size, rigid or with lash and errors; half of them are behind a propeller shaft. Carrier, pinion and driven
    end have the inertia of the vehicle's carrier in total."""
    pinion = int(random.integers(8, 14))
    ring = int(round(pinion * random.uniform(2.5, 5.0)))
    ratio, size = ring / pinion, max((vehicle.peak / RATED) ** (1.0 / 3.0), SMALLEST)
    torque = 2.0 * vehicle.peak / ratio
    values = {"effects.final_drive": True, "final_drive.pinion_teeth": pinion, "final_drive.ring_teeth": ring,
              "final_drive.friction_torque": random.uniform(0.002, 0.02) * torque,
              "final_drive.viscous": random.uniform(0.0, 2e-5) * torque, "inertia.carrier": 0.4 * vehicle.carrier}
    front = 0.6 * vehicle.carrier / ratio**2
    if random.random() < 0.5:
        values |= elastic_mesh(random, vehicle, size)
    if random.random() < 0.5:
        values |= propeller_shaft(random, torque, 0.8 * front)
        front *= 0.2
    return values | {"inertia.pinion": front}


def elastic_mesh(random, vehicle, size):
    """Mesh with lash that is damped by 3 to 10 %, with small errors of the mesh order and its harmonic, and runouts in some."""
    radius, stiffness = 0.09 * size, 3e8 * size
    damping = 2.0 * random.uniform(0.03, 0.1) * sqrt(stiffness * 0.1 * vehicle.carrier) / radius
    values = {"elastic_mesh": True, "mean_radius": radius, "stiffness": stiffness, "damping": damping,
              "backlash": random.uniform(5e-5, 2e-4) * size, "error_1": random.uniform(1e-6, 4e-6) * size}
    if random.random() < 0.5:
        values |= {"error_2": random.uniform(2e-7, 1e-6) * size, "error_phase_2": random.uniform(-3.0, 3.0)}
    if random.random() < 0.3:
        values |= {"pinion_runout": random.uniform(5e-6, 2e-5) * size, "ring_runout": random.uniform(5e-6, 3e-5) * size}
    return {f"final_drive.{name}": value for name, value in values.items()}


def propeller_shaft(random, torque, inertia):
    """Shaft that twists by 2 to 6 degrees under the peak torque and damps its driven end by 2 to 10 %; half of them have a joint."""
    stiffness = torque / random.uniform(0.035, 0.1)
    values = {"effects.propeller_shaft": True, "inertia.propeller_end": inertia, "propeller_shaft.stiffness": stiffness,
              "propeller_shaft.damping": 2.0 * random.uniform(0.02, 0.1) * sqrt(stiffness * inertia)}
    if random.random() < 0.5:
        values |= {"propeller_shaft.joint_angle": random.uniform(0.02, 0.15),
                   "propeller_shaft.joint_quarter_turn": bool(random.random() < 0.5)}
    return values


def warm_up(random, _vehicle, _contact, _law):
    return {"effects.warm_up": True, "oil.temperature": random.uniform(253.0, 363.0),
            "warm_up.ambient_temperature": random.uniform(253.0, 303.0)}


def strength(_random, _vehicle, _contact, _law):
    return {"effects.strength": True}


def mesh_history(_random, _vehicle, _contact, _law):
    return {"effects.mesh_history": True}


# share of drives with an effect, if the level of gear contact accepts it, and the function that draws its values
EFFECTS = {drawn.__name__: (share, drawn) for share, drawn in [
    (0.6, half_shaft), (0.6, bearing_drag), (0.5, thrust_friction), (0.3, tooth_friction), (0.4, limited_slip), (0.2, pin_compliance),
    (0.3, body_compliance), (0.25, tooth_errors), (0.25, warm_up), (0.2, strength), (0.2, mesh_history), (0.3, final_drive)]}
