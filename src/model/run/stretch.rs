//! Integration of a stretch of time, with its ledger: work, heat, mesh cycles, fatigue, switches of dry friction.

use super::excessive_deflection::ExcessiveDeflection;
use super::failure::StepFailure;
use super::hints;
use super::ledger::{Recorded, Records};
use crate::contact::mesh::Law;
use crate::integrate::{
    self, AfterStep, DormandPrince, DynSecondOrder, DynSystem, Failure, Point, Radau, Rodas4, Rodas5P, SolverContext,
    Step,
};
use crate::model::assembly::model::{Gears, Model};
use crate::model::dynamics::power::Power;
use crate::model::dynamics::state::State;
use crate::model::scene::{Method, SolverSpec};

/// Attempts at steps of plain teeth granted to one call: bounds the time that a host can be kept waiting to some seconds.
const BUDGET: u64 = 2_000_000;
/// What a section of solid teeth costs in meshes of plain teeth: by facet of a flank, and the least.
const SOLID_PER_FACET: usize = 6;
const LEAST_SOLID: usize = 128;
/// Entries of the matrices of plain teeth with planets that are alike.
const PLAIN: usize = 16;
/// What a step of Radau costs in steps of the other methods.
const RADAU_IN_STEPS: usize = 8;

/// Attempts at steps granted to one call: the fewer, the more each costs.
pub fn budget(model: &Model) -> u64 {
    let Gears::Teeth(teeth) = &model.gears else { return BUDGET };
    let work = match &teeth.mesh.law {
        // few facets have many neighbours, many facets are many
        Law::Solid(solid) => {
            solid.section_count() * (SOLID_PER_FACET * model.parameters.solid.facets as usize).max(LEAST_SOLID)
        }
        _ if teeth.additions.in_detail => teeth.additions.detailed.face.points() * teeth.layout.groups,
        _ => 1,
    };
    // matrices of few rows cost by their number of entries, and an implicit step that iterates some steps that do not
    let freedoms = teeth.layout.count();
    let steps = if model.parameters.solver.method == Method::Radau { RADAU_IN_STEPS } else { 1 };
    BUDGET / (work.max(freedoms * freedoms / PLAIN) * steps) as u64
}

/// Integrates to `until` [s].
pub fn integrate<const N: usize, E: Recorded<N>>(
    mut equations: E,
    model: &Model,
    state: &mut State,
    until: f64,
    budget: &mut u64,
) -> Result<(), StepFailure> {
    let solver = &model.parameters.solver;
    // the equations do not know the time: counted from here it is resolved as finely as steps can get
    let (mut point, mut time) = (state.point(), 0.0);
    let end = until - state.time;
    let mut good = (point, time);
    let mut outcome = Ok(());
    let mut switched = true;
    let mut anchors = equations.friction_state().map(|state| state.anchor);
    while switched && time < end && outcome.is_ok() {
        switched = false;
        let State { time: begin, control, statistics, work, heat, bias, fatigue, .. } = state;
        let mut records = Records { begin: *begin, work, heat, bias, fatigue };
        let mut observe = |step: Step<N, Power>| {
            equations.record(model, &step, &mut records)?;
            equations.drag(step.end, &step.power[2], &mut anchors);
            good = (*step.end, step.time);
            if equations.is_due(step.end, step.time) {
                switched = true;
                return Ok(AfterStep::Stop);
            }
            Ok(AfterStep::Continue)
        };
        let context = SolverContext { tolerance: solver.relative_tolerance, control, statistics, budget };
        outcome = if solver.method == Method::Adaptive {
            integrate::advance(&Rodas5P, &equations, &mut point, &mut time, end, context, observe)
        } else {
            otherwise(solver, &equations, &mut point, &mut time, end, context, &mut observe)
        };
        equations.anchor(&anchors);
        if switched {
            equations.settle(&point, time, &mut state.heat);
            anchors = equations.friction_state().map(|state| state.anchor);
        }
    }
    state.friction = *equations.friction_state();
    state.set_point(&good.0);
    state.time += good.1;
    outcome.map_err(|failure| explain(failure, state.time, model))
}

/// Integrates by another method than the default.
#[inline(never)]
fn otherwise<const N: usize>(
    solver: &SolverSpec,
    system: &dyn DynSecondOrder<N, Power>,
    point: &mut Point<N>,
    time: &mut f64,
    until: f64,
    context: SolverContext,
    observe: &mut dyn FnMut(Step<N, Power>) -> Result<AfterStep, ExcessiveDeflection>,
) -> Result<(), Failure<ExcessiveDeflection>> {
    let system = &DynSystem(system);
    match solver.method {
        Method::Adaptive => integrate::advance(&Rodas5P, system, point, time, until, context, observe),
        Method::Radau => integrate::advance(&Radau, system, point, time, until, context, observe),
        Method::Rodas4 => integrate::advance(&Rodas4, system, point, time, until, context, observe),
        Method::DormandPrince => integrate::advance(&DormandPrince, system, point, time, until, context, observe),
        Method::FixedStep => {
            let counts = (context.statistics, context.budget);
            integrate::advance_fixed(system, point, time, until, solver.fixed_step, counts, observe)
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
