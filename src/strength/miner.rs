//! Palmgren–Miner: D = Σ n_i/N_f(σ_i), failure expected at D = 1.

use serde::{Deserialize, Serialize};

use super::material::SnCurve;

/// Damage of one flank or one root, grown cycle by cycle.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Damage {
    /// Damage sum D.
    pub sum: f64,
    /// Cycles counted, loaded ones only.
    pub cycles: f64,
    /// Largest stress that did any [Pa].
    pub peak: f64,
}

impl Damage {
    /// Counts `cycles` (parts of a cycle too) at `stress` [Pa]; nothing without stress or cycles.
    pub fn add(&mut self, curve: &SnCurve, stress: f64, cycles: f64) {
        if stress > 0.0 && stress.is_finite() && cycles > 0.0 && cycles.is_finite() {
            self.sum += cycles * curve.damage_per_cycle(stress);
            self.cycles += cycles;
            self.peak = self.peak.max(stress);
        }
    }
}
