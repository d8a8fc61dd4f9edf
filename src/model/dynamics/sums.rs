//! Sums over completed steps.

use serde::{Deserialize, Serialize};

use super::ledger_rates::{LedgerRates, simpson};
use super::shaft_means::TorqueMeans;
use crate::integrate::Step;
use crate::model::scene::OilSpec;
use crate::model::setup::{CONTACT_HEAT, HEATS};
use crate::model::thermal::Thermal;
use crate::numeric::Finite;

/// Sums to which completed steps add.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Sums {
    /// Work of all inputs since the start [J].
    pub work: f64,
    /// Heat since the start by cause [J].
    pub heat: [f64; HEATS],
    /// Temperatures.
    pub thermal: Thermal,
    /// Means of the shaft torques over whole mesh cycles, for the torque bias.
    pub torque_means: TorqueMeans,
}

impl Default for Sums {
    fn default() -> Self {
        let thermal = Thermal::uniform(OilSpec::default().temperature);
        Self { work: 0.0, heat: [0.0; HEATS], thermal, torque_means: TorqueMeans::default() }
    }
}

impl Sums {
    /// Adds work and heat of a step. Without `all`, only contact produces heat.
    #[inline]
    pub fn add<const N: usize>(&mut self, step: &Step<N, LedgerRates>, all: bool) {
        self.work += simpson(step, |p| p.input);
        for i in 0..if all { HEATS } else { CONTACT_HEAT + 1 } {
            self.heat[i] += simpson(step, |p| p.heat[i]);
        }
    }

    /// True if all numbers are valid.
    pub fn is_valid(&self) -> bool {
        let Self { work, heat, thermal, torque_means } = self;
        Finite::is_finite(work) && heat.is_finite() && thermal.is_valid() && torque_means.is_finite()
    }
}
