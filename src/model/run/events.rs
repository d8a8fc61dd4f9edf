//! Changes at the start of a step or at an event: a tooth breaks, lock and brakes move, friction starts and ends. Also
//! the time of the next change that the host does not cause.

use super::LedgerEquations;
use super::moving_inputs::acting_inputs;
use crate::integrate::{Point, SecondOrder};
use crate::model::assembly::Model;
use crate::model::dynamics::acting_inputs::ActingInputs;
use crate::model::dynamics::actuated::courses;
use crate::model::dynamics::dogs::DogEquations;
use crate::model::dynamics::event::Happening;
use crate::model::dynamics::with_equations;
use crate::model::dynamics::{FrictionEquations, InputsAndFriction, State};
use crate::model::effect_kinds::{FrictionState, PairFriction};
use crate::model::scene::{ACTUATED_LOCK, Dogs, Inputs, PAIRS, RubbingKind};
use crate::model::setup::CONTACT_HEAT;

/// Kinetic and stored energy [J].
pub fn energy(model: &Model, inputs: &Inputs, state: &State) -> f64 {
    with_equations!(model, state, inputs, |equations| equations.energy(&state.point::<N>()).iter().sum())
}

/// Time of the next change of the equations that the host does not cause [s]: the onset of the tooth fault, if it is
/// still to come, or the next step of a lock whose actuator moves.
pub fn next_change(model: &Model, state: &State) -> Option<f64> {
    let onset = onset(model).filter(|_| may_break_tooth(model) && !state.is_tooth_broken);
    let onset = onset.filter(|&onset| !state.timeline.has_reached(onset));
    onset.into_iter().chain(next_step_of_lock(model, state)).reduce(f64::min)
}

/// Time at which a lock whose actuator moves takes its next step [s]. The stiffness of a closed lock follows its command,
/// so the lock is constant in between, within about one hundredth of the full command.
fn next_step_of_lock(model: &Model, state: &State) -> Option<f64> {
    let (ActingInputs { values, derivatives, actuated }, all) = (&state.inputs, &model.body_effects().actuators);
    let actuator = all[ACTUATED_LOCK].as_ref().filter(|of| !of.is_immediate())?;
    let moves = actuated.as_ref()?.moves_one(ACTUATED_LOCK, all, &courses(values, derivatives.as_ref()));
    moves.then(|| state.time() + actuator.hundredth())
}

/// Applies the command of the lock behind its actuator, if it has changed.
pub fn follow_lock(model: &Model, inputs: &Inputs, state: &mut State) {
    if state.inputs.actuated.is_some() && acting_inputs(model, inputs, state).lock != state.lock {
        apply_changes(model, inputs, state);
    }
}

/// True if the lock is due to follow its command. An actuator moves it in steps ([`next_change`]).
pub fn has_lock_moved(model: &Model, inputs: &Inputs, state: &State) -> bool {
    let lock = acting_inputs(model, inputs, state).lock;
    lock != state.lock && next_step_of_lock(model, state).is_none()
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
    let has_come = || onset(model).is_some_and(|onset| state.timeline.has_reached(onset));
    may_break_tooth(model) && !state.is_tooth_broken && (inputs.fault > 0.5 || has_come())
}

/// Breaks the tooth if its time has come or the fault input triggers it. The energy stored in the tooth becomes heat.
pub fn break_tooth(model: &Model, inputs: &Inputs, state: &mut State) {
    if breaks_tooth(model, inputs, state) {
        let before = energy(model, inputs, state);
        state.is_tooth_broken = true;
        state.events.record(Happening::ToothBreaks, 0, state.time());
        state.sums.heat[CONTACT_HEAT] += before - energy(model, inputs, state);
    }
}

/// Applies the changes that are due: a tooth breaks, lock and brakes follow their commands, and friction starts and
/// ends on bodies.
pub fn apply_changes(model: &Model, inputs: &Inputs, state: &mut State) {
    break_tooth(model, inputs, state);
    state.lock = acting_inputs(model, inputs, state).lock;
    switch_dogs(model, inputs, state);
    if !model.body_effects().may_have_dry_friction(state) {
        return;
    }
    let before = state.friction;
    switch_friction(model, inputs, state);
    record_holds(&before, state);
}

/// Passes their commands to the dog clutches and switches those that are due.
pub fn switch_dogs(model: &Model, inputs: &Inputs, state: &mut State) {
    if !model.body_effects().half_shafts.dogs.iter().any(Option::is_some) {
        return;
    }
    with_equations!(model, state, inputs, |equations| {
        equations.command_dogs(inputs);
        equations.settle_dogs(&state.point(), &mut state.sums.heat);
        let (before, time) = (state.dogs, state.time());
        state.dogs = equations.applied().dogs;
        state.events.record_dogs([&before, &state.dogs], time);
    });
}

/// True if the command of a dog clutch has changed.
pub fn has_dog_command_changed(model: &Model, inputs: &Inputs, state: &State) -> bool {
    let commands = Dogs::commands(inputs);
    (0..2).any(|s| model.body_effects().half_shafts.dogs[s].is_some() && commands[s] != state.dogs.commanded[s])
}

/// Switches the friction and the dog clutches that are due at the `end` of the last completed step, whose time on the
/// clock is `at` [s]. Simulation time is `begin` [s] when the clock is zero. Returns true if this is an event.
pub fn switch<const N: usize, E: LedgerEquations<N> + ?Sized>(
    equations: &mut E,
    state: &mut State,
    end: &Point<N>,
    (begin, at): (f64, f64),
) -> bool {
    let before = equations.applied().friction_state;
    equations.settle_friction(end, at, false, &mut state.sums.heat);
    equations.settle_dogs(end, &mut state.sums.heat);
    let (after, time) = (equations.applied(), begin + at);
    let engages = state.events.record_dogs([&state.dogs, &after.dogs], time);
    state.dogs = after.dogs;
    state.events.record_friction([&before, &after.friction_state], time) || engages
}

/// Records an event for each body that friction starts or stops holding, compared with the friction `before`.
pub fn record_holds(before: &[FrictionState; PAIRS], state: &mut State) {
    let (after, time) = (state.friction, state.time());
    state.events.record_friction([before, &after], time);
}

/// Starts and ends friction on bodies. Wheels that are held by more than the limit torque of their brakes start to
/// slide.
fn switch_friction(model: &Model, inputs: &Inputs, state: &mut State) {
    with_equations!(model, state, inputs, |equations| {
        equations.adapt_friction(&state.point(), &mut state.sums.heat);
        equations.settle_friction(&state.point(), 0.0, true, &mut state.sums.heat);
        state.friction = equations.applied().friction_state;
    });
}

/// Winds up the springs of pairs at rest to their torques in `friction`, and lets those slide that begin to.
pub fn wind_friction(model: &Model, inputs: &Inputs, state: &mut State, friction: &PairFriction) {
    if model.body_effects().may_have_dry_friction(state) {
        with_equations!(model, state, inputs, |equations| {
            equations.wind_friction(&state.point(), friction);
            state.friction = equations.applied().friction_state;
        });
    }
}

/// True if brakes or clutches were applied or released since friction last switched.
pub fn has_commanded_changed(model: &Model, inputs: &Inputs, state: &State) -> bool {
    let mut applied = InputsAndFriction::without_friction(inputs, state);
    applied.add(model.body_effects(), state);
    let mut commanded = (0..PAIRS).filter(|&i| RubbingKind::of(i).0.is_commanded());
    commanded.any(|i| applied.friction().on(i).stiffness != state.friction[i].stiffness)
}

/// True if inputs command the limit torques of brakes or clutches.
#[inline]
pub fn has_commanded(model: &Model) -> bool {
    model.body_effects().has_commanded
}

/// Returns `state` with the brakes and clutches that `inputs` command, or `None` if no friction changes.
pub fn with_commanded(model: &Model, inputs: &Inputs, state: &State) -> Option<State> {
    let mut braked = *state;
    switch_friction(model, inputs, &mut braked);
    (braked.friction != state.friction).then_some(braked)
}
