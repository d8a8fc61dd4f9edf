//! Drives of the differential, free and imposed motions, and the representation of tooth contact.

use crate::declaration::{Condition, all, any};

choices! {
    /// Drive of the carrier.
    pub enum CarrierDrive: "CarrierDrive" {
        Speed = 1, "speed": "carrier.speed_command is imposed";
        Torque = 2, "torque": "carrier.torque_command acts, and carrier.speed_command is the initial speed";
    }
}

choices! {
    /// Drive of the wheel side of a half-shaft.
    pub enum SideDrive: "SideDrive" {
        Torque = 1, "torque": "load torque on the wheel side";
        Speed = 2, "speed": "speed command imposed on the wheel side; the half-shaft twists";
    }
}

choices! {
    /// Spin of the planets on their pins.
    pub enum PlanetSpin: "PlanetSpin" {
        Free = 1, "free": "spin follows from the tooth forces";
        Imposed = 2, "imposed": "spin.command is imposed";
    }
}

choices! {
    /// Representation of tooth contact.
    pub enum GearContact: "GearContact" {
        Ideal = 1, "ideal": "no teeth: Willis' equation as a constraint";
        Lumped = 2, "lumped": "one spring per mesh";
        Tooth = 3, "tooth": "individual tooth pairs along the path of contact";
        Solid = 4, "solid": "overlap of solid teeth with faceted flanks";
    }
}

choices! {
    /// State at the start time.
    pub enum Start: "Start" {
        Equilibrium = 1, "equilibrium": "meshes preloaded by the loads at the start time";
        Rolling = 2, "rolling": "unloaded, with teeth in mid-gap and speeds by Willis' equation";
        Rest = 3, "rest": "at rest, except for imposed motions";
        SteadyHeat = 4, "steady_heat": "equilibrium, at temperatures that balance the mean heat flows of \
                                        warm_up.cycle";
    }
}

impl Start {
    /// True if the loads press the meshes together at the start.
    pub fn is_in_equilibrium(self) -> bool {
        matches!(self, Self::Equilibrium | Self::SteadyHeat)
    }
}

parameters! {
    /// Drives, planet spin, tooth contact and start of a scene.
    pub struct Scene in "scene" {
        /// Drive of the carrier
        carrier_drive: CarrierDrive = CarrierDrive::Speed;
        /// Drive of the left half-shaft
        left_drive: SideDrive = SideDrive::Torque;
        /// Drive of the right half-shaft
        right_drive: SideDrive = SideDrive::Torque;
        /// Spin of the planets on their pins
        planet_spin: PlanetSpin = PlanetSpin::Free;
        /// Representation of tooth contact
        gear_contact: GearContact = GearContact::Tooth;
        /// State at the start time
        start: Start = Start::Equilibrium;
    }
}

impl Scene {
    /// Condition under which the speed command of the drive has an effect: it is imposed, or the drive turns at the
    /// start.
    pub fn drive_has_speed() -> Condition {
        let left = is!(Self.left_drive, SideDrive::Torque);
        let right = is!(Self.right_drive, SideDrive::Torque);
        let turns_at_start = all([
            Condition::FromStart,
            differs!(Self.start, Start::Rest),
            any([all([left, right]), all([is!(Self.planet_spin, PlanetSpin::Free), any([left, right])])]),
        ]);
        any([is!(Self.carrier_drive, CarrierDrive::Speed), turns_at_start])
    }
}
