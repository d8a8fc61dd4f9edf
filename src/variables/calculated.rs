//! Rows of the parameters calculated from others: dimensions and masses of the gears.

use super::access::OutputSource;
use super::outputs::{add, outputs};
use crate::declaration::units::*;
use crate::declaration::{Causality, Row, Variability};

/// Rows of all calculated parameters.
pub fn rows() -> Vec<Row<OutputSource>> {
    let mut rows = Vec::new();
    outputs! { rows:
        /// Mass of one {gear} as a solid, even if inertias are given
        "geometry.{gear}_mass": KILOGRAM, Constant(|s, i| s.masses()[i]);
        /// Contact ratio on the sphere: path of contact over base pitch
        "geometry.contact_ratio": ONE, Constant(|s, _| s.pair().path.contact_ratio);
        /// Outer cone distance
        "geometry.outer_cone_distance": METRE | MM, Constant(|s, _| s.pair().outer_cone);
        /// Inner cone distance
        "geometry.inner_cone_distance": METRE | MM, Constant(|s, _| s.pair().inner_cone);
        /// Pitch angle of a {gear}
        "geometry.{gear}_pitch_angle": RADIAN | DEG, Constant(|s, i| s.pair().gears[i].pitch);
        /// Tip angle of a {gear}
        "geometry.{gear}_tip_angle": RADIAN | DEG, Constant(|s, i| s.pair().gears[i].tip);
        /// Root angle of a {gear}
        "geometry.{gear}_root_angle": RADIAN | DEG, Constant(|s, i| s.pair().gears[i].root);
        /// Base angle of a {gear}: half-angle of the cone from which its flanks unroll
        "geometry.{gear}_base_angle": RADIAN | DEG, Constant(|s, i| s.pair().gears[i].base);
        /// Angle through which one wheel turns freely while the other one and the carrier are held: the backlash of two
        /// meshes in series; 0 without effects.backlash
        "geometry.wheel_lash": RADIAN | DEG, Constant(|s, _| s.pair().wheel_lash());
    }
    for row in &mut rows {
        (row.causality, row.variability) = (Causality::CalculatedParameter, Variability::Fixed);
    }
    rows
}
