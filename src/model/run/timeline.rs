//! Times at which something happens. Only this module computes these times and checks that the simulation has reached
//! them:
//!
//! - the time requested by the host,
//! - a change of the equations that the host does not cause: the onset of the tooth fault,
//! - the end of a long interval, at which the integrator's clock is reset,
//! - the expected next change of the inputs, after they have been constant for as long as before.
//!
//! A stop is the earliest of the first three. Steps are only fitted to the expected change; they may go beyond it. The
//! call fails if the integrator's clock does not reach the stop.

use super::StepFailure;
use super::integration::LONGEST_INTERVAL;
use crate::model::assembly::Model;
use crate::model::dynamics::event::{AdvanceOptions, Pause};
use crate::model::dynamics::{Clock, State};
use crate::model::scene::Inputs;

/// Relative allowance for rounding in the time for which inputs are expected to be constant. Hosts add up their steps.
const ROUNDING: f64 = 1e-6;
/// Number of rounded operations on times between two stops.
const ROUNDED_OPERATIONS: f64 = 8.0;

/// Stop of an integration.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Stop {
    /// Time of the stop [s].
    pub time: f64,
    /// True if the equations change at the stop.
    pub is_change: bool,
}

/// Smallest distinguishable difference of times near `time` [s].
fn resolution(time: f64) -> f64 {
    ROUNDED_OPERATIONS * f64::EPSILON * time.abs().max(LONGEST_INTERVAL)
}

/// Time of the next change of the equations that the host does not cause [s]: the onset of the tooth fault, if it is
/// still to come.
pub fn next_change(model: &Model, state: &State) -> Option<f64> {
    let onset = onset(model).filter(|_| may_break_tooth(model) && !state.is_tooth_broken);
    onset.filter(|&onset| !has_come(onset, state))
}

/// True if a tooth of the scene may break.
pub fn may_break_tooth(model: &Model) -> bool {
    model.parameters.effects.tooth_fault
}

/// Time at which a tooth breaks by itself [s], if it does.
fn onset(model: &Model) -> Option<f64> {
    model.parameters.specs.tooth_fault.time()
}

/// True if a tooth breaks now, because its time has come or the fault input triggers it.
pub fn breaks_tooth(model: &Model, inputs: &Inputs, state: &State) -> bool {
    let has_come = || onset(model).is_some_and(|onset| has_come(onset, state));
    may_break_tooth(model) && !state.is_tooth_broken && (inputs.fault > 0.5 || has_come())
}

/// True if `time` [s] has been reached, within the rounding of times.
fn has_come(time: f64, state: &State) -> bool {
    state.time() + resolution(time) >= time
}

/// First stop up to `until` [s].
pub fn next_stop(model: &Model, state: &State, until: f64) -> Stop {
    let time = if until - state.time() > 1.5 * LONGEST_INTERVAL { state.time() + LONGEST_INTERVAL } else { until };
    match next_change(model, state) {
        // a communication point that differs from the change only by rounding counts as the change
        Some(change) if (change - time).abs() <= resolution(change) => Stop { time, is_change: true },
        Some(change) if change < time => Stop { time: change, is_change: true },
        _ => Stop { time, is_change: false },
    }
}

/// Moves the state to `until` [s] if the pending step contains this time and the equations change only later. Returns
/// true if the state moved.
#[inline]
pub fn move_within(model: &Model, state: &mut State, (until, options): (f64, AdvanceOptions)) -> bool {
    // the pause refers to the state before the move
    let pause = if options.is_part {
        state.pending_step.as_ref().map(|step| {
            let [now, time] = last_communication_point(state, &step.clock);
            Pause { now, time, inputs: step.inputs }
        })
    } else {
        None
    };
    let moves = next_change(model, state).is_none_or(|change| until + resolution(change) < change)
        && state.move_within(until, model.layout.count());
    if moves {
        state.pause = pause;
    }
    moves
}

/// Starts an interval of constant inputs at the present, because inputs or something else have changed. A further
/// change at the same time, such as a reaction to an event, does not start another interval.
pub fn begin_constant_inputs(state: &mut State) {
    if state.constant_since == Some(state.time()) {
        return;
    }
    state.constant_before = state.constant_since.map_or(f64::INFINITY, |since| state.time() - since);
    state.constant_since = Some(state.time());
}

/// Clock of the pending step, or a new clock that starts now.
pub fn clock(model: &Model, state: &State) -> Clock {
    if let Some(pending_step) = &state.pending_step {
        return pending_step.clock;
    }
    let change = next_change(model, state).unwrap_or(f64::INFINITY);
    Clock::new(change - state.time(), expected(state))
}

/// Remaining time for which inputs are expected to be constant [s].
pub fn expected(state: &State) -> f64 {
    let left = state.constant_before - state.constant_since.map_or(0.0, |since| state.time() - since);
    left * (1.0 + ROUNDING)
}

/// Last communication point, or the present if the motion has not paused since: time on the integrator's clock, and
/// simulation time [s].
pub fn last_communication_point(state: &State, clock: &Clock) -> [f64; 2] {
    state.pause.map_or([clock.now, state.time()], |pause| [pause.now, pause.time])
}

/// Moves the time to `until` [s], given that the integrator's clock is at `reached` [s]. Fails if both differ by more
/// than rounding; the time is then `reached`.
pub fn arrive(state: &mut State, until: f64, reached: f64) -> Result<(), StepFailure> {
    if (until - reached).abs() <= resolution(until) {
        state.move_with_clock(until);
        return Ok(());
    }
    state.move_with_clock(reached);
    Err(StepFailure::not_reached(reached, until))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn arrival_fails_if_the_motion_has_not_reached_the_time() {
        let mut state = State::at_rest(0.25, 1e-6);
        let failure = arrive(&mut state, 1.0, 0.5).unwrap_err();
        assert!(failure.message.contains("t = 1 s"), "{failure}");
        assert_eq!((state.time(), failure.time), (0.5, 0.5));
        // a difference within rounding is accepted
        assert!(arrive(&mut state, 1.0, 1.0 - f64::EPSILON).is_ok());
        assert_eq!(state.time(), 1.0);
    }
}
