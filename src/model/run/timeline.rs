//! What happens at a time. This is the one place that knows of it, and every way of moving on passes through it.
//!
//! The equations change by themselves where a tooth breaks; inputs are expected to change when they have held as long as
//! before; long stretches end so that the integrator's clock is set back; and the host asks for a time. A stop is the first
//! of these. The time moves by as much as the integrator's clock has moved, or the call fails.

use super::StepFailure;
use super::integration::LONGEST_INTERVAL;
use crate::model::assembly::Model;
use crate::model::dynamics::event::{Pause, Way};
use crate::model::dynamics::{Clock, State};
use crate::model::scene::Inputs;

/// By how much longer than before inputs are expected to hold: hosts add up steps, with all the rounding that brings.
const ROUNDING: f64 = 1e-6;
/// Operations on times, each of them rounded, between one stop and the next.
const ROUNDED: f64 = 8.0;

/// Where the integration of a stretch of time is to stop.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Stop {
    /// Its time [s].
    pub time: f64,
    /// Whether the equations change there.
    pub is_change: bool,
}

/// Times that are closer than this cannot be told apart near `time` [s].
fn resolution(time: f64) -> f64 {
    ROUNDED * f64::EPSILON * time.abs().max(LONGEST_INTERVAL)
}

/// Time at which the equations change by themselves, if that is still to come [s]: a tooth breaks.
pub fn next_change(model: &Model, state: &State) -> Option<f64> {
    let p = &model.parameters;
    let onset = p.specs.tooth_fault.onset;
    (p.effects.tooth_fault && !state.is_tooth_broken && onset > 0.0 && !has_come(onset, state)).then_some(onset)
}

/// Whether a tooth breaks now, by its time or by the trigger.
pub fn breaks_tooth(model: &Model, inputs: &Inputs, state: &State) -> bool {
    let p = &model.parameters;
    let onset = p.specs.tooth_fault.onset;
    p.effects.tooth_fault && !state.is_tooth_broken && (inputs.fault > 0.5 || onset > 0.0 && has_come(onset, state))
}

/// Whether `time` [s] has come, up to the rounding of times.
fn has_come(time: f64, state: &State) -> bool {
    state.time() + resolution(time) >= time
}

/// The first stop on the way to `until` [s].
pub fn next_stop(model: &Model, state: &State, until: f64) -> Stop {
    let time = if until - state.time() > 1.5 * LONGEST_INTERVAL { state.time() + LONGEST_INTERVAL } else { until };
    match next_change(model, state) {
        // a communication point that rounding parts from the change is the change
        Some(change) if (change - time).abs() <= resolution(change) => Stop { time, is_change: true },
        Some(change) if change < time => Stop { time: change, is_change: true },
        _ => Stop { time, is_change: false },
    }
}

/// Moves to `until` [s] if the step ahead contains it and the equations hold up to there and beyond. Returns whether it does.
#[inline]
pub fn move_within(model: &Model, state: &mut State, (until, way): (f64, Way)) -> bool {
    // reckoned before the move
    let pause = if way.is_part {
        state.pending_step.as_ref().map(|step| {
            let [now, time] = shown(state, &step.clock);
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

/// Inputs have changed, or something else: from now on they hold.
pub fn begin_holding(state: &mut State) {
    state.held = state.begun.map_or(f64::INFINITY, |begun| state.time() - begun);
    state.begun = Some(state.time());
}

/// The clock of the step ahead, or a new one that starts now.
pub fn clock(model: &Model, state: &State) -> Clock {
    if let Some(pending_step) = &state.pending_step {
        return pending_step.clock;
    }
    let held = state.held - state.begun.map_or(0.0, |begun| state.time() - begun);
    let change = next_change(model, state).unwrap_or(f64::INFINITY);
    Clock::new(change - state.time(), held * (1.0 + ROUNDING))
}

/// Begin of the way to the next communication point: on the integrator's clock and in time [s].
pub fn shown(state: &State, clock: &Clock) -> [f64; 2] {
    state.pause.map_or([clock.now, state.time()], |pause| [pause.now, pause.time])
}

/// Moves the time to `until` [s], to which the motion must have come: by the integrator's clock it has come to `reached` [s].
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
