//! The force is minus the gradient of the energy, at the ends of the path too.

use bevel_differential::contact::mesh::{Mesh, MeshState};
use bevel_differential::geometry::Pair;
use bevel_differential::geometry::corner::CornerGap;
use fastrand::Rng;

use super::setup::{OTHERS, STATES, difference, impact_meshes, loaded, random_state, smooth};
use crate::mesh_laws::{RESTITUTION, STEP, UNDAMPED, meshes};

fn force_is_minus_the_gradient(meshes: &[(Mesh, Pair)], has_pairs: bool) {
    let mut random = Rng::with_seed(11);
    let (mut worst, mut spots) = (0.0f64, [0; 3]);
    for (mesh, pair) in meshes {
        for _ in 0..STATES {
            let state = MeshState { rate: [0.0; 2], ..random_state(&mut random, pair) };
            let depth = state.position[0].abs() - pair.normal_backlash / 2.0;
            // the error is (h/a)⁴ ~ 1e-12 of the force, and rounding ε V/h ~ 1e-13 of it; across a corner's coming into
            // contact the energy is only d^(e+1): (h/a)^e of a pair's force, 3e-5 of h/a = 1e-3
            let h = 1e-3 * depth;
            let force = mesh.force(&state).force;
            let scale = force[0].abs();
            let allowed = if smooth(mesh, &state, h, false) { 1e-8 } else { 1e-4 };
            for axis in 0..2 {
                let gradient = difference(&state, axis, h, false, |s| mesh.energy(s));
                let off = (force[axis] + gradient).abs() / scale;
                if allowed < 1e-5 {
                    worst = worst.max(off);
                }
                assert!(off < allowed, "{state:?} axis {axis}: {} {gradient}, off {off:e}", force[axis]);
            }
            loaded(mesh, state.position).iter().for_each(|p| spots[p.spot as usize] += 1);
        }
    }
    println!("worst {worst:e} of |F_q|, pairs on [path, planet tip, side tip]: {spots:?}");
    assert!(spots.iter().all(|&n| n > 300) || !has_pairs, "{spots:?}");
}

#[test]
fn force_without_damping_is_minus_the_gradient_of_the_energy() {
    force_is_minus_the_gradient(&impact_meshes(0.0, true), true);
}

#[test]
fn force_of_every_law_is_minus_the_gradient_of_its_energy() {
    for kind in OTHERS {
        print!("{kind:?}: ");
        force_is_minus_the_gradient(&meshes(kind, UNDAMPED, true), kind.has_pairs());
    }
}

fn force_stays_the_gradient_across_the_ends(meshes: &[(Mesh, Pair)]) {
    let mut worst = 0.0f64;
    for (mesh, pair) in meshes {
        for hand in [-1.0, 1.0] {
            for depth in [1e-4, 1e-3] {
                let q = hand * (pair.normal_backlash / 2.0 + depth);
                // the tooth k = 0 at the planet tip's end, and at the side tip's, where Δ = low − s + a = 0
                for (s, corner) in [(mesh.engagement.corner[0].end, 0), (-mesh.engagement.corner[1].end + depth, 1)] {
                    let jump = mesh.engagement.corner[corner].exact(0.0).gap.dd;
                    let at_end = -hand * (s - pair.centred_position());
                    for past in [-2e-4, -1e-6, 0.0, 1e-6, 2e-4] {
                        let state = MeshState { position: [q, at_end + past], rate: [0.0; 2], ..MeshState::default() };
                        let force = mesh.force(&state).force;
                        let h = 1e-3 * depth;
                        for axis in 0..2 {
                            let gradient = difference(&state, axis, h, false, |s| mesh.energy(s));
                            // g″ jumps at the end: there the difference is off by g″h/6 times the pair's force, and
                            // next to it by little more
                            let off = (force[axis] + gradient).abs() / force[0].abs();
                            worst = worst.max(off / (jump * h));
                            assert!(off < 1e-8 + 0.25 * jump * h, "{state:?} axis {axis}: off {off:e}, h {h:e}");
                        }
                    }
                }
            }
        }
    }
    println!("worst error {worst:.3} g″h");
}

#[test]
fn force_stays_the_gradient_across_the_ends_of_the_path() {
    force_stays_the_gradient_across_the_ends(&impact_meshes(0.0, true));
}

#[test]
fn force_of_every_law_stays_the_gradient_across_the_ends_of_the_path() {
    for kind in OTHERS {
        print!("{kind:?}: ");
        force_stays_the_gradient_across_the_ends(&meshes(kind, UNDAMPED, true));
    }
}

#[test]
fn force_of_every_law_is_continuous_where_corners_take_over_and_where_they_leave() {
    let mut worst = 0.0f64;
    for kind in OTHERS {
        for damping in [UNDAMPED, STEP, RESTITUTION] {
            for (mesh, pair) in meshes(kind, damping, true) {
                for (hand, depth, rate) in [
                    (-1.0, 1e-4, [0.2, -0.3]),
                    (-1.0, 1e-3, [-0.1, 0.4]),
                    (1.0, 1e-3, [0.3, 0.1]),
                    (1.0, 3e-3, [0.0; 2]),
                ] {
                    let q = hand * (pair.normal_backlash / 2.0 + depth);
                    let [planet, side] = &mesh.engagement.corner;
                    // Δ at which the corner's gap is the approach
                    let leaves = |corner: &CornerGap| {
                        let (mut touches, mut clear) = (0.0, corner.reach(depth));
                        for _ in 0..80 {
                            let middle = 0.5 * (touches + clear);
                            if corner.at(middle).v < depth { touches = middle } else { clear = middle }
                        }
                        touches
                    };
                    let places =
                        [planet.end, planet.end + leaves(planet), -side.end + depth, -side.end + depth - leaves(side)];
                    for s in places {
                        let force = |past: f64| {
                            let x = -hand * (s + past - pair.centred_position());
                            mesh.force(&MeshState { position: [q, x], rate, ..MeshState::default() }).force
                        };
                        let scale = mesh
                            .force(&MeshState { position: [q, 0.0], rate: [0.0; 2], ..MeshState::default() })
                            .force[0]
                            .abs();
                        let (before, after) = (force(-1e-11), force(1e-11));
                        for axis in 0..2 {
                            // a jump would be of the order of the force; slopes are some hundred forces per radian,
                            // at the least approach ten thousand
                            let jump = (after[axis] - before[axis]).abs() / scale;
                            worst = worst.max(jump);
                            assert!(jump < 1e-6, "{kind:?} {damping:?} q {q} s {s} axis {axis}: jump {jump:e}");
                        }
                    }
                }
            }
        }
    }
    println!("worst {worst:e} of |F_q|");
}
