//! A smooth function on an interval as a polynomial, constant beyond its ends.

use crate::numeric::{PI, cos};

/// Degree of the polynomial. The error of a coupling between tooth pairs (`sharing`) is 2e-6 of a pair's compliance for
/// gears with at least eight teeth, and 1e-3 for five teeth.
const DEGREE: usize = 6;

/// A polynomial in x = (u − middle)/half, constant beyond x = ±1.
#[derive(Clone, Debug, Default)]
pub struct Polynomial {
    middle: f64,
    per_half: f64,
    terms: [f64; DEGREE + 1],
}

impl Polynomial {
    /// Interpolates `f` at the Chebyshev points between `low` and `high`.
    pub fn new([low, high]: [f64; 2], f: impl Fn(f64) -> f64) -> Self {
        let (middle, half, count) = (0.5 * (low + high), 0.5 * (high - low), DEGREE + 1);
        let angle = |j: usize| PI * (j as f64 + 0.5) / count as f64;
        let values: Vec<f64> = (0..count).map(|j| f(middle + half * cos(angle(j)))).collect();
        // monomial coefficients of the Chebyshev polynomials T_n−1 and T_n
        let (mut terms, mut last, mut this) = ([0.0; DEGREE + 1], [0.0; DEGREE + 1], [0.0; DEGREE + 1]);
        this[0] = 1.0;
        for n in 0..count {
            let twice = if n == 0 { 1.0 } else { 2.0 };
            let sum: f64 = (0..count).map(|j| values[j] * cos(n as f64 * angle(j))).sum();
            for (term, part) in terms.iter_mut().zip(&this) {
                *term += twice / count as f64 * sum * part;
            }
            let next = std::array::from_fn(|p| if p > 0 { twice * this[p - 1] } else { 0.0 } - last[p]);
            (last, this) = (this, next);
        }
        Self { middle, per_half: 1.0 / half, terms }
    }

    /// A constant function.
    pub fn constant(value: f64) -> Self {
        let mut terms = [0.0; DEGREE + 1];
        terms[0] = value;
        Self { middle: 0.0, per_half: 0.0, terms }
    }

    /// True if the value depends on the position.
    pub fn varies(&self) -> bool {
        self.per_half > 0.0
    }

    /// Value at x = (u − middle)/half, from −1 to 1.
    pub fn at_normalised(&self, x: f64) -> f64 {
        self.terms.iter().rev().fold(0.0, |sum, term| sum * x + term)
    }

    /// Value, slope and, if `CURVATURE`, curvature at `u`.
    #[inline(always)]
    pub fn at<const CURVATURE: bool>(&self, u: f64) -> [f64; 3] {
        let free = (u - self.middle) * self.per_half;
        let x = free.clamp(-1.0, 1.0);
        let (mut value, mut slope, mut curvature) = (self.terms[DEGREE], 0.0, 0.0);
        for term in self.terms[..DEGREE].iter().rev() {
            if CURVATURE {
                curvature = curvature * x + 2.0 * slope;
            }
            slope = slope * x + value;
            value = value * x + term;
        }
        let scale = if free == x { self.per_half } else { 0.0 };
        [value, slope * scale, curvature * scale * scale]
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::numeric::sin;

    #[test]
    fn a_smooth_function_is_met_with_its_slopes() {
        let polynomial = Polynomial::new([-0.2, 0.4], |s| libm::exp(s) * cos(2.0 * s));
        for j in 0..=100 {
            let s = -0.2 + 0.006 * f64::from(j);
            let (e, c, i) = (libm::exp(s), cos(2.0 * s), sin(2.0 * s));
            let exact = [e * c, e * (c - 2.0 * i), e * (-3.0 * c - 4.0 * i)];
            let found = polynomial.at::<true>(s.clamp(-0.2, 0.4 - 1e-16));
            for k in 0..3 {
                assert!((found[k] - exact[k]).abs() < [1e-6, 1e-4, 1e-2][k], "{s}: {found:?} {exact:?}");
            }
        }
        let [end, slope, curvature] = polynomial.at::<true>(2.0);
        assert!((end - libm::exp(0.4) * cos(0.8)).abs() < 1e-6 && (slope, curvature) == (0.0, 0.0));
    }
}
