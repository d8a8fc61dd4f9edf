//! Temperatures of oil, gears, clutch packs, washers and case.

pub mod network;
#[cfg(test)]
#[path = "tests/network.rs"]
mod network_tests;

use serde::{Deserialize, Serialize};

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

/// Change of a temperature that friction does not feel yet [K]: limit torques follow in steps of this size.
const UNFELT: f64 = 0.5;

/// Temperatures of all nodes, and the heat that made them.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Thermal {
    /// Temperature of all nodes at the start [K].
    start: f64,
    /// What each has warmed up by since [K].
    pub rises: [f64; NODES],
    /// Temperatures as friction feels them [K].
    pub felt: [f64; NODES],
    /// Heat of the ledger that has entered each node [J].
    pub entered: [f64; NODES],
    /// Heat given off to ambient and a sump of given temperature [J].
    pub given_off: f64,
    /// Time since friction last felt a change [s].
    pub since: f64,
    /// Longest step: temperatures, at their last rate, change by what friction does not feel [s].
    pub longest: f64,
}

impl Thermal {
    /// All nodes at `temperature` [K].
    pub fn uniform(temperature: f64) -> Self {
        Self {
            start: temperature,
            rises: [0.0; NODES],
            felt: [temperature; NODES],
            entered: [0.0; NODES],
            given_off: 0.0,
            since: 0.0,
            longest: f64::MAX,
        }
    }

    /// Temperatures [K].
    pub fn temperatures(&self) -> [f64; NODES] {
        self.rises.map(|rise| self.start + rise)
    }

    /// Whether friction is to feel the present temperatures.
    pub fn is_to_be_felt(&self) -> bool {
        self.change() > UNFELT
    }

    /// Lets friction feel the present temperatures.
    pub fn feel(&mut self) {
        self.longest = self.since * UNFELT / self.change();
        (self.felt, self.since) = (self.temperatures(), 0.0);
    }

    /// Largest change that friction does not feel yet [K].
    fn change(&self) -> f64 {
        self.temperatures().iter().zip(&self.felt).fold(0.0, |most, (now, felt)| most.max((now - felt).abs()))
    }

    /// Whether all numbers are finite.
    pub fn is_finite(&self) -> bool {
        let sum = |x: &[f64]| x.iter().sum::<f64>();
        let rest = self.start + self.given_off + self.since;
        (sum(&self.rises) + sum(&self.felt) + sum(&self.entered) + rest).is_finite() && self.longest >= 0.0
    }
}
