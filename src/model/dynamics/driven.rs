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
pub struct Driven<const N: usize> {
    /// Whether they change.
    pub changes: bool,
    /// Whether the equations are to be evaluated at the inputs of the time.
    pub scales: bool,
    /// Otherwise, a₀, a₁ and a₂.
    pub by_order: [[f64; N]; 3],
}

impl<const N: usize> Driven<N> {
    /// Inputs are constant.
    pub const NO: Self = Self { changes: false, scales: false, by_order: [[0.0; N]; 3] };
    /// Equations are to be evaluated at the inputs of the time.
    pub const SCALES: Self = Self { changes: true, scales: true, ..Self::NO };

    /// Adds to the accelerations at `time` [s].
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
            return Driven::SCALES;
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
        Driven { changes: true, scales: false, by_order }
    }

    /// Whether the equations are to be evaluated at the inputs of the time.
    #[inline]
    pub(super) fn scales_by_inputs(&self) -> bool {
        S::MAY_ACT && self.driven.scales
    }

    /// Adds to the accelerations at `time` [s] what changing inputs add.
    #[inline(always)]
    pub(super) fn add_by_inputs(&self, time: f64, accelerations: &mut [f64; N]) {
        if S::MAY_CHANGE && (!S::MAY_ACT || self.driven.changes) {
            self.driven.add(time, accelerations);
        }
    }

    /// Power of what changing inputs add, at the velocities of `at` at `time` [s] [W].
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
