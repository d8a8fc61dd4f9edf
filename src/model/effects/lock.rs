//! A lock that holds both side gears to the carrier: T_max = command × torque, a clutch pressed from outside.

use super::super::causes::Cause;
use super::super::effect_specs::LockSpec;
use super::super::grip::{Grip, PlanetGrip, SideGrip};

/// Hold of the lock at full command.
pub fn grip(spec: &LockSpec) -> Grip {
    Grip {
        cause: Cause::Clutch,
        side: SideGrip { constant: spec.torque, stiffness: spec.stiffness, ..SideGrip::default() },
        planet: PlanetGrip::default(),
        static_ratio: 1.0,
    }
}
