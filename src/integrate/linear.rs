//! Factorisation of the small dense matrix of a step, A = U L with a unit upper triangle, from the last row to the first.
//!
//! Bodies that may be alike are ordered behind those that they act on, so that they are eliminated first and never couple
//! with each other. No rows are exchanged: the matrix is that of a mechanical system, row-scaled by inertias, whose pivots are
//! positive unless the step is far too long; a vanishing pivot is rejected and the step becomes shorter.

use super::system::{Matrix, SecondOrder, sum};

/// Least pivot over the largest element of its row.
pub const LEAST_PIVOT: f64 = 1e-10;

/// Factors of a matrix of order `N`.
pub struct Factors<const N: usize> {
    /// U above the diagonal, L below, reciprocal pivots on it.
    m: Matrix<N>,
}

impl<const N: usize> Factors<N> {
    /// Factorises `m` for the system `S`; `None` if a pivot vanishes or is not finite.
    #[inline(always)]
    pub fn new<S: SecondOrder<N>>(mut m: Matrix<N>) -> Option<Self> {
        for k in (0..N).rev() {
            let largest = m[k].iter().fold(0.0, |largest: f64, x| largest.max(x.abs()));
            for j in 0..=k {
                m[k][j] -= sum::<N, S>(k + 1, N, |i| m[k][i] * m[i][j]);
            }
            let pivot = m[k][k];
            // the comparison fails for NaN too
            if !(pivot.abs() > LEAST_PIVOT * largest && pivot.is_finite()) {
                return None;
            }
            let inverse = 1.0 / pivot;
            for i in 0..k {
                m[i][k] = (m[i][k] - sum::<N, S>(k + 1, N, |j| m[i][j] * m[j][k])) * inverse;
            }
            m[k][k] = inverse;
        }
        Some(Self { m })
    }

    /// Solves for the right-hand side `b` in place.
    #[inline(always)]
    pub fn solve<S: SecondOrder<N>>(&self, b: &mut [f64; N]) {
        let m = &self.m;
        for i in (0..N).rev() {
            b[i] -= sum::<N, S>(i + 1, N, |j| m[i][j] * b[j]);
        }
        for i in 0..N {
            b[i] = (b[i] - sum::<N, S>(0, i, |j| m[i][j] * b[j])) * m[i][i];
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::integrate::{Linearisation, Point};

    struct Some3;
    impl<const N: usize> SecondOrder<N> for Some3 {
        type Power = ();
        const ALIKE: (usize, usize) = if N >= 5 { (N - 2, 2) } else { (N, 0) };
        fn evaluate(&self, _: &Point<N>) -> ([f64; N], ()) {
            ([0.0; N], ())
        }
        fn linearise(&self, _: &Point<N>) -> Linearisation<N, ()> {
            Linearisation { acceleration: [0.0; N], by_position: [[0.0; N]; N], by_velocity: [[0.0; N]; N], power: () }
        }
        fn weights(&self, _: &Point<N>) -> Point<N> {
            Point::ZERO
        }
    }

    fn solution_satisfies<const N: usize>(random: &mut impl FnMut() -> f64) {
        let mut m: Matrix<N> = std::array::from_fn(|_| std::array::from_fn(|_| random()));
        for i in 0..N {
            m[i][i] += N as f64; // dominated by its diagonal, like a step's matrix
        }
        let b: [f64; N] = std::array::from_fn(|_| random());
        let mut x = b;
        Factors::new::<Some3>(m).unwrap().solve::<Some3>(&mut x);
        for i in 0..N {
            let residual: f64 = (0..N).map(|j| m[i][j] * x[j]).sum::<f64>() - b[i];
            assert!(residual.abs() < 1e-13, "order {N}: {residual}");
        }
    }

    #[test]
    fn solution_satisfies_the_system() {
        let mut seed = 1u64;
        let mut random = || {
            seed = seed.wrapping_mul(6364136223846793005).wrapping_add(1442695040888963407);
            (seed >> 11) as f64 / (1u64 << 53) as f64 - 0.5
        };
        for _ in 0..20 {
            solution_satisfies::<1>(&mut random);
            solution_satisfies::<2>(&mut random);
            solution_satisfies::<4>(&mut random);
            solution_satisfies::<7>(&mut random);
        }
        assert!(Factors::new::<Some3>([[0.0; 2]; 2]).is_none());
        assert!(Factors::new::<Some3>([[f64::NAN; 2]; 2]).is_none());
    }
}
