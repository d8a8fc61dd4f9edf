//! Meshes under IMPACT, random states, and differences that stay clear of switches.

use crate::random::Draws;
use bevel_differential::contact::damping::Damping;
use bevel_differential::contact::mesh::{Mesh, MeshState};
use bevel_differential::contact::pairs::{Flank, Spot, ToothPair};
use bevel_differential::geometry::Pair;
use fastrand::Rng;

use crate::mesh_laws::{Kind, PER_FULL_DEPTH, meshes};

pub const STATES: usize = 4000;

/// Deepest approach tried [rad]: 0.1 mm at R_m.
pub const DEEPEST: f64 = 3e-3;

/// Meshes under IMPACT with `damping`.
pub fn impact_meshes(damping: f64, corner_contact: bool) -> Vec<(Mesh, Pair)> {
    meshes(Kind::Impact, Damping::Step { coefficient: damping, per_full_depth: PER_FULL_DEPTH }, corner_contact)
}

/// Laws besides IMPACT.
pub const OTHERS: [Kind; 4] = [Kind::DampedImpact, Kind::Line, Kind::LineWeber, Kind::Lumped];

pub fn at(position: [f64; 2]) -> MeshState {
    MeshState { position, ..MeshState::default() }
}

pub fn random_state(random: &mut Rng, pair: &Pair) -> MeshState {
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

pub fn loaded(mesh: &Mesh, position: [f64; 2]) -> Vec<ToothPair> {
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
pub fn pattern(mesh: &Mesh, state: &MeshState) -> Vec<(Flank, Spot, bool, bool)> {
    let mut pairs = Vec::new();
    mesh.loaded(state, |p, force| {
        if p.depth > 0.0 {
            pairs.push((p.flank, p.spot, force.total <= 0.0, mesh.cone * p.depth * PER_FULL_DEPTH >= 1.0));
        }
    });
    pairs
}

pub fn shifted(state: &MeshState, axis: usize, h: f64, of_rate: bool) -> MeshState {
    let mut s = *state;
    if of_rate {
        s.rate[axis] += h
    } else {
        s.position[axis] += h
    }
    s
}

/// Fourth-order central difference of `f` by position or rate `axis`, and the largest step tried.
pub fn difference(state: &MeshState, axis: usize, h: f64, of_rate: bool, f: impl Fn(&MeshState) -> f64) -> f64 {
    let at = |k: f64| f(&shifted(state, axis, k * h, of_rate));
    (8.0 * (at(1.0) - at(-1.0)) - (at(2.0) - at(-2.0))) / (12.0 * h)
}

/// Whether the pattern stays the same within two steps and no pair is about to leave: at depth d ≫ h the fourth-order
/// difference of d^e has an error of (h/d)⁴ only.
pub fn smooth(mesh: &Mesh, state: &MeshState, h: f64, of_rate: bool) -> bool {
    if !of_rate && loaded(mesh, state.position).iter().any(|p| p.depth < 30.0 * h) {
        return false;
    }
    let here = pattern(mesh, state);
    (0..2).all(|axis| [-2.0, 2.0].iter().all(|k| pattern(mesh, &shifted(state, axis, k * h, of_rate)) == here))
}
