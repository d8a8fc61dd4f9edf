//! Inverse of the small dense matrix of a step, which is applied once a stage.
//!
//! With the bodies that may be alike, p, apart from the others, c,
//!
//!   A = [C B; D P],   S = C − B P⁻¹ D,   x_c = S⁻¹ (b_c − B P⁻¹ b_p),   x_p = P⁻¹ b_p − P⁻¹ D x_c
//!
//! so that alike bodies never couple with each other and sums over them are formed in pairs. The blocks are kept as columns,
//! those of the others applied after those of p: a solution is a sum of columns, which suits vectors of any width.
//!
//! No rows are exchanged: the matrix is that of a mechanical system, row-scaled by inertias, whose pivots are positive unless
//! the step is far too long; a vanishing pivot is rejected and the step becomes shorter.

use std::ops::Range;

use super::system::{Matrix, SecondOrder, in_pairs};

/// Least pivot over the largest element of its row.
pub const LEAST_PIVOT: f64 = 1e-10;

/// The inverse of a matrix of order `N`.
pub struct Inverse<const N: usize> {
    /// Of p: [−B P⁻¹; P⁻¹]; of c: [S⁻¹; −P⁻¹ D S⁻¹].
    columns: Matrix<N>,
}

/// p: the bodies that may be alike.
#[inline(always)]
const fn alike<const N: usize, S: SecondOrder<N>>() -> Range<usize> {
    S::ALIKE.0..S::ALIKE.0 + S::ALIKE.1
}

/// Whether `i` is one of them.
#[inline(always)]
const fn is_alike<const N: usize, S: SecondOrder<N>>(i: usize) -> bool {
    i >= S::ALIKE.0 && i < S::ALIKE.0 + S::ALIKE.1
}

/// c: the others, before and behind them.
#[inline(always)]
const fn others<const N: usize, S: SecondOrder<N>>() -> [Range<usize>; 2] {
    [0..S::ALIKE.0, S::ALIKE.0 + S::ALIKE.1..N]
}

/// Inverts, in place, the part of `a` whose rows and columns lie in `of`; `None` if a pivot vanishes against the element
/// `largest` of its row or is not finite.
#[inline(always)]
fn invert<const N: usize, const M: usize>(a: &mut Matrix<N>, of: [Range<usize>; M], largest: &[f64; N]) -> Option<()> {
    for k in 0..N {
        if !of.iter().any(|range| range.contains(&k)) {
            continue;
        }
        let pivot = a[k][k];
        // the comparison fails for NaN too
        if !(pivot.abs() > LEAST_PIVOT * largest[k] && pivot.is_finite()) {
            return None;
        }
        let inverse = 1.0 / pivot;
        a[k][k] = 1.0;
        for range in of.clone() {
            a[k][range].iter_mut().for_each(|x| *x *= inverse);
        }
        let row = a[k];
        for rows in of.clone() {
            for i in rows {
                if i != k {
                    let factor = std::mem::replace(&mut a[i][k], 0.0);
                    for range in of.clone() {
                        for j in range {
                            a[i][j] -= factor * row[j];
                        }
                    }
                }
            }
        }
    }
    Some(())
}

impl<const N: usize> Inverse<N> {
    /// Inverts `a` for the system `S`; `None` if a pivot vanishes or is not finite.
    #[inline(always)]
    pub fn new<S: SecondOrder<N>>(mut a: Matrix<N>) -> Option<Self> {
        let (first, count) = S::ALIKE;
        let mut largest = [0.0f64; N];
        for i in 0..N {
            for j in 0..N {
                largest[i] = largest[i].max(a[i][j].abs());
            }
        }
        invert(&mut a, [alike::<N, S>()], &largest)?;
        let mut columns = [[0.0; N]; N];
        // P⁻¹ and −B P⁻¹
        for g in alike::<N, S>() {
            for i in alike::<N, S>() {
                columns[g][i] = a[i][g];
            }
            for i in (0..N).filter(|&i| !is_alike::<N, S>(i)) {
                columns[g][i] = -in_pairs(count, |k| a[i][first + k] * a[first + k][g]);
            }
        }
        // P⁻¹ D
        let mut from_others = [[0.0; N]; N];
        for g in alike::<N, S>() {
            for range in others::<N, S>() {
                for j in range {
                    from_others[g][j] = in_pairs(count, |k| a[g][first + k] * a[first + k][j]);
                }
            }
        }
        for i in (0..N).filter(|&i| !is_alike::<N, S>(i)) {
            for range in others::<N, S>() {
                for j in range {
                    a[i][j] -= in_pairs(count, |k| a[i][first + k] * from_others[first + k][j]);
                }
            }
        }
        invert(&mut a, others::<N, S>(), &largest)?;
        for j in (0..N).filter(|&j| !is_alike::<N, S>(j)) {
            for i in (0..N).filter(|&i| !is_alike::<N, S>(i)) {
                columns[j][i] = a[i][j];
            }
            for g in alike::<N, S>() {
                let sum = |range: Range<usize>| range.map(|i| from_others[g][i] * a[i][j]).sum::<f64>();
                let [before, behind] = others::<N, S>();
                columns[j][g] = -(sum(before) + sum(behind));
            }
        }
        Some(Self { columns })
    }

    /// Solves for the right-hand side `b` in place.
    #[inline(always)]
    pub fn solve<S: SecondOrder<N>>(&self, b: &mut [f64; N]) {
        let (first, count) = S::ALIKE;
        let columns = &self.columns;
        // plain loops: what they call is inlined into the vectors' width
        let mut x = [0.0; N];
        for i in 0..N {
            x[i] = in_pairs(count, |k| columns[first + k][i] * b[first + k]);
        }
        let mut left = *b;
        for j in (0..N).filter(|&j| !is_alike::<N, S>(j)) {
            left[j] += x[j];
            x[j] = 0.0;
        }
        for range in others::<N, S>() {
            for j in range {
                for i in 0..N {
                    x[i] += columns[j][i] * left[j];
                }
            }
        }
        *b = x;
    }
}

/// Σ of `columns` times `x`, those of bodies that may be alike in pairs.
#[inline(always)]
pub fn times<const N: usize, S: SecondOrder<N>>(columns: &Matrix<N>, x: &[f64; N]) -> [f64; N] {
    let (first, count) = S::ALIKE;
    let mut sum = [0.0; N];
    for i in 0..N {
        sum[i] = in_pairs(count, |k| columns[first + k][i] * x[first + k]);
    }
    for range in others::<N, S>() {
        for j in range {
            for i in 0..N {
                sum[i] += columns[j][i] * x[j];
            }
        }
    }
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
