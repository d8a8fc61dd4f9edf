//! Elastic and mass data, and moments of inertia of the bodies.

spec! {
    /// Elastic and mass data of both gears.
    pub struct Material {
        /// Young's modulus E [Pa].
        pub young_modulus: f64 = 2.07e11,
        /// Poisson's ratio ν.
        pub poisson_ratio: f64 = 0.25,
        /// Density ρ [kg/m³].
        pub density: f64 = 7800.0,
    }
}

spec! {
    /// Moments of inertia about the axis of rotation [kg·m²].
    pub struct InertiaSpec {
        /// True if the inertias of the gears follow from their solids; otherwise the values below apply.
        pub from_geometry: bool = true,
        /// Carrier with ring gear and cross-shaft, without planets.
        pub carrier: f64 = 0.02,
        /// One side gear, if not from geometry.
        pub side_gear: f64 = 1.47e-4,
        /// Mass of one side gear [kg], if not from geometry; 0 = mass of its solid.
        pub side_gear_mass: f64 = 0.0,
        /// One planet about its axis, if not from geometry.
        pub planet: f64 = 3.23e-5,
        /// Wheel side of the left half-shaft, rigid on the side gear unless the shaft twists; 0 = none.
        pub left_end: f64 = 0.0,
        /// Wheel side of the right half-shaft, rigid on the side gear unless the shaft twists; 0 = none.
        pub right_end: f64 = 0.0,
    }
}
