//! A step that is over, and the motion in it.

use crate::integrate::{Extension, Point, SecondOrder, Step};
use crate::model::dynamics::LARGEST;
use crate::model::dynamics::ledger_rates::LedgerRates;

/// A completed step, the motion that it was while pending, and the part of it that was taken.
pub type CompletedStep<'a, 'b, const N: usize> = (&'a Step<'b, N, LedgerRates>, Option<(&'a Extension<N>, f64)>);

/// The motion in a completed step, for equations of any size.
pub struct Passed {
    /// Size of the step [s].
    pub h: f64,
    /// Time at its begin [s].
    pub begin: f64,
    /// The motion in it.
    pub extension: Extension<LARGEST>,
    /// Part of the step that was taken.
    pub part: f64,
}

impl Passed {
    /// The step `completed`, whose times count from `begin` [s].
    pub fn new<const N: usize>(equations: &impl SecondOrder<N>, (step, motion): CompletedStep<N>, begin: f64) -> Self {
        let without;
        let (Extension { start, end, coefficients }, part) = match motion {
            Some(motion) => motion,
            None => {
                without = cubic(equations, step);
                (&without, 1.0)
            }
        };
        let largest = |at: &Point<N>| Point::of([&at.q, &at.v]);
        let coefficients = coefficients.each_ref().map(largest);
        let extension = Extension { start: largest(start), end: largest(end), coefficients };
        Self { h: step.h, begin: begin + step.time - step.h, extension, part }
    }
}

/// A continuous extension of a step without one: positions by the cubic through both ends, velocities in proportion.
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
