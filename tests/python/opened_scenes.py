"""Random scenes with tooth errors, most of which open the meshes, with gears at rest against each other under constant loads.

Every value is drawn from one generator, so a scene is identified by its number."""

import numpy as np

# planets, their teeth, teeth of the side gears: all planets in phase, or every other one offset by half a pitch
GEARS = [(2, 10, 16), (2, 11, 16), (2, 10, 15), (3, 10, 15), (3, 11, 15), (4, 10, 16), (4, 11, 16), (4, 10, 14), (4, 9, 14)]
# given inertias, so that torques follow from accelerations
INERTIAS = {"inertia.from_geometry": False, "inertia.side_gear": 1.5e-4, "inertia.planet": 3e-5, "inertia.carrier": 0.02}
UM = 1e-6


def scene(number, seed=30):
    """Start values of scene `number`: {name: value}."""
    random = np.random.default_rng([seed, number])
    chance = lambda share: bool(random.random() < share)  # noqa: E731
    around = lambda most: float(random.uniform(-most, most))  # noqa: E731
    up_to = lambda most: float(random.uniform(0.0, most))  # noqa: E731
    planets, planet_teeth, side_teeth = GEARS[random.integers(len(GEARS))]
    law = str(random.choice(["impact", "line", "line_weber", "line", "line_weber"]))
    values = INERTIAS | {
        "geometry.planet_count": planets, "geometry.planet_teeth": planet_teeth, "geometry.side_teeth": side_teeth,
        "effects.tooth_errors": True, "contact.law": law, "carrier.speed_command": float(random.choice([0.0, 50.0, -50.0]))}
    load = float(random.choice([-1.0, 1.0]) * 10.0 ** random.uniform(0.5, 2.9))
    other = load * float(random.choice([1.0, 1.0, 1.0, 1.0, 1.0 + around(0.02), up_to(1.0)]))
    values |= {"left.load_torque": load, "right.load_torque": other}
    errors = {}
    if chance(0.6):
        errors["planet_axial_offset"] = up_to(400.0) * UM
    if chance(0.3):
        errors["side_axial_offset"] = around(300.0) * UM
    if chance(0.3):
        errors["axis_offset"] = around(200.0) * UM
    if chance(0.2):
        errors["shaft_angle_error"] = around(3e-3)
    if chance(0.5):
        errors["crowning"] = up_to(60.0) * UM
    if chance(0.4):
        errors |= {"planet_tip_relief": up_to(60.0) * UM, "side_tip_relief": up_to(60.0) * UM,
                   "relief_length": float(random.uniform(0.2, 1.0))}
    if chance(0.4):
        errors |= {"accuracy_grade": int(random.integers(2, 12)), "seed": int(random.integers(1000)),
                   "runout_by_grade": chance(0.3)}
    if not errors.get("runout_by_grade") and chance(0.2):
        errors |= {"planet_runout": up_to(60.0) * UM, "side_runout": up_to(60.0) * UM}
    values |= {f"tooth_errors.{name}": value for name, value in errors.items()}
    if law != "impact" and chance(0.4):
        values["effects.body_compliance"] = True
    if chance(0.25):
        values |= {"effects.pin_compliance": True, "pin_compliance.pin_stiffness": float(10.0 ** random.uniform(8.0, 9.5))}
    if chance(0.25):
        values |= {"effects.half_shaft": True, "inertia.left_end": 0.3, "inertia.right_end": 0.5}
    # washers may hold loads that the teeth do not carry, with springs that are wound up first
    friction = [("thrust_friction", 0.15)] if load == other else []
    for effect, share in [("bearing_drag", 0.2), ("tooth_friction", 0.15), *friction]:
        if chance(share):
            values[f"effects.{effect}"] = True
    if chance(0.2):
        values |= {"scene.planet_spin": "imposed", "spin.command": 0.0}
    return values
