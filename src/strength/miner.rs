//! Palmgren–Miner: D = Σ n_i/N_f(σ_i), failure expected at D = 1.

use serde::{Deserialize, Serialize};

use super::SnCurve;
use crate::numeric::finite;

/// Damage of one flank or one root, accumulated cycle by cycle.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Damage {
    /// Damage sum D.
    pub sum: f64,
    /// Number of counted cycles. Cycles without damage do not count.
    pub cycles: f64,
}

finite!(Damage { sum, cycles });

impl Damage {
    /// Counts `cycles` (also fractions) at `stress` [Pa]; has no effect without stress or cycles.
    pub fn add(&mut self, curve: &SnCurve, stress: f64, cycles: f64) {
        if stress.is_finite() {
            self.grow(curve.damage_per_cycle(stress), cycles);
        }
    }

    /// Counts `cycles` with the damage `per_cycle` each; has no effect without damage or cycles.
    pub fn grow(&mut self, per_cycle: f64, cycles: f64) {
        if per_cycle > 0.0 && per_cycle.is_finite() && cycles > 0.0 && cycles.is_finite() {
            self.sum += cycles * per_cycle;
            self.cycles += cycles;
        }
    }

    /// Mean damage of a cycle; 0 before the first.
    pub fn per_cycle(&self) -> f64 {
        if self.cycles > 0.0 { self.sum / self.cycles } else { 0.0 }
    }
}
