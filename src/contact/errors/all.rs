//! All tooth errors of a differential: the gap of a pair is their sum.

use super::crowning::Crowning;
use super::misalignment::Misalignment;
use super::pitch::{PitchDeviations, Tolerances};
use super::relief::TipRelief;
use super::runout::Runout;
use super::{ContactNormals, MeshId, PairId, ToothErrorSpec};
use crate::contact::detailed::Opening;
use crate::geometry::Pair;
use crate::numeric::Jet;
use crate::problem::Problem;

/// Deviations and modifications of all teeth of a differential.
#[derive(Clone, Debug)]
pub struct ToothErrors {
    pub(super) planets: usize,
    teeth: [usize; 2],
    per_mean_cone: f64,
    normals: ContactNormals,
    pub(super) pitch: Option<PitchDeviations>,
    pub(super) runout: Option<Runout>,
    relief: Option<TipRelief>,
    crowning: Option<Crowning>,
    misalignment: Option<Misalignment>,
}

impl ToothErrors {
    /// Returns the errors defined by `spec` on the gears of `pair`, for `planets` equally spaced planets. Fails if the
    /// specification is invalid.
    pub fn new(spec: &ToothErrorSpec, pair: &Pair, planets: usize) -> Result<Self, Problem> {
        spec.check()?;
        if planets == 0 {
            return Err(Problem::new("geometry.planet_count", "0 planets; at least one is required"));
        }
        let runout = if spec.runout_by_grade {
            [0, 1].map(|i| Tolerances::of_gear(spec.accuracy_grade, pair, i).runout)
        } else {
            [spec.planet_runout, spec.side_runout]
        };
        let normals = ContactNormals::new(pair);
        Ok(Self {
            planets,
            teeth: pair.gears.map(|g| g.teeth.unsigned_abs().max(1) as usize),
            per_mean_cone: 1.0 / pair.mean_cone,
            normals,
            pitch: PitchDeviations::new(spec.accuracy_grade, spec.seed, pair, planets),
            runout: Runout::new(runout, spec.seed, pair, planets),
            relief: TipRelief::new(spec, pair),
            crowning: Crowning::new(spec, pair),
            misalignment: Misalignment::new(spec, &normals, planets),
        })
    }

    /// Gap e [m] of tooth pair `pair` in `mesh` at cone distance `r` [m] and position `s` [rad] along the path of
    /// contact or past its ends: the sum of all errors.
    pub fn gap(&self, mesh: MeshId, pair: PairId, r: f64, s: f64) -> f64 {
        let (mesh, pair) = self.in_range(mesh, pair);
        self.opening(mesh, pair, s).at(r)
    }

    /// Opening of tooth pair `pair` in `mesh` at position `s` [rad], over the whole face. The indices must be in range.
    #[inline]
    pub fn opening(&self, mesh: MeshId, pair: PairId, s: f64) -> Opening {
        let mut opening = Opening::NONE;
        if let Some(pitch) = &self.pitch {
            opening.turn += pitch.gap(mesh, pair) * self.per_mean_cone;
        }
        if let Some(crowning) = &self.crowning {
            let [even, turn, bend] = crowning.polynomial();
            opening.even = opening.even + even;
            opening.turn += turn;
            opening.bend = bend;
        }
        if let Some(relief) = &self.relief {
            opening.even = opening.even + relief.gap(s);
        }
        if self.misalignment.is_some() || self.runout.is_some() {
            let normal = self.normals.normal(pair.flank, s);
            if let Some(misalignment) = &self.misalignment {
                opening.even = opening.even + misalignment.offset(mesh, &normal);
                opening.turn += misalignment.turn(mesh);
            }
            if let Some(runout) = &self.runout {
                opening.even = opening.even + runout.gap(mesh, pair, Jet::variable(s), &normal);
            }
        }
        opening
    }

    /// Upper bound of a tooth pair's excess material [m] up to the cone distance `outer` [m].
    pub fn max_excess(&self, outer: f64) -> f64 {
        self.pitch.as_ref().map_or(0.0, |pitch| pitch.max_excess() * outer * self.per_mean_cone)
            + self.runout.as_ref().map_or(0.0, Runout::max_excess)
            + self.misalignment.as_ref().map_or(0.0, |misalignment| misalignment.max_excess(outer))
    }

    /// Eccentricity of the teeth of planet (`gear` = 0) or side gear (1) number `index` [m], and its azimuth [rad]. The
    /// azimuth is measured from the centre of tooth 0 in the direction of the tooth count.
    pub fn eccentricity(&self, gear: usize, index: usize) -> [f64; 2] {
        let gear = gear % 2;
        let gears = [self.planets, 2][gear];
        self.runout.as_ref().map_or([0.0; 2], |runout| runout.eccentricity(gear, index % gears))
    }

    /// True if e/R is uniform over the face, like the penetration arc of perfect teeth. All slices are then identical.
    pub fn is_uniform_over_face(&self) -> bool {
        self.runout.is_none()
            && self.relief.is_none()
            && self.crowning.is_none()
            && self.misalignment.as_ref().is_none_or(Misalignment::is_rotation)
    }

    /// True if all teeth of each gear are identical, so that the gaps repeat with every pitch.
    pub fn repeats_every_pitch(&self) -> bool {
        self.pitch.is_none() && self.runout.is_none()
    }

    /// True if planets differ in teeth or position, so that no planet may represent another.
    pub fn is_individual(&self) -> bool {
        self.pitch.is_some()
            || self.runout.is_some()
            || self.misalignment.as_ref().is_some_and(Misalignment::is_individual)
    }

    #[inline]
    fn in_range(&self, mesh: MeshId, pair: PairId) -> (MeshId, PairId) {
        (
            MeshId { planet: mesh.planet % self.planets, side: mesh.side % 2 },
            PairId {
                planet_tooth: pair.planet_tooth % self.teeth[0],
                side_tooth: pair.side_tooth % self.teeth[1],
                flank: pair.flank,
            },
        )
    }
}
