"""A case of the study in MuJoCo: rigid teeth as convex meshes that meet in points, with soft constraints.

MuJoCo's contact is a linear spring and damper, which it solves implicitly. In its terms (time constant t, damping ratio 1,
impedance d, A = inverse inertia at the contact), the spring is K = 1 / (t² A d (1 − d)) and the damper 2 d t K. K is the
study's force divided by its penetration, at the mean force of a mesh. With t = 0.4 ms, the damper is three times the
study's. t stays constant for smaller steps, because the law would otherwise change with it. MuJoCo requires t to be at
least two steps, so t grows with steps above 0.2 ms.
"""

import time as clock

import mujoco
import numpy as np

import cases
import gears

# inertia of imposed motions: in a communication step, loads change their speed by 2e-4 rad/s, and then the speed is reset
IMPOSED = 1e4
# the study's contact law, for the stiffness of a pair
STIFFNESS, EXPONENT = 1.824634e10, 1.5
TIME_CONSTANT = 4e-4
# an arbitrary value: axes are fixed, so only inertias about them matter
MASS = 0.3


def impedance(case, time_constant):
    """MuJoCo's d for the study's stiffness."""
    side, planet = (gears.MEAN_CONE * np.sin(gear.base) for gear in (gears.SIDE, gears.PLANET))
    inverse_inertia = side**2 / gears.SIDE.inertia()
    if case.spin is None:
        inverse_inertia += planet**2 / gears.PLANET.inertia()
    force = cases.LOAD / (gears.PLANETS * side)
    stiffness = force / (force / STIFFNESS) ** (1.0 / EXPONENT)
    # d (1 − d) is at most 1/4, and the time constant cannot give a softer contact
    return 0.5 * (1.0 + np.sqrt(max(1.0 - 4.0 / (stiffness * time_constant**2 * inverse_inertia), 0.0)))


def build(case, wanted):
    spec = mujoco.MjSpec()
    option = spec.option
    option.timestep = wanted["step"]
    option.gravity = [0.0, 0.0, 0.0]
    option.integrator = mujoco.mjtIntegrator.mjINT_IMPLICITFAST
    option.solver = mujoco.mjtSolver.mjSOL_NEWTON
    option.tolerance, option.ccd_tolerance = 1e-12, 1e-8
    # exact inverse inertia of each contact; the default estimate would change the stiffness
    option.enableflags |= mujoco.mjtEnableBit.mjENBL_DIAGEXACT
    if not wanted["many_points"]:
        option.disableflags |= mujoco.mjtDisableBit.mjDSBL_MULTICCD
    for gear, name in (gears.PLANET, "planet"), (gears.SIDE, "side"):
        mesh = spec.add_mesh()
        mesh.name = name
        mesh.uservert = gear.teeth_points(wanted["facets"], gap_first=gear is gears.SIDE)[0].ravel().tolist()
        mesh.inertia = mujoco.mjtMeshInertia.mjMESH_INERTIA_CONVEX
    time_constant = max(TIME_CONSTANT, 2.0 * wanted["step"])
    contact = [time_constant, 1.0], impedance(case, time_constant)
    carrier = add_body(spec.worldbody, "carrier", np.eye(3), [1.0, 0.0, 0.0], 1e-3, True)
    for k, frame in enumerate(gears.PLANET_FRAMES, 1):
        axis = [0.0, 0.0, gears.PLANET_SENSE]
        body = add_body(carrier, f"planet{k}", frame, axis, gears.PLANET.inertia(), case.spin is not None)
        add_teeth(body, gears.PLANET, "planet", (1, 2), contact)
    for name, frame in gears.SIDE_FRAMES.items():
        axis = [0.0, 0.0, gears.SIDE_SENSE[name]]
        body = add_body(spec.worldbody, name, frame, axis, gears.SIDE.inertia(), False)
        add_teeth(body, gears.SIDE, "side", (2, 1), contact)
    return spec.compile()


def add_body(parent, name, frame, axis, inertia, imposed):
    body = parent.add_body()
    body.name = name
    body.quat = np.zeros(4)
    mujoco.mju_mat2Quat(body.quat, np.ascontiguousarray(frame).ravel())
    body.mass, body.inertia, body.ipos, body.explicitinertial = MASS, [inertia] * 3, [0.0] * 3, True
    joint = body.add_joint()
    joint.name, joint.type, joint.axis = name, mujoco.mjtJoint.mjJNT_HINGE, axis
    if imposed:
        joint.armature = IMPOSED
    return body


def add_teeth(body, gear, mesh, kinds, contact):
    """Adds the teeth of a gear, which collide only with those of the other kind, without friction."""
    for k in range(gear.teeth):
        half = np.pi * k / gear.teeth
        geom = body.add_geom()
        geom.type, geom.meshname, geom.density = mujoco.mjtGeom.mjGEOM_MESH, mesh, 0.0
        geom.quat = [np.cos(half), 0.0, 0.0, np.sin(half)]
        geom.contype, geom.conaffinity = kinds
        geom.condim = 1
        geom.solref[:2], geom.solimp[:2] = contact[0], contact[1]


def normal_forces(model, data, sides):
    """Sums of the normal forces on left and right."""
    sums, force = np.zeros(2), np.zeros(6)
    for k in range(data.ncon):
        mujoco.mj_contactForce(model, data, k, force)
        bodies = model.geom_bodyid[data.contact.geom[k]]
        sums[next(i for i, side in enumerate(sides) if side in bodies)] += force[0]
    return sums


def run(wanted):
    case = cases.CASES[wanted["case"]]
    model = build(case, wanted)
    data = mujoco.MjData(model)
    sides, planets, carrier = ([model.joint(name).dofadr[0] for name in names]
                               for names in (["left", "right"], ["planet1", "planet2"], ["carrier"]))
    bodies = [model.body(name).id for name in ("left", "right")]
    data.qvel[sides] = case.sides
    count, within = cases.counts(wanted["step"])
    speeds, forces, cpu = np.zeros((count * within, 2)), np.full((count, 2), np.nan), 0.0
    for k in range(count):
        begin, time = clock.process_time(), k * cases.STEP
        data.qpos[carrier], data.qvel[carrier] = case.carrier * time, case.carrier
        if case.spin is not None:
            data.qpos[planets], data.qvel[planets] = case.spin * time, case.spin
        data.qfrc_applied[sides] = -cases.load(time + cases.STEP, wanted["at_once"])
        for i in range(k * within, (k + 1) * within):
            mujoco.mj_step(model, data)
            speeds[i] = data.qvel[sides]
        cpu += clock.process_time() - begin
        if k % cases.FORCES_EVERY == 0:
            forces[k] = normal_forces(model, data, bodies)
    angles = [float(data.qpos[i]) for i in (*sides, *carrier, planets[0])]
    time = wanted["step"] * np.arange(1, count * within + 1)
    return cases.measures(case, time, speeds, angles, forces, cpu)


if __name__ == "__main__":
    cases.report(run(cases.settings()))
