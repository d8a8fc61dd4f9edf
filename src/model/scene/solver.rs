//! Integration of a scene, and facets of solid teeth.

choices! {
    /// Integration method.
    pub enum Method: "SolverMethod" {
        Adaptive = 1, "adaptive": "adaptive L-stable Rosenbrock method of order 5";
        FixedStep = 2, "fixed_step": "implicit method with fixed steps and bounded computing effort, for real time";
        Radau = 3, "radau": "Radau IIA of order 5, adaptive, for comparison";
    }
}

spec! {
    /// Accuracy and method of integration.
    pub struct SolverSpec {
        /// Integration method.
        pub method: Method = Method::Adaptive,
        /// Relative tolerance of the local error per step.
        pub relative_tolerance: f64 = 1e-6,
        /// Longest step of the method with fixed steps [s].
        pub fixed_step: f64 = 1e-4,
        /// True if identical planets in phase are simulated once and counted; otherwise each planet is simulated.
        pub merge_planets: bool = true,
        /// True if a jump of a torque or an imposed speed is spread linearly over the next communication step.
        pub input_ramp: bool = false,
    }
}

spec! {
    /// Facets of solid teeth.
    pub struct SolidTeeth {
        /// Facets on the involute of each flank.
        pub facets: i32 = 32,
        /// Width of the patch over which the maximum overlap is evaluated, relative to the width that follows from the
        /// facets.
        pub smoothing: f64 = 1.0,
    }
}
