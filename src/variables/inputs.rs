//! Rows of the inputs.

use crate::declaration::units::{self, DEG_PER_S};
use crate::declaration::{Row, row};
use crate::model::{InputField, effects};

/// Far beyond any differential, but small enough that no intermediate result overflows.
const MAX_SPEED: f64 = 1e5;
const MAX_TORQUE: f64 = 1e8;

/// Rows of all inputs.
pub fn rows() -> Vec<Row<InputField>> {
    let mut rows: Vec<Row<InputField>> = vec![
        row("carrier.speed_command", "Imposed carrier speed; initial speed when the carrier is torque-driven")
            .when(
                "scene.carrier_drive = speed or initialisation and (scene.start != rest or scene.gear_contact = \
                 ideal) and (scene.left_drive = torque and scene.right_drive = torque or scene.planet_spin = free \
                 and (scene.left_drive = torque or scene.right_drive = torque))",
            )
            .input((units::RAD_PER_S, DEG_PER_S), MAX_SPEED, |i| &mut i.carrier_speed),
        row("carrier.torque_command", "Carrier torque when the carrier is torque-driven")
            .when("scene.carrier_drive = torque")
            .input(units::NEWTON_METRE, MAX_TORQUE, |i| &mut i.carrier_torque),
        row(
            "left.load_torque",
            "Signed load torque on the left half-shaft: a positive load resists positive rotation, and turns a \
             standing wheel backward; left.brake_torque only resists",
        )
        .when("scene.left_drive = torque")
        .input(units::NEWTON_METRE, MAX_TORQUE, |i| &mut i.load_torque[0]),
        row(
            "right.load_torque",
            "Signed load torque on the right half-shaft: a positive load resists positive rotation, and turns a \
             standing wheel backward; right.brake_torque only resists",
        )
        .when("scene.right_drive = torque")
        .input(units::NEWTON_METRE, MAX_TORQUE, |i| &mut i.load_torque[1]),
        row("spin.command", "Imposed planet spin relative to the carrier; positive spin makes the left side faster")
            .when("scene.planet_spin = imposed")
            .input((units::RAD_PER_S, DEG_PER_S), MAX_SPEED, |i| &mut i.planet_spin),
        row("left.speed_command", "Imposed speed of the wheel side of the left half-shaft when it is speed-driven")
            .when("scene.left_drive = speed")
            .input((units::RAD_PER_S, DEG_PER_S), MAX_SPEED, |i| &mut i.side_speed[0]),
        row("right.speed_command", "Imposed speed of the wheel side of the right half-shaft when it is speed-driven")
            .when("scene.right_drive = speed")
            .input((units::RAD_PER_S, DEG_PER_S), MAX_SPEED, |i| &mut i.side_speed[1]),
    ];
    rows.extend(effects::inputs());
    rows
}
