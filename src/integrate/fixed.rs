//! Fixed-size steps with bounded work, for hosts that run in real time.
//!
//! R. Alexander's two-stage SDIRK method of order 2 (SIAM J. Numer. Anal. 14:1006, 1977) is L-stable and stiffly
//! accurate, with γ = 1 − 1/√2. With s = γh, each stage solves
//!
//!   v = v₀ + s a(q, v),   q = q₀ + s B v
//!
//! from a base (q₀, v₀) by a fixed number of Newton iterations with the exact Jacobian at each,
//!
//!   (I − s D − s² K B) δ = v₀ + s a(q, v) − v,   v += θ δ,   q = q₀ + s B v,
//!
//! on the second-order block, which takes one factorisation of the order of the velocities per iteration. Rosenbrock
//! methods need a single linearisation. However, a step longer than a contact starts on one side of a kink and ends on
//! the other, and must be linearised at its end. The system shortens an iteration (θ < 1) that would jump deep into a
//! contact that the linearisation does not contain yet.

use super::linear::{Inverse, Shape};
use super::{Failure, Linearisation, Matrix, Point, SecondOrder, Statistics, Step, TimedPoint};

/// γ = 1 − 1/√2.
const GAMMA: f64 = 1.0 - std::f64::consts::FRAC_1_SQRT_2;
/// Newton iterations per stage. An impact between teeth needs three iterations to be detected and one to converge.
const ITERATIONS: u32 = 4;
/// Fraction by which a step may exceed the requested size without being divided, because communication points are
/// rounded.
const ROUNDING: f64 = 1e-6;

/// Equal steps up to a given time.
pub struct FixedSteps<'a, const N: usize, S: SecondOrder<N> + ?Sized> {
    system: &'a S,
    /// Time at the start and at the end of all steps [s].
    between: [f64; 2],
    /// Size of a step [s].
    h: f64,
    /// Number of steps.
    steps: f64,
    /// Number of completed steps.
    done: f64,
    /// Start of the last completed step.
    start: Point<N>,
    /// Ledger rates at the start of the next step.
    at_begin: S::Rates,
}

impl<'a, const N: usize, S: SecondOrder<N> + ?Sized> FixedSteps<'a, N, S> {
    /// Steps of at most `longest` [s] from `point` at `begin` to `until` [s].
    pub fn new(
        system: &'a S,
        point: &Point<N>,
        [begin, until]: [f64; 2],
        longest: f64,
        statistics: &mut Statistics,
    ) -> Self {
        let steps = libm::ceil((until - begin) / longest * (1.0 - ROUNDING)).max(1.0);
        let at_begin = system.evaluate_at(point, begin).1;
        statistics.evaluations += 1;
        let h = (until - begin) / steps;
        Self { system, between: [begin, until], h, steps, done: 0.0, start: *point, at_begin }
    }

    /// Moves `point` and `time` [s] by one step, which is taken from the budget. Returns `None` after the last step.
    pub fn next<'s>(
        &'s mut self,
        point: &'s mut Point<N>,
        time: &mut f64,
        (statistics, budget): (&mut Statistics, &mut u64),
    ) -> Result<Option<Step<'s, N, S::Rates>>, Failure> {
        let Self { system, between: [begin, until], h, .. } = *self;
        if self.done >= self.steps {
            return Ok(None);
        }
        *budget = budget.checked_sub(1).ok_or(Failure::TooManySteps)?;
        let end = sdirk(system, TimedPoint { point, time: *time }, h, statistics).ok_or(Failure::Diverged)?;
        let middle = Point {
            q: std::array::from_fn(|i| 0.5 * (point.q[i] + end.q[i])),
            v: std::array::from_fn(|i| 0.5 * (point.v[i] + end.v[i])),
        };
        let halfway = *time + 0.5 * h;
        let ledger_rates =
            [self.at_begin, system.evaluate_at(&middle, halfway).1, system.evaluate_at(&end, *time + h).1];
        statistics.evaluations += 2;
        statistics.accepted += 1;
        self.at_begin = ledger_rates[2];
        self.done += 1.0;
        self.start = std::mem::replace(point, end);
        *time = if self.done < self.steps { begin + self.done * h } else { until };
        Ok(Some(Step { h, time: *time, start: &self.start, end: point, ledger_rates, dense_output: None }))
    }
}

/// Computes one step. Returns `None` if a matrix is singular or a value is not finite.
fn sdirk<const N: usize, S: SecondOrder<N> + ?Sized>(
    system: &S,
    TimedPoint { point: start, time }: TimedPoint<N>,
    h: f64,
    counts: &mut Statistics,
) -> Option<Point<N>> {
    let s = GAMMA * h;
    let first = stage(system, start, start, (s, time + s), counts)?;
    // base of the second stage: y₀ + (1 − γ) h f₁ with s f₁ = y₁ − y₀
    let carry = (1.0 - GAMMA) / GAMMA;
    let base = Point {
        q: std::array::from_fn(|i| start.q[i] + carry * (first.q[i] - start.q[i])),
        v: std::array::from_fn(|i| start.v[i] + carry * (first.v[i] - start.v[i])),
    };
    stage(system, &base, &first, (s, time + h), counts)
}

/// Solves a stage at `time` from `base`, iterating from the velocities of `near`. Returns `None` if a matrix is
/// singular or a value is not finite.
fn stage<const N: usize, S: SecondOrder<N> + ?Sized>(
    system: &S,
    base: &Point<N>,
    near: &Point<N>,
    (s, time): (f64, f64),
    counts: &mut Statistics,
) -> Option<Point<N>> {
    let at = |v: [f64; N]| {
        let rate = system.rates(&v);
        Point { q: std::array::from_fn(|i| base.q[i] + s * rate[i]), v }
    };
    // the first iterate is not limited by `safe_fraction`, although it may already be too deep in a contact
    let mut y = at(near.v);
    for _ in 0..ITERATIONS {
        let lin = system.linearise_at(&y, time);
        counts.evaluations += 1;
        counts.jacobians += 1;
        let mut change: [f64; N] = std::array::from_fn(|i| base.v[i] + s * lin.acceleration[i] - y.v[i]);
        let (shape, mut inverse) = (Shape::of(system), Inverse::EMPTY);
        inverse.fill(shape, &mut matrix_of(system, &lin, s))?;
        inverse.solve(shape, &mut change);
        let full = at(std::array::from_fn(|i| y.v[i] + change[i]));
        let fraction = system.safe_fraction(&y, &full);
        y = if fraction < 1.0 { at(std::array::from_fn(|i| y.v[i] + fraction * change[i])) } else { full };
    }
    let finite = y.q.iter().chain(&y.v).sum::<f64>().is_finite();
    finite.then_some(y)
}

/// I − s D − s² K B.
fn matrix_of<const N: usize, S: SecondOrder<N> + ?Sized>(
    system: &S,
    lin: &Linearisation<N, S::Rates>,
    s: f64,
) -> Matrix<N> {
    let mut matrix = lin.by_position;
    system.times_rates(&mut matrix);
    for i in 0..N {
        for j in 0..N {
            matrix[i][j] = -s * (lin.by_velocity[i][j] + s * matrix[i][j]);
        }
        matrix[i][i] += 1.0;
    }
    matrix
}
