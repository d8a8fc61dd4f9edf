//! Motion without the solver: within the pending step, and of ideal gears without effects.

use super::events::next_change;
use super::interval::{arrive_at, wrap_and_constrain};
use super::moving_inputs::advance_inputs;
use super::{Simulation, StepFailure};
use crate::model::dynamics::timeline::resolution;

impl Simulation {
    /// Moves to `until` [s] within the pending step. Returns false if this step does not contain `until`, or if the
    /// equations change before.
    #[inline(always)]
    pub(super) fn move_within_pending(&mut self, until: f64, is_part: bool) -> bool {
        let Self { model, state, .. } = self;
        if state.pending_step.is_none() {
            return false;
        }
        let is_before_change = next_change(model, state).is_none_or(|change| until + resolution(change) < change);
        let moves = is_before_change && state.move_within(until, is_part, model.layout.count());
        if moves {
            wrap_and_constrain(model, state);
        }
        moves
    }

    /// Moves ideal gears without effects to `until` [s], in closed form.
    pub(super) fn advance_in_closed_form(&mut self, until: f64) -> Result<(), StepFailure> {
        let Self { model, state, inputs, .. } = self;
        let h = until - state.time();
        let (q, v, work) = (state.q, state.v, state.sums.work);
        match &state.inputs.derivatives {
            None => model.ideal.advance(state, inputs, h),
            Some(derivatives) => {
                let motions = model.ideal.motion_by_order(inputs, derivatives);
                model.ideal.advance_along(state, &motions, h);
            }
        }
        if !state.is_motion_finite() {
            (state.q, state.v, state.sums.work) = (q, v, work);
            return Err(StepFailure::not_finite(state.time()));
        }
        if state.inputs.derivatives.is_some() {
            advance_inputs(model, inputs, state, h);
            // exact to the last bit, because the next step would treat any difference as a discontinuity
            model.ideal.impose(state, inputs);
        }
        state.timeline.pause = None;
        arrive_at(state, until, state.time() + h)?;
        state.statistics.accepted += 1;
        state.control.last = h;
        state.wrap(&model.periods, &model.body_effects().pairs);
        Ok(())
    }
}
