//! Means of the shaft torques, from which the torque bias is read.

use serde::{Deserialize, Serialize};

/// Time integrals of the shaft torques, kept mesh cycle by mesh cycle.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Bias {
    /// ∫T dt of left and right since the mesh cycle began [N·m·s].
    pub sum: [f64; 2],
    /// How long that is [s].
    pub time: f64,
    /// Cycles rolled since it began, backward negative.
    pub rolled: f64,
    /// Means over the last whole mesh cycle [N·m], and how long it took [s].
    pub last: Option<([f64; 2], f64)>,
    /// Time since that cycle ended [s].
    pub since: f64,
}

impl Bias {
    /// Means over the last whole mesh cycle [N·m], unless rolling has nearly stopped since.
    pub fn mean(&self) -> Option<[f64; 2]> {
        self.last.filter(|(_, took)| self.since <= 2.0 * took).map(|(mean, _)| mean)
    }
}
