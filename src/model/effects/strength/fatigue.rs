//! Damage of the teeth of a running differential.

use serde::{Deserialize, Serialize};

use super::overload::Overloads;
use crate::model::scene::layout::MAX_GROUPS;
use crate::strength::{Damage, Rainflow, ToothDamage};

/// Damage of the teeth so far.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Fatigue {
    /// Planets, by group.
    pub planets: [ToothDamage; MAX_GROUPS],
    /// Side gears.
    pub sides: [ToothDamage; 2],
    /// Force on the teeth that stand in mesh on each side.
    pub standing: [Rainflow; 2],
    /// Damage to the roots of planet and side gear from it, by side.
    pub stood: [[Damage; 2]; 2],
    /// Stresses that exceeded their strength.
    pub overloads: Overloads,
}

impl Fatigue {
    /// Sets the readings of damage.
    pub fn read(&self, readings: &mut [f64]) {
        let worst = |gears: &[ToothDamage], of: fn(&ToothDamage) -> f64| gears.iter().map(of).fold(0.0, f64::max);
        let stood = |i: usize| self.stood[0][i].sum.max(self.stood[1][i].sum);
        let damage = [
            worst(&self.planets, ToothDamage::worst_root) + stood(0),
            worst(&self.sides, ToothDamage::worst_root) + stood(1),
            worst(&self.planets, ToothDamage::worst_pitting),
            worst(&self.sides, ToothDamage::worst_pitting),
        ];
        readings[STRESSES..].copy_from_slice(&damage);
    }
}

/// Readings of stress, which stand before those of damage.
pub const STRESSES: usize = 4;
