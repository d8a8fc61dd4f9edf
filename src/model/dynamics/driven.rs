//! Inputs that change while they act.
//!
//! Accelerations are linear in torques and in imposed accelerations, with constant coefficients. So inputs that follow a parabola,
//! u(t) = u + u̇ t + ü t²/2, add a parabola of time to the accelerations at constant inputs, Δv̇ = a₀ + a₁ t + a₂ t², and the power
//! Σ J Δv̇ v to that of the inputs. Only a final drive whose teeth scale what the carrier is given, and torques of brakes, need the
//! equations at the inputs of the time.

use super::shape::Shape;
use super::{Acted, Equations};
use crate::integrate::Point;
use crate::model::scene::{CARRIER, InputDerivatives, Inputs};

/// What inputs add to the accelerations while they change.
#[derive(Clone, Copy)]
pub enum Driven<const N: usize> {
    /// Nothing: they are constant.
    No,
    /// A parabola of time: its coefficients, from the constant on.
    Adds([[f64; N]; 3]),
    /// More than that.
    Scales,
}

impl<const N: usize, S: Shape<N>> Equations<'_, S, N> {
    /// What the inputs that act add.
    #[inline(never)]
    pub(super) fn addition(&self, derivatives: &InputDerivatives) -> Driven<N> {
        let [first, second] = &derivatives.rates;
        let (plan, inverse) = (&self.teeth.plan, &self.teeth.inverse_inertia);
        let moves_carrier = |rates: &Inputs| rates.carrier_speed != 0.0 || rates.carrier_torque != 0.0;
        let scales = S::MAY_ACT
            && ([first, second].iter().any(|rates| rates.brake_torque != [0.0; 2])
                || [first, second].iter().any(|rates| moves_carrier(rates))
                    && self.teeth.effect_terms.body_effects.scale_carrier_inputs());
        if scales {
            return Driven::Scales;
        }
        let mut by_order = [[0.0; N]; 3];
        let mut torque = |i: usize, of: fn(&Inputs, usize) -> f64, s: usize| {
            (by_order[1][i], by_order[2][i]) = (inverse[i] * of(first, s), 0.5 * inverse[i] * of(second, s));
        };
        for s in (0..2).filter(|&s| !plan.side_imposed[s]) {
            torque(if S::MAY_ACT { self.wheel(s) } else { s }, |inputs, s| -inputs.load_torque[s], s);
        }
        if !plan.carrier_imposed {
            torque(CARRIER, |inputs, _| inputs.carrier_torque, 0);
        }
        let mut acceleration = |i: usize, of: fn(&Inputs, usize) -> f64, s: usize| {
            // where effects may act the equations have the first of them already
            (by_order[0][i], by_order[1][i]) = (if S::MAY_ACT { 0.0 } else { of(first, s) }, of(second, s));
        };
        if plan.carrier_imposed {
            acceleration(CARRIER, |inputs, _| inputs.carrier_speed, 0);
        }
        for s in (0..2).filter(|&s| plan.side_imposed[s]) {
            acceleration(self.end(s), |inputs, s| inputs.side_speed[s], s);
        }
        for g in (0..self.groups()).filter(|_| plan.spin_imposed) {
            acceleration(self.planet(g), |inputs, _| inputs.planet_spin, 0);
        }
        Driven::Adds(by_order)
    }

    /// Adds to the accelerations at `time` [s] what `by_order` gives; returns the power of it at the velocities of `at` [W].
    #[inline]
    pub(super) fn add_parabola(
        &self,
        by_order: &[[f64; N]; 3],
        (at, time): (&Point<N>, f64),
        accelerations: &mut [f64; N],
    ) -> f64 {
        let mut power = 0.0;
        for i in 0..self.count() {
            let added = by_order[0][i] + time * (by_order[1][i] + time * by_order[2][i]);
            accelerations[i] += added;
            power += self.teeth.inertia[i] * added * at.v[i];
        }
        for g in 0..self.groups() {
            let i = self.planet(g);
            let added = by_order[0][i] + time * (by_order[1][i] + time * by_order[2][i]);
            power += (self.members(g) - 1.0) * self.teeth.inertia[i] * added * at.v[i];
        }
        power
    }

    /// ∂(accelerations)/∂t at `time` [s] of what `by_order` gives.
    pub(super) fn slope_of_parabola(by_order: &[[f64; N]; 3], time: f64) -> [f64; N] {
        std::array::from_fn(|i| by_order[1][i] + 2.0 * time * by_order[2][i])
    }
}
