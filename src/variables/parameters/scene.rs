//! Rows of drives, representation of tooth contact, and start.

use crate::declaration::{Parameter, Row, row};
use crate::model::Parameters;

/// Rows of `scene.…`.
pub fn rows() -> Vec<Row<Parameter<Parameters>>> {
    vec![
        row("scene.carrier_drive", "How the carrier is driven").choice(|p| &mut p.scene.carrier_drive),
        row("scene.left_drive", "How the left half-shaft is driven").choice(|p| &mut p.scene.left_drive),
        row("scene.right_drive", "How the right half-shaft is driven").choice(|p| &mut p.scene.right_drive),
        row("scene.planet_spin", "Whether planets spin freely on their pins").choice(|p| &mut p.scene.planet_spin),
        row("scene.gear_contact", "Representation of tooth contact").choice(|p| &mut p.scene.gear_contact),
        row("scene.start", "State at the start time").choice(|p| &mut p.scene.start),
    ]
}
