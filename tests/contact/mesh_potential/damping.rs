//! The Jacobian is that of the damped force, and damping only ever dissipates.

use bevel_differential::contact::damping::Damping;
use bevel_differential::contact::mesh::{Mesh, MeshState};
use bevel_differential::geometry::Pair;
use fastrand::Rng;

use super::setup::{OTHERS, STATES, difference, impact_meshes, pattern, random_state, smooth};
use crate::mesh_laws::{PER_FULL_DEPTH, RESTITUTION, STEP, UNDAMPED, meshes};

fn jacobian_equals_differences(meshes: &[(Mesh, Pair)]) -> usize {
    let mut random = Rng::with_seed(12);
    let (mut worst, mut compared, mut clipped) = (0.0f64, 0, 0);
    for (mesh, pair) in meshes {
        for _ in 0..STATES {
            let state = random_state(&mut random, pair);
            let depth = state.position[0].abs() - pair.normal_backlash / 2.0;
            let h = 1e-4 * depth;
            let (load, jacobian) = mesh.linearise(&state);
            clipped += pattern(mesh, &state).iter().filter(|p| p.2).count();
            assert_eq!(load.force, mesh.force(&state).force, "{state:?}");
            for (of_rate, h, by) in [(false, h, jacobian.by_position), (true, 1e-3, jacobian.by_rate)] {
                if !smooth(mesh, &state, h, of_rate) {
                    continue;
                }
                compared += 1;
                let scale = by.iter().flatten().fold(1e-30, |m: f64, x| m.max(x.abs()));
                for a in 0..2 {
                    for b in 0..2 {
                        let d = difference(&state, b, h, of_rate, |s| mesh.force(s).force[a]);
                        let off = (by[a][b] - d).abs() / scale;
                        worst = worst.max(off);
                        // rounding ε F/(h F′) ~ 1e-12, growing where forces nearly cancel
                        assert!(off < 1e-6, "{state:?} {of_rate} [{a}][{b}]: {} {d} off {off:e}", by[a][b]);
                    }
                }
            }
        }
    }
    println!("worst {worst:e} of the largest entry in {compared} comparisons, {clipped} clipped pairs");
    assert!(compared > STATES);
    clipped
}

#[test]
fn jacobian_equals_differences_of_the_damped_force() {
    assert!(jacobian_equals_differences(&impact_meshes(5e4, true)) > 100);
}

#[test]
fn jacobian_of_every_law_equals_differences_of_the_damped_force() {
    // and so much damping that flanks often let go
    let harsh =
        [Damping::Step { coefficient: 1e7, per_full_depth: PER_FULL_DEPTH }, Damping::HuntCrossley { lambda: 60.0 }];
    for kind in OTHERS {
        for damping in [UNDAMPED, STEP, RESTITUTION].into_iter().chain(harsh) {
            print!("{kind:?} {damping:?}: ");
            let clipped = jacobian_equals_differences(&meshes(kind, damping, true));
            assert!(clipped > 100 || !harsh.contains(&damping));
        }
    }
}

#[test]
fn hessian_is_symmetric_without_damping() {
    let mut random = Rng::with_seed(13);
    let others = OTHERS.into_iter().flat_map(|kind| meshes(kind, UNDAMPED, true));
    for (mesh, pair) in impact_meshes(0.0, true).into_iter().chain(others) {
        for _ in 0..STATES {
            let [[_, a], [b, _]] = mesh.linearise(&random_state(&mut random, &pair)).1.by_position;
            assert!((a - b).abs() <= 1e-14 * a.abs(), "{a} {b}");
        }
    }
}

fn power_plus_heat_is_what_the_energy_loses(meshes: &[(Mesh, Pair)]) {
    let mut random = Rng::with_seed(14);
    let (mut worst, mut hot) = (0.0f64, 0);
    for (mesh, pair) in meshes {
        for _ in 0..STATES {
            let state = random_state(&mut random, pair);
            let load = mesh.force(&state);
            assert!(load.heat >= 0.0, "{state:?} cools: {}", load.heat);
            hot += usize::from(load.heat > 0.0);
            let depth = state.position[0].abs() - pair.normal_backlash / 2.0;
            let h = 1e-3 * depth;
            let gained: f64 =
                (0..2).map(|axis| difference(&state, axis, h, false, |s| mesh.energy(s)) * state.rate[axis]).sum();
            let power = load.force[0] * state.rate[0] + load.force[1] * state.rate[1];
            let scale = mesh.force(&MeshState { rate: [0.0; 2], ..state }).force[0].abs() + load.force[0].abs();
            let off = (power + load.heat + gained).abs() / scale;
            let steady = smooth(mesh, &state, h, false);
            if steady {
                worst = worst.max(off);
            }
            assert!(off < if steady { 1e-8 } else { 2e-4 }, "{state:?}: off {off:e}");
        }
    }
    println!("worst {worst:e} of |F_q| · 1 rad/s, {hot} states with heat");
    assert!(hot > STATES);
}

#[test]
fn power_of_the_force_plus_heat_is_what_the_energy_loses() {
    power_plus_heat_is_what_the_energy_loses(&impact_meshes(5e4, true));
}

#[test]
fn power_of_the_force_of_every_law_plus_heat_is_what_the_energy_loses() {
    for kind in OTHERS {
        for damping in [STEP, RESTITUTION] {
            print!("{kind:?} {damping:?}: ");
            power_plus_heat_is_what_the_energy_loses(&meshes(kind, damping, true));
        }
    }
}
