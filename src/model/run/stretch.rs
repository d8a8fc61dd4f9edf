//! Integration of a stretch of time, with its ledger: work, heat, mesh cycles, fatigue, switches of dry friction.

use super::excessive_deflection::ExcessiveDeflection;
use super::failure::StepFailure;
use super::hints;
use super::ledger::{Recorded, Records};
use crate::contact::mesh::Law;
use crate::integrate::{
    self, AfterStep, Course, DormandPrince, DynSecondOrder, DynSystem, Failure, Pending, Radau, Rodas4, Rodas5P,
    SolverContext, Step,
};
use crate::model::assembly::model::{Gears, Model};
use crate::model::dynamics::clock::Clock;
use crate::model::dynamics::power::Power;
use crate::model::dynamics::state::State;
use crate::model::dynamics::watched::Watched;
use crate::model::scene::{Inputs, Method, SolverSpec};
use crate::numeric::lanes::{Task, in_lanes};

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
/// be set back. Compiled once for each size and width of vectors, whoever calls it.
#[inline(never)]
pub fn integrate<const N: usize, E: Recorded<N>>(
    equations: &mut E,
    model: &Model,
    state: &mut State,
    stretch: Stretch,
    budget: &mut u64,
) -> Result<(), StepFailure> {
    in_lanes(Integration::<N, E> { equations, model, state, stretch, budget })
}

/// The integration of a stretch, as a task for vectors of any width.
struct Integration<'a, const N: usize, E> {
    equations: &'a mut E,
    model: &'a Model,
    state: &'a mut State,
    stretch: Stretch<'a>,
    budget: &'a mut u64,
}

impl<const N: usize, E: Recorded<N>> Task for Integration<'_, N, E> {
    type Output = Result<(), StepFailure>;

    #[inline]
    fn run(self) -> Self::Output {
        let Self { equations, model, state, stretch, budget } = self;
        integrate_stretch(equations, model, state, stretch, budget)
    }
}

#[inline]
fn integrate_stretch<const N: usize, E: Recorded<N>>(
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
    let mut anchors = equations.friction_state().map(|state| state.anchor);
    while switched && outcome.is_ok() {
        switched = false;
        let State { control, statistics, work, heat, bias, .. } = state;
        let mut records = Records { begin, work, heat, bias, watched: &mut *watched };
        let mut observe = |step: Step<N, Power>, pending: Option<&Pending<N, Power>>| {
            if !is_shown {
                equations.admit(step.end)?;
            }
            equations.record(model, (&step, pending), &mut records);
            equations.drag(step.end, &step.power[2], &mut anchors);
            switched = equations.is_due(step.end, step.time);
            Ok(if switched || step.time >= longest { AfterStep::Stop } else { AfterStep::Continue })
        };
        let context = SolverContext { tolerance: solver.relative_tolerance, control, statistics, budget };
        outcome = if solver.method == Method::Adaptive {
            integrate::proceed(&Rodas5P, &*equations, &mut course, clock.now, context, |step, pending| {
                observe(step, Some(pending))
            })
        } else {
            otherwise(solver, &*equations, &mut course, clock.now, context, &mut observe)
        };
        equations.anchor(&anchors);
        if switched {
            equations.settle(&course.point, course.time, &mut state.heat);
            anchors = equations.friction_state().map(|state| state.anchor);
            switched = course.time < longest && course.end - course.time > RESOLUTION;
        }
    }
    state.friction = *equations.friction_state();
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

/// What looks at completed steps, each with what it was while pending.
type Observer<'a, const N: usize> =
    &'a mut dyn FnMut(Step<N, Power>, Option<&Pending<N, Power>>) -> Result<AfterStep, ExcessiveDeflection>;

/// Integrates by another method than the default.
#[inline(never)]
fn otherwise<const N: usize>(
    solver: &SolverSpec,
    system: &dyn DynSecondOrder<N, Power>,
    course: &mut Course<N, Power>,
    until: f64,
    context: SolverContext,
    observe: Observer<N>,
) -> Result<(), Failure<ExcessiveDeflection>> {
    let system = &DynSystem(system);
    let extended = |step: Step<N, Power>, pending: &Pending<N, Power>| observe(step, Some(pending));
    match solver.method {
        Method::Adaptive => integrate::proceed(&Rodas5P, system, course, until, context, extended),
        Method::Radau => integrate::proceed(&Radau, system, course, until, context, extended),
        Method::Rodas4 => integrate::proceed(&Rodas4, system, course, until, context, extended),
        Method::DormandPrince => integrate::proceed(&DormandPrince, system, course, until, context, extended),
        Method::FixedStep => {
            let counts = (context.statistics, context.budget);
            let Course { point, time, end, .. } = course;
            integrate::advance_fixed(system, point, time, *end, solver.fixed_step, counts, |step| observe(step, None))
        }
    }
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
