//! Where an integration stands: at the end of its last completed step, and within the pending step after it.
//!
//! A step whose error is small enough is pending until a time beyond its end is asked for. Until then its continuous
//! extension gives the motion at any time within it. Steps do not depend on these times.

use serde::{Deserialize, Serialize};

use super::Point;
use crate::numeric::{Finite, finite};

/// y(Θ) = y₀ + Θ ((y₁ − y₀) + (1−Θ) (b₀ + Θ (b₁ + Θ b₂))): a component of the continuous extension of a step, from its
/// ends and coefficients b. A component that does not change in the step keeps its bits.
#[inline]
pub fn extended(start: f64, end: f64, coefficients: [f64; 3], fraction: f64) -> f64 {
    let inner = coefficients[0] + fraction * (coefficients[1] + fraction * coefficients[2]);
    start + fraction * ((end - start) + (1.0 - fraction) * inner)
}

/// Continuous extension of a step.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Extension<const N: usize> {
    /// Begin of the step.
    pub start: Point<N>,
    /// Its end.
    pub end: Point<N>,
    /// Coefficients b₀, b₁ and b₂ of [`extended`].
    pub coefficients: [Point<N>; 3],
}

impl<const N: usize> Extension<N> {
    /// No motion.
    pub const NONE: Self = Self { start: Point::ZERO, end: Point::ZERO, coefficients: [Point::ZERO; 3] };

    /// The motion after a fraction of the step.
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

    /// Defect of the extension halfway through a step of size `h` [s]: `slope`, by the equations, less the slope of the
    /// extension.
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

/// How a step came about, for the control of the next ones.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Attempt {
    /// Size of the step [s].
    pub h: f64,
    /// Its error as a fraction of the tolerance.
    pub error: f64,
    /// Whether it is shorter than its error demands.
    pub cut: bool,
    /// Whether it ends on a kink.
    pub to_kink: bool,
    /// Whether a longer step was rejected just before.
    pub after_rejection: bool,
    /// Number of consecutive attempts before this one that were rejected for their ledger.
    pub unbalanced: u32,
    /// Size of the first of these attempts [s].
    pub whole: f64,
    /// Number of consecutive steps up to this one that were cut at a switch but ended before it.
    pub short: u32,
}

finite!(Attempt { h, error, whole; cut, to_kink, after_rejection, unbalanced, short });

impl Attempt {
    /// True if all numbers are finite and the step size is positive.
    pub fn is_valid(&self) -> bool {
        self.is_finite() && self.h > 0.0
    }
}

/// A step of small enough error that is not completed yet.
#[derive(Clone, Copy, Debug)]
pub struct Pending<P> {
    /// How it came about.
    pub attempt: Attempt,
    /// Ledger rates at its begin and halfway.
    pub ledger_rates: [P; 2],
    /// Kinetic and stored energy at its begin.
    pub energy: [f64; 2],
    /// Part of the step that is taken: all of it, unless the equations change within it.
    pub part: f64,
    /// Where torques change at the end of that part, and the integration goes on: the jump of the accelerations [rad/s²].
    pub jump: Option<f64>,
}

/// Where an integration stands.
#[derive(Clone, Copy, Debug)]
pub struct Course<const N: usize, P> {
    /// End of the last completed step.
    pub point: Point<N>,
    /// Its time [s].
    pub time: f64,
    /// The step from there on.
    pub pending: Option<Pending<P>>,
    /// The motion in it; without a pending step, room for that of the next one.
    pub extension: Extension<N>,
    /// Time at which these equations end, because they change [s]: no step is completed beyond it.
    pub end: f64,
    /// Time at which they are expected to end [s]: steps are fitted to it, but may go beyond.
    pub expected: f64,
    /// Longest step [s].
    pub longest: f64,
    /// Difference of times that a double can resolve [s].
    pub resolution: f64,
}

impl<const N: usize, P> Course<N, P> {
    /// From `point` at `time` to `end` [s].
    pub fn new(point: Point<N>, time: f64, end: f64) -> Self {
        let resolution = 4.0 * f64::EPSILON * end.abs().max(time.abs()).max(1e-9);
        let (pending, extension) = (None, Extension::NONE);
        Self { point, time, pending, extension, end, expected: f64::INFINITY, longest: f64::INFINITY, resolution }
    }

    /// Ends the equations at `end` [s]. A pending step is taken up to there, or dropped if that leaves nothing of it.
    pub fn end_at(&mut self, end: f64) {
        self.end = end;
        self.take_until(end);
    }

    /// Lets torques change at `time` [s], where accelerations jump by `jump` [rad/s²]: a pending step is taken up to there, and the
    /// integration goes on. Returns whether there is such a step.
    pub fn change_at(&mut self, time: f64, jump: f64) -> bool {
        self.take_until(time);
        self.pending.as_mut().map(|pending| pending.jump = Some(jump)).is_some()
    }

    fn take_until(&mut self, end: f64) {
        if let Some(pending) = &mut self.pending {
            let part = (end - self.time) / pending.attempt.h;
            if part > 0.0 {
                pending.part = part.min(1.0);
            } else {
                self.pending = None;
            }
        }
    }
}
