//! Settings before the first step: all parameters, the effects that follow from them, and contradictions between them.

pub mod advice;
pub mod effect_outputs;
mod parameters;
pub mod scene_effects;
pub mod validation;

pub use effect_outputs::{ATTACHED, CONTACT_HEAT, HEATS, STEP_READINGS};
pub use parameters::Parameters;
pub use scene_effects::SceneEffects;
