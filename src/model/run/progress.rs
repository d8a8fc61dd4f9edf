//! Progress in time: where the integration begins anew, goes on, and ends.
//!
//! While inputs hold, the integrator's steps do not depend on the times that the host asks for: one of them goes beyond
//! the present, and its continuous extension tells the motion. Where something changes, that step is completed up to the
//! present, and the integration begins anew there.

use super::events::{break_tooth, onset, update_friction};
use super::failure::StepFailure;
use super::imposed;
use super::stretch::{self, STRETCH, Stretch};
use crate::model::assembly::model::{Gears, Model};
use crate::model::dynamics::clock::Clock;
use crate::model::dynamics::equations::Equations;
use crate::model::dynamics::sizes::with_equations;
use crate::model::dynamics::state::State;
use crate::model::dynamics::watched::Watched;
use crate::model::scene::{Inputs, Method};

/// By how much longer than before inputs are expected to hold: hosts add up steps, with all the rounding that brings.
const ROUNDING: f64 = 1e-6;

/// Begins anew at the present: inputs have changed, or something else has.
pub fn begin_anew(model: &Model, inputs: &Inputs, (state, watched): (&mut State, &mut Watched)) {
    complete(model, (state, watched));
    imposed::jump(model, inputs, state);
    update_friction(model, inputs, state);
    state.held = state.begun.map_or(f64::INFINITY, |begun| state.time - begun);
    state.begun = Some(state.time);
}

/// Completes the step ahead up to the present, under the inputs that acted in it. Switches of friction that are due at the
/// present take place.
pub fn complete(model: &Model, (state, watched): (&mut State, &mut Watched)) {
    let Some(ahead) = &state.ahead else { return };
    let (inputs, mut clock) = (ahead.inputs, ahead.clock);
    clock.end = clock.now;
    let before = *state;
    state.input_derivatives = None;
    let mut budget = stretch::budget(model);
    let begin = state.time - clock.now;
    let stretch = Stretch { clock: &mut clock, begin, is_shown: true, inputs: &inputs, watched };
    let outcome = with_equations!(model, state, &inputs, |equations| {
        let mut equations = equations;
        stretch::integrate::<N, _>(&mut equations, model, state, stretch, &mut budget)
    });
    if outcome.is_err() {
        // what was shown holds; the ledger tells what it lacks
        *state = State { ahead: None, ..before };
    }
    state.input_derivatives = before.input_derivatives;
    keep_together(model, state);
}

/// Integrates to `until` [s].
pub fn integrate(
    model: &Model,
    (inputs, state, watched): (&mut Inputs, &mut State, &mut Watched),
    until: f64,
) -> Result<(), StepFailure> {
    let mut budget = stretch::budget(model);
    while state.time < until {
        let (begin, breaks) = (state.time, onset(model, state));
        let mut end = if until - begin > 1.5 * STRETCH { begin + STRETCH } else { until };
        end = end.min(breaks);
        let outcome = if state.input_derivatives.is_some() || model.parameters.solver.method == Method::FixedStep {
            to_end(model, inputs, (state, watched), end, &mut budget)
        } else {
            go_on(model, inputs, (state, watched), (end, breaks), &mut budget)
        };
        advance_inputs(inputs, state, if outcome.is_ok() { end } else { state.time } - begin);
        outcome?;
        // the rounding of the time axis may leave a rest too small to integrate
        state.time = end;
        break_tooth(model, inputs, state);
    }
    Ok(())
}

/// Integrates in steps that end at `end` [s], which inputs that change by their derivatives ask for, and steps of fixed size.
fn to_end(
    model: &Model,
    inputs: &Inputs,
    (state, watched): (&mut State, &mut Watched),
    end: f64,
    budget: &mut u64,
) -> Result<(), StepFailure> {
    let begin = state.time;
    let mut clock = Clock { now: end - begin, ..Clock::new(end - begin, f64::INFINITY) };
    let mut outcome = Ok(());
    while clock.time < clock.now && outcome.is_ok() {
        outcome = one_stretch(model, inputs, (state, watched), (&mut clock, begin), budget);
    }
    state.time = begin + clock.time;
    keep_together(model, state);
    outcome
}

/// Integrates on, in steps that do not depend on `until` [s], to the step that contains it. A tooth breaks at `breaks` [s].
fn go_on(
    model: &Model,
    inputs: &Inputs,
    (state, watched): (&mut State, &mut Watched),
    (until, breaks): (f64, f64),
    budget: &mut u64,
) -> Result<(), StepFailure> {
    let mut clock = match &state.ahead {
        Some(ahead) => ahead.clock,
        None => {
            let held = state.held - state.begun.map_or(0.0, |begun| state.time - begun);
            Clock::new(breaks - state.time, held * (1.0 + ROUNDING))
        }
    };
    let mut begin = state.time - clock.now;
    clock.now = if until == breaks { clock.end } else { clock.now + (until - state.time) };
    loop {
        let outcome = one_stretch(model, inputs, (state, watched), (&mut clock, begin), budget);
        if let Some(ahead) = &state.ahead {
            ahead.motion(model.layout.count(), [&mut state.q, &mut state.v]);
        }
        state.time = if state.ahead.is_some() { until } else { begin + clock.time };
        if outcome.is_err() || state.ahead.is_some() || clock.time >= clock.end {
            keep_together(model, state);
            return outcome;
        }
        keep_together(model, state);
        begin += clock.set_back();
    }
}

fn one_stretch(
    model: &Model,
    inputs: &Inputs,
    (state, watched): (&mut State, &mut Watched),
    (clock, begin): (&mut Clock, f64),
    budget: &mut u64,
) -> Result<(), StepFailure> {
    let stretch = Stretch { clock, begin, is_shown: false, inputs, watched };
    if let Some(teeth) = model.together.as_deref().filter(|teeth| state.is_together(teeth, &model.layout)) {
        let mut equations = Equations::<4, 1, 0, false>::new(teeth, inputs, state);
        let outcome = stretch::integrate::<4, _>(&mut equations, model, state, stretch, budget);
        state.let_others_follow(&model.layout);
        return outcome;
    }
    with_equations!(model, state, inputs, |equations| {
        let mut equations = equations;
        stretch::integrate::<N, _>(&mut equations, model, state, stretch, budget)
    })
}

/// Wraps positions unless a step leads on from them, and lets gears without teeth turn together to the last bit.
pub fn keep_together(model: &Model, state: &mut State) {
    if state.ahead.is_none() {
        state.wrap(&model.periods, &model.layout);
    }
    if let Gears::Rigid(_) = &model.gears {
        model.ideal.constrain(&mut state.v);
    }
}

/// Takes inputs to what they are `time` [s] later.
fn advance_inputs(inputs: &mut Inputs, state: &mut State, time: f64) {
    if let Some(input_derivatives) = state.input_derivatives {
        let (later, rest) = input_derivatives.after(time, inputs);
        (*inputs, state.input_derivatives) = (later, Some(rest));
        state.carrier_command = inputs.carrier_speed;
    }
}
