//! Inputs between communication points: u(t) = u + u̇ t + ü t²/2, with the derivatives that the host gives.
//!
//! Torques and imposed speeds follow the parabola; the derivatives of speeds are accelerations. The commands of lock
//! and fault follow it as well, but act only at the start of a step.

use serde::{Deserialize, Serialize};

use super::Inputs;
use crate::numeric::finite;

/// Highest order of the derivatives.
pub const ORDERS: usize = 2;

/// Derivatives of the inputs: u̇ and ü [unit of the input per s and per s²].
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct InputDerivatives {
    /// First and second derivatives.
    pub rates: [Inputs; ORDERS],
}

finite!(InputDerivatives { rates });

impl InputDerivatives {
    /// Derivatives of constant inputs.
    pub const ZERO: Self = Self { rates: [Inputs::ZERO; ORDERS] };

    /// Returns the derivatives of each input, taken from `other` if its `mask` is not 0.
    pub fn pick(&self, other: &Self, mask: &Inputs) -> Self {
        Self { rates: std::array::from_fn(|order| self.rates[order].pick(&other.rates[order], mask)) }
    }

    /// Returns the inputs and their derivatives `time` [s] after the inputs were `inputs`.
    pub fn after(&self, time: f64, inputs: &Inputs) -> (Inputs, Self) {
        let (mut later, mut rest) = (*inputs, *self);
        rest.follow(time, &mut later);
        (later, rest)
    }

    /// Advances `inputs` and these derivatives by `time` [s]. An input that has reached its limit stays there.
    pub fn follow(&mut self, time: f64, inputs: &mut Inputs) {
        inputs.follow(&mut self.rates, |value, rates, limits| follow_parabola(value, rates, limits, time));
    }
}

/// Advances a value and its first and second derivatives by `time` [s]. If the value would pass one of its `limits`, it
/// stays at the limit, and both derivatives become 0.
#[inline(never)]
fn follow_parabola(value: &mut f64, [first, second]: [&mut f64; 2], limits: [f64; 2], time: f64) {
    let unlimited = *value + time * *first + 0.5 * time * time * *second;
    *value = unlimited.clamp(limits[0], limits[1]);
    *first += time * *second;
    if *value != unlimited {
        (*first, *second) = (0.0, 0.0);
    }
}
