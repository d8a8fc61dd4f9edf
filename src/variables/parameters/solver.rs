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
        row("solid.facets", "Facets on the involute of each flank of solid teeth")
            .when("scene.gear_contact = solid")
            .integer((4, 1024), |p| &mut p.solid.facets),
        row(
            "solid.smoothing",
            "Width of the patch over which the greatest overlap of solid teeth is taken: 1 follows the \
             facets, a small value approaches the deepest point only",
        )
        .when("scene.gear_contact = solid")
        .real(units::ONE, (0.02, 10.0), |p| &mut p.solid.smoothing),
        row(
            "solver.merge_planets",
            "Planets that are identical and in phase are simulated once and counted; false: each is simulated",
        )
        .when("co-simulation and scene.gear_contact != ideal")
        .switch(|p| &mut p.solver.merge_planets),
        row(
            "solver.input_ramp",
            "Jumps of torques and imposed speeds are spread linearly over the communication step that follows, half a \
             step late; lock, fault trigger and temperatures still jump",
        )
        .when("co-simulation")
        .switch(|p| &mut p.solver.input_ramp),
    ]
}
