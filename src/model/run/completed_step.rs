//! Completed steps, and the motion within them.

use crate::integrate::{Extension, Point, SecondOrder, Step};
use crate::model::dynamics::MAX_SIZE;
use crate::model::dynamics::ledger_rates::LedgerRates;

/// Motion within a completed step, for equations of any size.
pub struct StepMotion {
    /// Size of the step [s].
    pub h: f64,
    /// Time at the start of the step [s].
    pub begin: f64,
    /// Dense output of the pending step. The completed step may end within it.
    pub extension: Extension<MAX_SIZE>,
    /// Fraction of the pending step that was accepted.
    pub accepted_fraction: f64,
    /// True if the step has no dense output, so that only both ends are known. The extension is then a [`cubic`], in
    /// which deflections of stiff teeth may overshoot.
    pub ends_only: bool,
}

impl StepMotion {
    /// Motion within a completed step whose times count from `begin` [s].
    pub fn new<const N: usize>(equations: &impl SecondOrder<N>, step: &Step<N, LedgerRates>, begin: f64) -> Self {
        let without;
        let (Extension { start, end, coefficients }, accepted_fraction) = match step.dense_output {
            Some(dense_output) => dense_output,
            None => {
                without = cubic(equations, step);
                (&without, 1.0)
            }
        };
        let largest = |at: &Point<N>| Point::of([&at.q, &at.v]);
        let coefficients = coefficients.each_ref().map(largest);
        let extension = Extension { start: largest(start), end: largest(end), coefficients };
        let ends_only = step.dense_output.is_none();
        Self { h: step.h, begin: begin + step.time - step.h, extension, accepted_fraction, ends_only }
    }
}

/// Dense output for a step without one: positions follow the cubic through both ends, velocities are interpolated
/// linearly.
fn cubic<const N: usize>(equations: &impl SecondOrder<N>, step: &Step<N, LedgerRates>) -> Extension<N> {
    let Step { h, start, end, .. } = *step;
    let [before, after] = [start, end].map(|at| equations.rates(&at.v));
    let mut coefficients = [Point::ZERO; 3];
    for i in 0..N {
        let change = end.q[i] - start.q[i];
        let [first, last] = [h * before[i] - change, change - h * after[i]];
        (coefficients[0].q[i], coefficients[1].q[i]) = (first, last - first);
    }
    Extension { start: *start, end: *end, coefficients }
}
