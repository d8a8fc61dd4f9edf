//! Integration over one interval. In the order of a step:
//!
//! 1. The equations are created from inputs and state (`dynamics::Equations::new`), in the shape of the scene.
//! 2. A method attempts a step (`integrate::proceed`, `integrate::advance_fixed`). It evaluates forces and derivatives
//!    in the order of `dynamics::equations`: contact of each planet, forces on the bodies, friction, effects, inputs.
//!    Its error, the ledger and kinks determine the step size.
//! 3. The integration fails if a tooth bends too far in the accepted step (`LedgerEquations::check_deflection`).
//! 4. Work, heat, temperatures, damage and mesh cycles are recorded (`LedgerEquations::record`).
//! 5. Sliding friction drags its anchors. The method stops if friction is due to switch, or if temperatures have
//!    changed noticeably.
//! 6. Effects use the new temperatures, and friction switches. If a switch is an event, the motion may pause.
//! 7. The step that ends beyond the present is stored in the state with its dense output (`dynamics::pending_step`).

use crate::FULL;

use super::failure::ExcessiveDeflection;
use super::{LedgerEquations, LedgerSums, StepFailure, effort};
use crate::integrate::{self, AfterStep, Failure, Radau, Rodas5P, SolverContext, Statistics, Step, Trajectory};
use crate::model::assembly::ideal_with_effects::{IDEAL_SIZE, IdealWithEffects, SHAFTS_SIZE};
use crate::model::assembly::{Gears, Model, Teeth};
use crate::model::dynamics::dogs::DogEquations;
use crate::model::dynamics::ledger_rates::LedgerRates;
use crate::model::dynamics::shape::{
    Any, ENDS_SIZE, MEDIUM_SIZE, PLAIN_SIZE, Plain, PlainDriven, Shape, TWO_GROUPS_SIZE, WithBodies, WithEffects,
    WithEnds,
};
use crate::model::dynamics::timeline::LONGEST_INTERVAL;
use crate::model::dynamics::{Clock, Equations, IdealEquations, MAX_SIZE, State};
use crate::model::effects::Memories;
use crate::model::scene::{Inputs, Method};

/// Longest step [s].
const LONGEST: f64 = LONGEST_INTERVAL;
/// Resolution of a double for times up to the length of an interval [s].
pub const RESOLUTION: f64 = 4.0 * f64::EPSILON * LONGEST_INTERVAL;

/// Clock, inputs and options of an integration.
pub struct Integration<'a> {
    /// Clock of the integrator.
    pub clock: &'a mut Clock,
    /// Simulation time at which the clock is zero [s].
    pub begin: f64,
    /// True if outputs at the target time were already returned to the host. A tooth that bends too far can then no
    /// longer be rejected.
    pub is_returned: bool,
    /// True if the motion pauses at an event. The clock's `now` becomes the time of the event, and the pending step
    /// starts there.
    pub pauses: bool,
    /// Inputs that act.
    pub inputs: &'a Inputs,
    /// Time on the clock [s] and change of the accelerations [rad/s²], if only torques have changed within the pending
    /// step.
    pub change: Option<(f64, f64)>,
    /// Fatigue damage and mesh history, to which completed steps add; `None` if nothing reads them.
    pub memories: Option<&'a mut Memories>,
}

/// Integrates `state` until the pending step contains the clock's `now`, the equations end, or the clock must be reset.
/// Fails if a step cannot be completed within the `budget` of attempted steps, or if a tooth bends too far.
pub fn integrate(
    model: &Model,
    state: &mut State,
    integration: Integration,
    budget: &mut u64,
) -> Result<(), StepFailure> {
    match &model.gears {
        Gears::Ideal(ideal) if !FULL || model.parameters.solver.method == Method::Adaptive => {
            integrate_ideal((ideal, model, state, integration, budget))
        }
        Gears::Ideal(ideal) => integrate_ideal_through_object((ideal, model, state, integration, budget)),
        Gears::Teeth(teeth) => integrate_teeth(teeth, model, state, integration, budget),
    }
}

/// Integrates with `teeth`, which may group planets that the model treats separately. Fails as [`integrate`] does.
pub fn integrate_teeth(
    teeth: &Teeth,
    model: &Model,
    state: &mut State,
    integration: Integration,
    budget: &mut u64,
) -> Result<(), StepFailure> {
    let (groups, plain) = (teeth.layout.groups, teeth.layout.plain());
    let method = model.parameters.solver.method;
    let is_default = method == Method::Adaptive;
    let arguments = (teeth, model, state, integration, budget);
    if FULL && is_default && !teeth.effect_terms.body_effects.act_in(arguments.2) {
        match (groups, arguments.2.inputs.derivatives.is_some()) {
            (1, false) => return integrate_monomorphised::<PLAIN_SIZE, Plain<1>>(arguments),
            (1, true) => return integrate_monomorphised::<PLAIN_SIZE, PlainDriven>(arguments),
            (2, false) => return integrate_monomorphised::<TWO_GROUPS_SIZE, Plain<2>>(arguments),
            _ => {}
        }
    }
    match (groups, plain) {
        (1, Some(false)) if is_default || method == Method::FixedStep => {
            integrate_monomorphised::<PLAIN_SIZE, WithEffects<1>>(arguments)
        }
        (2, Some(false)) if FULL && is_default => integrate_monomorphised::<TWO_GROUPS_SIZE, WithEffects<2>>(arguments),
        (1, Some(true)) if is_default || !FULL => integrate_monomorphised::<ENDS_SIZE, WithEnds>(arguments),
        (1, _) if FULL && is_default && !teeth.layout.has_pins => {
            integrate_monomorphised::<MEDIUM_SIZE, WithBodies>(arguments)
        }
        _ if FULL && teeth.layout.count() <= MEDIUM_SIZE => integrate_through_object::<MEDIUM_SIZE>(arguments),
        _ => integrate_through_object::<MAX_SIZE>(arguments),
    }
}

/// Constants of gears and scene, state, options and budget of an integration.
type Arguments<'a, 'b, G> = (&'a G, &'a Model, &'a mut State, Integration<'b>, &'a mut u64);

/// Integrates ideal gears with effects, monomorphised for the shape with ends, which fits all their scenes, and
/// for a larger size if a drive in front of the carrier moves separately.
#[inline(never)]
fn integrate_ideal((ideal, model, state, integration, budget): Arguments<IdealWithEffects>) -> Result<(), StepFailure> {
    if ideal.others.is_empty() {
        let equations = &mut IdealEquations::<SHAFTS_SIZE>::new(ideal, integration.inputs, state);
        return integrate_equations::<SHAFTS_SIZE, WithEnds, _>(equations, model, state, integration, budget);
    }
    let equations = &mut IdealEquations::<IDEAL_SIZE>::new(ideal, integration.inputs, state);
    integrate_equations::<IDEAL_SIZE, WithEnds, _>(equations, model, state, integration, budget)
}

/// Integrates ideal gears through a trait object, with a method that is not monomorphised for them.
#[inline(never)]
fn integrate_ideal_through_object(
    (ideal, model, state, integration, budget): Arguments<IdealWithEffects>,
) -> Result<(), StepFailure> {
    let equations: &mut dyn LedgerEquations<IDEAL_SIZE> =
        &mut IdealEquations::<IDEAL_SIZE>::new(ideal, integration.inputs, state);
    integrate_equations::<IDEAL_SIZE, Any, _>(equations, model, state, integration, budget)
}

/// Integrates plain teeth, or teeth with effects and planets in one or two groups. Monomorphised for each shape.
#[inline(never)]
fn integrate_monomorphised<const N: usize, S: Shape<N>>(
    (teeth, model, state, integration, budget): Arguments<Teeth>,
) -> Result<(), StepFailure> {
    let equations = &mut Equations::<S, N>::new(teeth, integration.inputs, state);
    integrate_equations::<N, S, _>(equations, model, state, integration, budget)
}

/// Integrates all other teeth and methods through a trait object.
#[inline(never)]
fn integrate_through_object<const N: usize>(
    (teeth, model, state, integration, budget): Arguments<Teeth>,
) -> Result<(), StepFailure> {
    let equations: &mut dyn LedgerEquations<N> = &mut Equations::<Any, N>::new(teeth, integration.inputs, state);
    integrate_equations::<N, Any, _>(equations, model, state, integration, budget)
}

/// Integrates with the method of the scene. [`integrate_teeth`] chooses a shape for which this method is compiled.
fn integrate_equations<const N: usize, S: Shape<N>, E: LedgerEquations<N> + ?Sized>(
    equations: &mut E,
    model: &Model,
    state: &mut State,
    integration: Integration,
    budget: &mut u64,
) -> Result<(), StepFailure> {
    let before = state.statistics;
    let Integration { clock, begin, is_returned, pauses, inputs, change, mut memories } = integration;
    let mut trajectory = resumed(state, clock);
    if let Some((time, acceleration_change)) = change {
        change_torques(equations, state, &mut trajectory, inputs, (time, acceleration_change));
    }
    // a clock that runs to the end of the equations is not reset, because that end is near
    let set_back_at = if clock.now < clock.end { LONGEST_INTERVAL } else { f64::INFINITY };
    let depends_on_temperature = model.thermal.is_some() && model.body_effects().depends_on_temperature();
    if depends_on_temperature {
        trajectory.longest = LONGEST.min(state.thermal.longest);
    }
    let (mut outcome, mut continues) = (Ok(()), true);
    while continues && outcome.is_ok() {
        let (mut switched, mut anchors) = (false, equations.applied().anchors());
        let State { control, statistics, rattle, work, heat, torque_means, thermal, .. } = state;
        let mut sums = LedgerSums { begin, work, heat, thermal, torque_means, memories: memories.as_deref_mut() };
        // records an accepted step and decides whether the method stops
        let observe = |step: Step<N, LedgerRates>| {
            if !is_returned {
                rattle.add_step(equations.check_deflection(step.end)?);
            }
            equations.record(model, &step, &mut sums);
            equations.drag_anchors(step.end, &step.ledger_rates[2], &mut anchors);
            switched = equations.is_switch_due(step.end, step.time);
            let is_warmer = depends_on_temperature && sums.thermal.is_update_due();
            Ok(if switched || is_warmer || step.time >= set_back_at { AfterStep::Stop } else { AfterStep::Continue })
        };
        // the method attempts steps until one passes `now`, or until `observe` stops it
        let tolerance = model.parameters.solver.relative_tolerance;
        let context = SolverContext { tolerance, control, statistics, budget };
        outcome = follow::<N, S, E>(equations, model, &mut trajectory, clock.now, context, observe);
        equations.applied_mut().set_anchors(&anchors);
        // the equations change: effects use new temperatures, and friction switches
        let is_warmer = depends_on_temperature && state.thermal.is_update_due();
        if is_warmer {
            state.thermal.use_temperatures();
            equations.applied_mut().update_temperatures(model.body_effects(), state.lock, &state.thermal.used);
            trajectory.longest = LONGEST.min(state.thermal.longest);
        }
        if switched && switch(equations, state, &trajectory, begin) && pauses && trajectory.time < clock.now {
            clock.now = trajectory.time;
        }
        let is_over = trajectory.time >= set_back_at || trajectory.end - trajectory.time <= RESOLUTION;
        continues = (switched || is_warmer) && !is_over;
    }
    state.inputs.values = *inputs;
    state.friction = equations.applied().friction_state;
    store(state, clock, &trajectory, outcome.is_ok());
    outcome.map_err(|failure| explain(failure, begin + clock.time, (model, inputs, state), &before))
}

/// Trajectory from the last completed step, or within the pending step if there is one. Always inlined, so that this
/// large value is written in place.
#[inline(always)]
fn resumed<const N: usize>(state: &State, clock: &Clock) -> Trajectory<N, LedgerRates> {
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

/// Applies the torques of `inputs` from a `time` on the clock [s] within the pending step. The accelerations change
/// there by `acceleration_change` [rad/s²].
fn change_torques<const N: usize, E: LedgerEquations<N> + ?Sized>(
    equations: &mut E,
    state: &mut State,
    trajectory: &mut Trajectory<N, LedgerRates>,
    inputs: &Inputs,
    (time, acceleration_change): (f64, f64),
) {
    equations.applied_mut().change = inputs.torques_since(&state.inputs.values);
    if !trajectory.change_at(time, acceleration_change) {
        // no part of the pending step precedes the change
        state.control.discontinuity(Some(acceleration_change));
    }
}

/// Follows the `trajectory` with the method of the scene until its pending step contains `until` [s], its equations
/// end, or `observe` stops it.
#[inline(always)]
fn follow<const N: usize, S: Shape<N>, E: LedgerEquations<N> + ?Sized>(
    equations: &E,
    model: &Model,
    trajectory: &mut Trajectory<N, LedgerRates>,
    until: f64,
    context: SolverContext,
    observe: impl FnMut(Step<N, LedgerRates>) -> Result<AfterStep, ExcessiveDeflection>,
) -> Result<(), Failure<ExcessiveDeflection>> {
    match model.parameters.solver.method {
        Method::FixedStep if S::HAS_FIXED_STEPS => {
            let (step, counts) = (model.parameters.solver.fixed_step, (context.statistics, context.budget));
            let Trajectory { point, time, end, .. } = trajectory;
            integrate::advance_fixed(equations, point, time, *end, step, counts, observe)
        }
        Method::Radau if S::HAS_RADAU => integrate::proceed(&Radau, equations, trajectory, until, context, observe),
        _ => integrate::proceed(&Rodas5P, equations, trajectory, until, context, observe),
    }
}

/// Stores the end of the last completed step and, if `is_ok`, the pending step.
fn store<const N: usize>(state: &mut State, clock: &mut Clock, trajectory: &Trajectory<N, LedgerRates>, is_ok: bool) {
    state.set_point(&trajectory.point);
    clock.time = trajectory.time;
    match &trajectory.pending {
        Some(pending) if is_ok => {
            state.pending_step.get_or_insert_default().set((pending, &trajectory.extension), *clock);
        }
        _ => state.pending_step = None,
    }
}

/// Switches the friction and the dog clutches that are due at the end of the last completed step. Returns true if this
/// is an event.
fn switch<const N: usize, E: LedgerEquations<N> + ?Sized>(
    equations: &mut E,
    state: &mut State,
    trajectory: &Trajectory<N, LedgerRates>,
    begin: f64,
) -> bool {
    let before = equations.applied().friction_state;
    equations.settle_friction(&trajectory.point, trajectory.time, false, &mut state.heat);
    equations.settle_dogs(&trajectory.point, &mut state.heat);
    let (after, time) = (equations.applied(), begin + trajectory.time);
    let engages = state.events.record_dogs([&state.dogs, &after.dogs], time);
    state.dogs = after.dogs;
    state.events.record_friction([&before, &after.friction_state], time) || engages
}

/// Maximum number of attempted steps for plain teeth in a communication step. It limits the waiting time of a host to
/// some seconds. `progress` extends it during long steps.
const BUDGET: u64 = 2_000_000;
/// Cost that effects on bodies (drag, shafts, dry friction) add to a step, relative to a step of plain teeth.
const EFFECTS: usize = 3;
/// Number of matrix entries for plain teeth with identical planets.
const PLAIN: usize = 16;
/// Maximum cost of a step of ideal gears with all effects, relative to a step of plain teeth.
const IDEAL: usize = 2;
/// Maximum cost of a step of `radau`, which iterates, relative to a step of the default method.
const RADAU_IN_STEPS: usize = 8;

/// Maximum number of attempted steps, as [`BUDGET`]. It is smaller if a step costs more.
pub fn budget(model: &Model) -> u64 {
    let Gears::Teeth(teeth) = &model.gears else { return BUDGET / IDEAL as u64 };
    let work = teeth.contact.work(model.parameters.solid.facets as usize, teeth.layout.groups);
    let has_effects = teeth.effect_terms.body_effects.has_effects || teeth.effect_terms.records_steps;
    let effects = if has_effects { EFFECTS } else { 0 };
    // the cost of small matrices is proportional to their number of entries
    let freedoms = teeth.layout.count();
    let steps = if model.parameters.solver.method == Method::Radau { RADAU_IN_STEPS } else { 1 };
    BUDGET / ((work.max(freedoms * freedoms / PLAIN) + effects) * steps) as u64
}

/// Error with the cause of the `failure` and a remedy. `before` are the statistics at the start of the integration.
#[cold]
fn explain(
    failure: Failure<ExcessiveDeflection>,
    time: f64,
    (model, inputs, state): (&Model, &Inputs, &State),
    before: &Statistics,
) -> StepFailure {
    let solver = &model.parameters.solver;
    let tolerance = solver.relative_tolerance;
    let message = match failure {
        Failure::Refused(tooth) => tooth.message(model),
        Failure::NotClosed => "the energy balance of the step before a change of torques does not close".into(),
        Failure::StepTooSmall { size } => format!(
            "the step size fell to {size:.3e} s, below the resolution of time; look at the inputs, \
             or loosen solver.relative_tolerance = {tolerance:e}"
        ),
        Failure::Diverged => format!(
            "a step of solver.fixed_step = {:e} s could not be solved; make it shorter, or take solver.method = adaptive",
            solver.fixed_step
        ),
        Failure::TooManySteps => format!(
            "{} attempts at steps, and a tenth of them for each second, were not enough for one communication step: {}; \
             shorten it, loosen solver.relative_tolerance = {tolerance:e}, or {}",
            budget(model),
            effort::too_many_steps(model, inputs, state, before),
            effort::fewer_steps(model, state)
        ),
    };
    StepFailure { time, message }
}
