//! What effects do to single teeth: gaps of their pairs, loads that differ over the face, friction along the flanks.

use std::sync::Arc;

use crate::contact::gaps::FlankGaps;
use crate::contact::tooth_friction::ToothFriction;

/// Slices of the face where loads differ over it.
const SLICES: usize = 8;

/// What effects do to single teeth.
#[derive(Clone, Debug, Default)]
pub struct ToothEffects {
    /// Gaps of tooth pairs, while intact and once a tooth is broken.
    pub gaps: [Option<Arc<FlankGaps>>; 2],
    /// Whether planets differ, so that none may stand for another.
    pub individual: bool,
    /// Whether loads differ over the face.
    pub sliced: bool,
}

/// Friction along the flanks.
#[derive(Clone, Copy, Debug)]
pub struct FlankFriction {
    /// The law with its parameters.
    pub law: ToothFriction,
    /// Index of its heat in the ledger.
    pub heat: usize,
}

impl ToothEffects {
    /// Slices wanted over the face.
    pub fn slices(&self) -> usize {
        if self.sliced { SLICES } else { 1 }
    }

    /// Sets the cone distances at which gaps are evaluated [m].
    pub fn set_cones(&mut self, cones: &[f64]) {
        for gaps in self.gaps.iter_mut().flatten() {
            Arc::make_mut(gaps).cones = cones.to_vec();
        }
    }
}
