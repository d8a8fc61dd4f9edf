//! Temperatures of oil, gears, clutch packs, washers and case.

pub mod network;
#[cfg(test)]
#[path = "tests/network.rs"]
mod network_tests;
pub mod of_scene;
pub mod steady;
#[cfg(test)]
#[path = "tests/steady.rs"]
mod steady_tests;

use serde::{Deserialize, Serialize};

use crate::numeric::Finite;
pub use network::Network;

/// Number of nodes.
pub const NODES: usize = 5;
/// Oil in the sump.
pub const OIL: usize = 0;
/// All gears.
pub const GEARS: usize = 1;
/// Clutch packs and lock.
pub const CLUTCH: usize = 2;
/// Thrust washers and pins.
pub const WASHERS: usize = 3;
/// Case and housing.
pub const CASE: usize = 4;

/// Temperature changes at which friction is updated [K]. The viscosity of a cold oil changes by a tenth per kelvin.
const UPDATE_THRESHOLDS: [f64; NODES] = [0.1, 0.5, 0.5, 0.5, 0.5];

/// Upper limit of step sizes, far above the time in which temperatures change [s].
const LONGEST: f64 = 1e3;
/// If the update interval is below this fraction of the longest step, the longest step is shortened immediately.
const SHORTER: f64 = 0.5;

/// Temperatures of all nodes, and the heat that they have absorbed and given off.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Thermal {
    /// Temperature of the oil at the start, to which all rises refer [K].
    start: f64,
    /// Rise of each node at the start [K].
    first: [f64; NODES],
    /// Present rise of each node [K].
    pub rises: [f64; NODES],
    /// Temperatures that friction uses [K].
    pub used: [f64; NODES],
    /// Heat of the ledger that has entered each node [J].
    pub entered: [f64; NODES],
    /// Heat given off to ambient and a sump of given temperature [J].
    pub given_off: f64,
    /// Longest step of the solver until the next update of friction [s].
    pub longest: f64,
    /// Interval in which a temperature changes by its update threshold, at the rates of the last step [s].
    update_interval: f64,
}

impl Thermal {
    /// All nodes at `temperature` [K].
    pub fn uniform(temperature: f64) -> Self {
        Self::at([temperature; NODES])
    }

    /// Nodes at `temperatures` [K].
    pub fn at(temperatures: [f64; NODES]) -> Self {
        let first = temperatures.map(|temperature| temperature - temperatures[OIL]);
        Self {
            start: temperatures[OIL],
            first,
            rises: first,
            used: temperatures,
            entered: [0.0; NODES],
            given_off: 0.0,
            longest: LONGEST,
            update_interval: LONGEST,
        }
    }

    /// Temperature change of each node since the start [K].
    pub fn gains(&self) -> [f64; NODES] {
        std::array::from_fn(|i| self.rises[i] - self.first[i])
    }

    /// Temperatures [K].
    pub fn temperatures(&self) -> [f64; NODES] {
        self.rises.map(|rise| self.start + rise)
    }

    /// True if friction must be updated with the present temperatures. Either a temperature has changed by its
    /// threshold, or it would do so well within the longest step.
    pub fn is_update_due(&self) -> bool {
        let changes = self.temperatures().into_iter().zip(self.used).map(|(now, used)| (now - used).abs());
        changes.zip(UPDATE_THRESHOLDS).any(|(change, threshold)| change > threshold)
            || self.update_interval < SHORTER * self.longest
    }

    /// Sets the update interval from the rates of all nodes, whose rises were `begin` [K] before the last `h` [s].
    fn note_rates(&mut self, begin: &[f64; NODES], h: f64) {
        let rates = self.rises.iter().zip(begin).map(|(end, begin)| (end - begin).abs() / h);
        let fastest = rates.zip(UPDATE_THRESHOLDS).fold(0.0, |most: f64, (rate, threshold)| most.max(rate / threshold));
        self.update_interval = LONGEST.min(1.0 / fastest.max(f64::MIN_POSITIVE));
        // a burst of heat that had shortened the steps is over: an infinite longest step causes an update of friction,
        // which determines the longest step again
        if h > SHORTER * self.longest && SHORTER * self.update_interval > self.longest {
            self.longest = f64::INFINITY;
        }
    }

    /// Updates the temperatures that friction uses, and the longest step until the next update.
    pub fn use_temperatures(&mut self) {
        (self.used, self.longest) = (self.temperatures(), self.update_interval);
    }

    /// True if all temperatures and heats are finite and all step sizes are positive. Step sizes may be infinite.
    pub fn is_valid(&self) -> bool {
        let Self { start, first, rises, used, entered, given_off, longest, update_interval } = self;
        let are_numbers = [first, rises, used, entered].into_iter().all(Finite::is_finite);
        are_numbers && [*start, *given_off].is_finite() && *longest > 0.0 && *update_interval > 0.0
    }
}
