//! A tip corner past the end of the path: the loaded points on its own tooth and on the mating tooth.
//!
//! The corner's own tooth is loaded at its tip. The mating tooth is loaded at the corner. The corner's polar angle φ
//! about the mate's axis determines the arc ψ of the flank, cosφ = cosδ_b cosψ. On the path, the roll length on the
//! section is the roll length at the pitch point plus R_e times the arc from the pitch point. A corner uses the same
//! rule, so that both agree at the end of the path.

use super::SectionPair;
use super::beams::{MIN_RANGE, are_beams, boundary};
use crate::geometry::{CornerTravel, Pair};

/// Steps per base pitch, and number of steps, in the search for the end of the corner's travel.
const SEARCH: (f64, i32) = (64.0, 256);

/// The tip corner of gear `own` on the flank of its mate.
#[derive(Clone, Copy, Debug)]
pub struct TipCorner {
    own: usize,
    travel: CornerTravel,
    outer_cone: f64,
    /// Roll length of the corner's own tooth at its tip [m].
    tip_roll: f64,
    /// Roll length [m] and arc [rad] of the mate at the pitch point.
    mate_pitch: (f64, f64),
    /// Roll length of the mate at its tip [m].
    mate_tip: f64,
}

impl TipCorner {
    /// Returns the corner of gear `own` (0 planet, 1 side gear) of `pair`, whose sections are `teeth`.
    pub fn new(pair: &Pair, teeth: &SectionPair, own: usize) -> Self {
        let (travel, mate) = (CornerTravel::new(pair, own), 1 - own);
        let mate_pitch = (teeth.sections[mate].pitch_roll, pair.pitch_arc[mate]);
        Self {
            own,
            travel,
            outer_cone: pair.outer_cone,
            tip_roll: teeth.sections[own].pitch_roll + pair.outer_cone * travel.end,
            mate_pitch,
            mate_tip: mate_pitch.0 + pair.outer_cone * (pair.tip_arc[mate] - mate_pitch.1),
        }
    }

    /// End of the path at this corner, as an arc from the pitch point toward the corner's own tip [rad].
    pub fn end(&self) -> f64 {
        self.travel.end
    }

    /// Arc ψ of the mate's flank at the corner, at Δ = `delta` [rad].
    pub fn mate_arc(&self, delta: f64) -> f64 {
        self.travel.mate_arc(delta)
    }

    /// Roll lengths of both gears [m] at Δ = `delta` [rad].
    pub fn rolls(&self, delta: f64) -> [f64; 2] {
        let mate = self.mate_pitch.0 + self.outer_cone * (self.mate_arc(delta) - self.mate_pitch.1);
        if self.own == 0 { [self.tip_roll, mate] } else { [mate, self.tip_roll] }
    }

    /// Distance past the end of the path up to which the corner is on its mate's flank and both teeth are beams [rad].
    /// It is 0 if it is less than `MIN_RANGE`.
    pub fn length(&self, teeth: &SectionPair, base_pitch: f64) -> f64 {
        let fits = |delta: f64| {
            let rolls = self.rolls(delta);
            rolls[1 - self.own] < self.mate_tip && are_beams(teeth, rolls)
        };
        let step = |j: i32| base_pitch / SEARCH.0 * f64::from(j);
        let last = (1..=SEARCH.1).take_while(|&j| fits(step(j))).last().unwrap_or(0);
        let length = if last == SEARCH.1 { step(last) } else { boundary(step(last), step(last + 1), fits) };
        if length < MIN_RANGE * base_pitch { 0.0 } else { length }
    }
}
