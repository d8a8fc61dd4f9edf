//! Integration of a scene, and facets of solid teeth.

use crate::declaration::prelude::*;
use crate::drives::{GearContact, Scene};

choices! {
    /// Integration method.
    pub enum Method: "SolverMethod" {
        Adaptive = 1, "adaptive": "adaptive L-stable Rosenbrock method of order 5";
        FixedStep = 2, "fixed_step": "implicit method with fixed steps and bounded computing effort, for real time";
        Radau = 3, "radau": "Radau IIA of order 5, adaptive, for comparison";
    }
}

parameters! {
    /// Accuracy and method of integration.
    pub struct SolverSpec in "solver" {
        /// Integration method
        method: Method = Method::Adaptive, when(Condition::OwnSteps);
        /// Relative tolerance of the local error per step
        relative_tolerance: f64 = 1e-6, ONE, 1e-11..=1e-1,
            when(all([Condition::OwnSteps, differs!(Self.method, Method::FixedStep)]));
        /// Maximum step of the fixed-step method; a communication step is divided into equal steps
        fixed_step: f64 = 1e-4, SECOND, 1e-7..=1e-2,
            when(all([Condition::OwnSteps, is!(Self.method, Method::FixedStep)]));
        /// Identical planets in phase are simulated as one; false: each planet is simulated
        merge_planets: bool = true, when(all([Condition::OwnSteps, differs!(Scene.gear_contact, GearContact::Ideal)]));
        /// Spreads jumps of torques and imposed speeds linearly over the next communication step; they then act half a
        /// step late; lock, fault trigger and temperatures still jump
        input_ramp: bool = false, when(Condition::OwnSteps);
    }
}

parameters! {
    /// Facets of solid teeth.
    pub struct SolidTeeth in "solid" {
        /// Number of facets on the involute of each flank of solid teeth
        facets: i32 = 32, 4..=1024, when(is!(Scene.gear_contact, GearContact::Solid));
        /// Relative width of the patch for the smooth maximum overlap of solid teeth: 1 is the width of a facet, and
        /// small values approach contact at the deepest point only
        smoothing: f64 = 1.0, ONE, 0.02..=10.0, when(is!(Scene.gear_contact, GearContact::Solid));
    }
}
