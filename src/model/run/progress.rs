//! Progress in time: restart, continuation and end of the integration.
//!
//! While inputs are constant, the integrator's steps do not depend on the times that the host requests. The pending
//! step ends beyond the present, and its dense output gives the motion at the present. When something changes, the
//! pending step is completed up to the present, and the integration restarts there. If only torques change, the
//! integration continues without a restart (see `change`).

use super::events::{apply_changes, break_tooth, follow_lock, next_change};
use super::integration::{self, Integration};
use super::{StepFailure, change, imposed};
use crate::model::assembly::{Gears, Model};
use crate::model::dynamics::acting_inputs::ActingInputs;
use crate::model::dynamics::actuated::courses;
use crate::model::dynamics::event::AdvanceOptions;
use crate::model::dynamics::timeline::LONGEST_INTERVAL;
use crate::model::dynamics::{Actuated, Clock, CommunicationPoint, State, Stop};
use crate::model::effects::Memories;
use crate::model::scene::{Inputs, Method};

/// Time of a communication step during which the limit of attempts grows [s]: an hour.
const LONGEST_GROWTH: f64 = 3600.0;
/// Share of the limit of attempts that each second of a communication step adds.
const GROWTH: f64 = 0.1;

/// Adds to the `budget` of attempts what a completed interval of the clock allows, so that the limit does not depend on
/// the length of a communication step. `advanced` [s] is the time since the start of the step; `remaining` [s] is the
/// time to its stop, which is negative only if a damaged state leads beyond it.
fn extend(budget: &mut u64, model: &Model, advanced: f64, remaining: f64) {
    if advanced <= LONGEST_GROWTH && remaining >= 0.0 {
        let limit = integration::budget(model);
        *budget = limit.min(*budget + (GROWTH * limit as f64) as u64);
    }
}

/// Restarts the integration at the present, because inputs or something else have changed.
pub fn restart(model: &Model, inputs: &Inputs, (state, memories): (&mut State, &mut Memories)) {
    let is_discontinuous = state.pending_step.is_some();
    complete(model, (state, Some(memories)));
    if is_discontinuous {
        state.control.discontinuity(None);
    }
    state.timeline.pause = None;
    imposed::follow_commands(model, inputs, state);
    apply_changes(model, inputs, state);
    state.timeline.begin_constant_inputs();
    state.inputs.values = *inputs;
}

/// Completes the pending step up to the present, under the inputs that acted in it. Also switches friction that is due
/// to switch at the present. Without `memories`, damage and mesh history are left out.
pub fn complete(model: &Model, (state, memories): (&mut State, Option<&mut Memories>)) {
    let Some(pending_step) = &state.pending_step else { return };
    let (inputs, mut clock) = (state.inputs.values, pending_step.clock);
    clock.end = clock.now;
    let before = *state;
    state.inputs.derivatives = None;
    let mut budget = integration::budget(model);
    let begin = state.time() - clock.now;
    let integration = Integration {
        clock: &mut clock,
        begin,
        is_returned: true,
        pauses: false,
        inputs: &inputs,
        change: None,
        memories,
    };
    let outcome = integration::integrate(model, state, integration, &mut budget);
    if outcome.is_err() || clock.time != clock.now {
        // outputs of this motion were already returned, so it is kept; the residual of the ledger shows the missing
        // energy
        *state = before;
        state.pending_step = None;
    }
    state.inputs.derivatives = before.inputs.derivatives;
    wrap_and_constrain(model, state);
}

/// Integrates to `until` [s], or to the first event if `options.pauses`; the state then contains a pause.
/// `acceleration_change` is the change of the accelerations at the present [rad/s²] if only torques have changed within
/// the pending step. Fails if a step fails; the time is then the last one that was reached.
pub fn integrate(
    model: &Model,
    (inputs, state, memories): (&mut Inputs, &mut State, &mut Memories),
    (until, options, mut acceleration_change): (f64, AdvanceOptions, Option<f64>),
) -> Result<(), StepFailure> {
    let mut budget = integration::budget(model);
    while state.time() < until {
        let (begin, events) = (state.time(), state.events.count());
        let stop = state.timeline.next_stop(next_change(model, state), until);
        let outcome = if inputs_move(model, state) || model.parameters.solver.method == Method::FixedStep {
            step_to_stop(model, inputs, (state, memories), stop, &mut budget)
        } else {
            step_past_stop(model, inputs, (state, memories), (stop, options, acceleration_change.take()), &mut budget)
        };
        advance_inputs(model, inputs, state, state.time() - begin);
        outcome?;
        // an event has paused the motion
        if state.time() < stop.time {
            return Ok(());
        }
        break_tooth(model, inputs, state);
        follow_lock(model, inputs, state);
        let pauses = if state.time() < until {
            options.pauses && state.events.count() != events
        } else {
            // no step is pending, so the next part starts a new clock, and the pause is stored at its time 0
            options.is_part && state.pending_step.is_none()
        };
        if pauses {
            let clock = state.pending_step.as_ref().map_or(0.0, |step| step.clock.now);
            state.timeline.pause = Some(CommunicationPoint { clock, time: state.time() });
            return Ok(());
        }
    }
    Ok(())
}

/// Integrates in steps, the last of which ends at the stop. Inputs with derivatives and steps of fixed size need this.
fn step_to_stop(
    model: &Model,
    inputs: &Inputs,
    (state, memories): (&mut State, &mut Memories),
    stop: Stop,
    budget: &mut u64,
) -> Result<(), StepFailure> {
    let begin = state.time();
    let length = stop.time - begin;
    let mut clock = Clock { now: length, ..Clock::new(length, f64::INFINITY) };
    let (mut outcome, mut extended) = (Ok(()), 0.0);
    while clock.time < clock.now && outcome.is_ok() {
        outcome = integrate_interval(model, inputs, (state, memories), (&mut clock, begin, false, None), budget);
        if clock.time - extended >= LONGEST_INTERVAL {
            extend(budget, model, clock.time, length - clock.time);
            extended = clock.time;
        }
    }
    wrap_and_constrain(model, state);
    arrive(state, stop, begin + clock.time, outcome)
}

/// Integrates in steps that do not depend on the stop. Ends if the pending step contains the stop, if the equations
/// change at the stop, or if an event pauses the motion before the stop.
fn step_past_stop(
    model: &Model,
    inputs: &Inputs,
    (state, memories): (&mut State, &mut Memories),
    (stop, options, acceleration_change): (Stop, AdvanceOptions, Option<f64>),
    budget: &mut u64,
) -> Result<(), StepFailure> {
    let mut clock = clock(model, state);
    let mut change = acceleration_change.map(|by| (change::begin_interval(state, &mut clock), by));
    let mut last = state.timeline.last_communication_point(&clock);
    let mut begin = last.time - last.clock;
    let mut target = if stop.is_change { clock.end } else { last.clock + (stop.time - last.time) };
    clock.now = target;
    let mut advanced = 0.0;
    // one iteration per interval of the clock
    loop {
        let at = (&mut clock, begin, options.pauses, change.take());
        let outcome = integrate_interval(model, inputs, (state, memories), at, budget);
        let mut reached = clock.time;
        if let Some(pending_step) = &state.pending_step {
            pending_step.motion(model.layout.count(), [&mut state.q, &mut state.v]);
            reached = clock.now.min(pending_step.end());
        }
        wrap_and_constrain(model, state);
        // an event has paused the motion before the stop
        if outcome.is_ok() && state.pending_step.is_some() && clock.now < target {
            (state.timeline.pause, state.timeline.now) = (Some(last), begin + clock.now);
            return Ok(());
        }
        // the pending step contains the stop, the equations change there, or a step has failed
        if outcome.is_err() || state.pending_step.is_some() || clock.time >= clock.end {
            let arrived = arrive(state, stop, begin + reached, outcome);
            if options.is_part && state.pending_step.is_some() {
                state.timeline.pause = Some(last);
            }
            return arrived;
        }
        // the interval has ended before the stop: continue with a reset clock
        let by = clock.set_back();
        (begin, last.clock, target) = (begin + by, last.clock - by, target - by);
        advanced += by;
        extend(budget, model, advanced, stop.time - (begin + clock.time));
    }
}

/// Moves the time to the stop, or to `reached` [s] if the motion has not reached the stop. Returns the error in
/// `outcome`, or an error if the stop was not reached.
fn arrive(state: &mut State, stop: Stop, reached: f64, outcome: Result<(), StepFailure>) -> Result<(), StepFailure> {
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

/// Clock of the pending step, or a new clock that starts now.
fn clock(model: &Model, state: &State) -> Clock {
    if let Some(pending_step) = &state.pending_step {
        return pending_step.clock;
    }
    let change = next_change(model, state).unwrap_or(f64::INFINITY);
    Clock::new(change - state.time(), state.timeline.expected())
}

/// Integrates up to the stop, or up to the next reset of the clock. Planets that move identically are integrated as one
/// group.
fn integrate_interval(
    model: &Model,
    inputs: &Inputs,
    (state, memories): (&mut State, &mut Memories),
    (clock, begin, pauses, change): (&mut Clock, f64, bool, Option<(f64, f64)>),
    budget: &mut u64,
) -> Result<(), StepFailure> {
    let integration =
        Integration { clock, begin, is_returned: false, pauses, inputs, change, memories: Some(memories) };
    if let Some(teeth) = model.merged.as_deref().filter(|teeth| state.planets_move_alike(teeth, &model.layout)) {
        let outcome = integration::integrate_teeth(teeth, model, state, integration, budget);
        state.let_others_follow(&model.layout);
        return outcome;
    }
    integration::integrate(model, state, integration, budget)
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

/// True if inputs have derivatives, or if actuators move behind them.
pub fn inputs_move(model: &Model, state: &State) -> bool {
    let ActingInputs { values, derivatives, actuated } = &state.inputs;
    let moves = |of: &Actuated| of.moves(&model.body_effects().actuators, &courses(values, derivatives.as_ref()));
    derivatives.is_some() || actuated.as_ref().is_some_and(moves)
}

/// Advances inputs by `time` [s] along their derivatives, and the actuators behind them.
pub fn advance_inputs(model: &Model, inputs: &mut Inputs, state: &mut State, time: f64) {
    let plan = &model.ideal.plan;
    if let Some(actuated) = &mut state.inputs.actuated {
        let commands = courses(inputs, state.inputs.derivatives.as_ref());
        *actuated = actuated.after(&model.body_effects().actuators, &commands, time);
    }
    if let Some(derivatives) = &mut state.inputs.derivatives {
        derivatives.follow(time, inputs);
        // rounding must not depend on whether the host or the program refers a command to the carrier
        plan.refer(inputs);
        *derivatives = plan.with_drive(*derivatives);
        state.inputs.values = *inputs;
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
