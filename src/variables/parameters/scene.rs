//! Rows of drives, representation of tooth contact, and start.

use crate::declaration::{Parameter, Row, choice, row};
use crate::model::{CarrierDrive, GearContact, Parameters, PlanetSpin, SideDrive, Start};

/// Rows of `scene.…`.
pub fn rows() -> Vec<Row<Parameter<Parameters>>> {
    vec![
        choice!(row("scene.carrier_drive", "How the carrier is driven"),
            "CarrierDrive", Parameters, |p| &mut p.scene.carrier_drive,
            CarrierDrive::Speed => "speed" "carrier.speed_command is imposed",
            CarrierDrive::Torque => "torque" "carrier.torque_command acts; carrier.speed_command is the initial speed"),
        choice!(row("scene.left_drive", "How the left half-shaft is driven"),
            "SideDrive", Parameters, |p| &mut p.scene.left_drive,
            SideDrive::Torque => "torque" "the load torque acts on its wheel side",
            SideDrive::Speed => "speed" "the speed command is imposed on its wheel side; the half-shaft twists"),
        choice!(row("scene.right_drive", "How the right half-shaft is driven"),
            "SideDrive", Parameters, |p| &mut p.scene.right_drive,
            SideDrive::Torque => "torque" "the load torque acts on its wheel side",
            SideDrive::Speed => "speed" "the speed command is imposed on its wheel side; the half-shaft twists"),
        choice!(row("scene.planet_spin", "Whether planets spin freely on their pins"),
            "PlanetSpin", Parameters, |p| &mut p.scene.planet_spin,
            PlanetSpin::Free => "free" "spin follows from the tooth forces",
            PlanetSpin::Imposed => "imposed" "planet.spin_command is imposed"),
        choice!(row("scene.gear_contact", "Representation of tooth contact"),
            "GearContact", Parameters, |p| &mut p.scene.gear_contact,
            GearContact::Ideal => "ideal" "no teeth: Willis' equation as a constraint",
            GearContact::Lumped => "lumped" "one spring per mesh",
            GearContact::Tooth => "tooth" "tooth pair by tooth pair along the path of contact",
            GearContact::Solid => "solid" "solids with faceted flanks, pressed together by geometry alone"),
        choice!(row("scene.start", "State at the start time"),
            "Start", Parameters, |p| &mut p.scene.start,
            Start::Equilibrium => "equilibrium" "meshes preloaded by the loads at the start time",
            Start::Rolling => "rolling" "speeds by Willis' equation, teeth in mid-gap, unloaded",
            Start::Rest => "rest" "everything at rest that is not imposed"),
    ]
}
