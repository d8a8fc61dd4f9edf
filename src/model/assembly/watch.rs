//! What completed steps are watched for beside the ledger, where a scene asks for it.

use crate::model::effects::strength::GearStrength;

/// What steps are watched for.
#[derive(Clone, Debug)]
pub struct Watch {
    /// Stress and fatigue.
    pub strength: Option<GearStrength>,
    /// Peak-to-peak values over mesh cycles.
    pub mesh_history: bool,
}
