//! What drives the differential, what is free, and how its teeth are represented.

use serde::{Deserialize, Serialize};

/// How the carrier is driven.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[repr(i32)]
pub enum CarrierDrive {
    /// Its speed is imposed, the torque follows.
    Speed = 1,
    /// Its torque is imposed, the speed follows.
    Torque = 2,
}

/// How the wheel side of a half-shaft is driven.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[repr(i32)]
pub enum SideDrive {
    /// A torque loads it.
    Torque = 1,
    /// Its speed is imposed; the half-shaft between it and the side gear twists.
    Speed = 2,
}

/// Whether the planets spin freely on their pins.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[repr(i32)]
pub enum PlanetSpin {
    /// Spin follows from the tooth forces.
    Free = 1,
    /// Spin is imposed, as the study does in its turn.
    Imposed = 2,
}

/// How tooth contact is represented.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[repr(i32)]
pub enum GearContact {
    /// No teeth: Willis' equation as a constraint.
    Ideal = 1,
    /// One spring per mesh.
    Lumped = 2,
    /// Tooth pair by tooth pair along the path of contact.
    Tooth = 3,
    /// Solids with faceted flanks, found and pressed together by geometry alone.
    Solid = 4,
}

/// State at the start time.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[repr(i32)]
pub enum Start {
    /// Meshes preloaded by the loads at the start time.
    Equilibrium = 1,
    /// Speeds by Willis' equation, teeth in the middle of their gaps, unloaded.
    Rolling = 2,
    /// Everything at rest that is not imposed.
    Rest = 3,
}

/// What drives, what is free, what is represented.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Scene {
    /// Carrier drive.
    pub carrier_drive: CarrierDrive,
    /// Drive of the left half-shaft.
    pub left_drive: SideDrive,
    /// Drive of the right half-shaft.
    pub right_drive: SideDrive,
    /// Planet spin.
    pub planet_spin: PlanetSpin,
    /// Representation of tooth contact.
    pub gear_contact: GearContact,
    /// State at the start time.
    pub start: Start,
}
