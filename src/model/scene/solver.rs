//! How a scene is integrated, and how solid teeth are cut into facets.

choices! {
    /// Integration method.
    pub enum Method: "SolverMethod" {
        Adaptive = 1, "adaptive": "adaptive L-stable Rosenbrock method of order 5";
        FixedStep = 2, "fixed_step": "implicit steps of fixed size and bounded work, for real time";
        Radau = 3, "radau": "Radau IIA of order 5, adaptive, for comparison";
        Rodas4 = 4, "rodas4": "RODAS of order 4(3), adaptive, for comparison";
        DormandPrince = 5, "dormand_prince": "explicit method of order 5(4), adaptive, for comparison";
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
        /// Planets that are identical and in phase are simulated once and counted; off simulates each.
        pub merge_planets: bool = true,
    }
}

spec! {
    /// How solid teeth are cut into facets.
    pub struct SolidTeeth {
        /// Facets on the involute of each flank.
        pub facets: i32 = 32,
        /// Width of the patch over which the greatest overlap is taken, as a multiple of the one that follows from the facets.
        pub smoothing: f64 = 1.0,
    }
}
