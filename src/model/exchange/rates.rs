//! The equations of motion as functions of positions and velocities, for other solvers.

use crate::integrate::{Point, SecondOrder};
use crate::model::dynamics::with_equations;
use crate::model::run::Simulation;

/// Point with the first `n` of positions `q` and velocities `v`.
fn first<const N: usize>(n: usize, q: &[f64], v: &[f64]) -> Point<N> {
    let mut point = Point::ZERO;
    point.q[..n].copy_from_slice(&q[..n]);
    point.v[..n].copy_from_slice(&v[..n]);
    point
}

impl Simulation {
    /// Number n of degrees of freedom.
    pub fn degrees_of_freedom(&self) -> usize {
        self.model.ideal.plan.layout().count()
    }

    /// Equations of motion, for other solvers: rates of positions and accelerations [rad/s, rad/s², m/s²] at the first
    /// n of positions `q` and velocities `v`, under the present inputs.
    pub fn rates(&self, q: &[f64], v: &[f64], [dq, dv]: [&mut [f64]; 2]) {
        let (inputs, state) = (&self.inputs, &self.state);
        with_equations!(self.model, state, inputs, |equations| {
            let n = equations.degrees_of_freedom();
            let at = first::<N>(n, q, v);
            let (acceleration, _) = equations.evaluate(&at);
            dq[..n].copy_from_slice(&equations.rates(&at.v)[..n]);
            dv[..n].copy_from_slice(&acceleration[..n]);
        });
    }

    /// Derivatives of the results of [`Self::rates`] with respect to positions and velocities: 2n rows of 2n columns,
    /// row by row, ordered (positions, velocities).
    pub fn slopes(&self, q: &[f64], v: &[f64], rows: &mut [f64]) {
        let (inputs, state) = (&self.inputs, &self.state);
        with_equations!(self.model, state, inputs, |equations| {
            let n = equations.degrees_of_freedom();
            let at = first::<N>(n, q, v);
            let linearisation = equations.linearise(&at);
            let mut rates: [[f64; N]; N] = std::array::from_fn(|i| std::array::from_fn(|j| f64::from(i == j)));
            equations.times_rates(&mut rates);
            for (i, row) in rows.chunks_exact_mut(2 * n).enumerate().take(2 * n) {
                let (by_position, by_velocity) = row.split_at_mut(n);
                if i < n {
                    by_position.fill(0.0);
                    by_velocity.copy_from_slice(&rates[i][..n]);
                } else {
                    by_position.copy_from_slice(&linearisation.by_position[i - n][..n]);
                    by_velocity.copy_from_slice(&linearisation.by_velocity[i - n][..n]);
                }
            }
        });
    }

    /// Returns a copy at positions `q` and velocities `v`, for its outputs there. The ledger is unchanged.
    pub fn moved(&self, q: &[f64], v: &[f64]) -> Self {
        let mut moved = self.clone();
        let n = self.degrees_of_freedom();
        moved.state.q[..n].copy_from_slice(&q[..n]);
        moved.state.v[..n].copy_from_slice(&v[..n]);
        moved.forces = None;
        moved
    }
}
