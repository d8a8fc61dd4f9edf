//! An interval of the integrator's clock: its start, the trajectory in it, and the arrival at a stop. Also completes the
//! pending step, in an interval that ends at the present.

use super::budget::budget;
use super::by_shape::in_shape;
use super::events::next_change;
use super::{Simulation, StepFailure};
use crate::integrate::Trajectory;
use crate::model::assembly::{Gears, Model};
use crate::model::dynamics::ledger_rates::LedgerRates;
use crate::model::dynamics::timeline::LONGEST_INTERVAL;
use crate::model::dynamics::{Clock, State, Stop};
use crate::model::effects::Memories;
use crate::model::scene::Inputs;

/// Longest step of the solver [s].
pub const LONGEST: f64 = LONGEST_INTERVAL;
/// Resolution of a double for times up to the length of an interval [s].
pub const RESOLUTION: f64 = 4.0 * f64::EPSILON * LONGEST_INTERVAL;

/// An interval of the integrator's clock, with all that changes in it.
pub struct Interval<'a> {
    /// Constants.
    pub model: &'a Model,
    /// State at the start, and then at the end.
    pub state: &'a mut State,
    /// Inputs that act.
    pub inputs: &'a Inputs,
    /// Memories of effects, to which completed steps add.
    pub memories: &'a mut Memories,
    /// Clock of the integrator.
    pub clock: &'a mut Clock,
    /// Number of attempts left.
    pub budget: &'a mut u64,
    /// Simulation time at which the clock is zero [s].
    pub begin: f64,
    /// True if the host has already read outputs at the target time. A tooth that bends too far can then no longer be
    /// rejected, and impacts in the rest of the pending step are not counted.
    pub was_read: bool,
    /// True if the motion pauses at an event. The clock's `now` becomes the time of the event, and the pending step
    /// starts there.
    pub pauses: bool,
    /// Time on the clock [s] and change of the accelerations [rad/s²], if only torques have changed within the pending
    /// step.
    pub change: Option<(f64, f64)>,
}

impl Simulation {
    /// Completes the pending step up to the present, under the inputs that acted in it, and switches the friction that
    /// is due there. If its ledger does not close, shorter steps replace it, and the motion changes within the tolerance.
    pub(in crate::model) fn complete_pending(&mut self) {
        let Self { model, state, memories, .. } = self;
        let Some(pending_step) = &state.pending_step else { return };
        let (inputs, mut clock) = (state.inputs.values, pending_step.clock);
        clock.end = clock.now;
        let before = *state;
        state.inputs.derivatives = None;
        let begin = state.time() - clock.now;
        let (clock, budget) = (&mut clock, &mut budget(model));
        let work = Interval {
            model,
            state,
            inputs: &inputs,
            memories,
            clock,
            budget,
            begin,
            was_read: true,
            pauses: false,
            change: None,
        };
        let outcome = in_shape(model, work);
        if outcome.is_err() || clock.time != clock.now {
            // no shorter step closes the ledger either: the motion that the host has seen is kept, and the residual of
            // the ledger shows the missing energy
            *state = before;
            state.pending_step = None;
        }
        state.inputs.derivatives = before.inputs.derivatives;
        wrap_and_constrain(model, state);
    }
}

/// Clock of the pending step, or a new clock that starts now.
pub fn clock(model: &Model, state: &State) -> Clock {
    if let Some(pending_step) = &state.pending_step {
        return pending_step.clock;
    }
    let change = next_change(model, state).unwrap_or(f64::INFINITY);
    Clock::new(change - state.time(), state.timeline.expected())
}

/// Trajectory from the last completed step, or within the pending step if there is one. Always inlined, so that this
/// large value is written in place.
#[inline(always)]
pub fn resumed<const N: usize>(state: &State, clock: &Clock) -> Trajectory<N, LedgerRates> {
    let mut trajectory = Trajectory {
        longest: LONGEST,
        resolution: RESOLUTION,
        expected: clock.expected,
        ..Trajectory::new(state.point(), clock.time, clock.end)
    };
    if let Some(pending_step) = &state.pending_step {
        pending_step.resume(&mut trajectory);
        trajectory.end_at(clock.end);
    }
    trajectory
}

/// Stores the end of the last completed step and, if `is_ok`, the pending step.
pub fn store<const N: usize>(
    state: &mut State,
    clock: &mut Clock,
    trajectory: &Trajectory<N, LedgerRates>,
    is_ok: bool,
) {
    state.set_point(&trajectory.point);
    clock.time = trajectory.time;
    match &trajectory.pending {
        Some(pending) if is_ok => {
            state.pending_step.get_or_insert_default().set((pending, &trajectory.extension), *clock);
        }
        _ => state.pending_step = None,
    }
}

/// Moves the time to the stop, or to `reached` [s] if the motion has not reached the stop. Returns the error in
/// `outcome`, or an error if the stop was not reached.
pub fn arrive(
    state: &mut State,
    stop: Stop,
    reached: f64,
    outcome: Result<(), StepFailure>,
) -> Result<(), StepFailure> {
    state.timeline.pause = None;
    if outcome.is_err() {
        state.timeline.now = reached;
    }
    outcome.and_then(|()| arrive_at(state, stop.time, reached))
}

/// Moves the time to `until` [s], given that the motion has reached `reached` [s]. Fails if both differ by more than
/// rounding; the time is then `reached`.
pub fn arrive_at(state: &mut State, until: f64, reached: f64) -> Result<(), StepFailure> {
    if state.timeline.arrive(until, reached) { Ok(()) } else { Err(StepFailure::not_reached(reached, until)) }
}

/// Wraps positions unless a pending step starts from them. Applies the constraint of ideal gears to their speeds, so
/// that it is exact to the last bit.
pub fn wrap_and_constrain(model: &Model, state: &mut State) {
    if state.pending_step.is_none() {
        state.wrap(&model.periods, &model.body_effects().pairs);
    }
    if let Gears::Ideal(_) = &model.gears {
        model.ideal.constrain(&mut state.v);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn arrival_fails_if_the_motion_has_not_reached_the_time() {
        let mut state = State::at_rest(0.25, 1e-6);
        let failure = arrive_at(&mut state, 1.0, 0.5).unwrap_err();
        assert!(failure.message.contains("t = 1 s"), "{failure}");
        assert_eq!((state.time(), failure.time), (0.5, 0.5));
        // a difference within rounding is accepted
        assert!(arrive_at(&mut state, 1.0, 1.0 - f64::EPSILON).is_ok());
        assert_eq!(state.time(), 1.0);
    }
}
