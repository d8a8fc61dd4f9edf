//! Damage of a gear's teeth while it rolls, per flank, accumulated during a simulation.

use serde::{Deserialize, Serialize};

use super::{Damage, Rolling};
use crate::numeric::finite;

/// Damage by load on one flank.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct FlankDamage {
    /// Damage of the root by bending.
    pub root: Damage,
    /// Damage of the flank by pitting.
    pub pitting: Damage,
}

/// Damage that one passage through a mesh causes to each tooth of a gear.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Cycle {
    /// Loaded flank, 0 or 1, numbered by [`super::loaded_flank`].
    pub flank: usize,
    /// Damage of the root by bending.
    pub root: f64,
    /// Damage of the flank by pitting.
    pub pitting: f64,
}

/// Damage of a gear's teeth, which are all assumed to be equally damaged. The type is `Copy` and allocates nothing.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct ToothDamage {
    /// Rolling that determines which passages count.
    pub rolling: Rolling,
    /// Both flanks.
    pub flanks: [FlankDamage; 2],
}

finite! {
    FlankDamage { root, pitting }
    ToothDamage { rolling, flanks }
}

impl ToothDamage {
    /// Counts an interval in which the gear turned by `angle` [rad] relative to the carrier. Its teeth are `pitch`
    /// [rad] apart. `cycles` contains the mean damage of a passage for each mesh of the gear. Every tooth passes each
    /// mesh once per revolution.
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

    /// Damage sum of the more damaged root [1].
    pub fn worst_root(&self) -> f64 {
        self.flanks[0].root.sum.max(self.flanks[1].root.sum)
    }

    /// Damage sum of the more damaged flank [1].
    pub fn worst_pitting(&self) -> f64 {
        self.flanks[0].pitting.sum.max(self.flanks[1].pitting.sum)
    }
}
