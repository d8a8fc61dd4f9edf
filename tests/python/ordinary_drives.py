"""Ordinary drives, drawn by a seed: daily use of the FMU by a host, with a pedal car, a car or a truck.

A drive is plain data and has a JSON form, so that players in other languages can repeat it:

        seed, index, manoeuvre, mirrored    origin of the drive
    fmi           "2.0" or "3.0"
    event_mode    true if a host of FMI 3.0 handles events within a step
    stop, step    stop time and communication step [s]
    slopes        true if the host gives derivatives of inputs; otherwise inputs are held through each step
    start         start values by name, SI; enumerations by literal
        inputs        points [time, value] by name; lines between points, and two points at the same time are a jump
        holds         {"from", "to", "wheels"}: interval in which these wheels must be at rest by their brakes

The host sets all inputs to their values at 0 before the start, and to the values at each communication point (`sampled`)."""

import math

import numpy as np
from final_drives import ratio_of
from ordinary_courses import DRIVE, LOCK, MANOEUVRES, SIDES, SPEED, Course, locked, park, park_for_an_hour
from ordinary_vehicles import differential, vehicle

# levels of gear contact with their laws, by share
CONTACTS = {"ideal": 0.14, "lumped": 0.14, "tooth impact": 0.22, "tooth line": 0.22, "tooth line_weber": 0.22, "solid impact": 0.06}
METHODS = {"adaptive": 0.88, "fixed_step": 0.06, "radau": 0.06}
# communication steps [s]: the shortest one only for short drives, 1 s for parking
STEPS = {1e-4: 0.08, 1e-3: 0.3, 1e-2: 0.62}
PARKING_STEPS = {1e-2: 0.3, 0.1: 0.3, 1.0: 0.4}
# pace of short drives, and of drives with solid teeth, whose steps cost ten times as much
SHORT = 0.1
# shares of speed-driven carriers, mirrored drives, FMI 3.0 and its event mode, derivatives of inputs, an hour of parking
BY_SPEED, MIRRORED, THREE, EVENTS, SLOPES, HOUR = 0.15, 0.3, 0.3, 0.5, 0.15, 0.3
# twist of a clutch at its torque, as for the start values [rad]
WOUND_UP = 0.01
# share of drives with clutches on command, and the ratios of their shafts: limited slip, superposition, brake of a side gear, blocking
CLUTCHES, CLUTCH_RATIOS = 0.2, [(1.0, 1.0), (1.125, 0.875), (0.0, 0.0), (1.15, 1.1), (0.9, 1.0)]
# share of actuators among these, of dog clutches among the drives with half-shafts whose wheels have inertia, and of gears that press
# their packs among those with packs
ACTUATORS, DISCONNECTS, PRESSED = 0.5, 0.3, 0.3
# shortest hold that is checked [s]
SHORTEST_HOLD = 0.2
# variables that change their sign in a mirrored drive
PORT = {DRIVE: "pinion.torque_command", SPEED: "pinion.speed_command"}
SIGNED = (*PORT, *PORT.values(), *(f"{side}.load_torque" for side in SIDES))
# A point of an input is moved to a communication point that is closer than this fraction of a step.
ROUNDING = 1e-6
# digits of values, and decimals of times: sufficient for any drive, and still readable
DIGITS, DECIMALS = 6, 6


def drives(seed, count, levels):
    """First drives of a seed. `levels`: levels of gear contact that each effect accepts, by its name."""
    for index in range(count):
        yield drive(seed, index, levels)


def drive(seed, index, levels):
    """Drive `index` of a seed. The manoeuvres alternate; everything else is drawn."""
    random = np.random.default_rng([seed, index])
    manoeuvre = MANOEUVRES[index % len(MANOEUVRES)]
    contact, law = (chosen(random, CONTACTS).split() + ["impact"])[:2]
    parking = manoeuvre is park
    step = chosen(random, PARKING_STEPS if parking else STEPS)
    if contact == "solid" and not parking:
        step = min(step, 1e-3)
    method = chosen(random, METHODS)
    if parking and method == "fixed_step":
        # a minute of fixed steps is half a million steps
        method = "adaptive"
    if parking and random.random() < HOUR:
        manoeuvre, step = park_for_an_hour, 1.0
    by_speed = bool(random.random() < BY_SPEED)
    driven = vehicle(random, by_speed)
    start = differential(random, driven, contact, law, levels)
    short = not parking and (step < 1e-3 or contact == "solid")
    course = Course(random, driven, SHORT if short else 1.0)
    manoeuvre(course)
    if manoeuvre is locked:
        start["lock.torque"] = 6.0 * driven.peak
    fmi, mirrored = "3.0" if random.random() < THREE else "2.0", bool(random.random() < MIRRORED)
    made = {
        "seed": seed, "index": index, "manoeuvre": manoeuvre.__name__, "mirrored": mirrored, "fmi": fmi,
        "event_mode": fmi == "3.0" and bool(random.random() < EVENTS), "stop": step * math.ceil(course.time / step - ROUNDING),
        "step": step, "slopes": fmi == "2.0" and bool(random.random() < SLOPES),
        "start": start | beginning(random, course, by_speed, method), "inputs": inputs(course, by_speed),
        # inputs that are held through a step may be one step late
        "holds": [hold | {"from": hold["from"] + step} for hold in course.holds if hold["to"] - hold["from"] - step >= SHORTEST_HOLD]}
    # drawn separately, so that all other values are unchanged
    clutches, commands = commanded(np.random.default_rng([seed, index, 1]), driven, made["stop"])
    made |= {"start": made["start"] | clutches, "inputs": made["inputs"] | commands}
    made = readable(at_port(disconnected(np.random.default_rng([seed, index, 2]), driven, made)))
    return image(made) if mirrored else made


def commanded(random, vehicle, stop):
    """Start values and inputs of clutches on command; none in most drives. Commands ramp, jump and hold."""
    if random.random() > CLUTCHES:
        return {}, {}
    left, right = CLUTCH_RATIOS[int(random.integers(len(CLUTCH_RATIOS)))]
    torque = vehicle.peak * random.uniform(0.05, 0.5)
    values = {"effects.clutches": True, "clutches.torque": torque, "clutches.stiffness": torque / WOUND_UP, "clutches.left_ratio": left,
              "clutches.right_ratio": right, "clutches.static_ratio": random.uniform(1.0, 1.3), "clutches.stribeck_speed": 0.1}
    commands = {}
    for side in SIDES:
        at = np.sort(np.append(0.0, random.uniform(0.0, stop, 4)))
        to = np.where(random.random(5) < 0.4, 0.0, random.random(5))
        # two points at one time are a jump
        at[3] = at[2]
        commands[f"{side}.clutch_command"] = [[float(time), float(value)] for time, value in zip(at, to)]
    return values, commands


def disconnected(random, vehicle, made):
    """Drive with actuators at the clutches on command, dog clutches and gears that press their packs; none of these in most drives. An
    axle coasts from the time at which it is disconnected, because the side gear of an open clutch takes no torque; the clutch closes
    again if the speeds permit it."""
    start, stop = made["start"], made["stop"]
    added, inputs = {}, {}
    if "effects.clutches" in start and random.random() < ACTUATORS:
        added |= {"clutches.dead_band": random.uniform(0.0, 0.2), "clutches.stroke_time": random.uniform(0.0, 0.3),
                  "clutches.response_time": random.uniform(0.0, 0.05), "clutches.response_damping": random.uniform(0.4, 1.5)}
    if start.get("effects.limited_slip") and start["scene.gear_contact"] in ("lumped", "tooth") and random.random() < PRESSED:
        added |= {"limited_slip.thrust_arm": random.uniform(1e-3, 0.02)}
        # the plates take the place of the washers
        start = {name: value for name, value in start.items() if name != "thrust_friction.side_washer_radius"}
    wheels = [side for side in SIDES if start.get(f"inertia.{side}_end", 0.0) > 0.0]
    if start.get("effects.half_shaft") and len(wheels) == 2 and random.random() < DISCONNECTS:
        side = str(random.choice(["left", "right", "both"]))
        added |= {"effects.disconnect": True, "disconnect.sides": side, "disconnect.lash": random.uniform(5e-3, 0.05),
                  "disconnect.most_speed": random.uniform(2.0, 20.0), "disconnect.ratchet_torque": vehicle.peak * random.uniform(0.0, 0.005),
                  "disconnect.most_torque": vehicle.peak * random.uniform(0.002, 0.02)}
        opens = np.sort(random.uniform(0.0, stop, 2))
        if DRIVE in made["inputs"]:
            points = made["inputs"][DRIVE]
            last = [opens[0], float(np.interp(opens[0], *zip(*points)))]
            inputs[DRIVE] = [*(point for point in points if point[0] < opens[0]), last, [opens[0], 0.0]]
        for name in SIDES if side == "both" else [side]:
            inputs[f"{name}.dog_command"] = [[0.0, 1.0], [opens[0], 1.0], [opens[0], 0.0], [opens[1], 0.0], [opens[1], 1.0]]
    return made | {"start": start | added, "inputs": made["inputs"] | inputs}


def chosen(random, shares):
    """Key of `shares`, drawn by its share."""
    return list(shares)[int(random.choice(len(shares), p=np.array([*shares.values()]) / sum(shares.values())))]


def beginning(random, course, by_speed, method):
    """Start values of the motion and the method."""
    mode = str(random.choice(["rolling", "equilibrium"] if course.begin else ["rest", "rolling", "equilibrium"]))
    values = {"scene.carrier_drive": "speed" if by_speed else "torque", "scene.start": mode}
    if not by_speed and mode != "rest":
        values[SPEED] = course.begin
    return values if method == "adaptive" else values | {"solver.method": method}


def at_port(drive):
    """Drive whose commands act on the pinion of its final drive, if it has one: torques are divided by the ratio, speeds multiplied."""
    start = drive["start"]
    if "effects.final_drive" not in start:
        return drive
    ratio = ratio_of(start)

    def moved(values, change):
        return {PORT.get(name, name): change(value, ratio if name == SPEED else 1.0 / ratio) if name in PORT else value
                for name, value in values.items()}

    return drive | {"start": moved(start, lambda value, factor: factor * value),
                    "inputs": moved(drive["inputs"], lambda points, factor: [[time, factor * value] for time, value in points])}


def inputs(course, by_speed):
    """Inputs of a course. A speed-driven carrier has the estimated speeds of the course instead of its torque."""
    found = {name: points or [[0.0, course.now[name]]] for name, points in course.points.items()}
    if not course.points[LOCK]:
        del found[LOCK]
    if by_speed:
        del found[DRIVE]
        found[SPEED] = course.track
    return found


def readable(drive):
    """Drive with rounded values and times."""
    def rounded(value):
        return float(f"{value:.{DIGITS}g}") if isinstance(value, float) else value

    def line(points):
        return [[round(time, DECIMALS), rounded(value)] for time, value in points]

    holds = [hold | {end: round(hold[end], DECIMALS) for end in ("from", "to")} for hold in drive["holds"]]
    return drive | {"stop": round(drive["stop"], DECIMALS), "start": {name: rounded(value) for name, value in drive["start"].items()},
                    "inputs": {name: line(points) for name, points in drive["inputs"].items()}, "holds": holds}


def image(drive):
    """Mirrored drive: all speeds and torques change their sign, brakes and lock do not."""
    # a difference avoids a negative zero
    start = {name: 0.0 - value if name in SIGNED else value for name, value in drive["start"].items()}
    mirrored = {name: [[time, 0.0 - value] for time, value in points] if name in SIGNED else points
                for name, points in drive["inputs"].items()}
    return drive | {"start": start, "inputs": mirrored}


def times(drive):
    """Communication points [s]."""
    return drive["step"] * np.arange(round(drive["stop"] / drive["step"]) + 1)


def sampled(drive):
    """Values of all inputs at the communication points, by name."""
    return {name: np.interp(times(drive), *on_points(points, drive["step"])) for name, points in drive["inputs"].items()}


def on_points(points, step):
    """Times and values of an input's points. Times that differ from a communication point only by rounding are moved to it."""
    at, values = np.transpose(points)
    nearest = np.round(at / step)
    return np.where(np.abs(at / step - nearest) < ROUNDING, step * nearest, at), values
