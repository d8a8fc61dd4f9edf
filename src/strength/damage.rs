//! Damage of a gear's teeth while it rolls, per flank, accumulated during a simulation.

use serde::{Deserialize, Serialize};

use super::{Damage, Rolling};
use crate::numeric::finite;

/// Damage by load on one flank.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct FlankDamage {
    /// Of the root, by bending.
    pub root: Damage,
    /// Of the flank, by pitting.
    pub pitting: Damage,
}

/// What one mesh does to a gear in a cycle.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Cycle {
    /// Flank that carries, 0 or 1: [`super::loaded_flank`].
    pub flank: usize,
    /// Damage to the root.
    pub root: f64,
    /// Damage to the flank.
    pub pitting: f64,
}

/// Damage of the teeth of a gear, all teeth taken as alike: `Copy`, no allocation.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct ToothDamage {
    /// Rolling that decides what counts.
    pub rolling: Rolling,
    /// Both flanks.
    pub flanks: [FlankDamage; 2],
}

finite! {
    FlankDamage { root, pitting }
    ToothDamage { rolling, flanks }
}

impl ToothDamage {
    /// Counts an interval in which the gear turned by `angle` [rad] relative to the carrier, while each of its meshes did as
    /// much as `cycles` say on the mean: each passes every tooth once per revolution.
    pub fn add(&mut self, angle: f64, pitch: f64, cycles: impl IntoIterator<Item = Cycle>) {
        let turns = self.rolling.advance(angle, pitch);
        if turns > 0.0 {
            for cycle in cycles {
                let flank = &mut self.flanks[cycle.flank & 1];
                flank.root.grow(cycle.root, turns);
                flank.pitting.grow(cycle.pitting, turns);
            }
        }
    }

    /// Damage sum of the worse root [1].
    pub fn worst_root(&self) -> f64 {
        self.flanks[0].root.sum.max(self.flanks[1].root.sum)
    }

    /// Damage sum of the worse flank [1].
    pub fn worst_pitting(&self) -> f64 {
        self.flanks[0].pitting.sum.max(self.flanks[1].pitting.sum)
    }
}
