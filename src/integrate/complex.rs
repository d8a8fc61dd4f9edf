//! Complex numbers and the complex linear system of collocation methods on the second-order block.
//!
//! The equations are those of [`Block`](super::block::Block), with a complex number a in place of 1/s:
//!
//!   (a I − D − K B / a) U_v = r_v + K r_q / a,   U_q = (r_q + B U_v) / a.
//!
//! The matrices D and −K B of a mechanical system store or dissipate energy. If a and 1/a have positive real parts, the
//! pivots therefore stay away from zero without row exchanges.

use std::ops::{Add, Mul, Sub};

use super::linear::LEAST_PIVOT;
use super::{Linearisation, Matrix, Point, SecondOrder};

/// A complex number.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Complex {
    /// Real part.
    pub re: f64,
    /// Imaginary part.
    pub im: f64,
}

impl Complex {
    const ZERO: Self = Self { re: 0.0, im: 0.0 };

    /// 1/z.
    #[inline]
    pub fn inverse(self) -> Self {
        let scale = 1.0 / (self.re * self.re + self.im * self.im);
        Self { re: self.re * scale, im: -self.im * scale }
    }

    /// Cheap magnitude, from |z| to √2 |z|.
    #[inline]
    fn size(self) -> f64 {
        self.re.abs() + self.im.abs()
    }
}

impl Add for Complex {
    type Output = Self;
    #[inline]
    fn add(self, b: Self) -> Self {
        Self { re: self.re + b.re, im: self.im + b.im }
    }
}

impl Sub for Complex {
    type Output = Self;
    #[inline]
    fn sub(self, b: Self) -> Self {
        Self { re: self.re - b.re, im: self.im - b.im }
    }
}

impl Mul for Complex {
    type Output = Self;
    #[inline]
    fn mul(self, b: Self) -> Self {
        Self { re: self.re * b.re - self.im * b.im, im: self.re * b.im + self.im * b.re }
    }
}

/// a I − J, factorised.
pub struct ComplexBlock<const N: usize> {
    /// Factors: U above the diagonal, L below it, and reciprocal pivots on it.
    m: [[Complex; N]; N],
    per_a: Complex,
}

impl<const N: usize> ComplexBlock<N> {
    /// Factorises a I − J. Returns `None` if the matrix is singular.
    #[inline]
    pub fn new<E: SecondOrder<N> + ?Sized>(system: &E, lin: &Linearisation<N, E::Rates>, a: Complex) -> Option<Self> {
        let (n, mut product) = (system.degrees_of_freedom(), lin.by_position);
        system.times_rates(&mut product);
        let per_a = a.inverse();
        let mut m = [[Complex::ZERO; N]; N];
        for i in 0..n {
            for j in 0..n {
                let k = product[i][j];
                m[i][j] = Complex { re: -lin.by_velocity[i][j] - k * per_a.re, im: -k * per_a.im };
            }
            m[i][i] = m[i][i] + a;
        }
        for k in (0..n).rev() {
            let largest = m[k].iter().fold(0.0, |largest: f64, x| largest.max(x.size()));
            for j in 0..=k {
                m[k][j] = (k + 1..n).fold(m[k][j], |rest, i| rest - m[k][i] * m[i][j]);
            }
            let pivot = m[k][k];
            // false for NaN
            if !(pivot.size() > LEAST_PIVOT * largest && pivot.size().is_finite()) {
                return None;
            }
            let inverse = pivot.inverse();
            for i in 0..k {
                m[i][k] = (k + 1..n).fold(m[i][k], |rest, j| rest - m[i][j] * m[j][k]) * inverse;
            }
            m[k][k] = inverse;
        }
        Some(Self { m, per_a })
    }

    /// Solves for the right-hand side `re` + i `im` in place. `k` is K = ∂v̇/∂q.
    #[inline]
    pub fn solve<E: SecondOrder<N> + ?Sized>(&self, system: &E, k: &Matrix<N>, re: &mut Point<N>, im: &mut Point<N>) {
        let (n, m, per_a) = (system.degrees_of_freedom(), &self.m, self.per_a);
        let mut b = [Complex::ZERO; N];
        for i in 0..n {
            let mut pull = Complex::ZERO;
            for j in 0..n {
                pull = pull + Complex { re: k[i][j] * re.q[j], im: k[i][j] * im.q[j] };
            }
            b[i] = Complex { re: re.v[i], im: im.v[i] } + per_a * pull;
        }
        for i in (0..n).rev() {
            b[i] = (i + 1..n).fold(b[i], |rest, j| rest - m[i][j] * b[j]);
        }
        for i in 0..n {
            b[i] = (0..i).fold(b[i], |rest, j| rest - m[i][j] * b[j]) * m[i][i];
        }
        (re.v, im.v) = (b.map(|x| x.re), b.map(|x| x.im));
        let rate = [system.rates(&re.v), system.rates(&im.v)];
        for i in 0..n {
            let u = per_a * Complex { re: re.q[i] + rate[0][i], im: im.q[i] + rate[1][i] };
            (re.q[i], im.q[i]) = (u.re, u.im);
        }
    }
}
