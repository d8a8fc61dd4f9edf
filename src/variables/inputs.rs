//! Rows of the inputs.

use crate::declaration::units::*;
use crate::declaration::{Condition, Row, all, any, row};
use crate::model::{
    CarrierDrive, FinalDriveSpec, GearContact, InputField, MAX_SPEED, MAX_TORQUE, PlanetSpin, Scene, SideDrive, Start,
    effects,
};

/// Condition that a carrier that is driven by torque turns at the start.
fn starts_turning() -> Condition {
    let left = is!(Scene.left_drive, SideDrive::Torque);
    let right = is!(Scene.right_drive, SideDrive::Torque);
    all([
        Condition::FromStart,
        any([differs!(Scene.start, Start::Rest), is!(Scene.gear_contact, GearContact::Ideal)]),
        any([all([left, right]), all([is!(Scene.planet_spin, PlanetSpin::Free), any([left, right])])]),
    ])
}

/// Rows of all inputs.
pub fn rows() -> Vec<Row<InputField>> {
    let mut rows: Vec<Row<InputField>> = vec![
        row("carrier.speed_command", "Imposed carrier speed; initial speed when the carrier is torque-driven")
            .when(all([off!(FinalDriveSpec), any([is!(Scene.carrier_drive, CarrierDrive::Speed), starts_turning()])]))
            .input(RAD_PER_S | DEG_PER_S, MAX_SPEED, |i| &mut i.carrier_speed),
        row("carrier.torque_command", "Carrier torque when the carrier is torque-driven")
            .when(all([off!(FinalDriveSpec), is!(Scene.carrier_drive, CarrierDrive::Torque)]))
            .input(NEWTON_METRE, MAX_TORQUE, |i| &mut i.carrier_torque),
        row(
            "left.load_torque",
            "Signed load torque on the left half-shaft: a positive load resists positive rotation, and turns a \
             standing wheel backward; left.brake_torque only resists",
        )
        .when(is!(Scene.left_drive, SideDrive::Torque))
        .input(NEWTON_METRE, MAX_TORQUE, |i| &mut i.load_torque[0]),
        row(
            "right.load_torque",
            "Signed load torque on the right half-shaft: a positive load resists positive rotation, and turns a \
             standing wheel backward; right.brake_torque only resists",
        )
        .when(is!(Scene.right_drive, SideDrive::Torque))
        .input(NEWTON_METRE, MAX_TORQUE, |i| &mut i.load_torque[1]),
        row("spin.command", "Imposed planet spin relative to the carrier; positive spin makes the left side faster")
            .when(is!(Scene.planet_spin, PlanetSpin::Imposed))
            .input(RAD_PER_S | DEG_PER_S, MAX_SPEED, |i| &mut i.planet_spin),
        row("left.speed_command", "Imposed speed of the wheel side of the left half-shaft when it is speed-driven")
            .when(is!(Scene.left_drive, SideDrive::Speed))
            .input(RAD_PER_S | DEG_PER_S, MAX_SPEED, |i| &mut i.side_speed[0]),
        row("right.speed_command", "Imposed speed of the wheel side of the right half-shaft when it is speed-driven")
            .when(is!(Scene.right_drive, SideDrive::Speed))
            .input(RAD_PER_S | DEG_PER_S, MAX_SPEED, |i| &mut i.side_speed[1]),
    ];
    rows.extend(effects::inputs());
    rows
}
