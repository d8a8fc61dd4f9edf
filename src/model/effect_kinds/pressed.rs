//! Pressure times speed of a rubbing surface, and friction beyond a limit of it.
//!
//! ```text
//! p v = ω (P + P_F F + P_L L)      friction × g(p v),   g = 1 up to the limit,   g = b from 1.05 × the limit
//! ```
//!
//! with the slip speed ω, the thrust F and the load L on the surface. A normal force N on the area A at the radius r has p =
//! N/A and v = ω r. A friction torque T = μ N r has p v = T ω/(μ A). Between the limit and its end u = 0 … 1 the factor is g =
//! 1 + (b − 1) u² (3 − 2u), so that it has a derivative everywhere. Temperature changes μ, not N: p v does not feel it.
//!
//! Source: J. E. Shigley, Mechanical Engineering Design, on boundary-lubricated bearings, for p v as what a surface bears.

use super::SurfaceLoad;

/// Width of the band in which friction changes, over the limit.
const BAND: f64 = 0.05;

/// Pressure times radius of a surface [N/m]: a constant, and per thrust and load.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Pressed {
    /// Constant part [N/m].
    pub constant: f64,
    /// Per thrust [1/m].
    pub per_thrust: f64,
    /// Per load, in N/m over the unit of the load.
    pub per_load: f64,
}

impl Pressed {
    /// Nothing presses.
    pub const NONE: Self = Self { constant: 0.0, per_thrust: 0.0, per_load: 0.0 };

    /// Pressure times radius under the loads `by` [N/m].
    pub fn at(&self, by: &SurfaceLoad) -> f64 {
        self.constant + self.per_thrust * by.thrust + self.per_load * by.load
    }

    /// The same pressed `factor` times as much.
    pub fn times(self, factor: f64) -> Self {
        let Self { constant, per_thrust, per_load } = self;
        Self { constant: factor * constant, per_thrust: factor * per_thrust, per_load: factor * per_load }
    }
}

/// Limit of p·v.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PvLimit {
    /// Largest p·v at which friction is as given [W/m²].
    pub limit: f64,
    /// Friction beyond the limit over that below it.
    pub beyond: f64,
}

impl PvLimit {
    /// Whether friction changes at the limit.
    pub fn acts(&self) -> bool {
        self.limit > 0.0 && self.beyond != 1.0
    }

    /// g and its slope [m²/W] at `pv` [W/m²].
    pub fn factor(&self, pv: f64) -> [f64; 2] {
        let width = BAND * self.limit;
        let u = (pv - self.limit) / width;
        if u <= 0.0 {
            return [1.0, 0.0];
        }
        if u >= 1.0 {
            return [self.beyond, 0.0];
        }
        let change = self.beyond - 1.0;
        [1.0 + change * u * u * (3.0 - 2.0 * u), change * 6.0 * u * (1.0 - u) / width]
    }
}

/// A rubbing surface; planets by their groups.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Surface {
    /// Between side gear and carrier: its washer, or its clutch pack.
    Side(usize),
    /// Pin of a planet.
    Pin(usize),
    /// Washer of a planet.
    PlanetWasher(usize),
    /// Brake of a wheel.
    Wheel(usize),
}
