//! How a scene is integrated, and how solid teeth are cut into facets.

use serde::{Deserialize, Serialize};

/// Integration method.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[repr(i32)]
pub enum Method {
    /// Adaptive L-stable Rosenbrock method of order 5.
    Adaptive = 1,
    /// Implicit steps of fixed size and bounded work, for real time.
    FixedStep = 2,
    /// Radau IIA of order 5, adaptive, for comparison.
    Radau = 3,
    /// RODAS of order 4(3), adaptive, for comparison.
    Rodas4 = 4,
    /// Dormand and Prince's explicit method of order 5(4), adaptive, for comparison.
    DormandPrince = 5,
}

/// Accuracy and method of integration.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct SolverSpec {
    /// Integration method.
    pub method: Method,
    /// Relative tolerance of the local error per step.
    pub relative_tolerance: f64,
    /// Longest step of the method with fixed steps [s].
    pub fixed_step: f64,
    /// Planets that are identical and in phase are simulated once and counted; off simulates each.
    pub merge_planets: bool,
}

/// How solid teeth are cut into facets.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct SolidTeeth {
    /// Facets on the involute of each flank.
    pub facets: i32,
    /// Width of the patch over which the greatest overlap is taken, as a multiple of the one that follows from the facets.
    pub smoothing: f64,
}
