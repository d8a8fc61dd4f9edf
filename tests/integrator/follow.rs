//! Loops over the parts of a step, as in a simulation, for systems without events of their own.

use bevel_differential::integrate::{
    Failure, FixedSteps, Method, Point, SecondOrder, Solver, SolverContext, Statistics, Step, Trajectory,
};

/// Decision of an observer after a completed step.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum AfterStep {
    /// Continue to the end of the interval.
    Continue,
    /// Stop here.
    Stop,
}

/// Integrates from `time` to `until` with `method`. Calls `observe` after each completed step; the observer may end the
/// integration early.
pub fn advance<const N: usize, M: Method, S: SecondOrder<N>>(
    method: &M,
    system: &S,
    point: &mut Point<N>,
    time: &mut f64,
    until: f64,
    context: SolverContext,
    observe: impl FnMut(Step<N, S::Rates>) -> AfterStep,
) -> Result<(), Failure> {
    let mut trajectory = Trajectory::new(*point, *time, until);
    let outcome = proceed(method, system, &mut trajectory, until, context, observe);
    (*point, *time) = (trajectory.point, trajectory.time);
    outcome
}

/// Integrates until the pending step of `trajectory` contains `until`, or until the equations end.
pub fn proceed<const N: usize, M: Method, S: SecondOrder<N>>(
    method: &M,
    system: &S,
    trajectory: &mut Trajectory<N, S::Rates>,
    until: f64,
    context: SolverContext,
    mut observe: impl FnMut(Step<N, S::Rates>) -> AfterStep,
) -> Result<(), Failure> {
    let mut solver = Solver::new(method, system, context, trajectory);
    loop {
        let Some(pending) = &trajectory.pending else {
            solver.attempt(trajectory)?;
            continue;
        };
        let part = trajectory.accepted_part(pending);
        if trajectory.stays_pending(&part, until) {
            return Ok(());
        }
        let judged = solver.judge(trajectory, pending, &part);
        if !judged.is_balanced {
            solver.reject_ledger(trajectory, &part, &judged)?;
        } else if observe(solver.complete(trajectory, &part, judged)) == AfterStep::Stop || part.is_last {
            return Ok(());
        }
    }
}

/// Integrates from `time` to `until` in equal steps of at most `longest`.
pub fn advance_fixed<const N: usize, S: SecondOrder<N>>(
    system: &S,
    point: &mut Point<N>,
    time: &mut f64,
    until: f64,
    longest: f64,
    (statistics, budget): (&mut Statistics, &mut u64),
) -> Result<(), Failure> {
    let mut steps = FixedSteps::new(system, point, [*time, until], longest, statistics);
    while steps.next(point, time, (statistics, budget))?.is_some() {}
    Ok(())
}
