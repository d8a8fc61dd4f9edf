//! Inputs that act in a simulation, as opposed to those that a host has set for its next step.

use serde::{Deserialize, Serialize};

use crate::model::scene::{InputDerivatives, Inputs};
use crate::numeric::finite;

/// Inputs that act in the pending step, or have acted up to the present.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct ActingInputs {
    /// Values, at the present if they have derivatives.
    pub values: Inputs,
    /// Derivatives, if the host has set them.
    pub derivatives: Option<InputDerivatives>,
}

finite!(ActingInputs { values, derivatives });
