//! Inverse of the small dense matrix of a step, applied once per stage.
//!
//! With the inner degrees of freedom p separate from the others c,
//!
//!   A = [C B; D P],   S = C − B P⁻¹ D,   x_c = S⁻¹ (b_c − B P⁻¹ b_p),   x_p = P⁻¹ b_p − P⁻¹ D x_c
//!
//! P is nearly diagonal, because inner bodies such as planets act on each other only through the other bodies. The
//! inverse is stored as columns, and a solution is a sum of columns. Sums of columns and elimination of whole rows suit
//! vector registers of any width.
//!
//! No rows are exchanged. The matrix belongs to a mechanical system and is row-scaled by inertias, so its pivots are
//! positive unless the step is far too long. A vanishing pivot is rejected, and the step becomes shorter.

use std::ops::Range;

use super::{Matrix, SecondOrder};
use crate::numeric::lanes;

/// Smallest allowed ratio of a pivot to the diagonal element it comes from.
pub const LEAST_PIVOT: f64 = 1e-10;

/// The inverse of a matrix of order `N`.
pub struct Inverse<const N: usize> {
    /// Columns [−B P⁻¹; P⁻¹] for p and [S⁻¹; −P⁻¹ D S⁻¹] for c.
    columns: Matrix<N>,
}

/// Divides row `k` of `a` by its pivot, which originally was `before`, and stores the reciprocal in the pivot's place.
/// Returns `None` if the pivot vanishes or is not finite.
#[inline(always)]
fn normalise<const N: usize>(a: &mut Matrix<N>, k: usize, before: f64) -> Option<()> {
    let pivot = a[k][k];
    // false for NaN
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

/// Eliminates the element in row `i`, column `k` with row `k`, and stores the element of the inverse in its place.
#[inline(always)]
fn eliminate<const N: usize>(a: &mut Matrix<N>, i: usize, k: usize) {
    let factor = a[i][k];
    a[i][k] = 0.0;
    for j in 0..N {
        a[i][j] -= factor * a[k][j];
    }
}

/// to += x of.
#[inline(always)]
pub fn add_times<const N: usize>(to: &mut [f64; N], x: f64, of: &[f64; N]) {
    if N.is_multiple_of(2) {
        return lanes::add_times(to, x, of);
    }
    for j in 0..N {
        to[j] += x * of[j];
    }
}

/// Layout of the degrees of freedom. It is read only once per step, because a system may be a trait object. It is
/// passed as a value, which is a constant if the system is known at compile time.
#[derive(Clone, Copy)]
pub struct Shape {
    first: usize,
    end: usize,
    count: usize,
}

impl Shape {
    /// Layout of `system`.
    #[inline(always)]
    pub fn of<const N: usize>(system: &(impl SecondOrder<N> + ?Sized)) -> Self {
        let (Range { start, end }, count) = (system.inner(), system.rows().min(N));
        Self { first: start.min(count), end: end.min(count), count }
    }

    /// Number of all rows.
    #[inline(always)]
    pub fn count(&self) -> usize {
        self.count
    }

    /// Range of the inner rows.
    #[inline(always)]
    fn inner(&self) -> Range<usize> {
        self.first..self.end
    }

    /// True if there are inner rows.
    #[inline(always)]
    fn has_inner(&self) -> bool {
        self.first < self.end
    }

    /// Ranges of the other rows, before and after the inner ones. Two plain loops are faster than one loop over both
    /// ranges.
    #[inline(always)]
    fn others(&self) -> [Range<usize>; 2] {
        [0..self.first, self.end..self.count]
    }
}

impl<const N: usize> Inverse<N> {
    /// Inverse without content. [`Inverse::fill`] must be called before use.
    pub const EMPTY: Self = Self { columns: [[0.0; N]; N] };

    /// Inverts `a` and overwrites it. Returns `None` if a pivot vanishes or is not finite.
    #[inline(always)]
    pub fn fill(&mut self, shape: Shape, a: &mut Matrix<N>) -> Option<()> {
        let (inner, columns) = (shape.inner(), &mut self.columns);
        let mut diagonal = [0.0; N];
        for i in 0..shape.count {
            diagonal[i] = a[i][i];
        }
        // [P⁻¹ D, P⁻¹]
        for k in inner.clone() {
            normalise(a, k, diagonal[k])?;
            for i in inner.clone() {
                if i != k && a[i][k] != 0.0 {
                    eliminate(a, i, k);
                }
            }
        }
        // [S, −B P⁻¹]
        for others in shape.others().into_iter().filter(|_| shape.has_inner()) {
            for i in others {
                let row = a[i];
                let mut taken = [0.0; N];
                add_in_pairs(a, &inner, &row, &mut taken);
                a[i][inner.clone()].fill(0.0);
                for j in 0..N {
                    a[i][j] -= taken[j];
                }
            }
        }
        for k in inner.clone() {
            for i in 0..shape.count {
                columns[k][i] = a[i][k];
            }
        }
        // [S⁻¹, …] and [−P⁻¹ D S⁻¹, …]
        for others in shape.others() {
            for k in others {
                normalise(a, k, diagonal[k])?;
                for i in 0..shape.count {
                    if i != k {
                        eliminate(a, i, k);
                    }
                }
            }
        }
        for others in shape.others() {
            for k in others {
                for i in 0..shape.count {
                    columns[k][i] = a[i][k];
                }
            }
        }
        Some(())
    }

    /// Solves for the right-hand side `b` in place.
    #[inline(always)]
    pub fn solve(&self, shape: Shape, b: &mut [f64; N]) {
        let (mut x, mut left) = ([0.0; N], *b);
        if shape.has_inner() {
            add_in_pairs(&self.columns, &shape.inner(), b, &mut x);
            add_times(&mut left, 1.0, &x);
            for others in shape.others() {
                x[others].fill(0.0);
            }
        }
        add(&self.columns, shape, &left, &mut x);
        *b = x;
    }
}

/// Adds the `inner` columns of a matrix times `x`, in pairs, so that two identical bodies give exactly twice the result
/// of one.
#[inline(always)]
fn add_in_pairs<const N: usize>(columns: &Matrix<N>, inner: &Range<usize>, x: &[f64; N], sum: &mut [f64; N]) {
    let one = |k: usize, i: usize| columns[inner.start + k][i] * x[inner.start + k];
    let two = |k: usize, i: usize| one(k, i) + one(k + 1, i);
    let three = |k: usize, i: usize| two(k, i) + one(k + 2, i);
    let four = |k: usize, i: usize| two(k, i) + two(k + 2, i);
    match inner.len() {
        0 => {}
        1 => add_times(sum, x[inner.start], &columns[inner.start]),
        2 => add_each(sum, |i| two(0, i)),
        3 => add_each(sum, |i| three(0, i)),
        6 => add_each(sum, |i| three(0, i) + three(3, i)),
        4 => add_each(sum, |i| four(0, i)),
        _ => add_each(sum, |i| four(0, i) + four(4, i)),
    }
}

#[inline(always)]
fn add_each<const N: usize>(sum: &mut [f64; N], term: impl Fn(usize) -> f64) {
    for i in 0..N {
        sum[i] += term(i);
    }
}

/// Adds the `columns` of the other degrees of freedom (not the inner ones) times `x`.
#[inline(always)]
fn add<const N: usize>(columns: &Matrix<N>, shape: Shape, x: &[f64; N], sum: &mut [f64; N]) {
    for others in shape.others() {
        for j in others {
            add_times(sum, x[j], &columns[j]);
        }
    }
}

/// Product of a matrix, stored as `columns`, and `x`.
#[inline(always)]
pub fn times<const N: usize>(shape: Shape, columns: &Matrix<N>, x: &[f64; N]) -> [f64; N] {
    let mut sum = [0.0; N];
    if shape.has_inner() {
        add_in_pairs(columns, &shape.inner(), x, &mut sum);
    }
    add(columns, shape, x, &mut sum);
    sum
}

#[cfg(test)]
mod tests {
    use super::*;

    fn inverse_of<const N: usize>(shape: Shape, mut m: Matrix<N>) -> Option<Inverse<N>> {
        let mut inverse = Inverse::EMPTY;
        inverse.fill(shape, &mut m).map(|()| inverse)
    }

    fn solution_satisfies<const N: usize>(shape: Shape, random: &mut impl FnMut() -> f64) {
        let mut m: Matrix<N> = std::array::from_fn(|_| std::array::from_fn(|_| random()));
        for i in 0..N {
            m[i][i] += N as f64; // dominated by its diagonal, like a step's matrix
        }
        let b: [f64; N] = std::array::from_fn(|_| random());
        let mut x = b;
        inverse_of(shape, m).unwrap().solve(shape, &mut x);
        for i in 0..shape.count {
            let residual: f64 = (0..shape.count).map(|j| m[i][j] * x[j]).sum::<f64>() - b[i];
            assert!(residual.abs() < 1e-13, "order {N}: {residual}");
        }
    }

    #[test]
    fn solution_satisfies_the_system() {
        let mut generator = fastrand::Rng::with_seed(1);
        let mut random = || generator.f64() - 0.5;
        for _ in 0..20 {
            solution_satisfies::<1>(Shape { first: 1, end: 1, count: 1 }, &mut random);
            solution_satisfies::<4>(Shape { first: 3, end: 4, count: 4 }, &mut random);
            solution_satisfies::<7>(Shape { first: 5, end: 7, count: 7 }, &mut random);
            // up to four groups of planets, with and without pins, before two attached bodies
            for inner in [1, 2, 3, 4, 6, 8] {
                solution_satisfies::<16>(Shape { first: 5, end: 5 + inner, count: 7 + inner }, &mut random);
            }
        }
        let shape = Shape { first: 2, end: 2, count: 2 };
        assert!(inverse_of(shape, [[0.0; 2]; 2]).is_none());
        assert!(inverse_of(shape, [[f64::NAN; 2]; 2]).is_none());
    }
}
