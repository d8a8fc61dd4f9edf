//! Stiffness of a tooth pair from the geometry of its teeth and the elastic constants E and ν.
//!
//! `section` and `profile` describe the tooth, and `bending` integrates over it. `compliance` loads the tooth on the
//! path, and past its ends at a tip `corner`, within the range in which both teeth are `beams`. `table` and `past_end`
//! store the result, and `laws` turns it into springs. All values are per unit of face width. Slices are similar, so
//! one section is valid for all cone distances.

mod beams;
mod bending;
mod compliance;
mod corner;
mod laws;
mod past_end;
mod profile;
mod section;
mod spline;
mod table;

use std::sync::Arc;

pub use compliance::{Elasticity, PairCompliance, SectionPair};
pub use laws::{Line, LineWeber};
pub use profile::{Piece, ProfilePoint, Span};
pub use section::{FlankLoad, RootSpec, SectionSpec, ToothSection};

use crate::geometry::Pair;
use crate::problem::Problem;
use beams::DEDENDUM;
use corner::TipCorner;
use past_end::{CornerRange, PastEnd};
use table::ComplianceTable;

/// Distance within which the stiffness becomes constant if neither the path nor a corner on its mate's flank can be
/// loaded [base pitches].
const LEVEL: f64 = 0.1;
/// Distance past the end of the path over which the slope of the compliance changes to that of a corner [base pitches].
/// It is a third of the contact half-width under load, over which the contact patch runs onto the edge.
const TURN: f64 = 4e-3;
/// Ratio of the contact half-width to the depth to the teeth's middles at the limit of Hertz's logarithm.
const DEEPEST: f64 = 0.5;
/// Number of intervals of Simpson's rule for the mean along the path.
const MEAN_INTERVALS: usize = 1024;

/// Stiffness of the tooth pairs of a gear pair along the path of contact.
#[derive(Clone, Debug)]
pub struct PairStiffness {
    /// Tredgold sections at the outer cone distance: planet, side gear.
    pub teeth: SectionPair,
    /// Positions on the path between which both teeth are beams [rad].
    pub range: [f64; 2],
    /// Distances past both path ends within which the tip-corner stiffness applies [rad]. Beyond them it levels off.
    pub corner_range: [f64; 2],
    /// Reference line load per cone distance ω = w/R [N/m²].
    pub reference: f64,
    /// Line load per cone distance ω₀ up to which Hertz's logarithm is valid [N/m²].
    pub limit: f64,
    /// Compliance Q at ω₀ [1/Pa].
    table: Arc<ComplianceTable>,
    /// Ends of the path [rad].
    pub path: [f64; 2],
    /// R_e [m].
    outer_cone: f64,
    /// p_b [rad].
    base_pitch: f64,
    /// Corner at the lower end (of the side gear) and at the upper end (of the planet).
    corners: [TipCorner; 2],
}

impl PairStiffness {
    /// Computes the stiffness of `pair` with roots of shape `root`, Young's modulus `young` [Pa] and Poisson's ratio
    /// `poisson`. The linear law uses the Hertz part at `line_load` [N/m] at the mean cone distance. Fails if a value
    /// is invalid or the teeth are not beams.
    pub fn new(pair: &Pair, root: &RootSpec, young: f64, poisson: f64, line_load: f64) -> Result<Self, Problem> {
        let teeth = Self::teeth(pair, root, Elasticity { young, poisson })?;
        Self::of_gears(pair, &teeth, line_load, |i, roll| teeth.sections[i].compliance(roll, &teeth.elasticity))
    }

    /// Sections of the teeth of `pair` with roots of shape `root`.
    pub fn teeth(pair: &Pair, root: &RootSpec, elasticity: Elasticity) -> Result<SectionPair, Problem> {
        let Elasticity { young, poisson } = elasticity;
        if !(young > 0.0 && young.is_finite()) {
            return Err(problem!("material.young_modulus", "{young:e} Pa is not a positive number"));
        }
        if !(0.0..0.5).contains(&poisson) {
            return Err(problem!("material.poisson_ratio", "{poisson} is not at least 0 and less than 0.5"));
        }
        if !(root.fillet > 0.0 && root.fillet.is_finite()) {
            return Err(problem!("geometry.root_fillet", "{} modules is not positive", root.fillet));
        }
        let section = |i: usize| SectionSpec::of_gear(pair, i).with_fillet(root.fillet * pair.module, DEDENDUM[i]);
        Ok(SectionPair { sections: [section(0)?, section(1)?], elasticity })
    }

    /// Computes the stiffness of `pair` with the sections `teeth`. `gear` returns the compliance [1/Pa] of gear 0 or 1
    /// without the Hertz part, at a roll length [m].
    pub fn of_gears(
        pair: &Pair,
        teeth: &SectionPair,
        line_load: f64,
        gear: impl Fn(usize, f64) -> f64,
    ) -> Result<Self, Problem> {
        if !(line_load > 0.0 && line_load.is_finite()) {
            return Err(problem!("contact.reference_line_load", "{line_load:e} N/m is not positive"));
        }
        let teeth = teeth.clone();
        let corners = [TipCorner::new(pair, &teeth, 1), TipCorner::new(pair, &teeth, 0)];
        let path = [-corners[0].end(), corners[1].end()];
        let (outer_cone, base_pitch) = (pair.outer_cone, pair.base_pitch);
        let range = beams::beams(&teeth, path, outer_cone, base_pitch)?;
        // a corner whose tooth is not a beam at the end of the path is not used past it
        let corner_range =
            [0, 1].map(|i| if range[i] == path[i] { corners[i].length(&teeth, base_pitch) } else { 0.0 });
        let limit = beams::positions(range)
            .map(|s| limit_line_load(&teeth, s * outer_cone) / outer_cone)
            .fold(f64::INFINITY, f64::min);
        let on_path = |s: f64| {
            let rolls = teeth.rolls(outer_cone * s);
            gear(0, rolls[0]) + gear(1, rolls[1]) + teeth.hertz_compliance(rolls, limit * outer_cone)
        };
        let table = ComplianceTable::new(range[0], range[1], on_path, |i, end| {
            if corner_range[i] == 0.0 {
                return PastEnd::levelling_off(end, LEVEL * base_pitch);
            }
            let (corner, own) = (&corners[i], 1 - i);
            let arc = corner.mate_arc(0.0);
            let part = CornerRange { turn: TURN * base_pitch, length: corner_range[i], mate_arc_squared: arc * arc };
            // the corner's own tooth is always loaded at its tip
            let tip = gear(own, corner.rolls(0.0)[own]);
            PastEnd::along_corner(&part, end, LEVEL * base_pitch, |delta| {
                let rolls = corner.rolls(delta);
                tip + gear(1 - own, rolls[1 - own]) + teeth.hertz_compliance(rolls, limit * outer_cone)
            })
        });
        let reference = line_load / pair.mean_cone;
        Ok(Self {
            teeth,
            range,
            corner_range,
            reference,
            limit,
            table: Arc::new(table),
            outer_cone,
            base_pitch,
            path,
            corners,
        })
    }

    /// Compliances and contact width by Weber's formulas at position `s` [rad], on the path or at the corners past its
    /// ends, under the line load per cone distance `load` [N/m²]. Values are at the outer cone distance. At R, b is
    /// smaller by the factor R/R_e, and the compliances are the same.
    pub fn exact(&self, s: f64, load: f64) -> PairCompliance {
        let rolls = if s < self.path[0] {
            self.corners[0].rolls(self.path[0] - s)
        } else if s > self.path[1] {
            self.corners[1].rolls(s - self.path[1])
        } else {
            self.teeth.rolls(self.outer_cone * s)
        };
        self.teeth.at_rolls(rolls, self.outer_cone * load)
    }

    /// Returns the linear law.
    pub fn line(&self) -> Line {
        let local = self.teeth.elasticity.hertz_factor();
        // above the limit, use the compliance of `LineWeber`'s tangent
        let (ratio, shift) = (self.limit / self.reference, libm::log(self.limit / self.reference));
        Line { table: self.table.clone(), shift: local * if ratio >= 1.0 { shift } else { ratio - 1.0 } }
    }

    /// Returns the law whose Hertz part depends on the load.
    pub fn line_weber(&self) -> LineWeber {
        LineWeber::new(self.table.clone(), self.teeth.elasticity.hertz_factor(), self.limit)
    }

    /// Stiffness c of one tooth pair per unit of width [Pa] under the reference load at any position `s` [rad].
    pub fn at(&self, s: f64) -> f64 {
        1.0 / self.line().compliance(s)
    }

    /// Mean stiffness of the mesh per unit of width c_γ = 1/p_b ∫c ds along the path [Pa], with the reference load on
    /// each tooth pair.
    pub fn mesh_mean(&self) -> f64 {
        let line = self.line();
        let length = self.path[1] - self.path[0];
        let mut sum = 0.0;
        for j in 0..=MEAN_INTERVALS {
            let weight = if j == 0 || j == MEAN_INTERVALS { 1.0 } else { 2.0 + 2.0 * (j % 2) as f64 };
            let s = self.path[0] + length * j as f64 / MEAN_INTERVALS as f64;
            sum += weight / line.compliance(s);
        }
        sum * length / (3.0 * MEAN_INTERVALS as f64 * self.base_pitch)
    }
}

/// Line load [N/m] at the outer section for which b is `DEEPEST` times √(t₁t₂).
fn limit_line_load(teeth: &SectionPair, s: f64) -> f64 {
    let rolls = teeth.rolls(s);
    let depth = |i: usize| teeth.sections[i].load(rolls[i]).depth;
    DEEPEST * DEEPEST * depth(0) * depth(1) / teeth.half_width_squared(rolls, 1.0)
}
