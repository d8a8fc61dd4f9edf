//! Inputs that act in a simulation, as opposed to those that a host has set for its next step.

use serde::{Deserialize, Serialize};

use super::Actuated;
use crate::model::scene::{InputDerivatives, Inputs};
use crate::numeric::finite;

/// Values of the inputs that act in the pending step, or have acted up to the present, and the derivatives for the next
/// step.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct ActingInputs {
    /// Values. If they have derivatives, these are the values at the present.
    pub values: Inputs,
    /// Derivatives from the present on, if the host has set them.
    pub derivatives: Option<InputDerivatives>,
    /// States of the actuators that commands pass, if the scene has any.
    pub actuated: Option<Actuated>,
}

finite!(ActingInputs { values, derivatives, actuated });
