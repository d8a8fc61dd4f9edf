"""Balance of the angular momentum about the axle, asserted after every step of a `Drive` in addition to that of the energy.

The carrier turns with its planets, or each planet turns with its compliant pin; side gears end at the half-shafts. Their
momentum changes by the torque on the carrier, the torques of the shafts and drag. Inertias are given, or from `outline_solids`.
The torque of a drive that imposes the carrier's speed follows from the torques of the meshes. Pinion and propeller shaft of a final
drive have a balance of their own, in which the torque of the drive becomes the torque on the carrier (`FinalDrive`).

INSTANT   relative rounding error of all terms at an instant
SOLIDS    relative error of the inertias of the program's faceted solids, as stated in docs/inside/theory.md
RUN       allowed error of the momentum of a run, in solver tolerances of the momentum turned over
SLIDING   slowest motion that shows in which direction a brake acts [rad/s]
WARMER    temperature change of an oil that warms up: drag follows in steps of 0.1 K, and the oil may change by as much
          within a step [K]"""

import numpy as np
import outline_solids
import theory
from final_drives import FinalDrive

INSTANT, SOLIDS, RUN, SLIDING, WARMER = 1e-9, 2e-5, 10.0, 1e-3, 0.2
SIDES = ["left", "right"]
# dry friction between side gears and carrier, which is not an output
RUBBING = ["effects.thrust_friction", "effects.limited_slip", "effects.clutches"]


class Momentum:
    """Momentum of an initialised instance."""

    def __init__(self, opened):
        self.opened = opened
        self.on = {name: opened.get(name) for name in opened.fmu.variables if name.startswith("effects.")}
        self.imposed = {name: self.literal(f"scene.{name}") == "speed" for name in ["carrier_drive", "left_drive", "right_drive"]}
        self.planets = opened.get("geometry.planet_count")
        self.radius = 0.5 * opened.get("geometry.module") * opened.get("geometry.side_teeth")
        self.orbit, self.side, self.facets = self.inertias()
        self.final = FinalDrive(opened) if self.on["effects.final_drive"] else None
        self.carrier = opened.get("inertia.carrier")
        self.twists = [self.imposed[f"{s}_drive"] or self.on["effects.half_shaft"] and opened.get(f"inertia.{s}_end") > 0.0
                       for s in SIDES]
        self.ends = opened.read([f"inertia.{s}_end" for s in SIDES])
        self.drag = {name: opened.get(f"bearing_drag.{name}") for name in
                     ["carrier_torque", "carrier_viscous", "carrier_churning", "side_torque", "side_viscous",
                      "breakaway_speed", "viscosity_from_oil", "reference_temperature", "churning_from_geometry",
                      "carrier_diameter", "carrier_width", "oil_level", "seal_diameter", "seal_torque_per_diameter",
                      "bearing_load", "bearing_diameter", "bearing_coefficient"]}
        self.pins = [f"planet[{i + 1}].pin_speed" if self.on["effects.pin_compliance"] else "carrier.speed"
                     for i in range(self.planets)]
        self.bodies = ["carrier.speed", *self.pins, "left.speed", "right.speed"]
        self.brake_varies = any(v.name.startswith("wheel_brake.") and v.causality == "parameter" and v.name != "wheel_brake.stiffness"
                                and opened.get(v.name) != v.start for v in opened.fmu.variables.values())
        self.gained = self.given = self.turned_over = 0.0
        self.momentum, self.external = self.now(), self.commands()

    def literal(self, name):
        number = self.opened.get(name)
        return next(literal for literal, its in self.opened.fmu.variable(name).literals.items() if its == number)

    def inertias(self):
        """Inertia of a planet about the axle and of a side gear, and weights of the allowed error of solids."""
        def of(name):
            if name == "backlash" and not self.on["effects.backlash"]:
                return 0.0
            return self.opened.get(f"geometry.{name}")

        both, cones = outline_solids.gears(self.literal("geometry.addendum_system"), of)
        density = self.opened.get("material.density")
        planet, side = (gear.inertias(cones, of(bore), density)
                        for gear, bore in zip(both, ["planet_bore", "side_bore"]))
        if self.opened.get("inertia.from_geometry"):
            return planet[1], side[0], [1.0, 1.0]
        # a given planet inertia has the proportions of its solid
        given = self.opened.get("inertia.planet")
        return planet[1] / planet[0] * given, self.opened.get("inertia.side_gear"), [1.0, 0.0]

    def weights(self):
        """Inertia of each body."""
        return np.array([self.carrier, *[self.orbit] * self.planets, self.side, self.side])

    def dragged(self, speeds, warmer=0.0):
        """Torques of drag on carrier and side gears, in an oil that is warmer by `warmer` kelvins."""
        if not self.on["effects.bearing_drag"]:
            return np.zeros(3)
        d = self.drag
        thick, churning = 1.0, d["carrier_churning"]
        oil, points = self.opened.get("temperature.oil") + warmer, [self.opened.get(f"oil.{name}") for name in theory.OIL]
        if d["viscosity_from_oil"]:
            thick = theory.viscosity(oil, *points) / theory.viscosity(d["reference_temperature"], *points)
        built_up = np.tanh(speeds / d["breakaway_speed"])
        if d["churning_from_geometry"]:
            kinematic = theory.kinematic_viscosity(oil, *points[:2])
            churning = theory.churning(kinematic, 1.0, d["carrier_diameter"], d["carrier_width"], d["oil_level"])
        bearings = d["carrier_torque"] + 2.0 * d["bearing_coefficient"] * d["bearing_load"] * d["bearing_diameter"]
        seal = d["side_torque"] + d["seal_torque_per_diameter"] * d["seal_diameter"]
        carrier = bearings * built_up[0] + thick * d["carrier_viscous"] * speeds[0] + churning * speeds[0] * abs(speeds[0])
        return np.array([carrier, *(seal * built_up[1:] + thick * d["side_viscous"] * speeds[1:])])

    def check(self):
        """Asserts the balance at the present time."""
        one = self.opened
        rates = np.array(one.read([f"der({name})" for name in self.bodies]))
        terms = self.weights() * rates
        speeds = np.array(one.read(["carrier.speed", "left.speed", "right.speed"]))
        drag = self.dragged(speeds)
        drive, *shafts = one.read(["carrier.torque", "left.shaft_torque", "right.shaft_torque"])
        meshes = self.radius * np.array(one.read(["left.tangential_force", "right.tangential_force"]))
        rounding = INSTANT * (np.sum(np.abs(terms)) + sum(map(abs, [drive, *shafts, *drag])) + np.sum(np.abs(meshes)))
        if self.on["effects.warm_up"]:
            rounding += np.sum(np.abs(self.dragged(speeds, WARMER) - self.dragged(speeds, -WARMER)))
        facets = SOLIDS * (self.facets[0] * np.sum(np.abs(terms[1:-2])) + self.facets[1] * np.sum(np.abs(terms[-2:])))
        # the gearing of clutches on command turns against the housing
        housing = one.get("clutches.housing_torque")
        rounding += INSTANT * abs(housing)
        off = np.sum(terms) - (drive - sum(shafts) - np.sum(drag) - housing)
        assert abs(off) <= rounding + facets, f"momentum about the axle is off by {off} N.m: {terms} {drive} {shafts}"
        port = one.get("propeller.torque")
        if not self.imposed["carrier_drive"]:
            command = one.get("pinion.torque_command" if self.final else "carrier.torque_command")
            assert abs(port - command) <= INSTANT * abs(command), f"the drive gives {port} N.m, not {command}"
        if self.final:
            self.final.check(rounding)
        if not self.final and not self.imposed["carrier_drive"]:
            wanted = port
        elif not any(self.on[name] for name in RUBBING) and one.get("lock.command") == 0.0:
            wanted = np.sum(terms[:-2]) + np.sum(meshes) + drag[0]
        else:
            wanted = drive
        assert abs(drive - wanted) <= rounding + facets + INSTANT * abs(wanted), f"the carrier has {drive} N.m, not {wanted}"
        for s, side in enumerate(SIDES):
            self.check_shaft(side, shafts[s], f"{side}.end_speed" if self.twists[s] else f"{side}.speed", rounding)

    def check_shaft(self, side, torque, wheel, rounding):
        """Asserts that the torque of a shaft equals that of its spring, and the torque that the wheel at its end needs."""
        one, speed = self.opened, self.opened.get(wheel)
        # the lash of a dog clutch has tests of its own
        if wheel.endswith("end_speed") and not self.on["effects.disconnect"]:
            spring, damper = one.read([f"half_shaft.{side}_stiffness", f"half_shaft.{side}_damping"])
            terms = [spring * one.get(f"{side}.shaft_twist"), damper * (one.get(f"{side}.speed") - speed)]
            assert abs(torque - sum(terms)) <= rounding + INSTANT * sum(map(abs, terms)), f"the spring at the {side} is off"
        brake = one.get(f"{side}.brake_torque") if self.on["effects.wheel_brake"] else 0.0
        # skips a brake that holds, or whose friction varies
        if self.imposed[f"{side}_drive"] or brake and (self.brake_varies or one.get("held.wheels") or abs(speed) < SLIDING):
            return
        needed = one.get(f"inertia.{side}_end") * one.get(f"der({wheel})") + one.get(f"{side}.load_torque") + brake * np.sign(speed)
        assert abs(torque - needed) <= rounding + INSTANT * abs(needed), f"the end at the {side} is off"

    def now(self):
        """Momentum including the ends and the final drive, and the sum of the magnitudes of its parts."""
        speeds = np.array(self.opened.read(self.bodies))
        ends = [self.opened.get(f"{s}.end_speed" if twists else f"{s}.speed") for s, twists in zip(SIDES, self.twists)]
        parts = np.concatenate([self.weights() * speeds, np.array(self.ends) * ends, self.final.momenta() if self.final else []])
        return np.sum(parts), np.sum(np.abs(parts))

    def commands(self):
        """External torques, or None if commands do not determine all of them."""
        if (self.on["effects.bearing_drag"] or self.on["effects.clutches"] or self.final and not self.final.keeps_momentum or any(self.imposed.values())
                or any(self.opened.read(["left.brake_torque", "right.brake_torque"]))):
            return None
        drive = self.final.command() if self.final else self.opened.get("carrier.torque_command")
        return np.array([drive, *self.opened.read(["left.load_torque", "right.load_torque"])])

    def before_step(self):
        """Reads the state and the inputs, which may have changed since the last step."""
        self.momentum, self.external = self.now(), self.commands()

    def after_step(self, size):
        """Asserts the balance at the end of a step of `size`, and over all steps."""
        self.check()
        external, now = self.commands(), self.now()
        if external is None or self.external is None or np.any(external != self.external):
            return
        self.gained += now[0] - self.momentum[0]
        self.given += size * (external[0] - external[1] - external[2])
        self.turned_over += size * np.sum(np.abs(external))
        whole = self.turned_over + now[1]
        allowed = RUN * self.opened.get("solver.relative_tolerance") * whole
        assert abs(self.gained - self.given) <= allowed, f"momentum of the run: {self.gained}, not {self.given} N.m.s"
