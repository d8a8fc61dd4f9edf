//! By how much the loads of others move pairs: what opens them when kinks of the force are predicted.

use super::couplings::MOST_PAIRS;
use crate::contact::Flank;

/// Arcs by which pairs are moved apart by others [rad].
#[derive(Clone, Copy, Debug, Default)]
pub struct OpeningByOthers {
    pairs: [Option<(usize, Flank, i64, f64)>; MOST_PAIRS],
    count: usize,
}

impl OpeningByOthers {
    /// How far before they touch pairs count, over the deepest approach of flanks.
    pub const LOOKOUT: f64 = 0.5;

    /// Adds a pair of `flank` with its number in the mesh with side gear `side`.
    pub fn add(&mut self, side: usize, flank: Flank, number: i64, by: f64) {
        if let Some(place) = self.pairs.get_mut(self.count) {
            *place = Some((side, flank, number, by));
            self.count += 1;
        }
    }

    /// The arc of such a pair [rad]; 0 of one that is far from touching.
    pub fn of(&self, side: usize, flank: Flank, number: i64) -> f64 {
        let same = |&&(s, f, n, _): &&(usize, Flank, i64, f64)| (s, f, n) == (side, flank, number);
        self.pairs.iter().flatten().find(same).map_or(0.0, |&(.., by)| by)
    }
}
