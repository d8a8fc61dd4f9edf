//! Constants of the strength rating of a pair, used at every accepted step.

use serde::{Deserialize, Serialize};

use super::{Bending, LineContact, RootStressFactors, SnCurve, ToothStrength, face_load};
use crate::geometry::Pair;

/// Contact, roots and S–N curves of a planet (index 0) and a side gear (index 1).
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Rating {
    /// Contact of the flanks.
    pub contact: LineContact,
    /// Roots.
    pub root: [RootStressFactors; 2],
    /// Strength of the roots.
    pub bending: Bending,
    /// S–N curve of the flanks.
    pub pitting: SnCurve,
    /// Exponent N_F from the face load factor to the root factor.
    pub face_exponent: f64,
    /// Angular pitches [rad].
    pub pitch: [f64; 2],
    /// Numbers of teeth.
    pub teeth: [usize; 2],
}

impl Rating {
    /// Returns the rating of `pair` with the elastic constants E [Pa] and ν, the material, and a tool of tip radius
    /// `tool_radius` modules. Returns `None` if a tooth has no valid root section or no valid root stress.
    pub fn new(
        pair: &Pair,
        (young_modulus, poisson_ratio): (f64, f64),
        material: &ToothStrength,
        tool_radius: f64,
    ) -> Option<Self> {
        Some(Self {
            contact: LineContact::new(pair, young_modulus, poisson_ratio),
            root: [RootStressFactors::new(pair, 0, tool_radius)?, RootStressFactors::new(pair, 1, tool_radius)?],
            bending: Bending { curve: material.bending, sensitivity: material.mean_stress_sensitivity() },
            pitting: material.pitting,
            face_exponent: face_load::exponent_of(pair),
            pitch: pair.gears.map(|g| g.tooth_pitch()),
            teeth: pair.gears.map(|g| g.teeth.max(0) as usize),
        })
    }
}
