//! Palmgren–Miner: D = Σ n_i/N_f(σ_i), failure expected at D = 1; and the constant load that does the same.

use serde::{Deserialize, Serialize};

use super::material::SnCurve;
use crate::numeric::pow;

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

    /// Both together.
    pub fn plus(&self, other: &Self) -> Self {
        Self { sum: self.sum + other.sum, cycles: self.cycles + other.cycles, peak: self.peak.max(other.peak) }
    }

    /// Constant stress [Pa] that does the same damage in the same cycles; 0 without cycles.
    pub fn equivalent_stress(&self, curve: &SnCurve) -> f64 {
        if self.cycles > 0.0 { curve.stress_of_damage(self.sum / self.cycles) } else { 0.0 }
    }
}

/// One line of a load table.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Bin {
    /// Torque [N·m].
    pub torque: f64,
    /// Load cycles of a tooth at this torque.
    pub cycles: f64,
}

impl Bin {
    /// Torque [N·m] over `revolutions` of the gear relative to the carrier, in mesh with `mates` gears.
    pub fn of_revolutions(torque: f64, revolutions: f64, mates: u32) -> Self {
        Self { torque, cycles: revolutions.abs() * f64::from(mates) }
    }
}

/// Damage of a load table at `stress_per_torque` [Pa/(N·m)].
pub fn damage_of_table(curve: &SnCurve, stress_per_torque: f64, table: &[Bin]) -> Damage {
    let mut damage = Damage::default();
    for bin in table {
        damage.add(curve, stress_per_torque * bin.torque, bin.cycles);
    }
    damage
}

/// Constant torque [N·m] that does the damage of the table in as many cycles: (Σ n T^k / Σ n)^(1/k); 0 without cycles.
pub fn equivalent_torque(slope: f64, table: &[Bin]) -> f64 {
    let loaded = |b: &&Bin| b.torque > 0.0 && b.torque.is_finite() && b.cycles > 0.0 && b.cycles.is_finite();
    let largest = table.iter().filter(loaded).map(|b| b.torque).fold(0.0, f64::max);
    let (mut weighted, mut cycles) = (0.0, 0.0);
    for bin in table.iter().filter(loaded) {
        // relative to the largest, so that no power overflows
        weighted += bin.cycles * pow(bin.torque / largest, slope);
        cycles += bin.cycles;
    }
    if cycles > 0.0 { largest * pow(weighted / cycles, 1.0 / slope) } else { 0.0 }
}
