//! Interface of one-step methods: all that the driver, the step-size control and the tests use of them.

use super::{Extension, Linearisation, Point, SecondOrder, Statistics};
use crate::numeric::lanes;

/// Result of a step that may still be rejected.
#[derive(Clone, Copy, Debug)]
pub struct Trial<const N: usize, P> {
    /// Estimate of the local error of its end.
    pub error: Point<N>,
    /// Its size as a fraction of the tolerance, see [`ErrorNorm::judge`].
    pub size: f64,
    /// The motion halfway; none where the end is in error, upon which nobody asks for the extension either.
    pub halfway: Option<Halfway<P>>,
}

/// What a step finds halfway.
#[derive(Clone, Copy, Debug)]
pub struct Halfway<P> {
    /// Error of the motion there, as a fraction of the allowed one.
    pub size: f64,
    /// Ledger rates.
    pub ledger_rates: P,
}

/// How much more an error halfway counts than one at the end: the middle is but one place of the motion in between, and
/// forces there show errors of stiff motions, which a stiffly accurate method has damped at the end.
const BETWEEN: f64 = 2.0;

impl<const N: usize, P: Copy> Trial<N, P> {
    /// The trial with a look at the middle of its motion, unless its end is in error already. Halfway in a step of size `h` from
    /// `time` the motion contradicts the equations by a defect, of which `solve` makes an error: (I/s − J)⁻¹ times it, with s some
    /// part of h.
    #[inline]
    pub fn looked_into<S: SecondOrder<N, Rates = P> + ?Sized>(
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

/// Weighted norm of errors relative to the tolerance: it accepts steps and stops iterations within them.
#[derive(Clone, Copy, Debug)]
pub struct ErrorNorm<const N: usize> {
    /// Reciprocals of the natural magnitudes of positions and velocities.
    pub weights: Point<N>,
    /// Relative tolerance: an error, weighted, must not exceed it.
    pub tolerance: f64,
}

impl<const N: usize> ErrorNorm<N> {
    /// Largest component of `of` over the allowed one; ignores NaN.
    #[inline]
    pub fn size(&self, of: &Point<N>) -> f64 {
        let mut largest = 0.0f64;
        for i in 0..N {
            largest = largest.max((of.q[i] * self.weights.q[i]).abs()).max((of.v[i] * self.weights.v[i]).abs());
        }
        largest / self.tolerance
    }

    /// Largest component of the error of a step to `end` over the allowed one; NaN if anything is not finite.
    #[inline]
    pub fn judge(&self, error: &Point<N>, end: &Point<N>) -> f64 {
        let weight = &self.weights;
        let (mut largest, mut sum) = (0.0f64, 0.0);
        for i in 0..N {
            let q = (error.q[i] * weight.q[i]).abs();
            let v = (error.v[i] * weight.v[i]).abs();
            largest = largest.max(q).max(v);
            // max() ignores NaN, a sum does not, nor does a product with zero
            sum += q + v + 0.0 * (end.q[i] + end.v[i]);
        }
        if sum.is_finite() { largest / self.tolerance } else { f64::NAN }
    }
}

/// A one-step method with an error estimate. It has no memory from step to step, so that snapshots need not contain it.
pub trait Method {
    /// Order p of the error estimate, 3 or 4: the estimate falls as h^(p+1).
    fn estimate(&self) -> u32;

    /// One step of size `h` from `start`, a point and its time, where `lin` was taken; `None` if it fails (a singular
    /// matrix, an iteration that does not converge), upon which a shorter one is tried. Counts its evaluations, and writes the
    /// motion in the step, of several hundred bytes, to where it stays.
    fn step<const N: usize, S: SecondOrder<N> + ?Sized>(
        &self,
        system: &S,
        start: (&Point<N>, f64),
        lin: &Linearisation<N, S::Rates>,
        h: f64,
        norm: &ErrorNorm<N>,
        to: (&mut Statistics, &mut Extension<N>),
    ) -> Option<Trial<N, S::Rates>>;

    /// x^(1/(p+1)), to a per mille, which suffices for a step size.
    #[inline]
    fn root(&self, x: f64) -> f64 {
        if self.estimate() == 3 { x.sqrt().sqrt() } else { fifth_root(x) }
    }
}

/// Degrees of freedom up to which all of a point is in registers at once, and sums over stages are compiled into the steps.
pub const IN_REGISTERS: usize = 6;
/// Numbers that are summed at a time beyond.
const TOGETHER: usize = 8;

/// y += scale Σ weight_j u_j over the first stages.
#[inline]
pub fn combine<const N: usize>(y: &mut Point<N>, weights: &[f64], scale: f64, u: &[Point<N>]) {
    if N > IN_REGISTERS {
        return combine_in_parts(y, weights, scale, u);
    }
    let mut sum = *y;
    for (weight, u) in weights.iter().zip(u) {
        add_times(&mut sum, weight * scale, u);
    }
    *y = sum;
}

/// y += weight u, two by two if positions and velocities are so.
#[inline(always)]
fn add_times<const N: usize>(y: &mut Point<N>, weight: f64, u: &Point<N>) {
    if N.is_multiple_of(2) {
        return lanes::add_times(y.row_mut(), weight, u.row());
    }
    for (y, u) in y.row_mut().iter_mut().zip(u.row()) {
        *y += weight * u;
    }
}

/// The same a few numbers after the other, so that each sum stays in a register instead of going to memory once a stage.
#[inline(never)]
fn combine_in_parts<const N: usize>(y: &mut Point<N>, weights: &[f64], scale: f64, u: &[Point<N>]) {
    const { assert!(N <= IN_REGISTERS || (2 * N).is_multiple_of(TOGETHER), "all of a point is in one of the parts") };
    for (k, part) in y.row_mut().chunks_exact_mut(TOGETHER).enumerate() {
        let mut sum = [0.0; TOGETHER];
        sum.copy_from_slice(part);
        for (weight, u) in weights.iter().zip(u) {
            let weight = weight * scale;
            for (sum, u) in sum.iter_mut().zip(&u.row()[TOGETHER * k..]) {
                *sum += weight * u;
            }
        }
        part.copy_from_slice(&sum);
    }
}

/// x^(1/5) to a per mille.
#[inline(never)]
pub(super) fn fifth_root(x: f64) -> f64 {
    // a fifth of the exponent is near; Newton's method on y⁵ = x does the rest
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
