//! User parameters of the gears, the inputs of all geometry formulas.

choices! {
    /// Rule that splits the working depth into addenda and fixes the clearance.
    pub enum AddendumSystem: "AddendumSystem" {
        Standard = 1, "standard": "addendum 1.0 modules, dedendum 1.25 modules on both gears";
        Gleason = 2, "gleason": "Gleason long-and-short addenda";
        Iso23509 = 3, "iso23509": "ISO 23509 mean addendum factor, clearance 0.25 modules";
        Explicit = 4, "explicit": "geometry.planet_addendum, planet_dedendum, side_addendum and side_dedendum";
    }
}

spec! {
    /// Specification of a gear pair: planet (index p) and side gear (index s) with coincident apexes.
    ///
    /// The default is the study's gear pair, but with Gleason's addenda.
    pub struct GearSpec {
        /// Outer transverse module m [m].
        pub module: f64 = 4.5e-3,
        /// Number of planet teeth z_p.
        pub planet_teeth: i32 = 10,
        /// Number of side gear teeth z_s.
        pub side_teeth: i32 = 16,
        /// Number of equally spaced planets N.
        pub planet_count: i32 = 2,
        /// Pressure angle α [rad].
        pub pressure_angle: f64 = 20f64.to_radians(),
        /// Shaft angle Σ [rad].
        pub shaft_angle: f64 = 90f64.to_radians(),
        /// Face width b [m].
        pub face_width: f64 = 20e-3,
        /// Circumferential backlash j_t at the outer pitch circle [m].
        pub backlash: f64 = 1e-4,
        /// Rule for addenda and dedenda.
        pub addendum_system: AddendumSystem = AddendumSystem::Gleason,
        /// Planet addendum coefficient h_ap/m for [`AddendumSystem::Explicit`].
        pub planet_addendum: f64 = 1.0,
        /// Side gear addendum coefficient h_as/m for [`AddendumSystem::Explicit`].
        pub side_addendum: f64 = 1.0,
        /// Planet dedendum coefficient h_fp/m for [`AddendumSystem::Explicit`].
        pub planet_dedendum: f64 = 1.25,
        /// Side gear dedendum coefficient h_fs/m for [`AddendumSystem::Explicit`].
        pub side_dedendum: f64 = 1.25,
        /// Fillet radius at the root of the teeth, in modules.
        pub root_fillet: f64 = 0.40,
        /// Diameter of the planet's bore (its pin) [m]; 0 means solid.
        pub planet_bore: f64 = 0.0,
        /// Diameter of the side gear's bore (its shaft) [m]; 0 means solid.
        pub side_bore: f64 = 0.0,
    }
}
