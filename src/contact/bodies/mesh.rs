//! Pairs of teeth of a mesh whose gears have elastic bodies.
//!
//! A symmetric compliance C relates the loads ω_k of the pairs to their arcs p_k: p = C ω. Its diagonal q_k is the
//! compliance of a single pair: teeth, roots and Hertzian contact. Its other entries t_kl are couplings: the load of
//! one pair moves another through both bodies. Neighbouring teeth are one pitch apart. The pair nearer to the planet's
//! tip is behind in the direction of the load on the planet, and ahead in the direction of the load on the side gear.

use nalgebra::{SMatrix, SVector};

use super::{GearBody, RootLoad, Support};
use crate::contact::Flank;
use crate::contact::stiffness::{PairCompliance, SectionPair};
use crate::geometry::Pair;
use crate::numeric::{TAU, sqrt};
use crate::problem::Problem;

/// Number of neighbours with a separate compliance: the tooth itself, the next, and the next but one.
const NEIGHBOURS: usize = 3;
/// Variables that errors about the supports name.
const BORE: [&str; 2] = ["geometry.planet_bore", "geometry.side_bore"];

/// A load on a pair as it acts on the numbered teeth of its gears.
pub(super) struct LoadedTooth {
    /// Left (0) or right (1) side gear.
    pub side: usize,
    /// Flank.
    pub flank: Flank,
    /// Position on the path [rad].
    pub s: f64,
}

impl LoadedTooth {
    /// Returns 1 if the load on gear `i` points to higher tooth numbers, −1 if to lower ones. On the left side, the
    /// drive flank presses the planet toward lower numbers and the side gear toward higher ones.
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
    /// Factors by which teeth bend more than those of a wide face.
    softening: [f64; 2],
    /// Compliances between a tooth and itself, the next tooth and the next but one, toward the planet's tip [1/Pa].
    between: [[[[f64; 3]; 3]; NEIGHBOURS]; 2],
    /// Compliances between a tooth and all teeth of its gear, toward higher numbers [1/Pa].
    around: [Vec<[[f64; 3]; 3]>; 2],
    /// Angular pitches of both gears [rad].
    pitches: [f64; 2],
    /// Number of equally loaded meshes, evenly spaced around each gear. The planet's other mesh does not count, because
    /// its load may differ.
    presses: [u32; 2],
    outer_cone: f64,
    base_pitch: f64,
}

impl MeshOnBodies {
    /// Returns the mesh of `pair` with the tooth sections `teeth` and gears held by `supports`. Each of `planets`
    /// planets presses on the side gear; all are assumed to be loaded like this one.
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
            // the direction toward the planet's tip is against the load on the planet
            let toward = if i == 0 { -1.0 } else { 1.0 };
            std::array::from_fn(|k| mesh.between_teeth(i, toward * k as f64))
        });
        mesh.around = [0, 1].map(|i| (0..mesh.teeth_of(i)).map(|k| mesh.between_teeth(i, k as f64)).collect());
        Ok(mesh)
    }

    /// Compliance between the loads on a tooth of gear `i` and on its counterparts under the other planets (column),
    /// and the displacement of a tooth `pitches` further (row) [1/Pa].
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

    /// Displacement of either of two pairs under a unit load on the other [1/Pa]. Tooth numbers of planet and side gear
    /// differ by `further`, with `a` at the higher numbers. Pairs of different meshes share only the planet.
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

    /// Smallest compliance of a single pair on `path` [rad] without the Hertzian part [1/Pa].
    pub(super) fn least_alone(&self, path: [f64; 2]) -> f64 {
        let alone = |k: u32| {
            let s = path[0] + (path[1] - path[0]) * f64::from(k) / 8.0;
            let rolls = self.teeth.rolls(self.outer_cone * s);
            self.gear(0, rolls[0]) + self.gear(1, rolls[1])
        };
        (0..=8).map(alone).fold(f64::INFINITY, f64::min)
    }

    /// Load at the root of gear `i` under a unit load on the flank at roll length `roll` [m].
    fn root_load(&self, i: usize, roll: f64) -> RootLoad {
        self.bodies[i].root.load(self.teeth.sections[i].load(roll).angle)
    }

    /// Compliance of a tooth of gear `i` with its body, if only this tooth is loaded, at roll length `roll` [m] [1/Pa].
    pub fn gear(&self, i: usize, roll: f64) -> f64 {
        let root = self.root_load(i, roll);
        self.teeth.sections[i].beam_compliance(roll, &self.teeth.elasticity, self.softening[i])
            + GearBody::displacement(&self.between[i][0], &root, &root)
    }

    /// Compliances of a single pair at position `s` [rad] on the path, under the line load per cone distance `load`
    /// [N/m²].
    pub fn alone(&self, s: f64, load: f64) -> PairCompliance {
        let rolls = self.teeth.rolls(self.outer_cone * s);
        let line_load = self.outer_cone * load;
        PairCompliance {
            gear: [0, 1].map(|i| self.gear(i, rolls[i])),
            hertz: self.teeth.hertz_compliance(rolls, line_load),
            half_width: sqrt(self.teeth.half_width_squared(rolls, line_load)),
        }
    }

    /// Coupling of the pair at position `s` [rad] with the pair `further` pitches nearer to the planet's tip [1/Pa]:
    /// displacement of either under a unit load on the other. Zero if `further` is more than two.
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

    /// Stiffness of two pairs that share a rotation [Pa], with and without their coupling. One pair is at `s` [rad],
    /// the other is the next toward the planet's tip. Each is under the line load per cone distance `load` [N/m²].
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

/// Ratio of the bending of a tooth of gear `i` of `pair` to its bending in plane strain. Teeth much wider than high are
/// in plane strain. Toward each end of the face, plane strain changes to plane stress over about half the tooth's
/// height, as in Saint-Venant's principle. A tooth no wider than high is a thin plate.
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
    fn softening_depends_on_the_shape_of_a_tooth_and_not_on_its_size() {
        // heights must be proportional to the module: Gleason's contain a constant in mm
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
