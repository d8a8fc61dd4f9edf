//! A step that is over, and the motion in it.

use crate::integrate::{Extension, Pending, Point, SecondOrder, Step};
use crate::model::dynamics::power::Power;

/// A completed step, and the same while it was pending.
pub type CompletedStep<'a, 'b, const N: usize> = (&'a Step<'b, N, Power>, Option<&'a Pending<N, Power>>);

/// The motion in a step, and the part of it that was taken.
pub fn extension<const N: usize>(
    equations: &impl SecondOrder<N>,
    (step, pending): CompletedStep<N>,
) -> (Extension<N>, f64) {
    match pending {
        Some(pending) => (pending.extension, pending.part),
        None => (cubic(equations, step), 1.0),
    }
}

/// A continuous extension of a step without one: positions by the cubic through both ends, velocities in proportion.
fn cubic<const N: usize>(equations: &impl SecondOrder<N>, step: &Step<N, Power>) -> Extension<N> {
    let Step { h, start, end, .. } = *step;
    let [before, after] = [start, end].map(|at| equations.rates(&at.v));
    let mut bends = [Point::ZERO; 3];
    for i in 0..N {
        let change = end.q[i] - start.q[i];
        let [first, last] = [h * before[i] - change, change - h * after[i]];
        (bends[0].q[i], bends[1].q[i]) = (first, last - first);
    }
    Extension { start: *start, end: *end, bends }
}
