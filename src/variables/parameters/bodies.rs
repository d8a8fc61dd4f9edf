//! Rows of material and moments of inertia.

use crate::declaration::units::{self, MPA};
use crate::declaration::{Parameter, Row, real, switch, when};
use crate::model::Parameters;

/// Rows of `material.…` and `inertia.…`.
pub fn rows() -> Vec<Row<Parameter<Parameters>>> {
    vec![
        when(
            "scene.gear_contact != ideal",
            real(
                "material.young_modulus",
                units::PASCAL,
                Some(MPA),
                (1e8, 1e13),
                |p| &mut p.material.young_modulus,
                "Young's modulus of both gears",
            ),
        ),
        when(
            "scene.gear_contact != ideal",
            real(
                "material.poisson_ratio",
                units::ONE,
                None,
                (0.0, 0.499),
                |p| &mut p.material.poisson_ratio,
                "Poisson's ratio of both gears",
            ),
        ),
        real(
            "material.density",
            units::KG_PER_M3,
            None,
            (100.0, 3e4),
            |p| &mut p.material.density,
            "Density of the gears",
        ),
        switch(
            "inertia.from_geometry",
            |p| &mut p.inertia.from_geometry,
            "Side gear and planet inertia from their solids; false: as given",
        ),
        real(
            "inertia.carrier",
            units::KG_M2,
            None,
            (1e-9, 1e6),
            |p| &mut p.inertia.carrier,
            "Carrier with ring gear and cross-shaft about its axis, without planets",
        ),
        when(
            "inertia.from_geometry = false",
            real(
                "inertia.side_gear",
                units::KG_M2,
                None,
                (1e-12, 1e6),
                |p| &mut p.inertia.side_gear,
                "Side gear about its axis, if not from geometry",
            ),
        ),
        when(
            "inertia.from_geometry = false",
            real(
                "inertia.planet",
                units::KG_M2,
                None,
                (1e-12, 1e6),
                |p| &mut p.inertia.planet,
                "Planet about its own axis, if not from geometry",
            ),
        ),
        real(
            "inertia.left_end",
            units::KG_M2,
            None,
            (0.0, 1e6),
            |p| &mut p.inertia.left_end,
            "Wheel side of the left half-shaft; rigid on the side gear unless effects.half_shaft; 0 = none",
        ),
        real(
            "inertia.right_end",
            units::KG_M2,
            None,
            (0.0, 1e6),
            |p| &mut p.inertia.right_end,
            "Wheel side of the right half-shaft; rigid on the side gear unless effects.half_shaft; 0 = none",
        ),
    ]
}
