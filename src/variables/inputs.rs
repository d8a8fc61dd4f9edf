//! Rows of the inputs.

use crate::declaration::units::*;
use crate::declaration::{Row, all, row, sides};
use crate::model::{
    CarrierDrive, FinalDriveSpec, InputField, MAX_SPEED, MAX_TORQUE, PlanetSpin, Scene, SideDrive, effects,
};

/// Rows of all inputs.
pub fn rows() -> Vec<Row<InputField>> {
    let [left_load, right_load] = sides(
        "load_torque",
        "Signed load torque on the {side} half-shaft: a positive load resists positive rotation, and turns a standing \
         wheel backward; {side}.brake_torque only resists",
    );
    let [left_speed, right_speed] =
        sides("speed_command", "Imposed speed of the wheel side of the {side} half-shaft when it is speed-driven");
    let mut rows: Vec<Row<InputField>> = vec![
        row("carrier.speed_command", "Imposed carrier speed; initial speed when the carrier is torque-driven")
            .when(all([off!(FinalDriveSpec), Scene::drive_has_speed()]))
            .instead("pinion.speed_command")
            .input(RAD_PER_S | DEG_PER_S, MAX_SPEED, |i| &mut i.carrier_speed),
        row("carrier.torque_command", "Carrier torque when the carrier is torque-driven")
            .when(all([off!(FinalDriveSpec), is!(Scene.carrier_drive, CarrierDrive::Torque)]))
            .instead("pinion.torque_command")
            .input(NEWTON_METRE, MAX_TORQUE, |i| &mut i.carrier_torque),
        left_load
            .when(is!(Scene.left_drive, SideDrive::Torque))
            .input(NEWTON_METRE, MAX_TORQUE, |i| &mut i.load_torque[0]),
        right_load
            .when(is!(Scene.right_drive, SideDrive::Torque))
            .input(NEWTON_METRE, MAX_TORQUE, |i| &mut i.load_torque[1]),
        row("spin.command", "Imposed planet spin relative to the carrier; positive spin makes the left side faster")
            .when(is!(Scene.planet_spin, PlanetSpin::Imposed))
            .input(RAD_PER_S | DEG_PER_S, MAX_SPEED, |i| &mut i.planet_spin),
        left_speed
            .when(is!(Scene.left_drive, SideDrive::Speed))
            .input(RAD_PER_S | DEG_PER_S, MAX_SPEED, |i| &mut i.side_speed[0]),
        right_speed
            .when(is!(Scene.right_drive, SideDrive::Speed))
            .input(RAD_PER_S | DEG_PER_S, MAX_SPEED, |i| &mut i.side_speed[1]),
    ];
    rows.extend(effects::inputs());
    rows
}
