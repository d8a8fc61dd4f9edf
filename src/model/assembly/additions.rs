//! What acts in a scene besides plain teeth: meshes in detail, forces on bodies, dry friction.

use std::sync::Arc;

use super::BodyEffects;
use crate::contact::FlankGaps;
use crate::contact::detailed::Detailed;

/// What acts in a scene besides plain teeth.
#[derive(Clone, Debug)]
pub struct Additions {
    /// The mesh in detail.
    pub detailed: Detailed,
    /// Whether an effect needs it while all teeth are sound.
    pub in_detail: bool,
    /// Index of the heat of friction along the flanks.
    pub friction_heat: usize,
    /// Gaps of the tooth pairs, while intact and once a tooth is broken.
    pub gaps: [Option<Arc<FlankGaps>>; 2],
    /// Teeth without errors, for their numbers.
    pub perfect: FlankGaps,
    /// Mass of a planet times its distance from the carrier's axis [kg·m].
    pub planet_moment: f64,
    /// Effects on bodies.
    pub bodies: BodyEffects,
}
