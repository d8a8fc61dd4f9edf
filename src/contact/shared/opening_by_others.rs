//! Openings of pairs by the loads of other pairs, used to predict kinks of the force.

use super::couplings::MAX_PAIRS;
use crate::contact::Flank;

/// Arcs by which other pairs move a pair apart [rad].
#[derive(Clone, Copy, Debug, Default)]
pub struct OpeningByOthers {
    /// Side gear, flank, number and arc [rad] of each pair.
    pairs: [Option<(usize, Flank, i64, f64)>; MAX_PAIRS],
    count: usize,
}

impl OpeningByOthers {
    /// Distance from contact within which pairs count, relative to the deepest approach of flanks.
    pub const LOOKOUT: f64 = 0.5;

    /// Adds the arc `by` [rad] of pair `number` of `flank` in the mesh with side gear `side`.
    pub fn add(&mut self, side: usize, flank: Flank, number: i64, by: f64) {
        if let Some(slot) = self.pairs.get_mut(self.count) {
            *slot = Some((side, flank, number, by));
            self.count += 1;
        }
    }

    /// Arc of pair `number` of `flank` on side `side` [rad]; 0 if the pair is far from touching.
    pub fn of(&self, side: usize, flank: Flank, number: i64) -> f64 {
        let same = |&&(s, f, n, _): &&(usize, Flank, i64, f64)| (s, f, n) == (side, flank, number);
        self.pairs.iter().flatten().find(same).map_or(0.0, |&(.., by)| by)
    }
}
