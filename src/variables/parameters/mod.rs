//! Rows of the parameters, one file per group. The effects declare their own parameters. Parameters are fixed unless
//! they are declared tunable. The order of the rows determines the value references. Rows named in `added.rs` are moved
//! behind all others.

mod bodies;
mod contact;
mod gears;
mod solver;

use crate::declaration::{Parameter, Row, row};
use crate::model::{Parameters, effects};

/// Rows of all parameters.
pub fn rows() -> Vec<Row<Parameter<Parameters>>> {
    let mut rows = gears::rows();
    rows.extend(bodies::rows());
    rows.extend(contact::rows());
    rows.extend(scene());
    rows.extend(teeth());
    rows.extend(
        effects::switches().into_iter().map(|row| row.map(|at| at.within(|p: &mut Parameters| &mut p.effects))),
    );
    rows.extend(solver::rows());
    rows.extend(
        effects::parameters().into_iter().map(|row| row.map(|at| at.within(|p: &mut Parameters| &mut p.specs))),
    );
    rows
}

/// Rows of `scene.…`: drives, representation of tooth contact, and start.
fn scene() -> Vec<Row<Parameter<Parameters>>> {
    vec![
        row("scene.carrier_drive", "Drive of the carrier").choice(|p| &mut p.scene.carrier_drive),
        row("scene.left_drive", "Drive of the left half-shaft").choice(|p| &mut p.scene.left_drive),
        row("scene.right_drive", "Drive of the right half-shaft").choice(|p| &mut p.scene.right_drive),
        row("scene.planet_spin", "Spin of the planets on their pins").choice(|p| &mut p.scene.planet_spin),
        row("scene.gear_contact", "Representation of tooth contact").choice(|p| &mut p.scene.gear_contact),
        row("scene.start", "State at the start time").choice(|p| &mut p.scene.start),
    ]
}

/// Switches for backlash and corner contact, which belong to no effect.
fn teeth() -> [Row<Parameter<Parameters>>; 2] {
    [
        row("effects.backlash", "Backlash between the teeth; false: none").switch(|p| &mut p.effects.backlash),
        row(
            "effects.corner_contact",
            "Tip-corner contact outside the path of contact; false: pairs enter and leave abruptly",
        )
        .when("scene.gear_contact != ideal")
        .switch(|p| &mut p.effects.corner_contact),
    ]
}
