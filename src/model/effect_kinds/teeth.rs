//! Influence of effects on single teeth: gaps of their pairs, loads that differ over the face, friction along the
//! flanks.

use std::sync::Arc;

use crate::contact::{FlankGaps, ToothFriction};

/// Influence of effects on single teeth.
#[derive(Clone, Debug, Default)]
pub struct ToothEffects {
    /// Gaps of tooth pairs: with intact teeth, and after a tooth has broken.
    pub gaps: [Option<Arc<FlankGaps>>; 2],
    /// True if planets differ, so each of them must be simulated.
    pub individual: bool,
    /// True if loads differ over the face.
    pub distributed: bool,
    /// True if the gear bodies are elastic.
    pub elastic_bodies: bool,
}

/// Friction along the flanks.
#[derive(Clone, Copy, Debug)]
pub struct FlankFriction {
    /// The law with its parameters.
    pub law: ToothFriction,
    /// Index of its heat in the ledger.
    pub heat_index: usize,
}
