//! Elastic and mass data, and moments of inertia of the bodies.

use crate::declaration::prelude::*;
use crate::drives::{GearContact, Scene};

parameters! {
    /// Elastic and mass data of both gears.
    pub struct Material in "material" {
        /// Young's modulus of both gears
        young_modulus: f64 = 2.07e11, PASCAL | MPA, 1e8..=1e13, when(differs!(Scene.gear_contact, GearContact::Ideal));
        /// Poisson's ratio of both gears
        poisson_ratio: f64 = 0.25, ONE, 0.0..=0.499, when(differs!(Scene.gear_contact, GearContact::Ideal));
        /// Density of the gears
        density: f64 = 7800.0, KG_PER_M3, 100.0..=3e4;
    }
}

parameters! {
    /// Moments of inertia about the axis of rotation.
    pub struct InertiaSpec in "inertia" {
        /// Inertias of side gears and planets from their geometry; false: given values
        from_geometry: bool = true;
        /// Inertia of the carrier with ring gear and cross-shaft, without planets
        carrier: f64 = 0.02, KG_M2, 1e-9..=1e6;
        /// Inertia of the pinion of the final drive, with the shaft that is rigid with it
        pinion: f64 = 0.003, KG_M2, 0.0..=1e6, when(Condition::Need(Need::Pinion));
        /// Inertia at the driven end of the propeller shaft
        propeller_end: f64 = 0.01, KG_M2, 1e-9..=1e6, when(Condition::Need(Need::PropellerEnd));
        /// Inertia of a side gear about its axis, if not from geometry
        side_gear: f64 = 1.47e-4, KG_M2, 1e-12..=1e6, when(is!(Self.from_geometry, false));
        /// Mass of a side gear for its axial motion, if not from geometry; 0 = geometry.side_mass
        side_gear_mass: f64 = 0.0, KILOGRAM, 0.0..=1e6,
            when(all([is!(Self.from_geometry, false), Condition::Need(Need::AxialMass)]));
        /// Inertia of a planet about its axis, if not from geometry
        planet: f64 = 3.23e-5, KG_M2, 1e-12..=1e6, when(is!(Self.from_geometry, false));
        /// Inertia at the wheel side of the left half-shaft; fixed to the side gear without effects.half_shaft
        left_end: f64 = 0.0, KG_M2, 0.0..=1e6;
        /// Inertia at the wheel side of the right half-shaft; fixed to the side gear without effects.half_shaft
        right_end: f64 = 0.0, KG_M2, 0.0..=1e6;
    }
}
