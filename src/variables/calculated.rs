//! Rows of the parameters that follow from others: dimensions of the gears and their masses.

use super::access::OutputSource;
use crate::declaration::units::{self, DEG, DisplayUnit, MM, Unit};
use crate::declaration::{Row, calculated};
use crate::model::Simulation;

fn constant(
    name: &'static str,
    unit: Unit,
    display: Option<DisplayUnit>,
    of: fn(&Simulation) -> f64,
    text: &'static str,
) -> Row<OutputSource> {
    calculated(name, unit, display, OutputSource::Constant(of), text)
}

fn angle(name: &'static str, of: fn(&Simulation) -> f64, text: &'static str) -> Row<OutputSource> {
    constant(name, units::RADIAN, Some(DEG), of, text)
}

/// Rows of all calculated parameters.
pub fn rows() -> Vec<Row<OutputSource>> {
    vec![
        constant(
            "geometry.planet_mass",
            units::KILOGRAM,
            None,
            |s| s.masses()[0],
            "Mass of one planet as a solid, also where inertias are given",
        ),
        constant(
            "geometry.side_mass",
            units::KILOGRAM,
            None,
            |s| s.masses()[1],
            "Mass of one side gear as a solid, also where inertias are given",
        ),
        constant(
            "geometry.contact_ratio",
            units::ONE,
            None,
            |s| s.pair().path.contact_ratio,
            "Contact ratio on the sphere: path of contact over base pitch",
        ),
        constant(
            "geometry.outer_cone_distance",
            units::METRE,
            Some(MM),
            |s| s.pair().outer_cone,
            "Outer cone distance",
        ),
        angle("geometry.planet_pitch_angle", |s| s.pair().gears[0].pitch, "Pitch angle of a planet"),
        angle("geometry.side_pitch_angle", |s| s.pair().gears[1].pitch, "Pitch angle of a side gear"),
        constant(
            "geometry.inner_cone_distance",
            units::METRE,
            Some(MM),
            |s| s.pair().inner_cone,
            "Inner cone distance",
        ),
        angle("geometry.planet_tip_angle", |s| s.pair().gears[0].tip, "Tip angle of a planet"),
        angle("geometry.planet_root_angle", |s| s.pair().gears[0].root, "Root angle of a planet"),
        angle(
            "geometry.planet_base_angle",
            |s| s.pair().gears[0].base,
            "Base angle of a planet: half-angle of the cone from which its flanks unroll",
        ),
        angle("geometry.side_tip_angle", |s| s.pair().gears[1].tip, "Tip angle of a side gear"),
        angle("geometry.side_root_angle", |s| s.pair().gears[1].root, "Root angle of a side gear"),
        angle(
            "geometry.side_base_angle",
            |s| s.pair().gears[1].base,
            "Base angle of a side gear: half-angle of the cone from which its flanks unroll",
        ),
        constant(
            "geometry.wheel_lash",
            units::RADIAN,
            Some(DEG),
            |s| s.pair().wheel_lash(),
            "Angle through which one wheel turns freely while the other one and the carrier are held: the backlash of two meshes in series; 0 without effects.backlash",
        ),
    ]
}
