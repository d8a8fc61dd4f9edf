//! User parameters of the gears, the inputs of all geometry formulas.

use crate::declaration::prelude::*;
use crate::drives::{GearContact, Scene};
use crate::numeric::FRAC_PI_2;

/// Accuracy to which a right angle can be typed [rad].
const TYPED: f64 = 5e-7;

choices! {
    /// Rule that splits the working depth into addenda and fixes the clearance.
    pub enum AddendumSystem: "AddendumSystem" {
        Standard = 1, "standard": "addendum 1.0 modules, dedendum 1.25 modules on both gears";
        Gleason = 2, "gleason": "Gleason long-and-short addenda";
        Iso23509 = 3, "iso23509": "ISO 23509 mean addendum factor, clearance 0.25 modules";
        Explicit = 4, "explicit": "geometry.planet_addendum, planet_dedendum, side_addendum and side_dedendum";
    }
}

parameters! {
    /// Specification of a gear pair: planet (index p) and side gear (index s) with coincident apexes.
    ///
    /// The default is the study's gear pair, but with Gleason's addenda.
    pub struct GearSpec in "geometry" {
        /// Outer transverse module
        module: f64 = 4.5e-3, METRE | MM, 2e-4..=0.1;
        /// Number of teeth of a planet
        planet_teeth: i32 = 10, 5..=200;
        /// Number of teeth of a side gear
        side_teeth: i32 = 16, 5..=200;
        /// Number of equally spaced planets; 2 side_teeth / planet_count must be an integer
        planet_count: i32 = 2, 2..=4;
        /// Pressure angle
        pressure_angle: f64 = 20f64.to_radians(), RADIAN | DEG, 0.17..=0.53;
        /// Angle between planet and side gear axes: two equal coaxial side gears can mesh with the same planet only at 90 deg
        shaft_angle: f64 = FRAC_PI_2, RADIAN | DEG, FRAC_PI_2 - TYPED..=FRAC_PI_2 + TYPED;
        /// Face width
        face_width: f64 = 20e-3, METRE | MM, 1e-4..=1.0;
        /// Rule for addenda and dedenda
        addendum_system: AddendumSystem = AddendumSystem::Gleason;
        /// Planet addendum per module, if geometry.addendum_system = explicit
        planet_addendum: f64 = 1.0, ONE, 0.05..=3.0, when(is!(Self.addendum_system, AddendumSystem::Explicit));
        /// Side gear addendum per module, if geometry.addendum_system = explicit
        side_addendum: f64 = 1.0, ONE, 0.05..=3.0, when(is!(Self.addendum_system, AddendumSystem::Explicit));
        /// Planet dedendum per module, if geometry.addendum_system = explicit
        planet_dedendum: f64 = 1.25, ONE, 0.05..=3.0, when(is!(Self.addendum_system, AddendumSystem::Explicit));
        /// Side gear dedendum per module, if geometry.addendum_system = explicit
        side_dedendum: f64 = 1.25, ONE, 0.05..=3.0, when(is!(Self.addendum_system, AddendumSystem::Explicit));
        /// Thickness per module that each planet tooth gains and each side gear tooth loses at the outer pitch circle
        thickness_shift: f64 = 0.0, ONE, -0.5..=0.5;
        /// Circumferential backlash at the outer pitch circle
        backlash: f64 = 1e-4, METRE | MM, 0.0..=0.05, when(is!(PlainTeeth.backlash, true));
        /// Root fillet radius per module, for the tooth stiffness
        root_fillet: f64 = 0.40, ONE, 0.0..=1.0;
        /// Bore diameter of a planet (pin diameter), for mass and rim; 0 = no bore
        planet_bore: f64 = 0.0, METRE | MM, 0.0..=10.0;
        /// Bore diameter of a side gear (shaft diameter), for mass and rim; 0 = no bore
        side_bore: f64 = 0.0, METRE | MM, 0.0..=10.0;
    }
}

impl GearSpec {
    /// Thickness per module that each tooth of gear `i` (0 planet, 1 side gear) gains by `thickness_shift`.
    pub fn thickening(&self, i: usize) -> f64 {
        if i == 0 { self.thickness_shift } else { -self.thickness_shift }
    }
}

parameters! {
    /// Switches of plain teeth, which belong to no effect.
    pub struct PlainTeeth in "effects" {
        /// Backlash between the teeth; false: none
        backlash: bool = true;
        /// Tip-corner contact outside the path of contact; false: pairs enter and leave abruptly
        corner_contact: bool = true, when(differs!(Scene.gear_contact, GearContact::Ideal));
    }
}
