//! Temperatures of oil, gears, clutch packs, washers and case.

pub mod network;
#[cfg(test)]
#[path = "tests/network.rs"]
mod network_tests;
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

/// Changes of temperatures that friction does not feel yet [K]: it follows in steps of this size. The viscosity of a cold oil
/// changes by a tenth in a kelvin.
const UNFELT: [f64; NODES] = [0.1, 0.5, 0.5, 0.5, 0.5];

/// Longest step, far above any time in which temperatures change [s].
const LONGEST: f64 = 1e3;
/// Part of the longest step below which one of unfelt change makes it shorter at once.
const SHORTER: f64 = 0.5;

/// Temperatures of all nodes, and the heat that made them.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Thermal {
    /// Temperature of the oil at the start, from which all rises count [K].
    start: f64,
    /// What each node is above that at the start [K].
    first: [f64; NODES],
    /// What each is above it now [K].
    pub rises: [f64; NODES],
    /// Temperatures as friction feels them [K].
    pub felt: [f64; NODES],
    /// Heat of the ledger that has entered each node [J].
    pub entered: [f64; NODES],
    /// Heat given off to ambient and a sump of given temperature [J].
    pub given_off: f64,
    /// Longest step [s].
    pub longest: f64,
    /// Step in which temperatures, at the rate of the last one, change by what friction does not feel [s].
    unfelt_step: f64,
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
            felt: temperatures,
            entered: [0.0; NODES],
            given_off: 0.0,
            longest: LONGEST,
            unfelt_step: LONGEST,
        }
    }

    /// What each node has warmed up by since the start [K].
    pub fn gains(&self) -> [f64; NODES] {
        std::array::from_fn(|i| self.rises[i] - self.first[i])
    }

    /// Temperatures [K].
    pub fn temperatures(&self) -> [f64; NODES] {
        self.rises.map(|rise| self.start + rise)
    }

    /// Whether friction is to feel the present temperatures: they have changed, or would within a longest step.
    pub fn is_to_be_felt(&self) -> bool {
        let changes = self.temperatures().into_iter().zip(self.felt).map(|(now, felt)| (now - felt).abs());
        changes.zip(UNFELT).any(|(change, unfelt)| change > unfelt) || self.unfelt_step < SHORTER * self.longest
    }

    /// Notes how fast nodes warm up that have risen from `begin` within `h` [s].
    fn note_rates(&mut self, begin: &[f64; NODES], h: f64) {
        let rates = self.rises.iter().zip(begin).map(|(end, begin)| (end - begin).abs() / h);
        let fastest = rates.zip(UNFELT).fold(0.0, |most: f64, (rate, unfelt)| most.max(rate / unfelt));
        self.unfelt_step = LONGEST.min(1.0 / fastest.max(f64::MIN_POSITIVE));
        // a burst of heat that had shortened steps is over: friction is to feel what it made, and the longest step is found anew
        if h > SHORTER * self.longest && SHORTER * self.unfelt_step > self.longest {
            self.longest = f64::INFINITY;
        }
    }

    /// Lets friction feel the present temperatures.
    pub fn feel(&mut self) {
        (self.felt, self.longest) = (self.temperatures(), self.unfelt_step);
    }

    /// True if all numbers are finite, except for the longest step, which may be infinite, and step sizes are positive.
    pub fn is_valid(&self) -> bool {
        let Self { start, first, rises, felt, entered, given_off, longest, unfelt_step } = self;
        let are_numbers = [first, rises, felt, entered].into_iter().all(Finite::is_finite);
        are_numbers && [*start, *given_off].is_finite() && *longest > 0.0 && *unfelt_step > 0.0
    }
}
