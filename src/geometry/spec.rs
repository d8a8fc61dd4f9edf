//! User parameters of the gears: the inputs of every geometry formula.

use serde::{Deserialize, Serialize};

/// Rule that splits the working depth into addenda and fixes the clearance.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[repr(i32)]
pub enum AddendumSystem {
    /// Addendum 1.0 m, dedendum 1.25 m on both gears.
    Standard = 1,
    /// Gleason long-and-short addenda for straight bevel gears.
    Gleason = 2,
    /// ISO 23509 with the mean addendum factor c_ham = 0.21 + 0.29/u_v, clearance 0.25 m.
    Iso23509 = 3,
    /// The four coefficients given by the user.
    Explicit = 4,
}

/// Gear pair as specified: planet (index p) and side gear (index s), apexes coincident.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct GearSpec {
    /// Outer transverse module m [m].
    pub module: f64,
    /// Planet teeth z_p.
    pub planet_teeth: i32,
    /// Side gear teeth z_s.
    pub side_teeth: i32,
    /// Number of equally spaced planets N.
    pub planet_count: i32,
    /// Pressure angle α [rad].
    pub pressure_angle: f64,
    /// Shaft angle Σ [rad].
    pub shaft_angle: f64,
    /// Face width b [m].
    pub face_width: f64,
    /// Circumferential backlash j_t at the outer pitch circle [m].
    pub backlash: f64,
    /// Rule for addenda and dedenda.
    pub addendum_system: AddendumSystem,
    /// Planet addendum coefficient h_ap/m for [`AddendumSystem::Explicit`].
    pub planet_addendum: f64,
    /// Side gear addendum coefficient h_as/m for [`AddendumSystem::Explicit`].
    pub side_addendum: f64,
    /// Planet dedendum coefficient h_fp/m for [`AddendumSystem::Explicit`].
    pub planet_dedendum: f64,
    /// Side gear dedendum coefficient h_fs/m for [`AddendumSystem::Explicit`].
    pub side_dedendum: f64,
    /// Fillet radius at the root of the teeth, in modules.
    pub root_fillet: f64,
    /// Diameter of the planet's bore (its pin) [m]; 0 = solid.
    pub planet_bore: f64,
    /// Diameter of the side gear's bore (its shaft) [m]; 0 = solid.
    pub side_bore: f64,
}

impl Default for GearSpec {
    /// The study's gear pair.
    fn default() -> Self {
        Self {
            module: 4.5e-3,
            planet_teeth: 10,
            side_teeth: 16,
            planet_count: 2,
            pressure_angle: 20f64.to_radians(),
            shaft_angle: 90f64.to_radians(),
            face_width: 20e-3,
            backlash: 1e-4,
            addendum_system: AddendumSystem::Gleason,
            planet_addendum: 1.0,
            side_addendum: 1.0,
            planet_dedendum: 1.25,
            side_dedendum: 1.25,
            root_fillet: 0.40,
            planet_bore: 0.0,
            side_bore: 0.0,
        }
    }
}
