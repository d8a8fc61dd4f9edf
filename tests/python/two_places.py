"""Pairs of outputs that show the same quantity, by the formulas of docs/inside/theory.md without code of the program.

Each function yields (what, one, other, scale): two values that must agree within `CLOSE` of the scale. A pair that agrees only in some
scenes is yielded only for them. `AtMost` in place of a value means that the other must not be below it."""

from math import atan2, cos, hypot, inf, pi, remainder, sin, sqrt, tan

import numpy as np
from momentum import INSTANT, SOLIDS

IDEAL, LUMPED, TOOTH, SOLID = 1, 2, 3, 4
IMPACT = 1
SPEED = 2
SIDES = ["left", "right"]
SIGMA = {"left": 1.0, "right": -1.0}
PAIRS, ENDS = 3, ("toe", "middle", "heel")
CLOSE = 1e-9
# pairs closer than this to an end of the path are not compared [base pitches]
MARGIN = 0.01
# fraction of the largest torque and power below which a ratio consists of rounding errors
ROUNDING = 1e-9
MOST_BIAS = 1e6
# sum of the shaft torques below which there is no bias [N·m]
LEAST_TORQUE = 1e-3
# relative difference by which stresses between the instants of the safety factors may be higher
BETWEEN = 1e-4


class AtMost(float):
    """The other value must not be below this one."""


class Scene:
    """Parameters of a scene, and the dimensions of its gears."""

    def __init__(self, fmu, opened):
        names = [name for name, v in fmu.variables.items() if v.causality in ("parameter", "input")]
        self.p = dict(zip(names, opened.read(names)))
        self.names = [name for name, v in fmu.variables.items() if v.causality in ("output", "local", "calculatedParameter")]
        p = self.p
        teeth = [p["geometry.planet_teeth"], p["geometry.side_teeth"]]
        self.planets, self.teeth, self.face = range(1, p["geometry.planet_count"] + 1), teeth, p["geometry.face_width"]
        self.contact = p["scene.gear_contact"]
        self.pitch = [atan2(*teeth), atan2(*reversed(teeth))]
        self.alpha = p["geometry.pressure_angle"]
        self.lever = [sin(pitch) * cos(self.alpha) for pitch in self.pitch]
        self.arc = [atan2(sqrt(1.0 - (cos(pitch) / sqrt(1.0 - lever**2)) ** 2), cos(pitch) / sqrt(1.0 - lever**2))
                    for pitch, lever in zip(self.pitch, self.lever)]
        self.outer = 0.5 * p["geometry.module"] * hypot(*teeth)
        self.inner, self.mean = self.outer - self.face, self.outer - 0.5 * self.face
        # cone distance at which the load of a line law acts
        self.centre = 2.0 / 3.0 * (self.outer**3 - self.inner**3) / (self.outer**2 - self.inner**2)
        self.base_pitch = 2.0 * pi * self.lever[0] / teeth[0]
        backlash = p["geometry.backlash"] if p["effects.backlash"] and self.contact != IDEAL else 0.0
        self.lash = backlash * cos(self.alpha) / self.outer
        self.modulus = p["material.young_modulus"] / (2.0 * (1.0 - p["material.poisson_ratio"] ** 2))
        self.has_ends = [p["effects.half_shaft"] and p[f"inertia.{side}_end"] > 0.0 or p[f"scene.{side}_drive"] == SPEED
                         for side in SIDES]
        # forces do not vary over the face, and act where the law says
        self.is_even = not any(p[f"effects.{name}"] for name in ("tooth_errors", "tooth_fault", "pin_compliance"))
        self.first, self.least = {}, {}

    def read(self, opened):
        """All values at an instant, including inputs."""
        inputs = [name for name, v in opened.fmu.variables.items() if v.causality == "input"]
        self.p.update(zip(inputs, opened.read(inputs)))
        return dict(zip(self.names, opened.read(self.names)))

    def constant(self, key, value, scale):
        """(value at the first instant, value), for a value that must not change."""
        return key, self.first.setdefault(key, value), value, scale


def geometry(scene, o):
    yield "outer cone", o["geometry.outer_cone_distance"], scene.outer, scene.outer
    yield "inner cone", o["geometry.inner_cone_distance"], scene.inner, scene.outer
    for i, gear in enumerate(["planet", "side"]):
        yield "pitch angle", o[f"geometry.{gear}_pitch_angle"], scene.pitch[i], 1.0
        yield "base angle", sin(o[f"geometry.{gear}_base_angle"]), scene.lever[i], 1.0
    # lash of the gears, even if the scene does not simulate teeth
    backlash = scene.p["geometry.backlash"] if scene.p["effects.backlash"] else 0.0
    lash = backlash * cos(scene.alpha) / scene.outer
    yield "lash of a wheel", o["geometry.wheel_lash"], 2.0 * lash / scene.lever[1], 1.0


def dog_torque(p, o, side, shaft):
    """Torque through a dog clutch, and the size of its parts. An open clutch has at most the torque of its ratcheting teeth."""
    torque, (stiffness, damped) = o[f"{side}.shaft_torque"], shaft
    if o[f"{side}.dog_phase"] < 3.0:
        return min(max(torque, -p["disconnect.ratchet_torque"]), p["disconnect.ratchet_torque"]), 1.0
    twist = o[f"{side}.twist"]
    sign = np.sign(twist)
    spring = stiffness * (abs(twist) - 0.5 * p["disconnect.lash"])
    return (sign * max(spring + sign * damped, 0.0) if spring > 0.0 else 0.0), abs(spring) + abs(damped)


def motion(scene, o):
    carrier, p = o["carrier.speed"], scene.p
    fastest = max(abs(o[f"{side}.speed"]) for side in SIDES) + abs(carrier)
    yield "mesh frequency", o["mesh.frequency"], scene.teeth[0] * abs(o["planet[1].spin_speed"]) / (2.0 * pi), fastest
    yield "acceleration of the carrier", o["carrier.acceleration"], o["der(carrier.speed)"], abs(o["carrier.acceleration"])
    for s, side in enumerate(SIDES):
        speed, angle = o[f"{side}.speed"], o[f"{side}.angle"]
        yield f"{side} angle", angle, o["carrier.angle"] + o[f"{side}.relative_angle"], 1.0 + abs(angle)
        yield f"{side} relative speed", o[f"der({side}.relative_angle)"], speed - carrier, fastest
        yield f"{side} acceleration", o[f"{side}.acceleration"], o[f"der({side}.speed)"], abs(o[f"{side}.acceleration"])
        if scene.has_ends[s]:
            end = o[f"{side}.end_speed"]
            yield f"{side} rate of twist", o[f"der({side}.shaft_twist)"], speed - end, fastest
            stiffness, damping = (p[f"half_shaft.{side}_{name}"] for name in ("stiffness", "damping"))
            if p["effects.disconnect"] and p["disconnect.sides"] in (1 + s, 3):
                torque, slack = dog_torque(p, o, side, (stiffness, damping * (speed - end)))
                yield f"{side} torque through the dog clutch", o[f"{side}.shaft_torque"], torque, slack
                continue
            if p["effects.half_shaft"]:
                yield f"{side} twist", o[f"{side}.twist"], o[f"{side}.shaft_twist"], 1.0
            parts = stiffness * o[f"{side}.shaft_twist"], damping * (speed - end)
            yield f"{side} torque by twist", o[f"{side}.shaft_torque"], sum(parts), sum(map(abs, parts))
    if scene.contact == IDEAL:
        ratio = scene.teeth[0] / scene.teeth[1]
        for side in SIDES:
            willis = carrier + SIGMA[side] * ratio * o["planet[1].spin_speed"]
            yield f"Willis {side}", o[f"{side}.speed"], willis, fastest
        return
    for i in scene.planets:
        spin = o[f"planet[{i}].spin_angle"]
        for side in SIDES:
            turn = o[f"{side}.relative_angle"] - (o[f"planet[{i}].pin_angle"] if p["effects.pin_compliance"] else 0.0)
            arcs = scene.lever[1] * turn, SIGMA[side] * scene.lever[0] * spin
            approach = -(arcs[0] - arcs[1]) - 0.5 * scene.lash
            error = o[f"planet[{i}].{side}_transmission_error"] / scene.mean
            # a mesh repeats after a base pitch, and errors of single teeth move its middle
            middle = remainder(error - approach, scene.base_pitch)
            rounding = 1.0 + sum(map(abs, arcs))
            if not p["effects.tooth_errors"]:
                yield f"planet {i} {side} transmission error", abs(middle), 0.0, rounding
            else:
                yield scene.constant(f"planet {i} {side} middle", middle, rounding)


def forces(scene, o):
    p, r_outer = scene.p, 0.5 * scene.p["geometry.module"] * scene.teeth[1]
    normal = {side: [o[f"planet[{i}].{side}_normal_force"] for i in scene.planets] for side in SIDES}
    largest = max(max(each) for each in normal.values())
    for side in SIDES:
        yield f"{side} normal force", o[f"{side}.normal_force"], sum(normal[side]), len(scene.planets) * largest
    for i in range(len(scene.planets) + 1, 5):
        yield f"planet {i} that is not there", max(abs(o[f"planet[{i}].{side}_normal_force"]) for side in SIDES), 0.0, 0.0
    pairs = loaded(o)
    if scene.contact in (TOOTH, SOLID) and len(pairs) < PAIRS:
        yield "force of the pairs", sum(abs(pair["force"]) for pair in pairs), normal["left"][0], largest
        count = o["planet[1].left_pairs"]
        if scene.is_even and scene.contact == TOOTH:
            yield "number of pairs", len(pairs), count, 1.0
        yield "number of pairs over the face", AtMost(count), float(len(pairs)), 1.0
    if scene.contact in (IDEAL, LUMPED):
        yield "pairs of no teeth", len(pairs), 0, 0.0
    if scene.contact not in (IDEAL, LUMPED):
        return
    if p["effects.pin_compliance"] and p["effects.disconnect"]:
        # pins swing back when a dog clutch opens, and both flanks of a mesh may touch
        return
    signs = {side: [1.0 if o[f"planet[{i}].{side}_transmission_error"] > 0.0 else -1.0 for i in scene.planets] for side in SIDES}
    if scene.contact == IDEAL:
        signs = {side: [1.0 if o[f"{side}.tangential_force"] > 0.0 else -1.0 for _ in scene.planets] for side in SIDES}
    arm = scene.lever[1] * (scene.mean if scene.contact == IDEAL else scene.centre)
    across = {side: [sign * force for sign, force in zip(signs[side], normal[side])] for side in SIDES}
    for side in SIDES:
        thrust = o[f"{side}.normal_force"] * sin(scene.alpha) * sin(scene.pitch[1])
        yield f"{side} thrust", o[f"{side}.thrust_force"], thrust, len(scene.planets) * largest
        yield f"{side} torque of the meshes", o[f"{side}.tangential_force"] * r_outer, arm * sum(across[side]), arm * largest
    for k, i in enumerate(scene.planets):
        thrust = (normal["left"][k] + normal["right"][k]) * sin(scene.alpha) * sin(scene.pitch[0])
        yield f"planet {i} thrust", o[f"planet[{i}].thrust_force"], thrust, largest
        pin = hypot((across["left"][k] + across["right"][k]) * cos(scene.alpha),
                    (normal["left"][k] - normal["right"][k]) * sin(scene.alpha) * sin(scene.pitch[1]))
        yield f"planet {i} pin force", o[f"planet[{i}].pin_force"], pin, largest


def loaded(o):
    """Loaded pairs of planet 1 with the left side gear."""
    names = ["tooth", "force", "height", *(f"{end}_pressure" for end in ENDS)]
    pairs = [{name: o[f"mesh.pair[{k}].{name}"] for name in names} for k in range(1, PAIRS + 1)]
    return [pair for pair in pairs if pair["tooth"] >= 0.0]


def places(scene, o):
    """Places where pairs touch on the path, from the turn of the planet."""
    if scene.contact != TOOTH:
        return
    gears = [[o[f"geometry.{gear}_{angle}_angle"] for angle in ("pitch", "tip", "base")] for gear in ("planet", "side")]
    # ends of the path by the arcs of the tips; it ends before a base circle
    ends = [atan2(sqrt(max(cos(base) ** 2 - cos(tip) ** 2, 0.0)), cos(tip)) for _, tip, base in gears]
    low, high = max(scene.arc[1] - ends[1], -scene.arc[0]), min(ends[0] - scene.arc[0], scene.arc[1])
    margin = MARGIN * scene.base_pitch
    addenda = [scene.outer * tan(tip - pitch) for pitch, tip, _ in gears]
    shift, thinned = addenda[0] - addenda[1], 0.5 * scene.lash / cos(scene.alpha) * scene.outer
    module = scene.p["geometry.module"]
    moved = scene.p["geometry.thickness_shift"]
    half_tooth = (0.5 * pi + moved + (shift * tan(scene.alpha) - thinned) / module) / scene.teeth[0]
    for pair in loaded(o):
        flank = 1.0 if pair["force"] > 0.0 else -1.0
        turned = flank * (o["planet[1].spin_angle"] + 2.0 * pi * pair["tooth"] / scene.teeth[0])
        wanted = scene.lever[0] * remainder(half_tooth + turned, 2.0 * pi)
        # beyond the ends of the path a tip corner touches elsewhere, that of the side gear by the turn of the side gear
        error = o["planet[1].left_transmission_error"] / scene.mean
        approach = error if flank > 0.0 else -error - scene.lash
        if low + approach + margin < wanted < high - margin:
            polar = scene.pitch[0] + pair["height"] / scene.mean
            place = atan2(sqrt(max(1.0 - scene.lever[0] ** 2 - cos(polar) ** 2, 0.0)), cos(polar)) - scene.arc[0]
            yield f"place of tooth {pair['tooth']:.0f}", place, wanted, 1.0 + abs(turned)


def powers(scene, o):
    p = scene.p
    ends = [o[f"{side}.end_speed"] if has else o[f"{side}.speed"] for side, has in zip(SIDES, scene.has_ends)]
    torques = [o[f"{side}.shaft_torque"] for side in SIDES]
    given = [o["propeller.torque"] * o["propeller.speed"], o["spin.torque"] * o["planet[1].spin_speed"]]
    taken = [torque * speed for torque, speed in zip(torques, ends)]
    yield "power in", o["power.in"], sum(given), sum(map(abs, given))
    yield "power out", o["power.out"], sum(taken), sum(map(abs, taken))
    fed = sum(max(power, 0.0) for power in given) + sum(max(-power, 0.0) for power in taken)
    if fed > ROUNDING * (sum(map(abs, given)) + sum(map(abs, taken))):
        yield "efficiency", o["efficiency"], max(1.0 - o["power.loss"] / fed, 0.0), 1.0
    for name in o:
        effect = {"heat.tooth_friction": "tooth_friction", "heat.thrust": "thrust_friction", "heat.support": "pin_compliance",
                  "heat.drag": "bearing_drag", "heat.brake": "wheel_brake", "heat.final_drive": "final_drive",
                  "heat.propeller_shaft": "propeller_shaft"}.get(name)
        if effect and not p[f"effects.{effect}"]:
            yield f"{name} of nothing", o[name], 0.0, 0.0
    ratio, locking = o["torque_bias_ratio"], o["locking_value"]
    push = abs(sum(torques))
    if not any(scene.has_ends) and push < 0.999 * LEAST_TORQUE:
        yield "torque bias without torque", ratio, 1.0, 1.0
        yield "locking value without torque", locking, 0.0, 1.0
    is_biased = push > max(1.001 * LEAST_TORQUE, ROUNDING * max(map(abs, torques)))
    if is_biased and locking < MOST_BIAS and 0.0 < abs(ratio) < MOST_BIAS and abs(ratio + 1.0) > ROUNDING:
        yield "locking value by torque bias", locking, abs((ratio - 1.0) / (ratio + 1.0)), 1.0 + abs(locking) ** 2
    if not any(scene.has_ends) and is_biased and locking < MOST_BIAS:
        yield "locking value by torques", locking, abs((torques[0] - torques[1]) / sum(torques)), 1.0 + abs(locking)


def stresses(scene, o):
    p = scene.p
    if not p["effects.strength"]:
        for name in o:
            if name.startswith(("stress.", "damage.", "safety.")):
                yield f"{name} of nothing", o[name], 0.0, 0.0
        return
    factor = p["strength.application_factor"]
    force = max(o[f"planet[{i}].{side}_normal_force"] for i in scene.planets for side in SIDES)
    grows = scene.contact == LUMPED or (scene.contact == TOOTH and p["contact.law"] != IMPACT)
    force *= factor
    # under a line law load per width and radius grow together; under IMPACT they are those of the mean cone
    curve = tan(scene.arc[0]) * tan(scene.arc[1]) / (tan(scene.arc[0]) + tan(scene.arc[1]))
    pressure = sqrt(force * scene.modulus / (pi * scene.face * scene.mean * curve))
    pitch = o["stress.contact_pitch"]
    if scene.is_even:
        yield "pressure at the pitch point by the force", pitch, pressure, pressure
    planet, side = o["stress.root_planet_max"], o["stress.root_side_max"]
    if min(planet, side) > 0.0:
        # with tooth pairs, each root has the height of its own pair
        if scene.contact == LUMPED:
            yield scene.constant("root of the planet over that of the side gear", planet / side, 1.0)
        if scene.is_even and scene.contact == LUMPED:
            yield scene.constant("root stress over the square of pressure", planet / pitch**2 * 1e9, 1.0 + planet / pitch**2 * 1e9)
    for pair in loaded(o):
        ends = ENDS if grows else ["middle"]
        for end in ends:
            own = sqrt(factor) * pair[f"{end}_pressure"]
            yield f"pressure at the {end} below the largest", AtMost(own), o["stress.contact_max"], own
    rated = o["stress.contact_rated"]
    if scene.is_even and pitch > 0.0:
        yield scene.constant("rated pressure over that at the pitch point", rated / pitch, 1.0)
    limits = {"root_min": (max(planet, side), p["strength.bending_strength"]), "flank_min": (rated, p["strength.contact_strength"])}
    for safety, (stress, strength) in limits.items():
        # safety is rated after steps, not at the start
        if o["solver.steps"] > 0.0 and stress > 0.0 and p["strength.rate_from"] == 0.0:
            least = scene.least[safety] = min(scene.least.get(safety, inf), strength / stress)
            yield safety, AtMost(o[f"safety.{safety}"]), (1.0 + BETWEEN) * least, 1.0


CHECKS = [geometry, motion, forces, places, powers, stresses]


def compared(scene, o):
    """[(what, one, other, relative difference)] of the pairs that do not agree at an instant."""
    found = []
    for check in CHECKS:
        for what, one, other, scale in check(scene, o):
            off = max(one - other, 0.0) if isinstance(one, AtMost) else abs(one - other)
            if not off <= CLOSE * scale:
                found.append((what, float(one), float(other), float(off / scale) if scale else np.inf))
    return found


def unbalanced(momentum, scene, o):
    """Side gears whose acceleration does not fit the torques of meshes, half-shaft, clutch on command and drag, unless other parts
    cause friction."""
    # an actuator may still release the lock
    locks = any(scene.p[f"lock.{name}"] > 0.0 for name in ("command", "stroke_time", "response_time"))
    if scene.contact == IDEAL or scene.p["effects.thrust_friction"] or scene.p["effects.limited_slip"] or locks:
        return []
    drag = momentum.dragged(np.array([o["carrier.speed"], *(o[f"{side}.speed"] for side in SIDES)]))[1:]
    found = []
    for side, drags in zip(SIDES, drag):
        terms = [momentum.radius * o[f"{side}.tangential_force"], -o[f"{side}.shaft_torque"], o[f"{side}.clutch_torque"], -drags,
                 -momentum.side * o[f"{side}.acceleration"]]
        allowed = INSTANT * sum(map(abs, terms)) + SOLIDS * momentum.facets[1] * abs(terms[-1])
        if abs(sum(terms)) > allowed:
            found.append((f"{side} torques and reaction", terms, sum(terms), allowed))
    return found
