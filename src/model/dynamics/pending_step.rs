//! The pending step: the integrator's step that contains the present. Its dense output gives the motion at the present.
//!
//! The integrator has a separate clock. It starts near the present, so that a double resolves even the shortest steps.
//! It advances only with completed steps, so that steps do not depend on the times that the host requests.

use serde::{Deserialize, Serialize};

use super::ledger_rates::LedgerRates;
use crate::integrate::{Extension, Pending, Point, Trajectory, extended};
use crate::model::scene::{Inputs, MAX_DOF};
use crate::numeric::Finite;

/// Times on the integrator's clock [s].
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Clock {
    /// End of the last completed step.
    pub time: f64,
    /// Present time, or the target time of an integration.
    pub now: f64,
    /// Time up to which the present equations are valid, because a tooth breaks or inputs change then.
    pub end: f64,
    /// Time at which inputs are expected to change.
    pub expected: f64,
}

impl Clock {
    /// Clock that starts now.
    pub fn new(end: f64, expected: f64) -> Self {
        Self { time: 0.0, now: 0.0, end, expected }
    }

    /// Resets the clock to zero at the end of the last completed step. Returns the shift [s].
    pub fn set_back(&mut self) -> f64 {
        let by = self.time;
        *self = Self { time: 0.0, now: self.now - by, end: self.end - by, expected: self.expected - by };
        by
    }

    /// True if all times are valid. The end and the expected change may be infinite.
    pub fn is_valid(&self) -> bool {
        let Self { time, now, end, expected } = *self;
        [time, now].is_finite() && now >= time && !(end + expected).is_nan()
    }
}

/// Positions and velocities of all degrees of freedom.
type Motion = [[f64; MAX_DOF]; 2];

/// Step that has passed the error test but is not completed, because it ends beyond the present.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct PendingStep {
    /// Inputs during the step.
    pub inputs: Inputs,
    /// Clock with the start of the step, the present time, and the time up to which the equations are valid.
    pub clock: Clock,
    step: Pending<LedgerRates>,
    start: Motion,
    end: Motion,
    /// Coefficients of the dense output (`integrate::Extension`).
    coefficients: [Motion; 3],
}

impl PendingStep {
    /// Stores the step `pending` with its dense output.
    pub fn set<const N: usize>(
        &mut self,
        (step, extension): (&Pending<LedgerRates>, &Extension<N>),
        clock: Clock,
        inputs: &Inputs,
    ) {
        let Extension { start, end, coefficients } = extension;
        (self.inputs, self.clock, self.step) = (*inputs, clock, *step);
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
    pub fn motion(&self, n: usize, [q, v]: [&mut [f64; MAX_DOF]; 2]) {
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
        let Self { inputs, clock, step, start, end, coefficients } = self;
        let is_motion_finite = start.is_finite() && end.is_finite() && coefficients.is_finite();
        is_motion_finite && inputs.is_finite() && clock.is_valid() && step.is_valid()
    }
}

fn store<const N: usize>(point: &Point<N>, [q, v]: &mut Motion) {
    point.write([q, v]);
}

fn restored<const N: usize>([q, v]: &Motion) -> Point<N> {
    Point::of([q, v])
}
