//! Thrust washers and pins: what gives an open differential its torque bias.
//!
//! Dry friction T = μ F r on each surface, with the thrust of all meshes on the side gear, both meshes' thrust on the
//! planet and the resultant across its pin (Coulomb; H. Naunheimer et al., Automotive Transmissions, 2nd ed., Springer
//! 2011, section 10.2 on locking values).

use super::super::causes::Cause;
use super::super::effect_specs::ThrustFrictionSpec;
use super::super::grip::{Grip, PlanetGrip, SideGrip};
use crate::geometry::Pair;

/// Hold of washers and pins.
pub fn grip(spec: &ThrustFrictionSpec, pair: &Pair) -> Grip {
    let ratio = f64::from(pair.gears[0].teeth) / f64::from(pair.gears[1].teeth);
    Grip {
        cause: Cause::Thrust,
        side: SideGrip {
            per_thrust: spec.coefficient * spec.side_washer_radius,
            stiffness: spec.stiffness,
            ..SideGrip::default()
        },
        planet: PlanetGrip {
            per_pin_force: spec.pin_coefficient * spec.pin_radius,
            per_thrust: spec.coefficient * spec.planet_washer_radius,
            stiffness: spec.stiffness * ratio * ratio,
        },
        static_ratio: 1.0,
    }
}
