//! Damage of a gear's teeth while it rolls, per flank, accumulated during a simulation.

use serde::{Deserialize, Serialize};

use super::counting::Rolling;
use super::material::SnCurve;
use super::miner::Damage;

/// Damage by load on one flank.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct FlankDamage {
    /// Of the root, by bending.
    pub root: Damage,
    /// Of the flank, by pitting.
    pub pitting: Damage,
}

/// Load of one mesh on a gear.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Load {
    /// Flank that carries, 0 or 1: [`super::loaded_flank`].
    pub flank: usize,
    /// Root stress [Pa].
    pub root: f64,
    /// Contact pressure [Pa].
    pub pressure: f64,
}

/// Damage of the teeth of a gear, all teeth taken as alike: `Copy`, no allocation.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct ToothDamage {
    /// Rolling that decides what counts.
    pub rolling: Rolling,
    /// Both flanks.
    pub flanks: [FlankDamage; 2],
}

impl ToothDamage {
    /// Counts an accepted step in which the gear turned by `angle` [rad] relative to the carrier under the `loads` of
    /// its meshes: each passes every tooth once per revolution.
    pub fn add(
        &mut self,
        (bending, pitting): (&SnCurve, &SnCurve),
        angle: f64,
        pitch: f64,
        loads: impl IntoIterator<Item = Load>,
    ) {
        let cycles = self.rolling.advance(angle, pitch);
        if cycles > 0.0 {
            for load in loads {
                let flank = &mut self.flanks[load.flank & 1];
                flank.root.add(bending, load.root, cycles);
                flank.pitting.add(pitting, load.pressure, cycles);
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
