//! What completed steps add to beside the state, in scenes that are watched for it.

use serde::{Deserialize, Serialize};

use crate::model::effects::mesh_history::MeshHistory;
use crate::model::effects::strength::Fatigue;

/// Damage of the teeth, and values over mesh cycles.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Watched {
    /// Damage of the teeth.
    pub fatigue: Fatigue,
    /// Peak-to-peak values over mesh cycles.
    pub mesh_history: MeshHistory,
}

impl Watched {
    /// Whether a simulation can continue from all numbers.
    pub fn is_valid(&self) -> bool {
        self.mesh_history.is_valid()
    }
}
