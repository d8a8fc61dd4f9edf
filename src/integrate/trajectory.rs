//! Trajectory of an integration: the end of its last completed step, and the pending step after it.
//!
//! A step whose error is small enough is pending until a time beyond its end is requested. Until then, its dense output
//! gives the motion at any time within the step. Steps do not depend on the requested times.

use serde::{Deserialize, Serialize};

use super::Point;
use crate::numeric::Finite;

/// Dense output of a component, y(Θ) = y₀ + Θ ((y₁ − y₀) + (1−Θ) (b₀ + Θ (b₁ + Θ b₂))), from its values at both ends of
/// the step and the coefficients b. A component that does not change within the step keeps its bits.
#[inline]
pub fn extended(start: f64, end: f64, coefficients: [f64; 3], fraction: f64) -> f64 {
    let inner = coefficients[0] + fraction * (coefficients[1] + fraction * coefficients[2]);
    start + fraction * ((end - start) + (1.0 - fraction) * inner)
}

/// Dense output of a step, its continuous extension.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Extension<const N: usize> {
    /// Start of the step.
    pub start: Point<N>,
    /// End of the step.
    pub end: Point<N>,
    /// Coefficients b₀, b₁ and b₂ of [`extended`].
    pub coefficients: [Point<N>; 3],
}

impl<const N: usize> Extension<N> {
    /// No motion.
    pub const NONE: Self = Self { start: Point::ZERO, end: Point::ZERO, coefficients: [Point::ZERO; 3] };

    /// Returns the motion after a fraction of the step.
    #[inline]
    pub fn at(&self, fraction: f64) -> Point<N> {
        let Self { start, end, coefficients } = self;
        if fraction == 1.0 {
            return *end;
        }
        let mut at = Point::ZERO;
        let (start, end, coefficients) = (start.row(), end.row(), coefficients.each_ref().map(Point::row));
        for (i, at) in at.row_mut().iter_mut().enumerate() {
            *at = extended(start[i], end[i], [coefficients[0][i], coefficients[1][i], coefficients[2][i]], fraction);
        }
        at
    }

    /// Defect of the dense output halfway through a step of size `h` [s]: the `slope` from the equations minus the
    /// slope of the dense output.
    #[inline]
    pub fn defect(&self, slope: &Point<N>, h: f64) -> Point<N> {
        let Self { start, end, coefficients } = self;
        let per_h = 1.0 / h;
        let rise = |from: f64, to: f64, one: f64, two: f64| per_h * ((to - from) + 0.25 * (one + two));
        let mut defect = Point::ZERO;
        let (start, end, coefficients) = (start.row(), end.row(), coefficients.each_ref().map(Point::row));
        for (i, (defect, slope)) in defect.row_mut().iter_mut().zip(slope.row()).enumerate() {
            *defect = slope - rise(start[i], end[i], coefficients[1][i], coefficients[2][i]);
        }
        defect
    }
}

/// A step whose error is small enough and that is not completed yet.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Pending<P> {
    /// Size of the step [s].
    pub h: f64,
    /// Error of the step as a fraction of the tolerance.
    pub error: f64,
    /// True if the step is shorter than its error requires.
    pub cut: bool,
    /// True if the step ends on a kink.
    pub to_kink: bool,
    /// True if a longer step was rejected just before.
    pub after_rejection: bool,
    /// Number of consecutive attempts rejected immediately before this one because their ledger did not close.
    pub unbalanced: u32,
    /// Size of the first attempt in a row whose ledger did not close [s].
    pub first_unbalanced: f64,
    /// Number of consecutive steps up to this one that were cut at a switch but ended before it.
    pub short: u32,
    /// Ledger rates at the start and halfway.
    pub ledger_rates: [P; 2],
    /// Kinetic and stored energy at the start.
    pub energy: [f64; 2],
}

impl<P: Finite> Pending<P> {
    /// True if all numbers are finite and the step size is positive.
    pub fn is_valid(&self) -> bool {
        // all fields are listed, so that none can be forgotten
        let Self {
            h,
            error,
            cut: _,
            to_kink: _,
            after_rejection: _,
            unbalanced: _,
            first_unbalanced,
            short: _,
            ledger_rates,
            energy,
        } = self;
        [*h, *error, *first_unbalanced].is_finite() && ledger_rates.is_finite() && energy.is_finite() && *h > 0.0
    }
}

/// Part of the pending step that is accepted.
#[derive(Clone, Copy, Debug)]
pub struct Part {
    /// Size [s].
    pub h: f64,
    /// Time at its end [s].
    pub reached: f64,
    /// True if the equations end there.
    pub is_last: bool,
}

/// Motion of an integration: the last completed step, and the pending step.
#[derive(Clone, Copy, Debug)]
pub struct Trajectory<const N: usize, P> {
    /// End of the last completed step.
    pub point: Point<N>,
    /// Time of this point [s].
    pub time: f64,
    /// Step that starts at this point, if it is computed but not completed.
    pub pending: Option<Pending<P>>,
    /// Dense output of the pending step. Without a pending step, memory for the next dense output.
    pub extension: Extension<N>,
    /// Fraction of the pending step that is accepted: 1, unless the equations change within the step.
    pub accepted_fraction: f64,
    /// Change of the accelerations [rad/s²] if torques change at the end of the accepted fraction and the
    /// integration continues.
    pub acceleration_change: Option<f64>,
    /// Time at which these equations end because they change [s]. No step is completed beyond it.
    pub end: f64,
    /// Time at which these equations are expected to end [s]. Steps are fitted to this time but may pass it.
    pub expected: f64,
    /// Maximum step size [s].
    pub longest: f64,
    /// Smallest difference of times that a double can resolve [s].
    pub resolution: f64,
}

impl<const N: usize, P> Trajectory<N, P> {
    /// Starts an integration from `point` at `time` to `end` [s].
    pub fn new(point: Point<N>, time: f64, end: f64) -> Self {
        let resolution = 4.0 * f64::EPSILON * end.abs().max(time.abs()).max(1e-9);
        Self {
            point,
            time,
            pending: None,
            extension: Extension::NONE,
            accepted_fraction: 1.0,
            acceleration_change: None,
            end,
            expected: f64::INFINITY,
            longest: f64::INFINITY,
            resolution,
        }
    }

    /// Part of the `pending` step that is accepted.
    #[inline(always)]
    pub fn accepted_part(&self, pending: &Pending<P>) -> Part {
        let h = pending.h * self.accepted_fraction;
        let reached = self.time + h;
        let is_last = self.end - reached <= self.resolution;
        Part { h, reached: if is_last { self.end } else { reached }, is_last }
    }

    /// True if the pending step, of which this `part` is accepted, contains `until` [s] and need not be completed. A part
    /// at whose end the equations end is completed if this end is requested.
    #[inline(always)]
    pub fn stays_pending(&self, part: &Part, until: f64) -> bool {
        let is_end_requested = until + self.resolution >= self.end;
        part.reached + self.resolution >= until && !(part.is_last && is_end_requested)
    }

    /// Ends the equations at `end` [s]. A pending step is accepted up to this time, or dropped if it starts there.
    pub fn end_at(&mut self, end: f64) {
        self.end = end;
        self.accept_until(end);
    }

    /// Changes torques at `time` [s], where accelerations change by `acceleration_change` [rad/s²]. A pending step is
    /// accepted up to this time, and the integration continues. Returns true if there is a pending step.
    pub fn change_at(&mut self, time: f64, acceleration_change: f64) -> bool {
        self.accept_until(time);
        self.acceleration_change = self.pending.is_some().then_some(acceleration_change);
        self.acceleration_change.is_some()
    }

    fn accept_until(&mut self, end: f64) {
        if let Some(pending) = &self.pending {
            let fraction = (end - self.time) / pending.h;
            if fraction > 0.0 {
                self.accepted_fraction = fraction.min(1.0);
            } else {
                self.pending = None;
            }
        }
    }
}
