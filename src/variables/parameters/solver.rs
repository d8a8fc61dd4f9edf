//! Rows of integration and solid teeth.

use crate::declaration::{Parameter, Row, row, units};
use crate::model::Parameters;

/// Rows of `solver.…` and `solid.…`.
pub fn rows() -> Vec<Row<Parameter<Parameters>>> {
    vec![
        row("solver.method", "Integration method").when("co-simulation").choice(|p| &mut p.solver.method),
        row("solver.relative_tolerance", "Relative tolerance of the local error per step")
            .when("co-simulation and solver.method != fixed_step")
            .real(units::ONE, (1e-11, 1e-1), |p| &mut p.solver.relative_tolerance),
        row(
            "solver.fixed_step",
            "Maximum step of the fixed-step method; a communication step is divided into equal steps",
        )
        .when("co-simulation and solver.method = fixed_step")
        .real(units::SECOND, (1e-7, 1e-2), |p| &mut p.solver.fixed_step),
        row("solid.facets", "Number of facets on the involute of each flank of solid teeth")
            .when("scene.gear_contact = solid")
            .integer((4, 1024), |p| &mut p.solid.facets),
        row(
            "solid.smoothing",
            "Relative width of the patch for the smooth maximum overlap of solid teeth: 1 is the width of a facet, \
             and small values approach contact at the deepest point only",
        )
        .when("scene.gear_contact = solid")
        .real(units::ONE, (0.02, 10.0), |p| &mut p.solid.smoothing),
        row("solver.merge_planets", "Identical planets in phase are simulated as one; false: each planet is simulated")
            .when("co-simulation and scene.gear_contact != ideal")
            .switch(|p| &mut p.solver.merge_planets),
        row(
            "solver.input_ramp",
            "Spreads jumps of torques and imposed speeds linearly over the next communication step; they then act \
             half a step late; lock, fault trigger and temperatures still jump",
        )
        .when("co-simulation")
        .switch(|p| &mut p.solver.input_ramp),
    ]
}
