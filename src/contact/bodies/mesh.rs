//! Pairs of teeth of a mesh whose gears have elastic bodies.
//!
//! Loads ω_k of the pairs and their arcs p_k belong to each other by a symmetric compliance, p = C ω: q_k of each pair alone,
//! teeth, roots and Hertz, and t_kl by which the load of one pair moves another, through both bodies. Teeth of neighbours
//! stand a pitch apart; the pair nearer to the planet's tip stands against the load on the planet, and with it on the side gear.

use nalgebra::{SMatrix, SVector};

use super::{GearBody, RootLoad, Support};
use crate::contact::Flank;
use crate::contact::stiffness::{PairCompliance, SectionPair};
use crate::geometry::Pair;
use crate::numeric::{TAU, sqrt};
use crate::problem::Problem;

/// Neighbours that are told apart: a pair, the next, the next but one.
const NEIGHBOURS: usize = 3;
/// What problems with the supports name.
const BORE: [&str; 2] = ["geometry.planet_bore", "geometry.side_bore"];

/// A load on a pair as it acts on the numbered teeth of its gears.
pub(super) struct LoadedTooth {
    /// Left (0) or right (1) side gear.
    pub side: usize,
    /// Flank.
    pub flank: Flank,
    /// Place on the path [rad].
    pub s: f64,
}

impl LoadedTooth {
    /// Whether the load on gear `i` points to higher numbers of teeth, or to lower ones. The planet is pressed toward lower
    /// numbers by the drive flank on the left, the side gear toward higher ones.
    fn sign(&self, i: usize) -> f64 {
        let forward = if self.flank == Flank::Drive { 1.0 } else { -1.0 };
        if i == 0 && self.side == 0 { -forward } else { forward }
    }
}

/// A mesh on elastic bodies.
#[derive(Clone, Debug)]
pub struct MeshOnBodies {
    /// Sections of the teeth.
    pub teeth: SectionPair,
    /// The gears' bodies: planet, side gear.
    pub bodies: [GearBody; 2],
    /// By how much teeth give way more than those of a wide face.
    softening: [f64; 2],
    /// Between a tooth and itself, the next tooth and the next but one, toward the planet's tip [1/Pa].
    between: [[[[f64; 3]; 3]; NEIGHBOURS]; 2],
    /// Between a tooth and all others of its gear, toward higher numbers.
    around: [Vec<[[f64; 3]; 3]>; 2],
    /// Angles between neighbouring teeth [rad].
    pitches: [f64; 2],
    /// Meshes of each gear that press alike, evenly around it: the planet's other mesh does not.
    presses: [u32; 2],
    outer_cone: f64,
    base_pitch: f64,
}

impl MeshOnBodies {
    /// The mesh of `pair` with the sections `teeth`, its gears held by `supports`. Each of `planets` planets presses on the
    /// side gear; all are taken to carry what this one does.
    pub fn new(pair: &Pair, teeth: &SectionPair, supports: [Support; 2], planets: u32) -> Result<Self, Problem> {
        let softening = [0, 1].map(|i| softening(pair, i, teeth.elasticity.poisson));
        let body = |i: usize| {
            let section = (&teeth.sections[i], &teeth.elasticity);
            GearBody::new(pair, i, section, supports[i], BORE[i])
        };
        let bodies = [body(0)?, body(1)?];
        let (outer_cone, base_pitch) = (pair.outer_cone, pair.base_pitch);
        let pitches = pair.gears.map(|gear| TAU / f64::from(gear.teeth));
        let presses = [1, planets.max(1)];
        let nothing = [[[[0.0; 3]; 3]; NEIGHBOURS]; 2];
        let mut mesh = Self {
            teeth: teeth.clone(),
            bodies,
            softening,
            between: nothing,
            around: [Vec::new(), Vec::new()],
            pitches,
            presses,
            outer_cone,
            base_pitch,
        };
        mesh.between = [0, 1].map(|i| {
            // toward the planet's tip is against the load on the planet
            let toward = if i == 0 { -1.0 } else { 1.0 };
            std::array::from_fn(|k| mesh.between_teeth(i, toward * k as f64))
        });
        mesh.around = [0, 1].map(|i| (0..mesh.teeth_of(i)).map(|k| mesh.between_teeth(i, k as f64)).collect());
        Ok(mesh)
    }

    /// Compliance between the loads on a tooth of gear `i` and on those that stand for it under the other planets (column) and
    /// the displacement of a tooth `pitches` further (row) [1/Pa].
    pub fn between_teeth(&self, i: usize, pitches: f64) -> [[f64; 3]; 3] {
        let mut sum = [[0.0; 3]; 3];
        for planet in 0..self.presses[i] {
            let around = TAU * f64::from(planet) / f64::from(self.presses[i]);
            let between = self.bodies[i].compliance_between(pitches * self.pitches[i] + around);
            for (to, from) in sum.as_flattened_mut().iter_mut().zip(between.as_flattened()) {
                *to += from;
            }
        }
        sum
    }

    /// Number of teeth of gear `i`.
    pub(super) fn teeth_of(&self, i: usize) -> usize {
        (TAU / self.pitches[i] + 0.5) as usize
    }

    /// By how much loads on two pairs move each other whose teeth of planet and side gear stand `further` teeth apart, the first
    /// at higher numbers [1/Pa]; pairs of different meshes share the planet alone.
    pub(super) fn coupling_of(&self, further: [i64; 2], a: &LoadedTooth, b: &LoadedTooth) -> f64 {
        let shared = if a.side == b.side { 2 } else { 1 };
        (0..shared)
            .map(|i| {
                let [measured, acting] = [a, b].map(|tooth| {
                    let roll = self.teeth.rolls(self.outer_cone * tooth.s)[i];
                    let ([across, along, moment], sign) = (self.root_load(i, roll), tooth.sign(i));
                    [sign * across, along, sign * moment]
                });
                let count = self.teeth_of(i) as i64;
                GearBody::displacement(&self.around[i][further[i].rem_euclid(count) as usize], &measured, &acting)
            })
            .sum()
    }

    /// Least compliance of a pair alone on `path` [rad], Hertz's part aside [1/Pa].
    pub(super) fn least_alone(&self, path: [f64; 2]) -> f64 {
        let alone = |k: u32| {
            let s = path[0] + (path[1] - path[0]) * f64::from(k) / 8.0;
            let rolls = self.teeth.rolls(self.outer_cone * s);
            self.gear(0, rolls[0]) + self.gear(1, rolls[1])
        };
        (0..=8).map(alone).fold(f64::INFINITY, f64::min)
    }

    /// Load at the root of gear `i` of a unit load at roll length `roll` [m].
    fn root_load(&self, i: usize, roll: f64) -> RootLoad {
        self.bodies[i].root.load(self.teeth.sections[i].load(roll).angle)
    }

    /// Compliance of a tooth of gear `i` and of its body under a load on it alone at roll length `roll` [m] [1/Pa].
    pub fn gear(&self, i: usize, roll: f64) -> f64 {
        let root = self.root_load(i, roll);
        self.teeth.sections[i].beam_compliance(roll, &self.teeth.elasticity, self.softening[i])
            + GearBody::displacement(&self.between[i][0], &root, &root)
    }

    /// Compliances of a pair alone at place `s` [rad] on the path under a line load per cone distance of `load` [N/m²].
    pub fn alone(&self, s: f64, load: f64) -> PairCompliance {
        let rolls = self.teeth.rolls(self.outer_cone * s);
        let line_load = self.outer_cone * load;
        PairCompliance {
            gear: [0, 1].map(|i| self.gear(i, rolls[i])),
            local: self.teeth.local(rolls, line_load),
            half_width: sqrt(self.teeth.half_width_squared(rolls, line_load)),
        }
    }

    /// By how much a load on the pair at place `s` [rad] moves the pair that stands `further` pitches nearer to the planet's
    /// tip, and the other way round [1/Pa]; 0 if more than two.
    pub fn coupling(&self, s: f64, further: usize) -> f64 {
        let [here, there] = [s, s + further as f64 * self.base_pitch].map(|s| self.teeth.rolls(self.outer_cone * s));
        [0, 1]
            .into_iter()
            .filter(|_| further < NEIGHBOURS)
            .map(|i| {
                GearBody::displacement(
                    &self.between[i][further],
                    &self.root_load(i, there[i]),
                    &self.root_load(i, here[i]),
                )
            })
            .sum()
    }

    /// Stiffness of two pairs that share a rotation, at `s` [rad] and the next toward the planet's tip, each under the line
    /// load per cone distance `load` [N/m²]; with and without what couples them [Pa].
    pub fn two_pairs(&self, s: f64, load: f64) -> [f64; 2] {
        let alone = [s, s + self.base_pitch].map(|s| self.alone(s, load).total());
        let coupling = self.coupling(s, 1);
        let together = |t: f64| {
            let matrix = SMatrix::<f64, 2, 2>::new(alone[0], t, t, alone[1]);
            matrix.try_inverse().map_or(f64::NAN, |inverse| (inverse * SVector::<f64, 2>::repeat(1.0)).sum())
        };
        [together(coupling), together(0.0)]
    }
}

/// By how much bending of a tooth of gear `i` of `pair` exceeds that in plane strain. Teeth much wider than high are in plane
/// strain; toward each end of the face it turns into plane stress over about half the tooth's height, as in Saint-Venant's
/// principle. A tooth no wider than high is a thin plate.
fn softening(pair: &Pair, i: usize, poisson: f64) -> f64 {
    // the tooth's height shrinks toward the apex
    let height = (pair.gears[i].addendum + pair.gears[i].dedendum) * pair.mean_cone / pair.outer_cone;
    let ends = (height / (pair.outer_cone - pair.inner_cone)).min(1.0);
    let square = poisson * poisson;
    1.0 + square / (1.0 - square) * ends
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geometry::{AddendumSystem, GearSpec};

    #[test]
    fn softening_hangs_on_the_shape_of_a_tooth_and_not_on_its_size() {
        // heights in modules alone: Gleason's have a constant in mm
        let spec = GearSpec { addendum_system: AddendumSystem::Standard, ..GearSpec::default() };
        let larger = GearSpec {
            module: 10.0 * spec.module,
            face_width: 10.0 * spec.face_width,
            backlash: 10.0 * spec.backlash,
            ..spec
        };
        let [small, large] = [spec, larger].map(|spec| [0, 1].map(|i| softening(&Pair::new(&spec), i, 0.3)));
        assert!((0..2).all(|i| (small[i] - large[i]).abs() < 1e-12), "{small:?} {large:?}");
        // a tooth no wider than high is a thin plate, a wide one nearly in plane strain
        let of_width = |width: f64| softening(&Pair::new(&GearSpec { face_width: width, ..spec }), 0, 0.3);
        assert!((of_width(3e-3) - 1.0 / (1.0 - 0.09)).abs() < 1e-12);
        assert!(of_width(14e-3) < of_width(10e-3) && of_width(10e-3) < of_width(3e-3));
    }
}
