//! What changes at the begin of a step or at an event: a tooth breaks, the lock moves, dry friction catches and lets go.

use super::causes::Cause;
use super::commands;
use super::constants::{Gears, Model};
use super::parameters::Inputs;
use super::sizes::{by_rigid_size, by_size, with_equations};
use super::state::State;
use crate::integrate::SecondOrder;

/// Kinetic and stored energy [J].
pub fn energy(model: &Model, inputs: &Inputs, state: &State) -> f64 {
    with_equations!(model, state, inputs, |equations| equations.energy(&state.point::<N>()).iter().sum())
}

/// Breaks the tooth when its time has come or when it is triggered; the energy that it held is heat.
pub fn break_tooth(model: &Model, inputs: &Inputs, state: &mut State) {
    if commands::breaks_tooth(model, inputs, state) {
        let before = energy(model, inputs, state);
        state.fault = true;
        state.heat[Cause::Contact as usize] += before - energy(model, inputs, state);
    }
}

/// Lets the lock follow its command, catches bodies that dry friction takes hold of, and lets go of those it releases.
pub fn catch_holds(model: &Model, inputs: &Inputs, state: &mut State) {
    break_tooth(model, inputs, state);
    let was_locked = state.lock > 0.0;
    state.lock = inputs.lock;
    match &model.gears {
        Gears::Rigid(rigid) if rigid.acts(state) || was_locked => by_rigid_size!(model, {
            let mut equations = E::new(rigid, inputs, state);
            equations.take_over(&state.point(), &mut state.heat);
            state.holds = equations.holds;
        }),
        Gears::Teeth(teeth) if teeth.full.acts(state) => by_size!(teeth, true, {
            let mut equations = E::new(teeth, inputs, state);
            equations.take_over(&state.point(), &mut state.heat);
            state.holds = equations.holds;
        }),
        _ => {}
    }
}
