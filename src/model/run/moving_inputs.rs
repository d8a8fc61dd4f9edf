//! Inputs that change during a step: along their derivatives, or behind actuators.

use crate::model::assembly::Model;
use crate::model::dynamics::acting_inputs::ActingInputs;
use crate::model::dynamics::actuated::courses;
use crate::model::dynamics::{Actuated, State};
use crate::model::scene::{InputDerivatives, Inputs};

/// Inputs that act at `state`, behind the actuators.
pub fn acting_inputs(model: &Model, inputs: &Inputs, state: &State) -> Inputs {
    let Some(actuated) = &state.inputs.actuated else { return *inputs };
    let (actuators, mut acting, mut derivatives) = (&model.body_effects().actuators, *inputs, InputDerivatives::ZERO);
    let commands = courses(inputs, state.inputs.derivatives.as_ref());
    let present = actuated.at(actuators, [&state.inputs.values, inputs], state.time());
    present.act(actuators, &commands, &mut acting, &mut derivatives);
    acting
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
