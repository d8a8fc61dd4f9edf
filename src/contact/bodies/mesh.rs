//! Pairs of teeth of a mesh whose gears have elastic bodies.
//!
//! Loads ω_k of the pairs and their arcs p_k belong to each other by a symmetric compliance, p = C ω: q_k of each pair alone,
//! teeth, roots and Hertz, and t_kl by which the load of one pair moves another, through both bodies. Teeth of neighbours
//! stand a pitch apart; the pair nearer to the planet's tip stands against the load on the planet, and with it on the side gear.

use nalgebra::{SMatrix, SVector};

use super::body::GearBody;
use super::root::RootLoad;
use super::support::Support;
use crate::contact::stiffness::{PairCompliance, SectionPair};
use crate::geometry::Pair;
use crate::numeric::{TAU, sqrt};
use crate::problem::Problem;

/// Neighbours that are told apart: a pair, the next, the next but one.
const NEIGHBOURS: usize = 3;
/// What problems with the supports name.
const BORE: [&str; 2] = ["geometry.planet_bore", "geometry.side_bore"];

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
    outer_cone: f64,
    base_pitch: f64,
}

impl MeshOnBodies {
    /// The mesh of `pair` with the sections `teeth`, its gears held by `supports`.
    pub fn new(pair: &Pair, teeth: &SectionPair, supports: [Support; 2]) -> Result<Self, Problem> {
        let softening = [0, 1].map(|i| softening(pair, i, teeth.elasticity.poisson));
        let body = |i: usize| {
            let section = (&teeth.sections[i], &teeth.elasticity);
            GearBody::new(pair, i, section, supports[i], BORE[i])
        };
        let bodies = [body(0)?, body(1)?];
        let between = [0, 1].map(|i| {
            // toward the planet's tip is against the load on the planet
            let pitch = if i == 0 { -TAU } else { TAU } / f64::from(pair.gears[i].teeth);
            std::array::from_fn(|k| bodies[i].between(k as f64 * pitch))
        });
        let (outer_cone, base_pitch) = (pair.outer_cone, pair.base_pitch);
        Ok(Self { teeth: teeth.clone(), bodies, softening, between, outer_cone, base_pitch })
    }

    /// Load at the root of gear `i` of a unit load on the path at `s` [rad].
    fn root_load(&self, i: usize, s: f64) -> RootLoad {
        let roll = self.teeth.rolls(self.outer_cone * s)[i];
        self.bodies[i].root.load(self.teeth.sections[i].load(roll).angle)
    }

    /// Compliances of a pair alone at place `s` [rad] on the path under a line load per cone distance of `load` [N/m²].
    pub fn alone(&self, s: f64, load: f64) -> PairCompliance {
        let rolls = self.teeth.rolls(self.outer_cone * s);
        let line_load = self.outer_cone * load;
        let gear = [0, 1].map(|i| {
            let root = self.root_load(i, s);
            self.teeth.sections[i].beam_compliance(rolls[i], &self.teeth.elasticity, self.softening[i])
                + GearBody::moved(&self.between[i][0], &root, &root)
        });
        PairCompliance {
            gear,
            local: self.teeth.local(rolls, line_load),
            half_width: sqrt(self.teeth.half_width_squared(rolls, line_load)),
        }
    }

    /// By how much a load on the pair at place `s` [rad] moves the pair that stands `further` pitches nearer to the planet's
    /// tip, and the other way round [1/Pa]; 0 if more than two.
    pub fn coupling(&self, s: f64, further: usize) -> f64 {
        let other = s + further as f64 * self.base_pitch;
        [0, 1]
            .into_iter()
            .filter(|_| further < NEIGHBOURS)
            .map(|i| GearBody::moved(&self.between[i][further], &self.root_load(i, other), &self.root_load(i, s)))
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
