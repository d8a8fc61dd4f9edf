//! Linear systems of a step, reduced to the velocities. The reduced system is called the *second-order block*.
//!
//! With y = (q, v), q̇ = B v, K = ∂v̇/∂q and D = ∂v̇/∂v, the q-rows of (I/s − J) U = r are eliminated by hand. The
//! remaining matrix has only the order of the velocities:
//!
//!   (I/s − D − s K B) U_v = r_v + s K r_q,   U_q = s (r_q + B U_v).

use super::linear::{Inverse, Shape, add_times, times};
use super::method::IN_REGISTERS;
use super::{Linearisation, Matrix, Point, SecondOrder};
use crate::numeric::lanes;

/// The second-order block of I/s − J, inverted.
pub struct Block<const N: usize> {
    inverse: Inverse<N>,
    /// s K by columns.
    stiffness: Matrix<N>,
    /// s of I/s − J [s].
    s: f64,
}

impl<const N: usize> Block<N> {
    /// Block without content. [`Block::fill`] must be called before use.
    pub const EMPTY: Self = Self { inverse: Inverse::EMPTY, stiffness: [[0.0; N]; N], s: 0.0 };

    /// Inverts I/s − J in place, because moving the matrices costs more than inverting them. Returns `None` if the
    /// matrix is singular.
    #[inline(always)]
    pub fn fill<E: SecondOrder<N> + ?Sized>(
        &mut self,
        system: &E,
        shape: Shape,
        lin: &Linearisation<N, E::Rates>,
        s: f64,
    ) -> Option<()> {
        if N > IN_REGISTERS {
            self.fill_out_of_line(system, shape, lin, s)
        } else {
            self.fill_inline(system, shape, lin, s)
        }
    }

    /// Out-of-line copy for large systems, for which the cost of a call is negligible.
    #[inline(never)]
    fn fill_out_of_line<E: SecondOrder<N> + ?Sized>(
        &mut self,
        system: &E,
        shape: Shape,
        lin: &Linearisation<N, E::Rates>,
        s: f64,
    ) -> Option<()> {
        self.fill_inline(system, shape, lin, s)
    }

    #[inline(always)]
    fn fill_inline<E: SecondOrder<N> + ?Sized>(
        &mut self,
        system: &E,
        shape: Shape,
        lin: &Linearisation<N, E::Rates>,
        s: f64,
    ) -> Option<()> {
        let mut matrix = [[0.0; N]; N];
        matrix[..shape.count()].copy_from_slice(&lin.by_position[..shape.count()]);
        system.times_rates(&mut matrix);
        for i in 0..shape.count() {
            for j in 0..N {
                matrix[i][j] = -lin.by_velocity[i][j] - s * matrix[i][j];
            }
            matrix[i][i] += 1.0 / s;
        }
        self.inverse.fill(shape, &mut matrix)?;
        for i in 0..shape.count() {
            for j in 0..N {
                self.stiffness[j][i] = s * lin.by_position[i][j];
            }
        }
        self.s = s;
        Some(())
    }

    /// Solves for the right-hand side `r` in place.
    #[inline(always)]
    pub fn solve<E: SecondOrder<N> + ?Sized>(&self, system: &E, shape: Shape, r: &mut Point<N>) {
        if N > IN_REGISTERS { self.solve_out_of_line(system, shape, r) } else { self.solve_inline(system, shape, r) }
    }

    /// Out-of-line copy for large systems.
    #[inline(never)]
    fn solve_out_of_line<E: SecondOrder<N> + ?Sized>(&self, system: &E, shape: Shape, r: &mut Point<N>) {
        self.solve_inline(system, shape, r);
    }

    #[inline(always)]
    fn solve_inline<E: SecondOrder<N> + ?Sized>(&self, system: &E, shape: Shape, r: &mut Point<N>) {
        let s = self.s;
        let pulled = times(shape, &self.stiffness, &r.q);
        add_times(&mut r.v, 1.0, &pulled);
        self.inverse.solve(shape, &mut r.v);
        add_times(&mut r.q, 1.0, &system.rates(&r.v));
        lanes::multiply(&mut r.q, s);
    }
}
