//! A stretch of time, step by step. In the order of a step:
//!
//! 1. Inputs and state make the equations (`dynamics::Equations::new`), in the shape of the scene.
//! 2. A method tries a step (`integrate::proceed`, `integrate::advance_fixed`). It evaluates forces and derivatives: the contact of each
//!    planet, the bodies it acts on, friction, effects, inputs (`dynamics::equations`). Its error, the ledger and kinks decide its size.
//! 3. The accepted step is refused if a tooth has bent too far (`LedgerEquations::check_deflection`).
//! 4. Work, heat, temperatures, damage and mesh cycles are recorded (`LedgerEquations::record`).
//! 5. Sliding friction drags its anchors along; friction that is due to switch stops the method.
//! 6. Bodies take new temperatures over, friction switches, and a switch that is an event pauses the motion.
//! 7. The step that leads beyond the present stays in the state with its motion (`dynamics::PendingStep`).

use crate::FULL;

use super::failure::ExcessiveDeflection;
use super::watching::Watched;
use super::widened::Widened;
use super::{LedgerEquations, LedgerSums, StepFailure, effort};
use crate::integrate::{self, AfterStep, Course, Extension, Failure, Radau, Rodas5P, SolverContext, Statistics, Step};
use crate::model::assembly::ideal_with_effects::{IdealWithEffects, MOST};
use crate::model::assembly::{Gears, Model, Teeth};
use crate::model::dynamics::ledger_rates::LedgerRates;
use crate::model::dynamics::shape::{
    Any, DIFFERENT, LEAST, MEDIUM, Plain, PlainDriven, Shape, WITH_ENDS, WithEffects, WithEnds,
};
use crate::model::dynamics::{Clock, Equations, IdealEquations, LARGEST, State};
use crate::model::scene::{FRICTION_BODIES, Inputs, Method};

/// Longest stretch integrated before positions are wrapped and the clock is set back [s].
pub const LONGEST_INTERVAL: f64 = 1.0;
/// Longest step [s].
const LONGEST: f64 = LONGEST_INTERVAL;
/// What a double can resolve of times up to the length of a stretch [s].
pub const RESOLUTION: f64 = 4.0 * f64::EPSILON * LONGEST_INTERVAL;

/// What to integrate.
pub struct Integration<'a> {
    /// The integrator's clock.
    pub clock: &'a mut Clock,
    /// Time at which it shows zero [s].
    pub begin: f64,
    /// Whether the time to integrate to was shown before: then it is too late to refuse a tooth that bends too far.
    pub is_shown: bool,
    /// Whether to stop at an event: the step that leads on from there then contains the clock's `now`.
    pub pauses: bool,
    /// Inputs that act.
    pub inputs: &'a Inputs,
    /// Where only torques have changed within the step ahead: when on the clock, and by how much accelerations jump [rad/s²].
    pub change: Option<(f64, f64)>,
    /// What steps are watched for.
    pub watched: &'a mut Watched,
}

/// Integrates the motion of `state` until the step ahead contains the clock's `now`, the equations end, or the clock is to
/// be set back.
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
        Gears::Ideal(ideal) => ideal_by_table((ideal, model, state, integration, budget)),
        Gears::Teeth(teeth) => integrate_teeth(teeth, model, state, integration, budget),
    }
}

/// The same with `teeth`, which may have planets together that the model has apart.
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
        match (groups, arguments.2.input_derivatives.is_some()) {
            (1, false) => return whole::<LEAST, Plain<1>>(arguments),
            (1, true) => return whole::<LEAST, PlainDriven>(arguments),
            (2, false) => return whole::<DIFFERENT, Plain<2>>(arguments),
            _ => {}
        }
    }
    match (groups, plain) {
        (1, Some(false)) if is_default || method == Method::FixedStep => whole::<LEAST, WithEffects<1>>(arguments),
        (2, Some(false)) if FULL && is_default => whole::<DIFFERENT, WithEffects<2>>(arguments),
        (1, Some(true)) if is_default || !FULL => whole::<WITH_ENDS, WithEnds>(arguments),
        _ if FULL && teeth.layout.count() <= MEDIUM => by_table::<MEDIUM>(arguments),
        _ => by_table::<LARGEST>(arguments),
    }
}

/// Constants of the gears and of the scene, state, stretch of time and budget of an integration.
type Arguments<'a, 'b, G> = (&'a G, &'a Model, &'a mut State, Integration<'b>, &'a mut u64);

/// Gears without teeth with effects, compiled as a whole: in the shape with ends every scene has room.
#[inline(never)]
fn integrate_ideal((ideal, model, state, integration, budget): Arguments<IdealWithEffects>) -> Result<(), StepFailure> {
    let equations = &mut IdealEquations::new(ideal, integration.inputs, state);
    integrate_equations::<MOST, WithEnds, _>(equations, model, state, integration, budget)
}

/// Methods for gears without teeth that are not compiled for them.
#[inline(never)]
fn ideal_by_table((ideal, model, state, integration, budget): Arguments<IdealWithEffects>) -> Result<(), StepFailure> {
    let equations: &mut dyn LedgerEquations<MEDIUM> =
        &mut Widened(IdealEquations::new(ideal, integration.inputs, state));
    integrate_equations::<MEDIUM, Any, _>(equations, model, state, integration, budget)
}

/// Plain teeth, and effects on planets in one or two groups: compiled as a whole for each shape.
#[inline(never)]
fn whole<const N: usize, S: Shape<N>>(
    (teeth, model, state, integration, budget): Arguments<Teeth>,
) -> Result<(), StepFailure> {
    let equations = &mut Equations::<S, N>::new(teeth, integration.inputs, state);
    integrate_equations::<N, S, _>(equations, model, state, integration, budget)
}

/// All other teeth and methods: the integration calls their forces through a table of functions.
#[inline(never)]
fn by_table<const N: usize>((teeth, model, state, integration, budget): Arguments<Teeth>) -> Result<(), StepFailure> {
    let equations: &mut dyn LedgerEquations<N> = &mut Equations::<Any, N>::new(teeth, integration.inputs, state);
    integrate_equations::<N, Any, _>(equations, model, state, integration, budget)
}

/// Integrates with the method of the scene, as far as it is compiled for the shape: [`integrate_teeth`] chooses the shape accordingly.
fn integrate_equations<const N: usize, S: Shape<N>, E: LedgerEquations<N> + ?Sized>(
    equations: &mut E,
    model: &Model,
    state: &mut State,
    integration: Integration,
    budget: &mut u64,
) -> Result<(), StepFailure> {
    let solver = &model.parameters.solver;
    let Integration { clock, begin, is_shown, pauses, inputs, change, watched } = integration;
    let before = state.statistics;
    let mut course = Course {
        longest: LONGEST,
        resolution: RESOLUTION,
        expected: clock.expected,
        ..Course::new(state.point(), clock.time, clock.end)
    };
    // resume the step that leads beyond the present
    if let Some(pending_step) = &state.pending_step {
        pending_step.resume(&mut course);
        course.end_at(clock.end);
        if let Some((time, jump)) = change {
            equations.acting_mut().change = inputs.torques_since(&pending_step.inputs);
            if !course.change_at(time, jump) {
                // it begins at the change
                state.control.jump(Some(jump));
            }
        }
    }
    // on the way to the end of the equations the clock need not be set back: that end is near
    let set_back_at = if clock.now < clock.end { LONGEST_INTERVAL } else { f64::INFINITY };
    let mut outcome = Ok(());
    let mut switched = true;
    let mut anchors = equations.acting().anchors();
    let feels_temperature = model.thermal.is_some() && model.body_effects().feels_temperature();
    if feels_temperature {
        course.longest = LONGEST.min(state.thermal.longest);
    }
    while switched && outcome.is_ok() {
        switched = false;
        let State { control, statistics, rattle, work, heat, torque_means, thermal, .. } = state;
        let mut sums = LedgerSums { begin, work, heat, thermal, torque_means, watched: &mut *watched };
        // what an accepted step leaves behind
        let mut observe = |step: Step<N, LedgerRates>, motion: Option<(&Extension<N>, f64)>| {
            if !is_shown {
                rattle.add_step(equations.check_deflection(step.end)?);
            }
            equations.record(model, (&step, motion), &mut sums);
            equations.drag_anchors(step.end, &step.ledger_rates[2], &mut anchors);
            switched = equations.is_friction_due(step.end, step.time);
            let is_warmer = feels_temperature && sums.thermal.is_to_be_felt();
            Ok(if switched || is_warmer || step.time >= set_back_at { AfterStep::Stop } else { AfterStep::Continue })
        };
        let context = SolverContext { tolerance: solver.relative_tolerance, control, statistics, budget };
        let system = &*equations;
        outcome = match solver.method {
            Method::FixedStep if S::HAS_FIXED_STEPS => {
                let (counts, Course { point, time, end, .. }) = ((context.statistics, context.budget), &mut course);
                let observe = |step: Step<N, LedgerRates>| observe(step, None);
                integrate::advance_fixed(system, point, time, *end, solver.fixed_step, counts, observe)
            }
            Method::Radau if S::HAS_RADAU => {
                integrate::proceed(&Radau, system, &mut course, clock.now, context, |step, motion| {
                    observe(step, Some(motion))
                })
            }
            _ => integrate::proceed(&Rodas5P, system, &mut course, clock.now, context, |step, motion| {
                observe(step, Some(motion))
            }),
        };
        equations.acting_mut().anchor(&anchors);
        let is_warmer = feels_temperature && state.thermal.is_to_be_felt();
        // the equations change: temperatures that bodies feel, and friction
        if is_warmer {
            state.thermal.feel();
            course.longest = LONGEST.min(state.thermal.longest);
            equations.acting_mut().feel(model.body_effects(), state.lock, &state.thermal.felt);
        }
        if switched {
            let before = equations.acting().friction_state;
            equations.settle_friction(&course.point, course.time, 0..FRICTION_BODIES, &mut state.heat);
            anchors = equations.acting().anchors();
            let friction = [&before, &equations.acting().friction_state];
            let is_event = state.events.record_friction(friction, begin + course.time);
            if is_event && pauses && course.time < clock.now {
                clock.now = course.time;
            }
        }
        switched = (switched || is_warmer) && course.time < set_back_at && course.end - course.time > RESOLUTION;
    }
    state.friction = equations.acting().friction_state;
    state.set_point(&course.point);
    clock.time = course.time;
    match &course.pending {
        Some(pending) if outcome.is_ok() => {
            let pending = (pending, &course.extension);
            state.pending_step.get_or_insert_default().set(pending, *clock, inputs);
        }
        _ => state.pending_step = None,
    }
    outcome.map_err(|failure| explain(failure, begin + clock.time, (model, inputs, state), &before))
}

/// Attempts at steps of plain teeth granted to one call: bounds the time that a host can be kept waiting to some seconds.
const BUDGET: u64 = 2_000_000;
/// What effects that act on bodies add: drag, shafts, dry friction.
const EFFECTS: usize = 3;
/// Entries of the matrices of plain teeth with planets that are alike.
const PLAIN: usize = 16;
/// What a step of ideal gears with all effects costs at most.
const IDEAL: usize = 2;
/// Cost of a step of `radau`, which iterates, at most in steps of the default method.
const RADAU_IN_STEPS: usize = 8;

/// Attempts at steps granted to one call: the fewer, the more each costs.
pub fn budget(model: &Model) -> u64 {
    let Gears::Teeth(teeth) = &model.gears else { return BUDGET / IDEAL as u64 };
    let work = teeth.contact.work(model.parameters.solid.facets as usize, teeth.layout.groups);
    let has_effects = teeth.effect_terms.body_effects.has_effects || teeth.effect_terms.is_watched;
    let effects = if has_effects { EFFECTS } else { 0 };
    // matrices of few rows cost by their number of entries
    let freedoms = teeth.layout.count();
    let steps = if model.parameters.solver.method == Method::Radau { RADAU_IN_STEPS } else { 1 };
    BUDGET / ((work.max(freedoms * freedoms / PLAIN) + effects) * steps) as u64
}

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
        Failure::NotClosed => "the energy balance of a step does not close up to where torques change".into(),
        Failure::StepTooSmall { size } => format!(
            "the step size fell to {size:.3e} s, below what time can resolve; look at the inputs, \
             or loosen solver.relative_tolerance = {tolerance:e}"
        ),
        Failure::Diverged => format!(
            "a step of solver.fixed_step = {:e} s could not be solved; make it shorter, or take solver.method = adaptive",
            solver.fixed_step
        ),
        Failure::TooManySteps => format!(
            "{} attempts at steps were not enough for one communication step: {}; shorten it, \
             loosen solver.relative_tolerance = {tolerance:e}, or {}",
            budget(model),
            effort::too_many_steps(model, inputs, state, before),
            effort::fewer_steps(model, state)
        ),
    };
    StepFailure { time, message }
}
