//! Utilisation of the strength of roots and flanks, and the safety factors that follow.

use serde::{Deserialize, Serialize};

use super::overload::{Overload, Stressed};
use crate::numeric::finite;

/// Largest safety factor that is reported; teeth without load have it.
pub const MOST: f64 = 1e3;

/// Largest ratio of stress to strength so far.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Largest {
    /// Stress over strength; 0 before the first stress.
    pub share: f64,
    /// Time at which it occurred [s].
    pub time: f64,
}

/// Largest ratios of stress to strength of roots and flanks.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Utilisation {
    /// Largest ratio of all roots.
    pub root: Largest,
    /// Largest ratio of all flanks.
    pub flank: Largest,
}

finite! {
    Largest { share, time }
    Utilisation { root, flank }
}

impl Largest {
    /// Safety factor: strength over stress.
    pub fn safety(&self) -> f64 {
        1.0 / self.share.max(1.0 / MOST)
    }
}

impl Utilisation {
    /// Takes a stress into account.
    pub fn watch(&mut self, what: Stressed, load: &Overload) {
        let largest = if what == Stressed::Flanks { &mut self.flank } else { &mut self.root };
        let share = load.stress / load.strength;
        if share > largest.share {
            *largest = Largest { share, time: load.time };
        }
    }

    /// Safety factors of roots and flanks: strength over the largest stress so far.
    pub fn safety(&self) -> [f64; 2] {
        [self.root.safety(), self.flank.safety()]
    }
}
