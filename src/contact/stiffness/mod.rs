//! Stiffness of a tooth pair from the geometry of its teeth and the elastic constants E and ν.
//!
//! `section` and `profile` describe the tooth, `compliance` loads it, `table` stores the result along the path of contact,
//! `laws` make springs of it. Per unit of face width; slices are similar, so one section holds for all cone distances.

mod compliance;
mod laws;
mod profile;
mod quadrature;
mod section;
mod table;

use std::sync::Arc;

pub use compliance::{Elasticity, PairCompliance, SectionPair};
pub use laws::{Line, LineWeber};
pub use profile::{Piece, ProfilePoint, Span};
pub use section::{FlankLoad, RootSpec, SectionSpec, ToothSection};

use crate::geometry::Pair;
use crate::geometry::corner::CLIP_MARGIN;
use crate::numeric::FRAC_PI_2;
use crate::problem::Problem;
use table::ComplianceTable;

/// Limits of the beam model. Least thickness of a tooth along the load [modules].
const LEAST_DEPTH: f64 = 0.05;
/// Largest angle of the load to the chord [rad].
const STEEPEST: f64 = FRAC_PI_2 * 2.0 / 3.0;
/// Largest distance below the root section at which the load crosses the tooth's middle [root chords].
const BELOW_ROOT: f64 = 0.25;
/// Steps of the search for the part of the path where both teeth are beams.
const SEARCH: usize = 128;
/// Least length of that part [base pitches].
const LEAST_RANGE: f64 = 0.02;
/// Past the ends the stiffness becomes constant within this many base pitches.
const TAIL: f64 = 0.1;
/// Half the width of contact over the depth to the teeth's middles at the limit of Hertz's logarithm.
const DEEPEST: f64 = 0.5;
/// Intervals of Simpson's rule for the mean along the path.
const MEAN_INTERVALS: usize = 1024;

/// Stiffness of the tooth pairs of a gear pair along the path of contact.
#[derive(Clone, Debug)]
pub struct PairStiffness {
    /// Tredgold sections at the outer cone distance: planet, side gear.
    pub teeth: SectionPair,
    /// Places between which both teeth are beams [rad]; beyond, stiffness levels out.
    pub range: [f64; 2],
    /// Reference line load per cone distance ω = w/R [N/m²].
    pub reference: f64,
    /// Line load per cone distance ω₀ up to which Hertz's logarithm holds [N/m²].
    pub limit: f64,
    /// Compliance Q at ω₀ [1/Pa].
    table: Arc<ComplianceTable>,
    /// R_e [m], p_b [rad], ends of the path [rad].
    outer_cone: f64,
    base_pitch: f64,
    path: [f64; 2],
}

impl PairStiffness {
    /// Stiffness of `pair` with roots of shape `root`, modulus `young` [Pa] and Poisson's ratio `poisson`; the linear
    /// law takes Hertz's part at `line_load` [N/m] at the mean cone distance.
    pub fn new(pair: &Pair, root: &RootSpec, young: f64, poisson: f64, line_load: f64) -> Result<Self, Problem> {
        if !(young > 0.0 && young.is_finite()) {
            return Err(Problem::new("material.young_modulus", format!("{young:e} Pa is not a positive number")));
        }
        if !(0.0..0.5).contains(&poisson) {
            return Err(Problem::new("material.poisson_ratio", format!("{poisson} is not within 0 and 0.5")));
        }
        if !(line_load > 0.0 && line_load.is_finite()) {
            return Err(Problem::new("contact.reference_line_load", format!("{line_load:e} N/m is not positive")));
        }
        if !(root.fillet > 0.0 && root.fillet.is_finite()) {
            return Err(Problem::new("geometry.root_fillet", format!("{} modules is not positive", root.fillet)));
        }
        let section = |i: usize| SectionSpec::of_gear(pair, i).with_fillet(root.fillet * pair.module, DEDENDUM[i]);
        let elasticity = Elasticity { young, poisson };
        let teeth = SectionPair { sections: [section(0)?, section(1)?], elasticity };
        let margin = CLIP_MARGIN * pair.base_pitch;
        let path = [pair.path.low.max(margin - pair.pitch_arc[0]), pair.path.high.min(pair.pitch_arc[1] - margin)];
        let outer_cone = pair.outer_cone;
        let range = beams(&teeth, path, outer_cone, pair.base_pitch)?;
        let limit = (0..=SEARCH)
            .map(|j| between(range, j) * outer_cone)
            .map(|place| limit_line_load(&teeth, place) / outer_cone)
            .fold(f64::INFINITY, f64::min);
        let table = ComplianceTable::new(range[0], range[1], TAIL * pair.base_pitch, |s| {
            teeth.at(outer_cone * s, limit * outer_cone).total()
        });
        let reference = line_load / pair.mean_cone;
        Ok(Self {
            teeth,
            range,
            reference,
            limit,
            table: Arc::new(table),
            outer_cone,
            base_pitch: pair.base_pitch,
            path,
        })
    }

    /// Compliances and width of contact by the formulas at place `s` [rad] within the range, for a line load per cone
    /// distance of `load` [N/m²]: at the outer cone distance. At R, b is R/R_e of it, the compliances are the same.
    pub fn exact(&self, s: f64, load: f64) -> PairCompliance {
        self.teeth.at(self.outer_cone * s, self.outer_cone * load)
    }

    /// The linear law.
    pub fn line(&self) -> Line {
        let local = self.teeth.elasticity.local();
        // above the limit the compliance of `LineWeber`'s tangent
        let (ratio, shift) = (self.limit / self.reference, libm::log(self.limit / self.reference));
        Line { table: self.table.clone(), shift: local * if ratio >= 1.0 { shift } else { ratio - 1.0 } }
    }

    /// The law with Hertz's part following the load.
    pub fn line_weber(&self) -> LineWeber {
        LineWeber::new(self.table.clone(), self.teeth.elasticity.local(), self.limit)
    }

    /// Stiffness c of one tooth pair per unit of width [Pa] under the reference load at place `s` [rad], any number.
    pub fn at(&self, s: f64) -> f64 {
        1.0 / self.line().compliance(s)
    }

    /// Mean stiffness of the mesh per unit of width c_γ = 1/p_b ∫c ds along the path [Pa] under the reference load, each
    /// tooth pair carrying it.
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

const DEDENDUM: [&str; 2] = ["geometry.planet_dedendum", "geometry.side_dedendum"];
const ADDENDUM: [&str; 2] = ["geometry.planet_addendum", "geometry.side_addendum"];

/// Step `j` of the search on `range`.
fn between(range: [f64; 2], j: usize) -> f64 {
    range[0] + (range[1] - range[0]) * j as f64 / SEARCH as f64
}

/// Line load [N/m] at the outer section at which b is `DEEPEST` of √(t₁t₂).
fn limit_line_load(teeth: &SectionPair, place: f64) -> f64 {
    let rolls = teeth.rolls(place);
    let depth = |i: usize| teeth.sections[i].load(rolls[i]).depth;
    DEEPEST * DEEPEST * depth(0) * depth(1) / teeth.half_width_squared(rolls, 1.0)
}

/// The parameter to change if a tooth is not a beam at `place` [m].
fn unfit(teeth: &SectionPair, place: f64) -> Option<&'static str> {
    let rolls = teeth.rolls(place);
    for (i, tooth) in teeth.sections.iter().enumerate() {
        let load = tooth.load(rolls[i]);
        if rolls[i] <= 0.0 {
            return Some(ADDENDUM[1 - i]);
        }
        if load.depth < LEAST_DEPTH * tooth.module || load.angle.abs() > STEEPEST {
            return Some(ADDENDUM[i]);
        }
        if load.lever < -BELOW_ROOT * tooth.root_chord {
            return Some(DEDENDUM[i]);
        }
    }
    None
}

/// The longest part of `path` on which both teeth are beams.
fn beams(teeth: &SectionPair, path: [f64; 2], outer_cone: f64, base_pitch: f64) -> Result<[f64; 2], Problem> {
    let fits = |s: f64| unfit(teeth, s * outer_cone).is_none();
    // where it changes between a place that fits and one that does not
    let edge = |mut inside: f64, mut outside: f64| {
        for _ in 0..50 {
            let half = 0.5 * (inside + outside);
            if fits(half) { inside = half } else { outside = half }
        }
        inside
    };
    let mut best = [0.0, 0.0];
    let mut j = 0;
    while j <= SEARCH {
        if !fits(between(path, j)) {
            j += 1;
            continue;
        }
        let first = j;
        while j < SEARCH && fits(between(path, j + 1)) {
            j += 1;
        }
        let low = if first == 0 { path[0] } else { edge(between(path, first), between(path, first - 1)) };
        let high = if j == SEARCH { path[1] } else { edge(between(path, j), between(path, j + 1)) };
        if high - low > best[1] - best[0] {
            best = [low, high];
        }
        j += 1;
    }
    if best[1] - best[0] < LEAST_RANGE * base_pitch {
        let middle = between(path, SEARCH / 2) * outer_cone;
        return Err(Problem::new(
            unfit(teeth, middle).unwrap_or(ADDENDUM[0]),
            format!(
                "only {:.3} base pitches of the path load both teeth as beams: they are pointed, or touch at their roots",
                (best[1] - best[0]) / base_pitch
            ),
        ));
    }
    Ok(best)
}
