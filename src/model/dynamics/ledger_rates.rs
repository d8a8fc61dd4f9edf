//! Ledger of a step: work and heat from their rates, and their balance with the energy.

use serde::{Deserialize, Serialize};

use crate::integrate::{Imbalance, Step};
use crate::model::scene::PAIRS;
use crate::model::setup::{CONTACT_HEAT, HEATS};
use crate::numeric::finite;

/// Rates of the ledger, and torques that steps record.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct LedgerRates {
    /// Net power of all inputs into the system [W].
    pub input: f64,
    /// Power converted to heat, by cause [W].
    pub heat: [f64; HEATS],
    /// Torques of the half-shafts [N·m].
    pub shaft: [f64; 2],
    /// Limit torque of the dry friction on each pair that slides [N·m].
    pub limit: [f64; PAIRS],
}

/// Fraction of the kinetic energy by which rounding may disturb the balance of a step.
const ENERGY_ROUNDING: f64 = 1e-13;

finite!(LedgerRates { input, heat, shaft, limit });

impl LedgerRates {
    /// Mean of two rates.
    pub fn mean(&self, other: &Self) -> Self {
        let mean = |a: f64, b: f64| 0.5 * (a + b);
        Self {
            input: mean(self.input, other.input),
            heat: std::array::from_fn(|i| mean(self.heat[i], other.heat[i])),
            shaft: [0, 1].map(|s| mean(self.shaft[s], other.shaft[s])),
            limit: std::array::from_fn(|i| mean(self.limit[i], other.limit[i])),
        }
    }

    /// Σ weight · rates.
    pub fn combined(of: [(f64, &Self); 5]) -> Self {
        let sum = |value: &dyn Fn(&Self) -> f64| of.iter().map(|(weight, rates)| weight * value(rates)).sum();
        Self {
            input: sum(&|p| p.input),
            heat: std::array::from_fn(|i| sum(&|p| p.heat[i])),
            shaft: [0, 1].map(|s| sum(&|p| p.shaft[s])),
            limit: std::array::from_fn(|i| sum(&|p| p.limit[i])),
        }
    }

    /// Residual of the energy balance of a step of size `h` [s], and the energy exchanged in the step: stored energy,
    /// work and heat. The energies before and after the step are kinetic and stored energy [J]. Without `ALL`, only
    /// contact produces heat.
    ///
    /// Kinetic energy does not count as exchanged, because most of it stays in the bodies. The residual is reduced by
    /// its rounding.
    #[inline]
    pub fn imbalance<const ALL: bool>([before, after]: [[f64; 2]; 2], h: f64, [a, m, b]: &[Self; 3]) -> Imbalance {
        let simpson = |of: &dyn Fn(&Self) -> f64| h / 6.0 * (of(a) + 4.0 * of(m) + of(b));
        let work = simpson(&|p| p.input);
        let heat = simpson(&|p| if ALL { p.heat.iter().sum() } else { p.heat[CONTACT_HEAT] });
        let gained = (after[0] - before[0]) + (after[1] - before[1]);
        let exchanged = before[1].max(after[1]) + work.abs() + heat.abs();
        let off = (gained - work + heat).abs() - ENERGY_ROUNDING * (before[0] + after[0]);
        Imbalance { residual: off.max(0.0), exchanged }
    }
}

/// Simpson's rule on start, middle and end of a step.
#[inline]
pub fn simpson<const N: usize>(step: &Step<N, LedgerRates>, of: impl Fn(&LedgerRates) -> f64) -> f64 {
    let [a, m, b] = &step.ledger_rates;
    step.h / 6.0 * (of(a) + 4.0 * of(m) + of(b))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::numeric::Finite;

    #[test]
    fn rates_with_a_limit_torque_that_is_not_finite_are_not_finite() {
        let mut rates = LedgerRates::default();
        assert!(rates.is_finite());
        rates.limit[PAIRS - 1] = f64::NAN;
        assert!(!rates.is_finite());
    }
}
