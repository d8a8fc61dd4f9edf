//! Times at which something happens. No other place knows them, and every motion in time passes through here.
//!
//! The equations change by themselves where a tooth breaks. Inputs are expected to change when they have held as long as
//! before. Long intervals end so that the integrator's clock is set back. The host asks for a time. A stop is the first of
//! these times. The expected change is no stop: steps are only fitted to it. The time moves as far as the integrator's
//! clock, or the call fails.

use super::StepFailure;
use super::integration::LONGEST_INTERVAL;
use crate::model::assembly::Model;
use crate::model::dynamics::event::{Pause, Way};
use crate::model::dynamics::{Clock, State};
use crate::model::scene::Inputs;

/// Relative allowance for rounding in the time that inputs are expected to hold: hosts add up steps.
const ROUNDING: f64 = 1e-6;
/// Rounded operations on times between one stop and the next.
const ROUNDED_OPERATIONS: f64 = 8.0;

/// Where an integration is to stop.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Stop {
    /// Its time [s].
    pub time: f64,
    /// Whether the equations change there.
    pub is_change: bool,
}

/// Least difference by which times near `time` can be told apart [s].
fn resolution(time: f64) -> f64 {
    ROUNDED_OPERATIONS * f64::EPSILON * time.abs().max(LONGEST_INTERVAL)
}

/// Time of the next change of the equations by themselves [s]: the onset of the tooth fault, if still to come.
pub fn next_change(model: &Model, state: &State) -> Option<f64> {
    let p = &model.parameters;
    let onset = p.specs.tooth_fault.time().filter(|_| p.effects.tooth_fault && !state.is_tooth_broken);
    onset.filter(|&onset| !has_come(onset, state))
}

/// Whether a tooth breaks now, by its time or by the trigger.
pub fn breaks_tooth(model: &Model, inputs: &Inputs, state: &State) -> bool {
    let p = &model.parameters;
    let has_come = || p.specs.tooth_fault.time().is_some_and(|onset| has_come(onset, state));
    p.effects.tooth_fault && !state.is_tooth_broken && (inputs.fault > 0.5 || has_come())
}

/// Whether `time` [s] has come, up to the rounding of times.
fn has_come(time: f64, state: &State) -> bool {
    state.time() + resolution(time) >= time
}

/// The first stop on the way to `until` [s].
pub fn next_stop(model: &Model, state: &State, until: f64) -> Stop {
    let time = if until - state.time() > 1.5 * LONGEST_INTERVAL { state.time() + LONGEST_INTERVAL } else { until };
    match next_change(model, state) {
        // a communication point that differs from the change only by rounding is the change
        Some(change) if (change - time).abs() <= resolution(change) => Stop { time, is_change: true },
        Some(change) if change < time => Stop { time: change, is_change: true },
        _ => Stop { time, is_change: false },
    }
}

/// Moves to `until` [s] if the pending step contains it and the equations change only later. Returns whether it moved.
#[inline]
pub fn move_within(model: &Model, state: &mut State, (until, way): (f64, Way)) -> bool {
    // computed before the move
    let pause = if way.is_part {
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

/// Inputs, or something else, have changed: from now on inputs hold. A further change at the same time, such as a reaction to an
/// event, does not end an interval.
pub fn begin_holding(state: &mut State) {
    if state.held_since == Some(state.time()) {
        return;
    }
    state.held_before = state.held_since.map_or(f64::INFINITY, |since| state.time() - since);
    state.held_since = Some(state.time());
}

/// The clock of the pending step, or a new one that starts now.
pub fn clock(model: &Model, state: &State) -> Clock {
    if let Some(pending_step) = &state.pending_step {
        return pending_step.clock;
    }
    let change = next_change(model, state).unwrap_or(f64::INFINITY);
    Clock::new(change - state.time(), expected(state))
}

/// Time for which inputs are expected to hold [s].
pub fn expected(state: &State) -> f64 {
    let left = state.held_before - state.held_since.map_or(0.0, |since| state.time() - since);
    left * (1.0 + ROUNDING)
}

/// The last communication point, or the present where the motion has not paused since: on the integrator's clock, and its
/// time [s].
pub fn last_communication_point(state: &State, clock: &Clock) -> [f64; 2] {
    state.pause.map_or([clock.now, state.time()], |pause| [pause.now, pause.time])
}

/// Moves the time to `until` [s] if the motion has come there. By the integrator's clock it has come to `reached` [s]; an error
/// if these differ by more than rounding.
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
    fn the_time_does_not_move_where_the_motion_has_not_come() {
        let mut state = State::at_rest(0.25, 1e-6);
        let failure = arrive(&mut state, 1.0, 0.5).unwrap_err();
        assert!(failure.message.contains("t = 1 s"), "{failure}");
        assert_eq!((state.time(), failure.time), (0.5, 0.5));
        // rounding is no difference
        assert!(arrive(&mut state, 1.0, 1.0 - f64::EPSILON).is_ok());
        assert_eq!(state.time(), 1.0);
    }
}
