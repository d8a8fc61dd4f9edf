//! Integration of a stretch of time, with its ledger: work, heat, mesh cycles, fatigue, switches of dry friction.

use super::failure::ExcessiveDeflection;
use super::{Recorded, Records, StepFailure, hints};
use crate::contact::Law;
use crate::integrate::{
    self, AfterStep, Compared, Course, Failure, Pending, Rodas5P, SecondOrder, SolverContext, Step,
};
use crate::model::assembly::rigid::MOST;
use crate::model::assembly::{Gears, Model, Teeth};
use crate::model::dynamics::power::Power;
use crate::model::dynamics::sizes::{DIFFERENT, EXACT, LEAST};
use crate::model::dynamics::{Clock, Equations, LARGEST, RigidEquations, State, Watched};
use crate::model::scene::{FRICTION_BODIES, Inputs, MAX_GROUPS, Method};

/// Attempts at steps of plain teeth granted to one call: bounds the time that a host can be kept waiting to some seconds.
const BUDGET: u64 = 2_000_000;
/// What a section of solid teeth costs in meshes of plain teeth: by facet of a flank, and the least.
const SOLID_PER_FACET: usize = 2;
const LEAST_SOLID: usize = 40;
/// What the meshes of a planet on elastic gear bodies cost at most, where a dozen pairs move each other.
const ON_BODIES: usize = 16;
/// What effects that act on bodies add: drag, shafts, dry friction.
const EFFECTS: usize = 3;
/// Entries of the matrices of plain teeth with planets that are alike.
const PLAIN: usize = 16;
/// What a step of Radau costs in steps of the other methods.
const RADAU_IN_STEPS: usize = 8;

/// Longest stretch integrated before positions are wrapped and the clock is set back [s].
pub const STRETCH: f64 = 1.0;
/// Longest step [s].
const LONGEST: f64 = STRETCH;
/// What a double can resolve of times up to the length of a stretch [s].
const RESOLUTION: f64 = 4.0 * f64::EPSILON * STRETCH;

/// Attempts at steps granted to one call: the fewer, the more each costs.
pub fn budget(model: &Model) -> u64 {
    let Gears::Teeth(teeth) = &model.gears else { return BUDGET };
    let work = match &teeth.mesh.law {
        // few facets have many neighbours, many facets are many
        Law::Solid(solid) => {
            solid.section_count() * (SOLID_PER_FACET * model.parameters.solid.facets as usize).max(LEAST_SOLID)
        }
        _ => {
            let in_detail = if teeth.additions.in_detail { teeth.additions.detailed.face.points() } else { 0 };
            let on_bodies = if teeth.shared.is_some() { ON_BODIES } else { 0 };
            ((in_detail + on_bodies) * teeth.layout.groups).max(1)
        }
    };
    let effects = if teeth.additions.bodies.always { EFFECTS } else { 0 };
    // matrices of few rows cost by their number of entries, and an implicit step that iterates some steps that do not
    let freedoms = teeth.layout.count();
    let steps = if model.parameters.solver.method == Method::Radau { RADAU_IN_STEPS } else { 1 };
    BUDGET / ((work.max(freedoms * freedoms / PLAIN) + effects) * steps) as u64
}

/// What to integrate.
pub struct Stretch<'a> {
    /// The integrator's clock.
    pub clock: &'a mut Clock,
    /// Time at which it shows zero [s].
    pub begin: f64,
    /// Whether the time to integrate to was shown before: then it is too late to refuse a tooth that bends too far.
    pub is_shown: bool,
    /// Inputs that act.
    pub inputs: &'a Inputs,
    /// What steps are watched for.
    pub watched: &'a mut Watched,
}

/// Integrates the motion of `state` until the step ahead contains the clock's `now`, the equations end, or the clock is to
/// be set back.
pub fn integrate(model: &Model, state: &mut State, stretch: Stretch, budget: &mut u64) -> Result<(), StepFailure> {
    match &model.gears {
        Gears::Rigid(rigid) => {
            let equations: &mut dyn Recorded<MOST> = &mut RigidEquations::new(rigid, stretch.inputs, state);
            integrate_stretch::<MOST, true, _>(equations, model, state, stretch, budget)
        }
        Gears::Teeth(teeth) => integrate_teeth(teeth, model, state, stretch, budget),
    }
}

/// The same with `teeth`, which may have planets together that the model has apart.
pub fn integrate_teeth(
    teeth: &Teeth,
    model: &Model,
    state: &mut State,
    stretch: Stretch,
    budget: &mut u64,
) -> Result<(), StepFailure> {
    let method = model.parameters.solver.method;
    if method == Method::Adaptive && !teeth.additions.bodies.act_in(state) {
        return match teeth.layout.groups {
            1 => whole::<LEAST, 1, false>(teeth, model, state, stretch, budget),
            2 => whole::<DIFFERENT, 2, false>(teeth, model, state, stretch, budget),
            _ => whole::<7, MAX_GROUPS, false>(teeth, model, state, stretch, budget),
        };
    }
    let is_default = method == Method::Adaptive;
    match (teeth.layout.groups, teeth.layout.plain()) {
        (1, Some(false)) if is_default || method == Method::FixedStep => {
            whole::<LEAST, 1, true>(teeth, model, state, stretch, budget)
        }
        (2, Some(false)) if is_default => whole::<DIFFERENT, 2, true>(teeth, model, state, stretch, budget),
        (1, Some(true)) if is_default => whole::<EXACT, 1, true>(teeth, model, state, stretch, budget),
        _ if teeth.layout.count() <= MOST => by_table::<MOST, MAX_GROUPS>(teeth, model, state, stretch, budget),
        _ => by_table::<LARGEST, MAX_GROUPS>(teeth, model, state, stretch, budget),
    }
}

/// Plain teeth, and effects on two planets: compiled as a whole for each size.
#[inline(never)]
fn whole<const N: usize, const G: usize, const WITH_EFFECTS: bool>(
    teeth: &Teeth,
    model: &Model,
    state: &mut State,
    stretch: Stretch,
    budget: &mut u64,
) -> Result<(), StepFailure> {
    let equations = &mut Equations::<N, G, WITH_EFFECTS>::new(teeth, stretch.inputs, state);
    integrate_stretch::<N, WITH_EFFECTS, _>(equations, model, state, stretch, budget)
}

/// Teeth with any effects on more: the integration calls their forces through a table of functions.
#[inline(never)]
fn by_table<const N: usize, const G: usize>(
    teeth: &Teeth,
    model: &Model,
    state: &mut State,
    stretch: Stretch,
    budget: &mut u64,
) -> Result<(), StepFailure> {
    let equations: &mut dyn Recorded<N> = &mut Equations::<N, G, true>::new(teeth, stretch.inputs, state);
    integrate_stretch::<N, true, _>(equations, model, state, stretch, budget)
}

/// By any method, or by the default one alone. Those that are there to compare with are not compiled in small sizes, and steps of
/// fixed size in the least of them alone: [`integrate_teeth`] knows.
fn integrate_stretch<const N: usize, const ANY_METHOD: bool, E: Recorded<N> + ?Sized>(
    equations: &mut E,
    model: &Model,
    state: &mut State,
    stretch: Stretch,
    budget: &mut u64,
) -> Result<(), StepFailure> {
    let solver = &model.parameters.solver;
    let Stretch { clock, begin, is_shown, inputs, watched } = stretch;
    let mut course = Course {
        longest: LONGEST,
        resolution: RESOLUTION,
        expected: clock.expected,
        ..Course::new(state.point(), clock.time, clock.end)
    };
    if let Some(ahead) = &state.ahead {
        ahead.resume(&mut course);
        course.end_at(clock.end);
    }
    // where the end is near the clock need not be set back
    let longest = if clock.now < clock.end { STRETCH } else { f64::INFINITY };
    let mut outcome = Ok(());
    let mut switched = true;
    let mut anchors = equations.acting().anchors();
    while switched && outcome.is_ok() {
        switched = false;
        let State { control, statistics, work, heat, bias, .. } = state;
        let mut records = Records { begin, work, heat, bias, watched: &mut *watched };
        let mut observe = |step: Step<N, Power>, pending: Option<&Pending<N, Power>>| {
            if !is_shown {
                equations.admit(step.end)?;
            }
            equations.record(model, (&step, pending), &mut records);
            equations.drag_anchors(step.end, &step.power[2], &mut anchors);
            switched = equations.is_friction_due(step.end, step.time);
            Ok(if switched || step.time >= longest { AfterStep::Stop } else { AfterStep::Continue })
        };
        let context = SolverContext { tolerance: solver.relative_tolerance, control, statistics, budget };
        let system = &*equations;
        outcome = match solver.method {
            Method::FixedStep if ANY_METHOD && (N == LEAST || N > EXACT) => {
                let (counts, Course { point, time, end, .. }) = ((context.statistics, context.budget), &mut course);
                let observe = |step: Step<N, Power>| observe(step, None);
                integrate::advance_fixed(system, point, time, *end, solver.fixed_step, counts, observe)
            }
            other => match other_than_default(other) {
                Some(other) if ANY_METHOD && N > EXACT => {
                    compared(&other, system, &mut course, clock.now, context, &mut observe)
                }
                _ => integrate::proceed(&Rodas5P, system, &mut course, clock.now, context, |step, pending| {
                    observe(step, Some(pending))
                }),
            },
        };
        equations.acting_mut().anchor(&anchors);
        if switched {
            equations.settle_friction(&course.point, course.time, 0..FRICTION_BODIES, &mut state.heat);
            anchors = equations.acting().anchors();
            switched = course.time < longest && course.end - course.time > RESOLUTION;
        }
    }
    state.friction = equations.acting().friction_state;
    state.set_point(&course.point);
    clock.time = course.time;
    match &course.pending {
        Some(pending) if outcome.is_ok() => {
            state.ahead.get_or_insert_default().set(pending, *clock, inputs);
        }
        _ => state.ahead = None,
    }
    outcome.map_err(|failure| explain(failure, begin + clock.time, model))
}

/// The method that `method` names, if it is one to compare the default with.
fn other_than_default(method: Method) -> Option<Compared> {
    match method {
        Method::Radau => Some(Compared::Radau),
        Method::Rodas4 => Some(Compared::Rodas4),
        Method::DormandPrince => Some(Compared::DormandPrince),
        Method::Adaptive | Method::FixedStep => None,
    }
}

/// What looks at completed steps, each with what it was while pending.
type Observer<'a, const N: usize> =
    &'a mut dyn FnMut(Step<N, Power>, Option<&Pending<N, Power>>) -> Result<AfterStep, ExcessiveDeflection>;

/// Integrates by another method of variable steps than the default.
#[inline(never)]
fn compared<const N: usize>(
    method: &Compared,
    system: &(impl SecondOrder<N, Power = Power> + ?Sized),
    course: &mut Course<N, Power>,
    until: f64,
    context: SolverContext,
    observe: Observer<N>,
) -> Result<(), Failure<ExcessiveDeflection>> {
    integrate::proceed(method, system, course, until, context, |step, pending| observe(step, Some(pending)))
}

fn explain(failure: Failure<ExcessiveDeflection>, time: f64, model: &Model) -> StepFailure {
    let solver = &model.parameters.solver;
    let tolerance = solver.relative_tolerance;
    let message = match failure {
        Failure::Refused(tooth) => tooth.message(model),
        Failure::StepTooSmall { size } => format!(
            "the step size fell to {size:.3e} s, below what time can resolve; look at the inputs, \
             or loosen solver.relative_tolerance = {tolerance:e}"
        ),
        Failure::Diverged => format!(
            "a step of solver.fixed_step = {:e} s could not be solved; make it shorter, or take solver.method = adaptive",
            solver.fixed_step
        ),
        Failure::TooManySteps => format!(
            "{} attempts at steps were not enough for one communication step; shorten it, \
             loosen solver.relative_tolerance = {tolerance:e}, or {}",
            budget(model),
            hints::more_damping(&model.parameters)
        ),
    };
    StepFailure { time, message }
}
