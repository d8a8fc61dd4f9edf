//! Rows of integration and solid teeth.

use crate::declaration::units;
use crate::declaration::{Parameter, Row, choice, integer, real, switch, when};
use crate::model::{Method, Parameters};

/// Rows of `solver.…` and `solid.…`.
pub fn rows() -> Vec<Row<Parameter<Parameters>>> {
    vec![
        when(
            "co-simulation",
            choice!("solver.method", "SolverMethod", Parameters, |p| &mut p.solver.method, "Integration method",
            Method::Adaptive => "adaptive" "adaptive L-stable Rosenbrock method of order 5",
            Method::FixedStep => "fixed_step" "implicit steps of fixed size and bounded work, for real time",
            Method::Radau => "radau" "Radau IIA of order 5, adaptive, for comparison",
            Method::Rodas4 => "rodas4" "RODAS of order 4(3), adaptive, for comparison",
            Method::DormandPrince => "dormand_prince" "explicit method of order 5(4), adaptive, for comparison"),
        ),
        when(
            "co-simulation and solver.method != fixed_step",
            real(
                "solver.relative_tolerance",
                units::ONE,
                None,
                (1e-11, 1e-1),
                |p| &mut p.solver.relative_tolerance,
                "Relative tolerance of the local error per step",
            ),
        ),
        when(
            "co-simulation and solver.method = fixed_step",
            real(
                "solver.fixed_step",
                units::SECOND,
                None,
                (1e-7, 1e-2),
                |p| &mut p.solver.fixed_step,
                "Longest step of the method with fixed steps; a communication step is divided into equal ones",
            ),
        ),
        when(
            "scene.gear_contact = solid",
            integer(
                "solid.facets",
                (4, 1024),
                |p| &mut p.solid.facets,
                "Facets on the involute of each flank of solid teeth",
            ),
        ),
        when(
            "scene.gear_contact = solid",
            real(
                "solid.smoothing",
                units::ONE,
                None,
                (0.02, 10.0),
                |p| &mut p.solid.smoothing,
                "Width of the patch over which the greatest overlap of solid teeth is taken: 1 follows the facets, less comes \
             near to the deepest point alone",
            ),
        ),
        when(
            "co-simulation and scene.gear_contact != ideal",
            switch(
                "solver.merge_planets",
                |p| &mut p.solver.merge_planets,
                "Planets that are identical and in phase are simulated once and counted; false: each is simulated",
            ),
        ),
    ]
}
