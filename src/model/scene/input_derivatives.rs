//! How inputs change between communication points: u(t) = u + u̇ t + ü t²/2, as far as the host gives derivatives.
//!
//! Torques follow the parabola, and so do imposed speeds, whose derivatives are accelerations. Lock and fault are commands:
//! they follow it too, but act at the start of a step.

use serde::{Deserialize, Serialize};

use super::Inputs;
use crate::numeric::finite;

/// Highest order of the derivatives.
pub const ORDERS: usize = 2;

/// Derivatives of the inputs: u̇ and ü [unit of the input per s and per s²].
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct InputDerivatives {
    /// By order, the first first.
    pub rates: [Inputs; ORDERS],
}

finite!(InputDerivatives { rates });

impl InputDerivatives {
    /// Inputs that stay constant.
    pub const ZERO: Self = Self { rates: [Inputs::ZERO; ORDERS] };

    /// Returns the derivatives of each input, or those of `other` where the `mask` is not 0.
    pub fn pick(&self, other: &Self, mask: &Inputs) -> Self {
        Self { rates: std::array::from_fn(|order| self.rates[order].pick(&other.rates[order], mask)) }
    }

    /// Inputs and their derivatives `time` [s] after they were `inputs`.
    pub fn after(&self, time: f64, inputs: &Inputs) -> (Inputs, Self) {
        let [first, second] = &self.rates;
        let unlimited = inputs.plus(time, first).plus(0.5 * time * time, second);
        let later = unlimited.limited();
        let rates = [first.plus(time, second), *second];
        if later == unlimited {
            return (later, Self { rates });
        }
        // an input that has reached its limit stays there
        (later, Self { rates: rates.map(|rate| rate.where_equal(&later, &unlimited)) })
    }
}
