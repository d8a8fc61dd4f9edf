//! What effects do to single teeth: gaps of their pairs, loads that differ over the face, friction along the flanks.

use std::sync::Arc;

use crate::contact::{FlankGaps, ToothFriction};

/// What effects do to single teeth.
#[derive(Clone, Debug, Default)]
pub struct ToothEffects {
    /// Gaps of tooth pairs, while intact and once a tooth is broken.
    pub gaps: [Option<Arc<FlankGaps>>; 2],
    /// Whether planets differ, so that none may stand for another.
    pub individual: bool,
    /// Whether loads differ over the face.
    pub sliced: bool,
    /// Whether the bodies of the gears are elastic.
    pub on_bodies: bool,
}

/// Friction along the flanks.
#[derive(Clone, Copy, Debug)]
pub struct FlankFriction {
    /// The law with its parameters.
    pub law: ToothFriction,
    /// Index of its heat in the ledger.
    pub heat_index: usize,
}
