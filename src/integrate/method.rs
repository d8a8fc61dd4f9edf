//! Interface of one-step methods, as used by the driver, the step-size control and the tests.

use super::{Extension, Linearisation, Point, SecondOrder, Statistics, TimedPoint};
use crate::numeric::lanes;

/// Result of a step that may still be rejected.
#[derive(Clone, Copy, Debug)]
pub struct Trial<const N: usize, P> {
    /// Estimate of the local error at the end of the step.
    pub error: Point<N>,
    /// Size of this error as a fraction of the tolerance, see [`ErrorNorm::judge`].
    pub size: f64,
    /// Result of the check halfway. `None` if the error at the end is too large; the step is then rejected, and its
    /// dense output is not used.
    pub halfway: Option<Halfway<P>>,
}

/// Result of the check halfway through a step.
#[derive(Clone, Copy, Debug)]
pub struct Halfway<P> {
    /// Error of the dense output halfway, as a fraction of the allowed error.
    pub size: f64,
    /// Ledger rates halfway.
    pub ledger_rates: P,
}

/// Weight of an error halfway relative to an error at the end. Errors halfway count double for two reasons. Elsewhere
/// inside the step, the error may be larger than at this one point. Forces inside the step also contain errors of stiff
/// motions, which a stiffly accurate method has damped at the end.
const BETWEEN: f64 = 2.0;

impl<const N: usize, P: Copy> Trial<N, P> {
    /// Adds the check halfway through the step, unless the error at the end is already too large. Halfway through a
    /// step of size `h` from `time`, the dense output violates the equations by a defect. `solve` turns the defect into
    /// an error by multiplying it with (I/s − J)⁻¹, where s is a fraction of h.
    #[inline]
    pub fn with_midpoint_check<S: SecondOrder<N, Rates = P> + ?Sized>(
        self,
        system: &S,
        (extension, time, h): (&Extension<N>, f64, f64),
        norm: &ErrorNorm<N>,
        counts: &mut Statistics,
        solve: impl FnOnce(&mut Point<N>),
    ) -> Self {
        if self.size.is_nan() || self.size > 1.0 {
            return self;
        }
        counts.evaluations += 1;
        let middle = extension.at(0.5);
        let (acceleration, ledger_rates) = system.evaluate_at(&middle, time + 0.5 * h);
        let mut error = extension.defect(&Point { q: system.rates(&middle.v), v: acceleration }, h);
        solve(&mut error);
        let size = BETWEEN * norm.judge(&error, &middle);
        Self { halfway: Some(Halfway { size, ledger_rates }), ..self }
    }
}

/// Weighted norm of errors relative to the tolerance. It decides whether steps are accepted and when iterations within
/// them stop.
#[derive(Clone, Copy, Debug)]
pub struct ErrorNorm<const N: usize> {
    /// Reciprocals of the natural magnitudes of positions and velocities.
    pub weights: Point<N>,
    /// Relative tolerance, which a weighted error must not exceed.
    pub tolerance: f64,
}

impl<const N: usize> ErrorNorm<N> {
    /// Largest component of `of` divided by the allowed one; ignores NaN.
    #[inline]
    pub fn size(&self, of: &Point<N>) -> f64 {
        let mut largest = 0.0f64;
        for i in 0..N {
            largest = largest.max((of.q[i] * self.weights.q[i]).abs()).max((of.v[i] * self.weights.v[i]).abs());
        }
        largest / self.tolerance
    }

    /// Largest component of the error of a step to `end`, divided by the allowed one. Returns NaN if any number is not
    /// finite.
    #[inline]
    pub fn judge(&self, error: &Point<N>, end: &Point<N>) -> f64 {
        let weight = &self.weights;
        let (mut largest, mut sum) = (0.0f64, 0.0);
        for i in 0..N {
            let q = (error.q[i] * weight.q[i]).abs();
            let v = (error.v[i] * weight.v[i]).abs();
            largest = largest.max(q).max(v);
            // max() ignores NaN, but a sum does not, and neither does a product with zero
            sum += q + v + 0.0 * (end.q[i] + end.v[i]);
        }
        if sum.is_finite() { largest / self.tolerance } else { f64::NAN }
    }
}

/// Results that a step writes in place.
pub struct StepOutput<'a, const N: usize> {
    /// Counters of evaluations.
    pub counts: &'a mut Statistics,
    /// Dense output, which has several hundred bytes.
    pub extension: &'a mut Extension<N>,
}

/// A one-step method with an error estimate. It keeps no data between steps, so snapshots need not contain it.
pub trait Method {
    /// Order p of the error estimate, 3 or 4: the estimate is proportional to h^(p+1).
    fn estimate_order(&self) -> u32;

    /// Computes one step of size `h` [s] from `start`, at which `lin` was evaluated. Returns `None` if the matrix is
    /// singular or an iteration does not converge; a shorter step is then tried.
    fn step<const N: usize, S: SecondOrder<N> + ?Sized>(
        &self,
        system: &S,
        start: TimedPoint<N>,
        lin: &Linearisation<N, S::Rates>,
        h: f64,
        norm: &ErrorNorm<N>,
        to: StepOutput<N>,
    ) -> Option<Trial<N, S::Rates>>;

    /// x^(1/(p+1)), accurate to 0.1 %, which suffices for a step size.
    #[inline]
    fn root(&self, x: f64) -> f64 {
        if self.estimate_order() == 3 { x.sqrt().sqrt() } else { fifth_root(x) }
    }
}

/// Maximum number of degrees of freedom for which a whole point fits in registers. Sums over stages are then inlined
/// into the steps.
pub const IN_REGISTERS: usize = 6;
/// Chunk size of sums over stages of larger systems.
const CHUNK: usize = 8;

/// Smallest size of points for this number of degrees of freedom: a point either fits in registers, or consists of
/// whole chunks.
pub const fn size_for(freedoms: usize) -> usize {
    if freedoms <= IN_REGISTERS { freedoms } else { freedoms.next_multiple_of(CHUNK / 2) }
}

/// y += scale Σ weight_j u_j, over as many stages as there are weights.
#[inline]
pub fn combine<const N: usize>(y: &mut Point<N>, weights: &[f64], scale: f64, u: &[Point<N>]) {
    if N > IN_REGISTERS {
        return combine_in_chunks(y, weights, scale, u);
    }
    let mut sum = *y;
    for (weight, u) in weights.iter().zip(u) {
        add_times(&mut sum, weight * scale, u);
    }
    *y = sum;
}

/// y += weight u, in vector lanes if the size allows it.
#[inline(always)]
fn add_times<const N: usize>(y: &mut Point<N>, weight: f64, u: &Point<N>) {
    if N.is_multiple_of(2) {
        return lanes::add_times(y.row_mut(), weight, u.row());
    }
    for (y, u) in y.row_mut().iter_mut().zip(u.row()) {
        *y += weight * u;
    }
}

/// y += scale Σ weight_j u_j for large systems, chunk by chunk. Each partial sum stays in registers instead of going
/// through memory once per stage.
#[inline(never)]
fn combine_in_chunks<const N: usize>(y: &mut Point<N>, weights: &[f64], scale: f64, u: &[Point<N>]) {
    const { assert!(N <= IN_REGISTERS || (2 * N).is_multiple_of(CHUNK), "chunks cover the whole point") };
    for (k, chunk) in y.row_mut().chunks_exact_mut(CHUNK).enumerate() {
        let mut sum = [0.0; CHUNK];
        sum.copy_from_slice(chunk);
        for (weight, u) in weights.iter().zip(u) {
            let weight = weight * scale;
            for (sum, u) in sum.iter_mut().zip(&u.row()[CHUNK * k..]) {
                *sum += weight * u;
            }
        }
        chunk.copy_from_slice(&sum);
    }
}

/// x^(1/5), accurate to 0.1 %.
#[inline(never)]
pub(super) fn fifth_root(x: f64) -> f64 {
    // a fifth of the exponent is a first guess, which Newton's method on y⁵ = x refines
    const BIAS: u64 = 1023 << 52;
    let x = x.clamp(1e-30, 1e30);
    let mut y = f64::from_bits(x.to_bits() / 5 + BIAS / 5 * 4);
    for _ in 0..2 {
        let y2 = y * y;
        y = 0.8 * y + 0.2 * x / (y2 * y2);
    }
    y
}

#[cfg(test)]
mod tests {
    #[test]
    fn fifth_root_is_good_to_a_per_mille() {
        for k in -200..200 {
            let x = 10f64.powf(f64::from(k) * 0.1);
            assert!((super::fifth_root(x) / x.powf(0.2) - 1.0).abs() < 1e-3, "{x:e}: {}", super::fifth_root(x));
        }
    }
}
