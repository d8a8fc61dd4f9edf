//! Effects beside the meshing of teeth: each a file with its formula, its derivatives, its energy and its heat.
//!
//! A scene holds a list of those that are on. What is off is not in the list; a scene with nothing on has no list.

mod body;

use super::effect_specs::EffectSpecs;
use super::grip::Grip;
pub use body::{Action, Bodies, BodyEffect, Slopes};

#[cfg(feature = "bearing_drag")]
pub mod bearing_drag;
#[cfg(feature = "final_drive")]
pub mod final_drive;
#[cfg(feature = "half_shaft")]
pub mod half_shaft;
#[cfg(feature = "limited_slip")]
pub mod limited_slip;
#[cfg(feature = "lock")]
pub mod lock;
#[cfg(feature = "pin_compliance")]
pub mod pin_compliance;
#[cfg(feature = "thrust_friction")]
pub mod thrust_friction;

use super::parameters::Parameters;
use super::plan::Plan;
use crate::geometry::Pair;

/// What a scene's effects need to know to set themselves up.
pub struct Setting<'a> {
    /// Parameters.
    pub parameters: &'a Parameters,
    /// Gears.
    pub pair: &'a Pair,
    /// Plan of the scene.
    pub plan: &'a Plan,
}

/// Switches that this build leaves out, by their names.
pub fn left_out(name: &str) -> bool {
    match name {
        "effects.bearing_drag" => !cfg!(feature = "bearing_drag"),
        "effects.final_drive" => !cfg!(feature = "final_drive"),
        "effects.half_shaft" => !cfg!(feature = "half_shaft"),
        "effects.limited_slip" => !cfg!(feature = "limited_slip"),
        "lock.command" => !cfg!(feature = "lock"),
        "effects.pin_compliance" => !cfg!(feature = "pin_compliance"),
        "effects.strength" => !cfg!(feature = "strength"),
        "effects.thrust_friction" => !cfg!(feature = "thrust_friction"),
        "effects.tooth_errors" => !cfg!(feature = "tooth_errors"),
        "effects.tooth_fault" => !cfg!(feature = "tooth_fault"),
        "effects.tooth_friction" => !cfg!(feature = "tooth_friction"),
        _ => false,
    }
}

/// Forces and torques on bodies that the scene's effects add, besides dry friction.
pub fn body_effects(setting: &Setting) -> Vec<Box<dyn BodyEffect>> {
    let mut list: Vec<Box<dyn BodyEffect>> = Vec::new();
    let effects = &setting.parameters.effects;
    let _ = (&mut list, effects);
    #[cfg(feature = "half_shaft")]
    if setting.plan.ends {
        list.push(Box::new(half_shaft::HalfShafts::new(setting)));
    }
    #[cfg(feature = "pin_compliance")]
    if effects.pin_compliance {
        list.push(Box::new(pin_compliance::PinCompliance::new(setting)));
    }
    #[cfg(feature = "bearing_drag")]
    if effects.bearing_drag {
        list.push(Box::new(bearing_drag::BearingDrag::new(setting)));
    }
    #[cfg(feature = "final_drive")]
    if effects.final_drive {
        list.push(Box::new(final_drive::FinalDrive::new(setting)));
    }
    list
}

/// What holds bodies together by dry friction: washers, pins and clutches.
pub fn grips(setting: &Setting) -> Vec<Grip> {
    let mut list = Vec::new();
    let effects = &setting.parameters.effects;
    let _ = (&mut list, effects);
    #[cfg(feature = "thrust_friction")]
    if effects.thrust_friction {
        list.push(thrust_friction::grip(&setting.parameters.specs.thrust_friction, setting.pair));
    }
    #[cfg(feature = "limited_slip")]
    if effects.limited_slip {
        list.push(limited_slip::grip(&setting.parameters.specs.limited_slip));
    }
    list
}

/// The lock at full command, if this build has one.
pub fn lock_grip(_specs: &EffectSpecs) -> Option<Grip> {
    #[cfg(feature = "lock")]
    return Some(lock::grip(&_specs.lock));
    #[cfg(not(feature = "lock"))]
    None
}
