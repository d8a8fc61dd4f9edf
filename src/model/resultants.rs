//! Forces, torques and powers at an instant: what outputs read, computed when asked for.
//!
//! A pair's force F acts along the flank's normal n, tangent to the sphere. About a gear's axis it has the lever arm
//! R ℓ, so that its part along the axis is F √(sin²φ − ℓ²) at polar angle φ; on the path ℓ = sinδ_b and that is
//! F cosδ_b sinψ, which at s = 0 is the textbook's F sinα sinδ. What remains is tangential to the carrier's rotation.

use super::ideal::Ideal;
use super::parameters::Inputs;
use super::plan::MAX_GROUPS;
use super::readings::{Forces, MeshForces};
use super::state::{CARRIER, PLANET, State};
use super::teeth::{Equations, SIGMA};
use crate::contact::mesh::{Flank, Mesh, MeshState, Spot, ToothPair};
use crate::geometry::Pair;
use crate::numeric::{cos, sin, sqrt};

/// Parts of a unit normal force of one pair: along the planet's axis, along the side gear's axis, tangential.
struct Parts {
    planet: f64,
    side: f64,
    tangential: f64,
}

fn parts(pair: &Pair, mesh: &Mesh, contact: &ToothPair) -> Parts {
    let [lever_p, lever_s] = pair.lever();
    let along = |polar: f64, lever: f64| sqrt((sin(polar) * sin(polar) - lever * lever).max(0.0));
    let (planet, side) = match contact.spot {
        Spot::Path => (
            cos(pair.gears[0].base) * sin(pair.pitch_arc[0] + contact.place),
            cos(pair.gears[1].base) * sin(pair.pitch_arc[1] - contact.place),
        ),
        Spot::PlanetTip => {
            let corner = mesh.corner[0].exact(contact.place);
            (along(corner.own_polar, lever_p * (1.0 - corner.gap.d)), along(corner.mate_polar, lever_s))
        }
        Spot::SideTip => {
            let corner = mesh.corner[1].exact(contact.place);
            (along(corner.mate_polar, lever_p), along(corner.own_polar, lever_s * (1.0 - corner.gap.d)))
        }
    };
    let forward = sqrt((1.0 - planet * planet - side * side).max(0.0));
    Parts { planet, side, tangential: if contact.flank == Flank::Drive { forward } else { -forward } }
}

fn mesh_forces(pair: &Pair, mesh: &Mesh, state: &MeshState) -> MeshForces {
    let mut out = MeshForces {
        transmission_error: mesh.drive_approach(state.position[0]) * pair.mean_cone,
        ..MeshForces::default()
    };
    mesh.pairs(state.position, |contact| {
        let force = mesh.pair_force(contact, state).1.total;
        let part = parts(pair, mesh, contact);
        out.normal += force;
        out.pairs += if force > 0.0 { 1.0 } else { 0.0 };
        out.side_thrust += force * part.side;
        out.planet_thrust += force * part.planet;
        out.tangential += force * part.tangential;
    });
    out
}

/// Sums over meshes and sides that both levels share, from `out.mesh` of all planets.
fn add_up(out: &mut Forces, planets: usize) {
    for i in 0..planets {
        let mesh = out.mesh[i];
        let (mut across, mut along) = (0.0, 0.0);
        for s in 0..2 {
            out.side_normal[s] += mesh[s].normal;
            out.side_thrust[s] += mesh[s].side_thrust;
            out.planet_thrust[i] += mesh[s].planet_thrust;
            across += mesh[s].tangential;
            along += SIGMA[s] * mesh[s].side_thrust;
        }
        out.pin_force[i] = sqrt(across * across + along * along);
    }
}

/// Powers from torques and speeds; heat is given.
fn add_powers(out: &mut Forces, state: &State, heat: f64) {
    let v = &state.v;
    out.power_in = out.carrier_torque * v[CARRIER] + out.spin_torque * v[PLANET];
    out.power_out = out.shaft_torque[0] * v[0] + out.shaft_torque[1] * v[1];
    out.power_loss = heat;
}

/// Forces of the differential with teeth.
pub fn teeth_forces<const N: usize>(pair: &Pair, equations: &Equations<N>, inputs: &Inputs, state: &State) -> Forces {
    let (teeth, point) = (equations.teeth, &state.point());
    let (torque, heat) = equations.tooth_torques(point);
    let mut a = torque;
    equations.finish(point, &mut a, heat);
    let mut out = Forces { carrier_acceleration: a[CARRIER], side_acceleration: [a[0], a[1]], ..Forces::default() };
    out.carrier_torque = if teeth.plan.carrier_imposed { -torque[CARRIER] } else { inputs.carrier_torque };
    for s in 0..2 {
        out.shaft_torque[s] = inputs.load_torque[s] + teeth.inertia.end[s] * a[s];
        out.side_tangential[s] = torque[s] / (0.5 * pair.outer_pitch_diameter(1));
    }
    let mut groups = [[MeshForces::default(); 2]; MAX_GROUPS];
    for (g, group) in teeth.plan.groups().iter().enumerate() {
        if teeth.plan.spin_imposed {
            out.spin_torque -= group.members * torque[PLANET + g];
        }
        for (s, forces) in groups[g].iter_mut().enumerate() {
            *forces = mesh_forces(pair, &teeth.mesh, &equations.mesh_state(point, g, s));
        }
    }
    for i in 0..teeth.plan.planets {
        out.mesh[i] = groups[teeth.plan.group_of[i]];
    }
    add_up(&mut out, teeth.plan.planets);
    add_powers(&mut out, state, heat);
    out
}

/// Forces of the ideal differential: torques shared equally by all meshes, acting at the pitch point.
pub fn ideal_forces(pair: &Pair, ideal: &Ideal, inputs: &Inputs, state: &State) -> Forces {
    let motion = ideal.motion(inputs);
    let side_acceleration = ideal.side_accelerations(&motion);
    let inertia = &ideal.inertia;
    let mut out = Forces {
        carrier_acceleration: motion.carrier,
        side_acceleration,
        carrier_torque: motion.carrier_torque,
        spin_torque: motion.spin_torque,
        ..Forces::default()
    };
    let mut mesh = [MeshForces::default(); 2];
    for s in 0..2 {
        let torque = inputs.load_torque[s] + inertia.side[s] * side_acceleration[s];
        out.shaft_torque[s] = inputs.load_torque[s] + inertia.end[s] * side_acceleration[s];
        out.side_tangential[s] = torque / (0.5 * pair.outer_pitch_diameter(1));
        let normal = torque / (inertia.planets * pair.mean_cone * pair.lever()[1]);
        let (alpha, pitch) = (pair.pressure_angle, [pair.gears[0].pitch, pair.gears[1].pitch]);
        mesh[s] = MeshForces {
            normal: normal.abs(),
            pairs: if normal == 0.0 { 0.0 } else { 1.0 },
            side_thrust: normal.abs() * sin(alpha) * sin(pitch[1]),
            planet_thrust: normal.abs() * sin(alpha) * sin(pitch[0]),
            tangential: normal * cos(alpha),
            transmission_error: 0.0,
        };
    }
    out.mesh[..ideal.plan.planets].fill(mesh);
    add_up(&mut out, ideal.plan.planets);
    add_powers(&mut out, state, 0.0);
    out
}
