//! Elastic and mass data, and moments of inertia of the bodies.

use serde::{Deserialize, Serialize};

/// Elastic and mass data of both gears.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Material {
    /// Young's modulus E [Pa].
    pub young_modulus: f64,
    /// Poisson's ratio ν.
    pub poisson_ratio: f64,
    /// Density ρ [kg/m³].
    pub density: f64,
}

/// Moments of inertia about the axis of rotation [kg·m²].
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct InertiaSpec {
    /// Gears from their solids; otherwise as given below.
    pub from_geometry: bool,
    /// Carrier with ring gear and cross-shaft, without planets.
    pub carrier: f64,
    /// One side gear, if not from geometry.
    pub side_gear: f64,
    /// One planet about its own axis, if not from geometry.
    pub planet: f64,
    /// Wheel side of the left half-shaft, rigid on the side gear unless the shaft twists; 0 = none.
    pub left_end: f64,
    /// Wheel side of the right half-shaft, rigid on the side gear unless the shaft twists; 0 = none.
    pub right_end: f64,
}
