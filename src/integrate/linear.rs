//! Inverse of the small dense matrix of a step, which is applied once a stage.
//!
//! With the bodies that may be alike, p, apart from the others, c,
//!
//!   A = [C B; D P],   S = C − B P⁻¹ D,   x_c = S⁻¹ (b_c − B P⁻¹ b_p),   x_p = P⁻¹ b_p − P⁻¹ D x_c
//!
//! so that alike bodies never couple with each other and sums over them are formed in pairs. What is applied is kept as
//! columns, and a solution is a sum of them: that suits vectors of any width, as does eliminating by whole rows.
//!
//! No rows are exchanged: the matrix is that of a mechanical system, row-scaled by inertias, whose pivots are positive unless
//! the step is far too long; a vanishing pivot is rejected and the step becomes shorter.

use super::system::{Matrix, SecondOrder, in_pairs};

/// Least pivot over the element on the diagonal that it comes from.
pub const LEAST_PIVOT: f64 = 1e-10;

/// The inverse of a matrix of order `N`.
pub struct Inverse<const N: usize> {
    /// Of p: [−B P⁻¹; P⁻¹]; of c: [S⁻¹; −P⁻¹ D S⁻¹].
    columns: Matrix<N>,
}

/// Whether body `i` may be alike to others.
#[inline]
const fn is_alike<const N: usize, S: SecondOrder<N>>(i: usize) -> bool {
    i >= S::ALIKE.0 && i < S::ALIKE.0 + S::ALIKE.1
}

/// Divides row `k` of `a` by its pivot, which once was `before`, and leaves the reciprocal in its place; `None` if the pivot
/// vanishes or is not finite.
#[inline]
fn normalise<const N: usize>(a: &mut Matrix<N>, k: usize, before: f64) -> Option<()> {
    let pivot = a[k][k];
    // the comparison fails for NaN too
    if !(pivot.abs() > LEAST_PIVOT * before.abs() && pivot.is_finite()) {
        return None;
    }
    let inverse = 1.0 / pivot;
    a[k][k] = 1.0;
    for j in 0..N {
        a[k][j] *= inverse;
    }
    Some(())
}

/// Takes so much of row `k` from row `i` that its element in column `k` vanishes; what the inverse has there takes its place.
#[inline]
fn eliminate<const N: usize>(a: &mut Matrix<N>, i: usize, k: usize) {
    let factor = a[i][k];
    a[i][k] = 0.0;
    for j in 0..N {
        a[i][j] -= factor * a[k][j];
    }
}

impl<const N: usize> Inverse<N> {
    /// Inverts `a` for the system `S`; `None` if a pivot vanishes or is not finite.
    #[inline]
    pub fn new<S: SecondOrder<N>>(mut a: Matrix<N>) -> Option<Self> {
        let (first, count) = S::ALIKE;
        let mut diagonal = [0.0; N];
        for i in 0..N {
            diagonal[i] = a[i][i];
        }
        // [P⁻¹ D, P⁻¹]
        for k in first..first + count {
            normalise(&mut a, k, diagonal[k])?;
            for i in first..first + count {
                if i != k {
                    eliminate(&mut a, i, k);
                }
            }
        }
        // [S, −B P⁻¹]
        for i in (0..N).filter(|&i| !is_alike::<N, S>(i)) {
            let row = a[i];
            for j in 0..N {
                let own = if is_alike::<N, S>(j) { 0.0 } else { row[j] };
                a[i][j] = own - in_pairs(count, |k| row[first + k] * a[first + k][j]);
            }
        }
        let mut columns = [[0.0; N]; N];
        for g in first..first + count {
            for i in 0..N {
                columns[g][i] = a[i][g];
            }
        }
        // [S⁻¹, …] and [−P⁻¹ D S⁻¹, …]
        for k in (0..N).filter(|&k| !is_alike::<N, S>(k)) {
            normalise(&mut a, k, diagonal[k])?;
            for i in 0..N {
                if i != k {
                    eliminate(&mut a, i, k);
                }
            }
        }
        for j in (0..N).filter(|&j| !is_alike::<N, S>(j)) {
            for i in 0..N {
                columns[j][i] = a[i][j];
            }
        }
        Some(Self { columns })
    }

    /// Solves for the right-hand side `b` in place.
    #[inline]
    pub fn solve<S: SecondOrder<N>>(&self, b: &mut [f64; N]) {
        let mut x = of_alike::<N, S>(&self.columns, b);
        let mut left = *b;
        for j in (0..N).filter(|&j| !is_alike::<N, S>(j)) {
            left[j] += x[j];
            x[j] = 0.0;
        }
        add_others::<N, S>(&self.columns, &left, &mut x);
        *b = x;
    }
}

/// Σ of those `columns` times `x` that belong to bodies that may be alike, in pairs.
#[inline]
fn of_alike<const N: usize, S: SecondOrder<N>>(columns: &Matrix<N>, x: &[f64; N]) -> [f64; N] {
    let (first, count) = S::ALIKE;
    // plain loops: what they call is inlined, for vectors of any width
    let mut sum = [0.0; N];
    for i in 0..N {
        sum[i] = in_pairs(count, |k| columns[first + k][i] * x[first + k]);
    }
    sum
}

/// Adds the other `columns` times `x`.
#[inline]
fn add_others<const N: usize, S: SecondOrder<N>>(columns: &Matrix<N>, x: &[f64; N], sum: &mut [f64; N]) {
    for j in (0..N).filter(|&j| !is_alike::<N, S>(j)) {
        for i in 0..N {
            sum[i] += columns[j][i] * x[j];
        }
    }
}

/// Σ of `columns` times `x`.
#[inline]
pub fn times<const N: usize, S: SecondOrder<N>>(columns: &Matrix<N>, x: &[f64; N]) -> [f64; N] {
    let mut sum = of_alike::<N, S>(columns, x);
    add_others::<N, S>(columns, x, &mut sum);
    sum
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
        Inverse::new::<Some3>(m).unwrap().solve::<Some3>(&mut x);
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
        assert!(Inverse::new::<Some3>([[0.0; 2]; 2]).is_none());
        assert!(Inverse::new::<Some3>([[f64::NAN; 2]; 2]).is_none());
    }
}
