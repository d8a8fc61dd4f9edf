//! Rows of the gears' geometry.

use crate::declaration::units::{self, DEG, MM};
use crate::declaration::{Parameter, Row, row};
use crate::model::Parameters;

/// Rows of `geometry.…`.
pub fn rows() -> Vec<Row<Parameter<Parameters>>> {
    vec![
        row("geometry.module", "Outer transverse module")
            .real((units::METRE, MM), (2e-4, 0.1), |p| &mut p.geometry.module),
        row("geometry.planet_teeth", "Number of teeth of a planet").integer((5, 200), |p| &mut p.geometry.planet_teeth),
        row("geometry.side_teeth", "Number of teeth of a side gear").integer((5, 200), |p| &mut p.geometry.side_teeth),
        row(
            "geometry.planet_count",
            "Number of equally spaced planets; 2 side_teeth / planet_count must be an integer",
        )
        .integer((2, 4), |p| &mut p.geometry.planet_count),
        row("geometry.pressure_angle", "Pressure angle")
            .real((units::RADIAN, DEG), (0.17, 0.53), |p| &mut p.geometry.pressure_angle),
        row("geometry.shaft_angle", "Angle between planet and side gear axes; a differential needs 90 deg").real(
            (units::RADIAN, DEG),
            (0.17, 3.0),
            |p| &mut p.geometry.shaft_angle,
        ),
        row("geometry.face_width", "Face width").real((units::METRE, MM), (1e-4, 1.0), |p| &mut p.geometry.face_width),
        row("geometry.addendum_system", "Rule for addenda and dedenda").choice(|p| &mut p.geometry.addendum_system),
        row("geometry.planet_addendum", "Planet addendum per module, if geometry.addendum_system = explicit")
            .when("geometry.addendum_system = explicit")
            .real(units::ONE, (0.05, 3.0), |p| &mut p.geometry.planet_addendum),
        row("geometry.side_addendum", "Side gear addendum per module, if geometry.addendum_system = explicit")
            .when("geometry.addendum_system = explicit")
            .real(units::ONE, (0.05, 3.0), |p| &mut p.geometry.side_addendum),
        row("geometry.planet_dedendum", "Planet dedendum per module, if geometry.addendum_system = explicit")
            .when("geometry.addendum_system = explicit")
            .real(units::ONE, (0.05, 3.0), |p| &mut p.geometry.planet_dedendum),
        row("geometry.side_dedendum", "Side gear dedendum per module, if geometry.addendum_system = explicit")
            .when("geometry.addendum_system = explicit")
            .real(units::ONE, (0.05, 3.0), |p| &mut p.geometry.side_dedendum),
        row("geometry.backlash", "Circumferential backlash at the outer pitch circle")
            .when("effects.backlash = true")
            .real((units::METRE, MM), (0.0, 0.05), |p| &mut p.geometry.backlash),
        row("geometry.root_fillet", "Root fillet radius per module, for the tooth stiffness").real(
            units::ONE,
            (0.0, 1.0),
            |p| &mut p.geometry.root_fillet,
        ),
        row("geometry.planet_bore", "Bore diameter of a planet (pin diameter), for mass and rim; 0 = no bore").real(
            (units::METRE, MM),
            (0.0, 10.0),
            |p| &mut p.geometry.planet_bore,
        ),
        row("geometry.side_bore", "Bore diameter of a side gear (shaft diameter), for mass and rim; 0 = no bore").real(
            (units::METRE, MM),
            (0.0, 10.0),
            |p| &mut p.geometry.side_bore,
        ),
    ]
}
