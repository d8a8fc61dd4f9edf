//! User parameters of the contact law.

use serde::{Deserialize, Serialize};

/// Law of force against penetration.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[repr(i32)]
pub enum ContactLaw {
    /// Adams IMPACT, acting at the mean cone distance.
    Impact = 1,
    /// Stiffness of the teeth from their geometry, over the face width; the Hertz part at a given load.
    Line = 2,
    /// The same with the Hertz part as the load has it.
    LineWeber = 3,
}

/// Damping of a tooth pair.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[repr(i32)]
pub enum DampingModel {
    /// C·STEP(d, 0, 0, d_max, 1)·ḋ, as in Adams IMPACT.
    Step = 1,
    /// Hunt and Crossley's F (1 + λ ḋ), λ from a coefficient of restitution.
    Restitution = 2,
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
    /// Which damping.
    pub damping_model: DampingModel,
    /// Coefficient of restitution e at the impact speed.
    pub restitution: f64,
    /// Impact speed at which the restitution holds [m/s].
    pub impact_speed: f64,
    /// Line load at the mean cone distance for the Hertz part of [`ContactLaw::Line`] [N/m].
    pub line_load: f64,
    /// Stiffness of a lumped mesh from the geometry of its teeth instead of the given one.
    pub mesh_stiffness_from_geometry: bool,
    /// Stiffness of a lumped mesh per face width c_γ [N/m²].
    pub mesh_stiffness: f64,
}

impl Default for ContactSpec {
    /// The study's Adams settings.
    fn default() -> Self {
        Self {
            law: ContactLaw::Impact,
            stiffness_from_hertz: false,
            // 5.77e5 N/mm^1.5 · (1000 mm/m)^1.5
            stiffness: 5.77e5 * 1e3 * 1e3_f64.sqrt(),
            exponent: 1.5,
            damping: 5e4,
            penetration_depth: 1e-4,
            damping_model: DampingModel::Step,
            restitution: 0.8,
            impact_speed: 0.1,
            line_load: 4e5,
            mesh_stiffness_from_geometry: true,
            mesh_stiffness: 1.8e10,
        }
    }
}
