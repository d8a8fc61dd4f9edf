//! What a user gives to define the contact law.

use serde::{Deserialize, Serialize};

/// Law of force against penetration.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[repr(i32)]
pub enum ContactLaw {
    /// Adams IMPACT, acting at the mean cone distance.
    Impact = 1,
}

/// Contact law and its constants.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct ContactSpec {
    /// The law.
    pub law: ContactLaw,
    /// Stiffness by the study's Hertz formula instead of the given one.
    pub stiffness_from_hertz: bool,
    /// Stiffness K [N/m^e].
    pub stiffness: f64,
    /// Exponent e.
    pub exponent: f64,
    /// Damping C at full penetration [N·s/m].
    pub damping: f64,
    /// Penetration of full damping d_max [m].
    pub penetration_depth: f64,
}

impl Default for ContactSpec {
    /// The study's Adams settings.
    fn default() -> Self {
        Self {
            law: ContactLaw::Impact,
            stiffness_from_hertz: false,
            // 5.77e5 N/mm^1.5 · (1000 mm/m)^1.5
            stiffness: 5.77e5 * 1e3 * libm::sqrt(1e3),
            exponent: 1.5,
            damping: 5e4,
            penetration_depth: 1e-4,
        }
    }
}
