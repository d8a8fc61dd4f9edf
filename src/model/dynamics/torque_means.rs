//! Means of the shaft torques over a mesh cycle, from which the torque bias follows.

use serde::{Deserialize, Serialize};

use crate::numeric::finite;

/// Time integrals of the shaft torques over the present mesh cycle, and their means over the last whole one.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct TorqueMeans {
    /// ∫T dt of left and right since the mesh cycle began [N·m·s].
    pub sum: [f64; 2],
    /// Time since the mesh cycle began [s].
    pub elapsed: f64,
    /// Part of a mesh cycle rolled since then, backward negative.
    pub cycles: f64,
    /// Means over the last whole mesh cycle [N·m], and its duration [s].
    pub last: Option<([f64; 2], f64)>,
    /// Time since the last whole cycle ended [s].
    pub since: f64,
}

finite!(TorqueMeans { sum, elapsed, cycles, last, since });

impl TorqueMeans {
    /// Means over the last whole mesh cycle [N·m], unless rolling has nearly stopped since.
    pub fn mean(&self) -> Option<[f64; 2]> {
        self.last.filter(|(_, took)| self.since <= 2.0 * took).map(|(mean, _)| mean)
    }
}
