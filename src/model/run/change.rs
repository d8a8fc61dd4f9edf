//! Changes of torques without a restart of the integration.
//!
//! Torques only add terms to the accelerations. If only they change, one evaluation with the new torques serves both
//! the start of the next step and the end of the step before the change; for the latter, the change of the torques is
//! taken back. The pending step is completed up to the change, with the torques that acted in it, and the integration
//! continues.

use super::events::may_break_tooth;
use crate::model::assembly::Model;
use crate::model::dynamics::{Clock, State};
use crate::model::scene::{Inputs, RubbingKind};

/// Returns the change of the accelerations [rad/s²] if `inputs` change only torques within the pending step. Returns
/// `None` if the integration must restart.
pub fn torque_change_within(model: &Model, inputs: &Inputs, state: &State) -> Option<f64> {
    if state.pending_step.is_none() || state.inputs.values == *inputs {
        return None;
    }
    let must_restart = state.inputs.derivatives.is_some() || model.body_effects().may_have_dry_friction(state);
    if must_restart { None } else { change_of_accelerations(model, &state.inputs.values, inputs) }
}

/// Change of the accelerations if inputs change from `before` to `inputs` [rad/s²], or `None` if more than torques
/// change.
fn change_of_accelerations(model: &Model, before: &Inputs, inputs: &Inputs) -> Option<f64> {
    let (plan, inertia) = (&model.ideal.plan, &model.ideal.inertia);
    let [before, inputs] = [before, inputs].map(|inputs| effective_inputs(model, inputs));
    let with_torques = Inputs { drive_torque: inputs.drive_torque, load_torque: inputs.load_torque, ..before };
    if with_torques != inputs {
        return None;
    }
    let wheel = |s: usize| if plan.shafts[s] { inertia.end[s] } else { inertia.side[s] };
    let [left, right, drive] = inputs.torques_since(&before).map(f64::abs);
    Some((left / wheel(0)).max(right / wheel(1)).max(drive / inertia.of_port(plan)))
}

/// Inputs that have an effect in the scene. All others are set to zero, so that a value without effect changes no step.
fn effective_inputs(model: &Model, inputs: &Inputs) -> Inputs {
    let plan = &model.ideal.plan;
    let given = |acts: bool, value: f64| if acts { value } else { 0.0 };
    let rubs = |kind: RubbingKind| model.body_effects().rubs(kind);
    let around = model.thermal.as_ref().map(|network| network.around);
    Inputs {
        drive_speed: given(plan.drive_imposed, inputs.drive_speed),
        drive_torque: given(!plan.drive_imposed, inputs.drive_torque),
        load_torque: [0, 1].map(|s| given(!plan.side_imposed[s], inputs.load_torque[s])),
        side_speed: [0, 1].map(|s| given(plan.side_imposed[s], inputs.side_speed[s])),
        planet_spin: given(plan.spin_imposed, inputs.planet_spin),
        lock: inputs.lock,
        brake_torque: inputs.brake_torque.map(|torque| given(rubs(RubbingKind::Wheel), torque)),
        clutch_command: inputs.clutch_command.map(|command| given(rubs(RubbingKind::Clutch), command)),
        dog_command: [0, 1].map(|s| given(plan.dogs[s].is_some(), inputs.dog_command[s])),
        fault: given(may_break_tooth(model), inputs.fault),
        ambient_change: given(around.is_some(), inputs.ambient_change),
        sump_change: given(around.is_some_and(|around| around.sump.is_some()), inputs.sump_change),
        // commands act through the inputs of the drive
        ..Inputs::ZERO
    }
}

/// Starts a new interval of constant inputs at the present, after a change of torques. Returns the present on the
/// `clock` [s].
pub fn begin_interval(state: &mut State, clock: &mut Clock) -> f64 {
    state.timeline.begin_constant_inputs();
    clock.expected = clock.now + state.timeline.expected();
    clock.now
}
