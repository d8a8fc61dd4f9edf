//! Rows of the parameters calculated from others: dimensions and masses of the gears.

use super::access::OutputSource::{self, Constant};
use crate::declaration::units::{self, DEG, MM};
use crate::declaration::{Row, row};

/// Rows of all calculated parameters.
pub fn rows() -> Vec<Row<OutputSource>> {
    vec![
        row("geometry.planet_mass", "Mass of one planet as a solid, even if inertias are given")
            .calculated(units::KILOGRAM, Constant(|s| s.masses()[0])),
        row("geometry.side_mass", "Mass of one side gear as a solid, even if inertias are given")
            .calculated(units::KILOGRAM, Constant(|s| s.masses()[1])),
        row("geometry.contact_ratio", "Contact ratio on the sphere: path of contact over base pitch")
            .calculated(units::ONE, Constant(|s| s.pair().path.contact_ratio)),
        row("geometry.outer_cone_distance", "Outer cone distance")
            .calculated((units::METRE, MM), Constant(|s| s.pair().outer_cone)),
        row("geometry.planet_pitch_angle", "Pitch angle of a planet")
            .calculated((units::RADIAN, DEG), Constant(|s| s.pair().gears[0].pitch)),
        row("geometry.side_pitch_angle", "Pitch angle of a side gear")
            .calculated((units::RADIAN, DEG), Constant(|s| s.pair().gears[1].pitch)),
        row("geometry.inner_cone_distance", "Inner cone distance")
            .calculated((units::METRE, MM), Constant(|s| s.pair().inner_cone)),
        row("geometry.planet_tip_angle", "Tip angle of a planet")
            .calculated((units::RADIAN, DEG), Constant(|s| s.pair().gears[0].tip)),
        row("geometry.planet_root_angle", "Root angle of a planet")
            .calculated((units::RADIAN, DEG), Constant(|s| s.pair().gears[0].root)),
        row(
            "geometry.planet_base_angle",
            "Base angle of a planet: half-angle of the cone from which its flanks unroll",
        )
        .calculated((units::RADIAN, DEG), Constant(|s| s.pair().gears[0].base)),
        row("geometry.side_tip_angle", "Tip angle of a side gear")
            .calculated((units::RADIAN, DEG), Constant(|s| s.pair().gears[1].tip)),
        row("geometry.side_root_angle", "Root angle of a side gear")
            .calculated((units::RADIAN, DEG), Constant(|s| s.pair().gears[1].root)),
        row(
            "geometry.side_base_angle",
            "Base angle of a side gear: half-angle of the cone from which its flanks unroll",
        )
        .calculated((units::RADIAN, DEG), Constant(|s| s.pair().gears[1].base)),
        row(
            "geometry.wheel_lash",
            "Angle through which one wheel turns freely while the other one and the carrier are held: the \
             backlash of two meshes in series; 0 without effects.backlash",
        )
        .calculated((units::RADIAN, DEG), Constant(|s| s.pair().wheel_lash())),
    ]
}
