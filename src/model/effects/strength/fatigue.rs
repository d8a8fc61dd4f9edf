//! Damage of the teeth of a running differential.

use serde::{Deserialize, Serialize};

use super::overload::Overloads;
use super::utilisation::Utilisation;
use crate::model::scene::layout::MAX_GROUPS;
use crate::strength::{Rating, StandingTeeth, ToothDamage};

/// Damage of the teeth so far.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Fatigue {
    /// Planets, by group.
    pub planets: [ToothDamage; MAX_GROUPS],
    /// Side gears.
    pub sides: [ToothDamage; 2],
    /// Teeth that stand in mesh on each side.
    pub standing: [StandingTeeth; 2],
    /// Stresses that exceeded their strength.
    pub overloads: Overloads,
    /// Largest stresses by their strengths.
    pub utilisation: Utilisation,
}

impl Fatigue {
    /// Damage sums: roots of the worst planet and side gear, then their flanks.
    pub fn sums(&self, rating: &Rating) -> [f64; 4] {
        let worst = |gears: &[ToothDamage], of: fn(&ToothDamage) -> f64| gears.iter().map(of).fold(0.0, f64::max);
        let [left, right] = self.standing.map(|teeth| teeth.worst(rating));
        [
            worst(&self.planets, ToothDamage::worst_root) + left[0].max(right[0]),
            worst(&self.sides, ToothDamage::worst_root) + left[1].max(right[1]),
            worst(&self.planets, ToothDamage::worst_pitting),
            worst(&self.sides, ToothDamage::worst_pitting),
        ]
    }
}
