//! Radau IIA: an implicit method of order 5 with three stages of stage order 3, L-stable and stiffly accurate.
//!
//! Source: E. Hairer, G. Wanner, Solving Ordinary Differential Equations II, 2nd ed., Springer 1996, section IV.8. The
//! stages are found by simplified Newton iterations in transformed variables, which separate them into a real and a
//! complex system. With Z_i = Y_i − y₀ = Σ T_ij W_j and T⁻¹ A⁻¹ T = Λ, block diagonal with γ and (α, −β; β, α), an
//! iteration is
//!
//!   (Λ/h − J) ΔW = T⁻¹ F(y₀ + T W) − Λ W/h.
//!
//! The error estimate has order 3 (ibid., (8.19) and (8.20)): (γ/h − J) e = f(y₀) + Σ e_i Z_i / h. For a stiff
//! component, the method damps the error within the step, but the estimate does not vanish. A step whose estimate is
//! too large is therefore judged by a second estimate, with f(y₀ + e) in place of f(y₀). The continuous extension is
//! the collocation polynomial, of order 3.
//!
//! Unlike in the code RADAU5 of the same authors, no step uses data of the previous step. The Jacobian is evaluated at
//! the start of each step. The first iteration from Z = 0 gives the stages of the motion that is linearised at the
//! start, with respect to time as well. It needs no evaluation, because f(y₀) is known.

use super::block::Block;
use super::complex::{Complex, ComplexBlock};
use super::linear::Shape;
use super::method::combine;
use super::{
    ErrorNorm, Extension, Linearisation, Matrix, Method, Point, SecondOrder, Statistics, StepOutput, TimedPoint, Trial,
};

/// The method.
pub struct Radau;

/// √6.
const SQRT_6: f64 = 2.449_489_742_783_178;
/// Nodes c_i of the stages, as fractions of the step.
const C: [f64; 3] = [(4.0 - SQRT_6) / 10.0, (4.0 + SQRT_6) / 10.0, 1.0];
/// Real eigenvalue γ of A⁻¹.
const GAMMA: f64 = 3.637_834_252_744_496;
/// Complex eigenvalues α ± iβ of A⁻¹.
const LAMBDA: Complex = Complex { re: 2.681_082_873_627_752_3, im: 3.050_430_199_247_410_5 };
/// T: the real eigenvector of A⁻¹, then the real and imaginary parts of the complex one, as columns.
const T: [[f64; 3]; 3] = [
    [9.123_239_487_089_295e-2, -0.141_255_295_020_954_2, -3.002_919_410_514_742_4e-2],
    [0.241_717_932_707_107, 0.204_129_352_293_799_93, 0.382_942_112_757_261_9],
    [0.966_048_182_615_093, 1.0, 0.0],
];
/// T⁻¹.
const INVERSE: [[f64; 3]; 3] = [
    [4.325_579_890_063_155, 0.339_199_251_815_809_87, 0.541_770_539_935_874_9],
    [-4.178_718_591_551_905, -0.327_682_820_761_062_4, 0.476_623_554_500_550_45],
    [-0.502_872_634_945_786_9, 2.571_926_949_855_605, -0.596_039_204_828_224_9],
];
/// e_i of the error estimate.
const ESTIMATE: [f64; 3] = [(-13.0 - 7.0 * SQRT_6) / 3.0, (-13.0 + 7.0 * SQRT_6) / 3.0, -1.0 / 3.0];

/// Maximum number of iterations. A shorter step is cheaper than more iterations.
const ITERATIONS: i32 = 10;
/// Share of the tolerance allowed as iteration error, small compared with the error estimate.
const LEFT_OVER: f64 = 0.01;
/// Share of a stage's magnitude allowed as rounding error, some units of the last place.
const ROUNDING: f64 = 4.0 * f64::EPSILON;

impl Method for Radau {
    #[inline]
    fn estimate_order(&self) -> u32 {
        3
    }

    // out of line, because its stages would enlarge the stack frame of the step loop
    #[inline(never)]
    fn step<const N: usize, S: SecondOrder<N> + ?Sized>(
        &self,
        system: &S,
        TimedPoint { point: start, time }: TimedPoint<N>,
        lin: &Linearisation<N, S::Rates>,
        h: f64,
        norm: &ErrorNorm<N>,
        StepOutput { counts, extension }: StepOutput<N>,
    ) -> Option<Trial<N, S::Rates>> {
        let (per_h, shape, mut real) = (1.0 / h, Shape::of(system), Block::EMPTY);
        real.fill(system, shape, lin, h / GAMMA)?;
        let complex = ComplexBlock::new(system, lin, Complex { re: LAMBDA.re * per_h, im: LAMBDA.im * per_h })?;
        let slope = Point { q: system.rates(&start.v), v: lin.acceleration };
        let rounding = ROUNDING * norm.size(start);
        let newton =
            Newton { system, shape, start, time, h, norm, rounding, real, complex, by_position: &lin.by_position };
        let z = newton.stages(slope, counts)?;

        let mut defect = Point::ZERO;
        combine(&mut defect, &ESTIMATE, per_h, &z);
        let mut error = shifted(&slope, &defect);
        newton.real.solve(system, shape, &mut error);
        if norm.size(&error) > 1.0 {
            error = shifted(&newton.slope(&error, 0.0), &defect);
            newton.real.solve(system, shape, &mut error);
            counts.evaluations += 1;
        }
        let mut coefficients = [Point::ZERO; 3];
        for (coefficient, weights) in coefficients.iter_mut().zip(&EXTENSION) {
            combine(coefficient, weights, 1.0, &z);
        }
        let end = shifted(start, &z[2]);
        let size = norm.judge(&error, &end);
        *extension = Extension { start: *start, end, coefficients };
        let trial = Trial { error, size, halfway: None };
        let solve = |defect: &mut Point<N>| newton.real.solve(system, shape, defect);
        Some(trial.with_midpoint_check(system, (extension, time, h), norm, counts, solve))
    }
}

/// Simplified Newton iteration for the stages of a step.
struct Newton<'a, S: ?Sized, const N: usize> {
    system: &'a S,
    shape: Shape,
    start: &'a Point<N>,
    time: f64,
    h: f64,
    norm: &'a ErrorNorm<N>,
    /// Rounding error of a stage, in the error norm.
    rounding: f64,
    /// Inverse of γ/h − J.
    real: Block<N>,
    /// Inverse of (α + iβ)/h − J.
    complex: ComplexBlock<N>,
    by_position: &'a Matrix<N>,
}

/// Result of an iteration.
enum Progress {
    Converged,
    Continues,
    Diverges,
}

impl<const N: usize, S: SecondOrder<N> + ?Sized> Newton<'_, S, N> {
    /// Returns Z of the three stages, from the `slope` at the start. Returns `None` if the iteration does not converge.
    fn stages(&self, slope: Point<N>, counts: &mut Statistics) -> Option<[Point<N>; 3]> {
        let (mut z, mut w, mut f) = ([Point::ZERO; 3], [Point::ZERO; 3], self.linearised(slope));
        let (mut last, mut iterations_left) = (f64::INFINITY, ITERATIONS);
        loop {
            let change = self.change(&f, &w);
            for i in 0..3 {
                combine(&mut w[i], &[1.0], 1.0, &change[i..]);
            }
            for i in 0..3 {
                z[i] = Point::ZERO;
                combine(&mut z[i], &T[i], 1.0, &w);
            }
            let size = self.norm.size(&change[0]).max(self.norm.size(&change[1])).max(self.norm.size(&change[2]));
            let sum: f64 = change.iter().map(|c| c.q.iter().chain(&c.v).sum::<f64>()).sum();
            if !sum.is_finite() {
                return None;
            }
            iterations_left -= 1;
            match self.progress(size, last, iterations_left) {
                Progress::Converged => return Some(z),
                Progress::Diverges => return None,
                Progress::Continues => {}
            }
            last = size;
            for i in 0..3 {
                f[i] = self.slope(&z[i], C[i] * self.h);
            }
            counts.evaluations += 3;
        }
    }

    /// Slopes of the three stages for the motion that is linearised at the start, where it has this `slope`.
    fn linearised(&self, slope: Point<N>) -> [Point<N>; 3] {
        let mut f = [slope; 3];
        if self.system.is_driven() {
            let drift = self.system.drift(self.start, self.time);
            for i in 0..3 {
                for j in 0..N {
                    f[i].v[j] += C[i] * self.h * drift[j];
                }
            }
        }
        f
    }

    /// Slope at the point `z` after the start, at the time `later` [s].
    fn slope(&self, z: &Point<N>, later: f64) -> Point<N> {
        let at = shifted(self.start, z);
        Point { q: self.system.rates(&at.v), v: self.system.evaluate_at(&at, self.time + later).0 }
    }

    /// ΔW for the slopes `f` of the stages.
    fn change(&self, f: &[Point<N>; 3], w: &[Point<N>; 3]) -> [Point<N>; 3] {
        let (per_h, mut change) = (1.0 / self.h, [Point::ZERO; 3]);
        for i in 0..3 {
            combine(&mut change[i], &INVERSE[i], 1.0, f);
        }
        combine(&mut change[0], &[-GAMMA], per_h, w);
        combine(&mut change[1], &[-LAMBDA.re, LAMBDA.im], per_h, &w[1..]);
        combine(&mut change[2], &[-LAMBDA.im, -LAMBDA.re], per_h, &w[1..]);
        let [first, re, im] = &mut change;
        self.real.solve(self.system, self.shape, first);
        self.complex.solve(self.system, self.by_position, re, im);
        change
    }

    /// Progress after a change of this `size`, where the change before it had the size `last`. Each change is smaller
    /// than the last by about the same factor, so the remaining changes are a geometric series. Only the first change is
    /// of another kind: it follows from the start, and a force that jumps within the step, such as that of a flank that
    /// touches, may make the second one about as large or larger in steps of any size. The second change therefore never
    /// ends the iteration.
    fn progress(&self, size: f64, last: f64, iterations_left: i32) -> Progress {
        let enough = LEFT_OVER.max(self.rounding);
        let shrink = size / last;
        let to_come = size * shrink / (1.0 - shrink);
        if size <= self.rounding || (shrink < 1.0 && to_come <= enough && iterations_left < ITERATIONS - 1) {
            Progress::Converged
        } else if iterations_left == ITERATIONS - 2 {
            Progress::Continues
        } else if shrink >= 1.0 || to_come * libm::pow(shrink, f64::from(iterations_left)) > enough {
            Progress::Diverges
        } else {
            Progress::Continues
        }
    }
}

#[inline]
fn shifted<const N: usize>(from: &Point<N>, by: &Point<N>) -> Point<N> {
    let mut to = *from;
    combine(&mut to, &[1.0], 1.0, std::slice::from_ref(by));
    to
}

/// Weights of the Z_i in the coefficients b₀ and b₁ of the collocation polynomial, from
/// b₀ + c_i b₁ = (Z_i/c_i − Z_3)/(1 − c_i) for the first two stages.
const EXTENSION: [[f64; 3]; 2] = extension_weights();

const fn extension_weights() -> [[f64; 3]; 2] {
    let mut weights = [[0.0; 3]; 2];
    let per_distance = 1.0 / (C[1] - C[0]);
    let mut i = 0;
    while i < 2 {
        let (own, other) = (1.0 / (C[i] * (1.0 - C[i])), C[1 - i]);
        let sign = if i == 0 { -1.0 } else { 1.0 };
        weights[1][i] = sign * per_distance * own;
        weights[0][i] = -sign * per_distance * own * other;
        weights[1][2] -= sign * per_distance / (1.0 - C[i]);
        weights[0][2] += sign * per_distance * other / (1.0 - C[i]);
        i += 1;
    }
    weights
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::integrate::extended;

    fn product(a: &[[f64; 3]; 3], b: &[[f64; 3]; 3]) -> [[f64; 3]; 3] {
        std::array::from_fn(|i| std::array::from_fn(|j| (0..3).map(|k| a[i][k] * b[k][j]).sum()))
    }

    #[test]
    fn transformation_diagonalises_the_method_and_collocates_powers_exactly() {
        let Complex { re, im } = LAMBDA;
        let lambda = [[GAMMA, 0.0, 0.0], [0.0, re, -im], [0.0, im, re]];
        let (one, inverse) = (product(&T, &INVERSE), product(&product(&T, &lambda), &INVERSE));
        for i in 0..3 {
            for j in 0..3 {
                assert!((one[i][j] - f64::from(u8::from(i == j))).abs() < 1e-14);
            }
            // A c^(n−1) = c^n / n for n = 1, 2, 3 defines A
            for n in 1..=3 {
                let back: f64 = (0..3).map(|j| inverse[i][j] * C[j].powi(n)).sum();
                assert!((back - f64::from(n) * C[i].powi(n - 1)).abs() < 1e-13);
            }
        }
    }

    #[test]
    fn error_estimate_and_extension_are_exact_for_powers_up_to_three() {
        for n in 1..=3 {
            let sum = |weights: &[f64; 3]| -> f64 { (0..3).map(|i| weights[i] * C[i].powi(n)).sum() };
            for at in [0.1, 0.5, 0.9] {
                let coefficients = [sum(&EXTENSION[0]), sum(&EXTENSION[1]), 0.0];
                assert!((extended(0.0, 1.0, coefficients, at) - at.powi(n)).abs() < 1e-14);
            }
            // h f(y₀) + Σ e_i Z_i vanishes for y = t, t², t³: it is of order h⁴
            let slope = if n == 1 { 1.0 } else { 0.0 };
            assert!((slope + sum(&ESTIMATE)).abs() < 1e-13, "{n}");
        }
    }
}
