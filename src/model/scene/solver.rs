//! How a scene is integrated, and how solid teeth are cut into facets.

choices! {
    /// Integration method.
    pub enum Method: "SolverMethod" {
        Adaptive = 1, "adaptive": "adaptive L-stable Rosenbrock method of order 5";
        FixedStep = 2, "fixed_step": "implicit steps of fixed size and bounded work, for real time";
        Radau = 3, "radau": "Radau IIA of order 5, adaptive, for comparison";
    }
}

/// Advice on a method that was removed, `given` by its value or literal, for messages about the enumeration with the literals
/// `names`; empty otherwise.
pub fn removed_method<'a>(given: &str, mut names: impl Iterator<Item = &'a str>) -> &'static str {
    match given {
        "4" | "rodas4" | "5" | "dormand_prince" if names.any(|name| name == Method::Radau.literal()) => {
            "; this method was removed, use adaptive"
        }
        _ => "",
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
        /// A jump of a torque or an imposed speed is spread linearly over the communication step that follows it.
        pub input_ramp: bool = false,
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
