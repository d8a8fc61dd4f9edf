//! Inputs that change with time.
//!
//! Accelerations are linear in torques and in imposed accelerations, with constant coefficients. Inputs that follow a
//! parabola, u(t) = u + u̇ t + ü t²/2, therefore add a parabola of time to the accelerations at constant inputs: Δv̇ =
//! a₀ + a₁ t + a₂ t². They add the power Σ J Δv̇ v to the power of the inputs. Brake torques are an exception, and
//! so is a pinion with friction under the torque of its mesh: the equations are evaluated at the inputs of each time.

use super::shape::Shape;
use super::{Equations, FrictionEquations, PinionLoss};
use crate::integrate::Point;
use crate::model::scene::{InputDerivatives, Inputs};

/// Terms that changing inputs add to the accelerations.
#[derive(Clone, Copy)]
pub struct Driven<const N: usize> {
    /// True if inputs change.
    pub changes: bool,
    /// True if the equations must be evaluated at the inputs of each time.
    pub scales: bool,
    /// Coefficients a₀, a₁ and a₂ of the parabola, unless `scales`.
    pub by_order: [[f64; N]; 3],
}

impl<const N: usize> Driven<N> {
    /// Constant inputs.
    pub const NO: Self = Self { changes: false, scales: false, by_order: [[0.0; N]; 3] };
    /// Inputs for which the equations must be evaluated at each time.
    pub const SCALES: Self = Self { changes: true, scales: true, ..Self::NO };

    /// Adds the parabola at `time` [s] to the accelerations.
    #[inline(always)]
    fn add(&self, time: f64, accelerations: &mut [f64; N]) {
        let [zero, one, two] = &self.by_order;
        for (i, acceleration) in accelerations.iter_mut().enumerate() {
            *acceleration += zero[i] + time * (one[i] + time * two[i]);
        }
    }

    /// ∂(accelerations)/∂t at `time` [s].
    pub fn slope(&self, time: f64) -> [f64; N] {
        std::array::from_fn(|i| self.by_order[1][i] + 2.0 * time * self.by_order[2][i])
    }
}

impl<const N: usize, S: Shape<N>> Equations<'_, S, N> {
    /// Terms that the inputs add to the accelerations.
    #[inline(never)]
    pub(super) fn driven_terms(&self, derivatives: &InputDerivatives) -> Driven<N> {
        let [first, second] = &derivatives.rates;
        let (plan, inverse) = (&self.teeth.plan, &self.teeth.inverse_inertia);
        let friction_changes = || [first, second].iter().any(|rates| rates.friction_commands() != [[0.0; 2]; 2]);
        if S::MAY_ACT && (friction_changes() || self.sliding_pinion().is_some()) {
            return Driven::SCALES;
        }
        let mut by_order = [[0.0; N]; 3];
        let mut torque = |i: usize, of: fn(&Inputs, usize) -> f64, s: usize| {
            (by_order[1][i], by_order[2][i]) = (inverse[i] * of(first, s), 0.5 * inverse[i] * of(second, s));
        };
        for s in (0..2).filter(|&s| !plan.side_imposed[s]) {
            torque(if S::MAY_ACT { self.wheel(s) } else { s }, |inputs, s| -inputs.load_torque[s], s);
        }
        if !plan.drive_imposed {
            torque(self.port(), |inputs, _| inputs.drive_torque, 0);
        }
        let mut acceleration = |i: usize, of: fn(&Inputs, usize) -> f64, s: usize| {
            // if effects may act, the equations already contain the first derivative
            (by_order[0][i], by_order[1][i]) = (if S::MAY_ACT { 0.0 } else { of(first, s) }, of(second, s));
        };
        if plan.drive_imposed {
            acceleration(self.port(), |inputs, _| inputs.drive_speed, 0);
        }
        for s in (0..2).filter(|&s| plan.side_imposed[s]) {
            acceleration(self.end(s), |inputs, s| inputs.side_speed[s], s);
        }
        for g in (0..self.groups()).filter(|_| plan.spin_imposed) {
            acceleration(self.planet(g), |inputs, _| inputs.planet_spin, 0);
        }
        Driven { changes: true, scales: false, by_order }
    }

    /// True if the equations must be evaluated at the inputs of each time.
    #[inline]
    pub(super) fn scales_by_inputs(&self) -> bool {
        S::MAY_ACT && self.driven.scales
    }

    /// Adds the terms of changing inputs at `time` [s] to the accelerations.
    #[inline(always)]
    pub(super) fn add_by_inputs(&self, time: f64, accelerations: &mut [f64; N]) {
        if S::MAY_CHANGE && (!S::MAY_ACT || self.driven.changes) {
            self.driven.add(time, accelerations);
        }
    }

    /// Power of the terms of changing inputs at `time` [s] and at the velocities of `at` [W].
    #[inline]
    pub(super) fn added_power(&self, at: &Point<N>, time: f64) -> f64 {
        if S::MAY_CHANGE && self.driven.changes { self.power_of_parabola(at, time) } else { 0.0 }
    }

    #[inline(never)]
    fn power_of_parabola(&self, at: &Point<N>, time: f64) -> f64 {
        let mut added = [0.0; N];
        self.driven.add(time, &mut added);
        let power = |i: usize| self.teeth.inertia[i] * added[i] * at.v[i];
        let other_members = |g: usize| (self.members(g) - 1.0) * power(self.planet(g));
        (0..self.count()).map(power).sum::<f64>() + self.sum(other_members)
    }
}
