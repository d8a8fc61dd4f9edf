"""Scenes that the library of every platform simulates: the study, laws, methods, effects, and those in scenes/*.toml."""

import tomllib

from bevel_differential.scene_file import flat

TURN = {"scene.planet_spin": "imposed", "spin.command": "200 deg/s", "carrier.speed_command": "954 deg/s"}
ENDS = {"inertia.left_end": 0.2, "inertia.right_end": 0.2}
# compared seconds of a scene
LONGEST = 0.5
# constants of oil, bearings and clutches
DRAG = {"bearing_drag.carrier_torque": 0.5, "bearing_drag.carrier_viscous": 5e-3, "bearing_drag.carrier_churning": 1e-4,
        "bearing_drag.side_torque": 0.2, "bearing_drag.side_viscous": 1e-3}
CLUTCHES = {"limited_slip.preload": 50.0, "limited_slip.torque_coefficient": 0.1}
# ramps, sheared oil and a measured curve with a breakaway torque, which the study's turn makes slide
KINDS = {"effects.limited_slip": True, "limited_slip.torque_coefficient": 0.1, "limited_slip.pressed_by": "both_sides",
         "limited_slip.coast_ratio": 0.25, "limited_slip.viscous_torque": 20.0, "limited_slip.viscous_speed": 3.0,
         "limited_slip.viscous_exponent": 0.6, "limited_slip.curve[1].torque": 30.0, "limited_slip.curve[2].slip": 1.0,
         "limited_slip.curve[2].torque": 25.0, "limited_slip.curve[3].slip": 5.0, "limited_slip.curve[3].torque": 40.0}
# a small car that launches, brakes to a stop, waits, reverses and stops again: inputs over time, and the duration [s]
CAR = {"scene.carrier_drive": "torque", "scene.start": "rest", "effects.wheel_brake": True, "effects.bearing_drag": True, **DRAG,
       "inertia.left_end": 12.0, "inertia.right_end": 12.0, "inertia.carrier": 0.1, "left.load_torque": 0.0, "right.load_torque": 0.0,
       "carrier.torque_command": 0.0}
BRAKES = ([0.0, 1.2, 1.3, 3.2, 3.3, 4.4, 4.5, 6.0], [0.0, 0.0, 300.0, 300.0, 0.0, 0.0, 300.0, 300.0])
COURSE = {"carrier.torque_command": ([0.0, 0.1, 1.0, 1.1, 3.3, 3.4, 4.2, 4.3, 6.0], [0.0, 400.0, 400.0, 0.0, 0.0, -200.0, -200.0, 0.0, 0.0]),
          "left.brake_torque": BRAKES, "right.brake_torque": BRAKES}
DRIVE = 6.0


def all_scenes(folder, effects):
    """Name, start values, events, tables and duration [s] of each scene."""
    together = TURN | ENDS | DRAG | CLUTCHES
    for effect in effects:
        if effect.switch and "tooth" in effect.contact:
            together |= effect.inputs | {effect.switch: True}
    for level, duration in [("tooth", 0.5), ("lumped", 0.5), ("ideal", 0.5), ("solid", 0.05)]:
        yield f"study, straight, {level}", {"scene.gear_contact": level}, [], [], duration
        yield f"study, turn, {level}", TURN | {"scene.gear_contact": level}, [], [], duration
    yield "study, turn, from mid-play", TURN | {"scene.start": "rolling"}, [], [], 0.1
    for law in ["line", "line_weber"]:
        values = TURN | {"contact.law": law, "contact.damping_model": "restitution"}
        yield f"turn, {law}, restitution", values, [], [], 0.1
    for method in ["fixed_step", "radau"]:
        yield f"turn, {method}", TURN | {"solver.method": method}, [], [], 0.05
    for law in ["coulomb_stribeck", "benedict_kelley", "iso_14179", "xu_kahraman"]:
        friction = {"effects.tooth_friction": True, "tooth_friction.law": law}
        yield f"turn, friction {law}", TURN | friction, [], [], 0.05
    yield "turn, clutches in drive", TURN | KINDS, [], [], 0.05
    yield "turn, clutches in coast", TURN | KINDS | {"left.load_torque": -400.0, "right.load_torque": -300.0}, [], [], 0.05
    for name, gears in [("ideal", {"scene.gear_contact": "ideal"}), ("tooth", {"contact.law": "line", "effects.thrust_friction": True})]:
        tables = [{"input": each, "time": time, "value": value} for each, (time, value) in COURSE.items()]
        yield f"drive, {name}", CAR | gears, [], tables, DRIVE
    # elastic gear bodies need a law that follows from the teeth
    yield "all effects, impact", together | {"effects.body_compliance": False}, [], [], 0.1
    yield "all effects, line", together | {"contact.law": "line", "tooth_errors.crowning": 1e-5}, [], [], 0.05
    for file in sorted(folder.glob("*.toml")):
        scene = tomllib.loads(file.read_text(encoding="utf-8"))
        # input files contain a standing car at first
        if "inputs" in scene:
            continue
        duration = min(float(scene["stop_time"]), LONGEST)
        yield (f"scenes/{file.name}", flat(scene["set"]), [flat(event) for event in scene.get("at", [])],
               scene.get("table", []), duration)
