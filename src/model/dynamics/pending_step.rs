//! The pending step: the integrator's step that contains the present. Its dense output gives the motion at the present.
//! The integrator's clock advances only with completed steps, so that steps do not depend on the times that the host
//! requests.

use serde::{Deserialize, Serialize};

use super::ledger_rates::LedgerRates;
use super::timeline::Clock;
use crate::integrate::{Extension, Pending, Point, Trajectory, extended};
use crate::model::scene::MAX_DOF;
use crate::numeric::Finite;

/// Positions and velocities of all degrees of freedom.
type Motion = [[f64; MAX_DOF]; 2];

/// Step that has passed the error test but is not completed, because it ends beyond the present.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct PendingStep {
    /// Clock with the start of the step, the present time, and the time up to which the equations are valid.
    pub clock: Clock,
    step: Pending<LedgerRates>,
    start: Motion,
    end: Motion,
    /// Coefficients of the dense output (`integrate::Extension`).
    coefficients: [Motion; 3],
}

impl PendingStep {
    /// Stores the pending `step` with its dense output.
    pub fn set<const N: usize>(&mut self, (step, extension): (&Pending<LedgerRates>, &Extension<N>), clock: Clock) {
        let Extension { start, end, coefficients } = extension;
        (self.clock, self.step) = (clock, *step);
        store(start, &mut self.start);
        store(end, &mut self.end);
        for (coefficient, stored) in coefficients.iter().zip(&mut self.coefficients) {
            store(coefficient, stored);
        }
    }

    /// Restores the point and the pending step of `trajectory`, but not its times.
    pub fn resume<const N: usize>(&self, trajectory: &mut Trajectory<N, LedgerRates>) {
        let (start, end) = (restored(&self.start), restored(&self.end));
        let coefficients = [0, 1, 2].map(|k| restored(&self.coefficients[k]));
        trajectory.extension = Extension { start, end, coefficients };
        (trajectory.point, trajectory.pending) = (start, Some(self.step));
    }

    /// Copies the motion of degree of freedom `first` to degree of freedom `i`.
    pub fn let_follow(&mut self, i: usize, first: usize) {
        let Self { start, end, coefficients: [one, two, three], .. } = self;
        for motion in [start, end, one, two, three] {
            motion.iter_mut().for_each(|of| of[i] = of[first]);
        }
    }

    /// End of the step on the integrator's clock [s].
    #[inline]
    pub fn end(&self) -> f64 {
        self.clock.time + self.step.h
    }

    /// Writes the first `n` positions and velocities at the present to `q` and `v`.
    #[inline]
    pub fn write_motion(&self, n: usize, [q, v]: [&mut [f64; MAX_DOF]; 2]) {
        let fraction = (self.clock.now - self.clock.time) / self.step.h;
        for (k, to) in [q, v].into_iter().enumerate() {
            if fraction >= 1.0 {
                to[..n].copy_from_slice(&self.end[k][..n]);
                continue;
            }
            for i in 0..n.min(MAX_DOF) {
                let coefficients = [self.coefficients[0][k][i], self.coefficients[1][k][i], self.coefficients[2][k][i]];
                to[i] = extended(self.start[k][i], self.end[k][i], coefficients, fraction);
            }
        }
    }

    /// True if a simulation can continue from this step: all numbers are finite, and the step size is positive.
    pub fn is_valid(&self) -> bool {
        let Self { clock, step, start, end, coefficients } = self;
        let is_motion_finite = start.is_finite() && end.is_finite() && coefficients.is_finite();
        is_motion_finite && clock.is_valid() && step.is_valid()
    }
}

fn store<const N: usize>(point: &Point<N>, [q, v]: &mut Motion) {
    point.write([q, v]);
}

fn restored<const N: usize>([q, v]: &Motion) -> Point<N> {
    Point::of([q, v])
}
