//! How much of their strength roots and flanks have been asked for, and the safety factors that follow.

use serde::{Deserialize, Serialize};

/// Largest safety factor that is given: that of teeth without load.
pub const MOST: f64 = 1e3;

/// Largest stress over strength so far; 0 before any.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Utilisation {
    /// Of all roots.
    pub root: f64,
    /// Of all flanks.
    pub flank: f64,
}

impl Utilisation {
    /// Safety factors of roots and flanks: strength over the largest stress so far.
    pub fn safety(&self) -> [f64; 2] {
        [self.root, self.flank].map(|largest| 1.0 / largest.max(1.0 / MOST))
    }
}
