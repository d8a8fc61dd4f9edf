//! The linear systems of implicit methods on the second-order block.
//!
//! With y = (q, v), q̇ = B v, K = ∂v̇/∂q and D = ∂v̇/∂v the q-rows of (I/s − J) U = r are solved by hand, so that the
//! matrix to factorise has the order of the velocities alone:
//!
//!   (I/s − D − s K B) U_v = r_v + s K r_q,   U_q = s (r_q + B U_v).

use super::linear::Factors;
use super::system::{Linearisation, Matrix, Point, SecondOrder, sum};

/// I/s − J, factorised.
pub struct Block<const N: usize> {
    factors: Factors<N>,
    s: f64,
}

impl<const N: usize> Block<N> {
    /// Factorises I/s − J; `None` if it is singular.
    #[inline(always)]
    pub fn new<E: SecondOrder<N>>(system: &E, lin: &Linearisation<N, E::Power>, s: f64) -> Option<Self> {
        let mut matrix = lin.by_position;
        system.times_rates(&mut matrix);
        for i in 0..N {
            for j in 0..N {
                matrix[i][j] = -lin.by_velocity[i][j] - s * matrix[i][j];
            }
            matrix[i][i] += 1.0 / s;
        }
        Some(Self { factors: Factors::new::<E>(matrix)?, s })
    }

    /// Solves for the right-hand side `r` in place.
    #[inline(always)]
    pub fn solve<E: SecondOrder<N>>(&self, system: &E, by_position: &Matrix<N>, r: &mut Point<N>) {
        let s = self.s;
        for i in 0..N {
            r.v[i] += s * sum::<N, E>(0, N, |j| by_position[i][j] * r.q[j]);
        }
        self.factors.solve::<E>(&mut r.v);
        let rate = system.rates(&r.v);
        for i in 0..N {
            r.q[i] = s * (r.q[i] + rate[i]);
        }
    }
}
