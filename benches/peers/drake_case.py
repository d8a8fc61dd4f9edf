"""A case of the study in Drake: each tooth is a compliant convex solid without friction, and steps have a fixed length.

`hydroelastic` contact integrates a pressure over the patch where two teeth overlap; the pressure increases inwards from
the surface according to `modulus`. `point` contact is a penalty on the deepest point of each pair.
"""

import time as clock

import numpy as np
from pydrake.geometry import (
    AddCompliantHydroelasticProperties,
    AddContactMaterial,
    Convex,
    HydroelasticContactRepresentation,
    ProximityProperties,
)
from pydrake.math import RigidTransform, RotationMatrix
from pydrake.multibody.plant import (
    AddMultibodyPlantSceneGraph,
    ContactModel,
    CoulombFriction,
    DiscreteContactApproximation,
)
from pydrake.multibody.tree import FixedOffsetFrame, RevoluteJoint, SpatialInertia, UnitInertia
from pydrake.systems.analysis import Simulator
from pydrake.systems.framework import DiagramBuilder

import cases
import gears

# inertia of imposed motions: in a communication step, loads change their speed by 2e-4 rad/s, and then the speed is reset
IMPOSED = 1e4
# an arbitrary value: axes are fixed, so only inertias about them matter
MASS = 0.3
# pressure [Pa] at the middle of a tooth, with which flanks deflect about as much as steel teeth
MODULUS = 4e10
DISSIPATION = 20.0
# point contact: the study's force divided by its penetration, at the mean force of a mesh; the pair's two teeth are in series
POINT_STIFFNESS = 2.0 * 1.75e8


def properties(contact):
    made = ProximityProperties()
    if contact == "hydroelastic":
        # the first number is for meshes of round shapes, and polyhedra do not use it
        AddCompliantHydroelasticProperties(1.0, MODULUS, made)
    AddContactMaterial(DISSIPATION, POINT_STIFFNESS, CoulombFriction(0.0, 0.0), made)
    return made


class Differential:
    """Plant with its joints by name."""

    def __init__(self, case, wanted):
        builder = DiagramBuilder()
        self.plant, self.scene_graph = AddMultibodyPlantSceneGraph(builder, wanted["step"])
        hydroelastic = wanted["contact"] == "hydroelastic"
        self.plant.set_contact_model(ContactModel.kHydroelastic if hydroelastic else ContactModel.kPoint)
        self.plant.set_discrete_contact_approximation(DiscreteContactApproximation.kLagged)
        self.plant.set_contact_surface_representation(HydroelasticContactRepresentation.kPolygon)
        self.plant.mutable_gravity_field().set_gravity_vector([0.0, 0.0, 0.0])
        self.material, self.facets = properties(wanted["contact"]), wanted["facets"]
        self.joints, self.actuators = {}, {}
        world = self.plant.world_body()
        carrier = self.add_body("carrier", world, np.eye(3), [1.0, 0.0, 0.0], 1e-3, True)
        for k, frame in enumerate(gears.PLANET_FRAMES, 1):
            axis, imposed = [0.0, 0.0, gears.PLANET_SENSE], case.spin is not None
            body = self.add_body(f"planet{k}", carrier, frame, axis, gears.PLANET.inertia(), imposed)
            self.add_teeth(body, gears.PLANET)
        self.sides = []
        for name, frame in gears.SIDE_FRAMES.items():
            body = self.add_body(name, world, frame, [0.0, 0.0, gears.SIDE_SENSE[name]], gears.SIDE.inertia(), False)
            self.add_teeth(body, gears.SIDE)
            self.sides.append(body)
        self.plant.Finalize()
        self.simulator = Simulator(builder.Build())
        self.simulator.Initialize()
        self.context = self.plant.GetMyMutableContextFromRoot(self.simulator.get_mutable_context())
        self.teeth_of_sides = [set(self.plant.GetCollisionGeometriesForBody(body)) for body in self.sides]

    def add_body(self, name, parent, frame, axis, inertia, imposed):
        unit = UnitInertia(inertia / MASS, inertia / MASS, inertia / MASS)
        body = self.plant.AddRigidBody(name, SpatialInertia(MASS, [0.0, 0.0, 0.0], unit))
        offset = RigidTransform(RotationMatrix(frame), [0.0] * 3)
        # the returned frame, because the plant takes ownership of the passed one
        mount = self.plant.AddFrame(FixedOffsetFrame(f"{name}_mount", parent.body_frame(), offset))
        self.joints[name] = self.plant.AddJoint(RevoluteJoint(name, mount, body.body_frame(), axis))
        self.actuators[name] = self.plant.AddJointActuator(f"{name}_drive", self.joints[name])
        if imposed:
            self.actuators[name].set_default_rotor_inertia(IMPOSED)
            self.actuators[name].set_default_gear_ratio(1.0)
        return body

    def add_teeth(self, body, gear):
        for k, corners in enumerate(gear.teeth_points(self.facets, gap_first=gear is gears.SIDE)):
            shape = Convex(points=corners.T.copy(), label=f"{body.name()}_{k}", scale=1.0)
            self.plant.RegisterCollisionGeometry(body, RigidTransform(), shape, f"tooth_{k}", self.material)

    def set(self, name, angle, speed):
        if angle is not None:
            self.joints[name].set_angle(self.context, angle)
        self.joints[name].set_angular_rate(self.context, speed)

    def normal_forces(self):
        """Sums of the normal forces on left and right."""
        results = self.plant.get_contact_results_output_port().Eval(self.context)
        contacts = []
        for k in range(results.num_hydroelastic_contacts()):
            contact = results.hydroelastic_contact_info(k)
            surface = contact.contact_surface()
            contacts.append(({surface.id_M(), surface.id_N()}, contact.F_Ac_W().translational()))
        for k in range(results.num_point_pair_contacts()):
            contact = results.point_pair_contact_info(k)
            contacts.append(({contact.point_pair().id_A, contact.point_pair().id_B}, contact.contact_force()))
        return [sum(np.linalg.norm(force) for pair, force in contacts if pair & teeth) for teeth in self.teeth_of_sides]


def run(wanted):
    case = cases.CASES[wanted["case"]]
    model = Differential(case, wanted)
    joints, sides = model.joints, ["left", "right"]
    for side, speed in zip(sides, case.sides):
        model.set(side, None, speed)
    actuation, drives = np.zeros(model.plant.num_actuators()), [model.actuators[side].input_start() for side in sides]
    count, within = cases.counts(wanted["step"])
    speeds, forces, cpu = np.zeros((count * within, 2)), np.full((count, 2), np.nan), 0.0
    for k in range(count):
        begin, time = clock.process_time(), k * cases.STEP
        model.set("carrier", case.carrier * time, case.carrier)
        if case.spin is not None:
            model.set("planet1", case.spin * time, case.spin)
            model.set("planet2", case.spin * time, case.spin)
        actuation[drives] = -cases.load(time + cases.STEP)
        model.plant.get_actuation_input_port().FixValue(model.context, actuation)
        for i in range(k * within, (k + 1) * within):
            model.simulator.AdvanceTo((i + 1) * wanted["step"])
            speeds[i] = [joints[side].get_angular_rate(model.context) for side in sides]
        cpu += clock.process_time() - begin
        if k % cases.FORCES_EVERY == 0:
            forces[k] = model.normal_forces()
    angles = [joints[name].get_angle(model.context) for name in (*sides, "carrier", "planet1")]
    time = wanted["step"] * np.arange(1, count * within + 1)
    return cases.measures(case, time, speeds, angles, forces, cpu)


if __name__ == "__main__":
    cases.report(run(cases.settings()))
