//! Utilisation of the strength of roots and flanks, and the safety factors that follow.

use serde::{Deserialize, Serialize};

use super::overload::{Overload, Stressed};
use crate::numeric::finite;

/// Largest safety factor that is reported; teeth without load have it.
pub const MOST: f64 = 1e3;

/// Largest ratio of stress to strength so far.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct LargestRatio {
    /// Stress over strength; 0 before the first stress.
    pub share: f64,
    /// Time at which it occurred [s].
    pub time: f64,
}

/// Largest ratios of stress to strength of roots and flanks.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Utilisation {
    /// Largest ratio of all roots.
    pub root: LargestRatio,
    /// Largest ratio of all flanks.
    pub flank: LargestRatio,
}

finite! {
    LargestRatio { share, time }
    Utilisation { root, flank }
}

impl LargestRatio {
    /// Safety factor: strength over stress.
    pub fn safety(&self) -> f64 {
        safety(self.share)
    }
}

impl Utilisation {
    /// Records the ratio of stress to strength in `load` if it is the largest so far.
    pub fn watch(&mut self, what: Stressed, load: &Overload) {
        let largest = if what == Stressed::Flanks { &mut self.flank } else { &mut self.root };
        let share = load.stress / load.strength;
        if share > largest.share {
            *largest = LargestRatio { share, time: load.time };
        }
    }
}

/// Safety factor of a ratio of stress to strength.
pub fn safety(share: f64) -> f64 {
    1.0 / share.max(1.0 / MOST)
}
