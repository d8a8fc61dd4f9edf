//! The mesh's force is the gradient of its energy, its Jacobian that of its force, and damping only ever heats.
//!
//! Here for IMPACT, and again for the other laws: their energy also depends on the place of a pair on the path.
//! Central differences of the program's own energy and force: their error is stated at each comparison.

#![allow(clippy::needless_range_loop)] // an index names the same axis or gear on both sides

mod mesh_explicit;
mod mesh_laws;

use bevel_differential::contact::damping::Damping;
use bevel_differential::contact::mesh::{Law, Mesh, MeshState};
use bevel_differential::contact::pairs::{Flank, Spot, ToothPair};
use bevel_differential::geometry::Pair;
use bevel_differential::geometry::corner::CornerGap;
use mesh_explicit::Lcg;
use mesh_laws::{Kind, PER_FULL_DEPTH, RESTITUTION, STEP, UNDAMPED, meshes};

const STATES: usize = 4000;
/// Deepest approach tried [rad]: 0.1 mm at R_m.
const DEEPEST: f64 = 3e-3;

/// Meshes under IMPACT with `damping`.
fn impact_meshes(damping: f64, corner_contact: bool) -> Vec<(Mesh, Pair)> {
    meshes(Kind::Impact, Damping::Step { coefficient: damping, per_full_depth: PER_FULL_DEPTH }, corner_contact)
}

/// Laws besides IMPACT.
const OTHERS: [Kind; 4] = [Kind::Power, Kind::Line, Kind::LineWeber, Kind::Lumped];

fn at(position: [f64; 2]) -> MeshState {
    MeshState { position, ..MeshState::default() }
}

fn random_state(random: &mut Lcg, pair: &Pair) -> MeshState {
    let depth = random.between(1e-5, DEEPEST);
    let hand = if random.between(-1.0, 1.0) < 0.0 { -1.0 } else { 1.0 };
    MeshState {
        position: [
            hand * (pair.normal_backlash / 2.0 + depth),
            random.between(-2.0 * pair.base_pitch, 2.0 * pair.base_pitch),
        ],
        rate: [random.between(-1.0, 1.0), random.between(-1.0, 1.0)],
        which: [0; 2],
    }
}

fn loaded(mesh: &Mesh, position: [f64; 2]) -> Vec<ToothPair> {
    let mut pairs = Vec::new();
    let at_rest = MeshState { position, ..MeshState::default() };
    mesh.loaded(&at_rest, |p, _| {
        if p.depth > 0.0 {
            pairs.push(*p);
        }
    });
    pairs
}

/// Pairs in contact with their kind, whether the law is clipped at zero, and whether IMPACT's damping is full: where this
/// changes, derivatives may jump or bend.
fn pattern(mesh: &Mesh, state: &MeshState) -> Vec<(Flank, Spot, bool, bool)> {
    let mut pairs = Vec::new();
    mesh.loaded(state, |p, force| {
        if p.depth > 0.0 {
            pairs.push((p.flank, p.spot, force.total <= 0.0, mesh.cone * p.depth * PER_FULL_DEPTH >= 1.0));
        }
    });
    pairs
}

fn shifted(state: &MeshState, axis: usize, h: f64, of_rate: bool) -> MeshState {
    let mut s = *state;
    if of_rate {
        s.rate[axis] += h
    } else {
        s.position[axis] += h
    }
    s
}

/// Fourth-order central difference of `f` by position or rate `axis`, and the largest step tried.
fn difference(state: &MeshState, axis: usize, h: f64, of_rate: bool, f: impl Fn(&MeshState) -> f64) -> f64 {
    let at = |k: f64| f(&shifted(state, axis, k * h, of_rate));
    (8.0 * (at(1.0) - at(-1.0)) - (at(2.0) - at(-2.0))) / (12.0 * h)
}

/// Whether the pattern stays the same within two steps and no pair is about to leave: at depth d ≫ h the fourth-order
/// difference of d^e has an error of (h/d)⁴ only.
fn smooth(mesh: &Mesh, state: &MeshState, h: f64, of_rate: bool) -> bool {
    if !of_rate && loaded(mesh, state.position).iter().any(|p| p.depth < 30.0 * h) {
        return false;
    }
    let here = pattern(mesh, state);
    (0..2).all(|axis| [-2.0, 2.0].iter().all(|k| pattern(mesh, &shifted(state, axis, k * h, of_rate)) == here))
}

fn force_is_minus_the_gradient(meshes: &[(Mesh, Pair)], has_pairs: bool) {
    let mut random = Lcg(11);
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

fn jacobian_equals_differences(meshes: &[(Mesh, Pair)]) -> usize {
    let mut random = Lcg(12);
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
    let mut random = Lcg(13);
    let others = OTHERS.into_iter().flat_map(|kind| meshes(kind, UNDAMPED, true));
    for (mesh, pair) in impact_meshes(0.0, true).into_iter().chain(others) {
        for _ in 0..STATES {
            let [[_, a], [b, _]] = mesh.linearise(&random_state(&mut random, &pair)).1.by_position;
            assert!((a - b).abs() <= 1e-14 * a.abs(), "{a} {b}");
        }
    }
}

fn power_plus_heat_is_what_the_energy_loses(meshes: &[(Mesh, Pair)]) {
    let mut random = Lcg(14);
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

#[test]
fn coasting_is_the_mirror_image_of_driving() {
    let mut random = Lcg(15);
    for corner_contact in [true, false] {
        let others = OTHERS.into_iter().flat_map(|kind| meshes(kind, RESTITUTION, corner_contact));
        for (mesh, pair) in impact_meshes(5e4, corner_contact).into_iter().chain(others) {
            for _ in 0..STATES {
                let state = random_state(&mut random, &pair);
                let mirror = MeshState {
                    position: state.position.map(|x| -x),
                    rate: state.rate.map(|x| -x),
                    ..MeshState::default()
                };
                let ((a, da), (b, db)) = (mesh.linearise(&state), mesh.linearise(&mirror));
                assert_eq!(a.force, b.force.map(|f| -f), "{state:?}");
                assert_eq!((a.heat, da.by_position, da.by_rate), (b.heat, db.by_position, db.by_rate), "{state:?}");
                assert_eq!(mesh.energy(&state), mesh.energy(&mirror));
            }
        }
    }
}

#[test]
fn energy_is_the_same_a_base_pitch_further() {
    let mut random = Lcg(16);
    let others = OTHERS.into_iter().flat_map(|kind| meshes(kind, UNDAMPED, true));
    for (mesh, pair) in impact_meshes(0.0, true).into_iter().chain(others) {
        for _ in 0..STATES {
            let [q, x] = random_state(&mut random, &pair).position;
            let (here, next) = (mesh.energy(&at([q, x])), mesh.energy(&at([q, x + pair.base_pitch])));
            assert!((here - next).abs() <= 1e-11 * here, "{q} {x}: {here} {next}");
        }
    }
}

#[test]
fn without_corner_contact_each_pair_on_the_path_bears_the_whole_approach() {
    let mut random = Lcg(17);
    for (mesh, pair) in impact_meshes(0.0, false) {
        for _ in 0..STATES {
            let [q, x] = random_state(&mut random, &pair).position;
            let approach = q.abs() - pair.normal_backlash / 2.0;
            // teeth on the path, counted one by one: s = γ_p sinδ_bp ± x + k p_b
            let start = pair.centred_position() - q.signum() * x;
            let (low, high) = (-mesh.engagement.corner[1].end, mesh.engagement.corner[0].end);
            let count =
                (-20..=20).filter(|&k| (low..=high).contains(&(start + f64::from(k) * pair.base_pitch))).count();
            let Law::Impact(law) = &mesh.law else { panic!("IMPACT was asked for") };
            let expected = count as f64 * law.energy(mesh.cone * approach);
            let energy = mesh.energy(&at([q, x]));
            assert!((energy - expected).abs() <= 1e-12 * expected, "{q} {x}: {energy} {expected}");
            // straight along the path: no force by x
            assert_eq!(
                mesh.force(&MeshState { position: [q, x], rate: [0.0; 2], ..MeshState::default() }).force[1],
                0.0
            );
        }
    }
}
