//! Changes of torques without a new beginning.
//!
//! Torques add to the accelerations, so where nothing else changes, one evaluation ends the step before the change and begins the next
//! one. The step ahead is completed up to the change, with the torques that acted in it, and the integration goes on.

use super::imposed::jump_of_accelerations;
use super::timeline;
use crate::model::assembly::Model;
use crate::model::dynamics::{Clock, State};
use crate::model::scene::Inputs;

/// Whether the step ahead can be completed by the next one, which `inputs` change: accelerations jump by so much [rad/s²].
pub fn jump_within(model: &Model, inputs: &Inputs, state: &State) -> Option<f64> {
    let pending_step = state.pending_step.as_ref().filter(|step| step.inputs != *inputs)?;
    let effects = model.body_effects();
    let begins_anew = state.input_derivatives.is_some() || effects.may_rub_in(state) || effects.scale_carrier_inputs();
    if begins_anew { None } else { jump_of_accelerations(model, &pending_step.inputs, inputs) }
}

/// Takes a change at the present up; returns the present on the `clock` [s].
pub fn take_up(state: &mut State, clock: &mut Clock) -> f64 {
    state.pause = None;
    timeline::begin_holding(state);
    clock.expected = clock.now + timeline::expected(state);
    clock.now
}
