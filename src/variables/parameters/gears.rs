//! Rows of the gears' geometry.

use crate::declaration::units::{self, DEG, MM};
use crate::declaration::{Parameter, Row, choice, integer, real, when};
use crate::geometry::AddendumSystem;
use crate::model::Parameters;

/// Rows of `geometry.…`.
pub fn rows() -> Vec<Row<Parameter<Parameters>>> {
    vec![
        real(
            "geometry.module",
            units::METRE,
            Some(MM),
            (2e-4, 0.1),
            |p| &mut p.geometry.module,
            "Outer transverse module",
        ),
        integer("geometry.planet_teeth", (5, 200), |p| &mut p.geometry.planet_teeth, "Teeth of a planet"),
        integer("geometry.side_teeth", (5, 200), |p| &mut p.geometry.side_teeth, "Teeth of a side gear"),
        integer(
            "geometry.planet_count",
            (2, 4),
            |p| &mut p.geometry.planet_count,
            "Number of equally spaced planets; 2 side_teeth / planet_count must be an integer",
        ),
        real(
            "geometry.pressure_angle",
            units::RADIAN,
            Some(DEG),
            (0.17, 0.53),
            |p| &mut p.geometry.pressure_angle,
            "Pressure angle",
        ),
        real(
            "geometry.shaft_angle",
            units::RADIAN,
            Some(DEG),
            (0.17, 3.0),
            |p| &mut p.geometry.shaft_angle,
            "Angle between planet and side gear axes; a differential needs 90 deg",
        ),
        real("geometry.face_width", units::METRE, Some(MM), (1e-4, 1.0), |p| &mut p.geometry.face_width, "Face width"),
        choice!("geometry.addendum_system", "AddendumSystem", Parameters, |p| &mut p.geometry.addendum_system,
            "Rule for addenda and dedenda",
            AddendumSystem::Standard => "standard" "addendum 1.0 m, dedendum 1.25 m on both gears",
            AddendumSystem::Gleason => "gleason" "Gleason long-and-short addenda",
            AddendumSystem::Iso23509 => "iso23509" "ISO 23509 mean addendum factor, clearance 0.25 m",
            AddendumSystem::Explicit => "explicit" "the four coefficients geometry.planet_addendum ... side_dedendum"),
        when(
            "geometry.addendum_system = explicit",
            real(
                "geometry.planet_addendum",
                units::ONE,
                None,
                (0.05, 3.0),
                |p| &mut p.geometry.planet_addendum,
                "Planet addendum per module, with addendum_system explicit",
            ),
        ),
        when(
            "geometry.addendum_system = explicit",
            real(
                "geometry.side_addendum",
                units::ONE,
                None,
                (0.05, 3.0),
                |p| &mut p.geometry.side_addendum,
                "Side gear addendum per module, with addendum_system explicit",
            ),
        ),
        when(
            "geometry.addendum_system = explicit",
            real(
                "geometry.planet_dedendum",
                units::ONE,
                None,
                (0.05, 3.0),
                |p| &mut p.geometry.planet_dedendum,
                "Planet dedendum per module, with addendum_system explicit",
            ),
        ),
        when(
            "geometry.addendum_system = explicit",
            real(
                "geometry.side_dedendum",
                units::ONE,
                None,
                (0.05, 3.0),
                |p| &mut p.geometry.side_dedendum,
                "Side gear dedendum per module, with addendum_system explicit",
            ),
        ),
        when(
            "effects.backlash = true",
            real(
                "geometry.backlash",
                units::METRE,
                Some(MM),
                (0.0, 0.05),
                |p| &mut p.geometry.backlash,
                "Circumferential backlash at the outer pitch circle",
            ),
        ),
        real(
            "geometry.root_fillet",
            units::ONE,
            None,
            (0.0, 1.0),
            |p| &mut p.geometry.root_fillet,
            "Fillet radius at the root of the teeth per module, for their stiffness",
        ),
        real(
            "geometry.planet_bore",
            units::METRE,
            Some(MM),
            (0.0, 10.0),
            |p| &mut p.geometry.planet_bore,
            "Bore diameter of a planet (its pin), for mass and rim; 0 = solid",
        ),
        real(
            "geometry.side_bore",
            units::METRE,
            Some(MM),
            (0.0, 10.0),
            |p| &mut p.geometry.side_bore,
            "Bore diameter of a side gear (its shaft), for mass and rim; 0 = solid",
        ),
    ]
}
