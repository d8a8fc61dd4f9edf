//! Clutch packs between side gears and carrier: T_max = preload + κ |T_s| with the torque T_s of the meshes on the side
//! gear (ramps and thrust press the plates in proportion to it).
//!
//! Source: the preloaded plate clutch of H. Naunheimer et al., Automotive Transmissions, 2nd ed., Springer 2011,
//! section 10.2.

use super::super::causes::Cause;
use super::super::effect_specs::LimitedSlipSpec;
use super::super::grip::{Grip, PlanetGrip, SideGrip};

/// Hold of the clutch packs.
pub fn grip(spec: &LimitedSlipSpec) -> Grip {
    Grip {
        cause: Cause::Clutch,
        side: SideGrip {
            constant: spec.preload,
            per_torque: spec.torque_coefficient,
            stiffness: spec.stiffness,
            ..SideGrip::default()
        },
        planet: PlanetGrip::default(),
        static_ratio: spec.static_ratio,
    }
}
