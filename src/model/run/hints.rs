//! Remedies in messages of a run, which depend on the laws and effects of the scene.

use crate::contact::{ContactLaw, DampingModel};
use crate::model::scene::GearContact;
use crate::model::setup::Parameters;

/// Remedy that stiffens the teeth, with the parameter of the law in use.
pub fn stiffer_teeth(p: &Parameters) -> &'static str {
    let contact = &p.contact;
    let from_gears = "use a larger geometry.module or geometry.face_width, from which the stiffness follows";
    match (p.scene.gear_contact, contact.law) {
        (GearContact::Lumped, _) if contact.mesh_stiffness_from_geometry => from_gears,
        (GearContact::Lumped, _) => "raise contact.mesh_stiffness",
        (_, ContactLaw::Impact) if contact.stiffness_from_hertz => {
            "use a larger geometry.module, or contact.stiffness_from_hertz = false with a larger contact.stiffness"
        }
        (_, ContactLaw::Impact) => "raise contact.stiffness",
        _ => from_gears,
    }
}

/// Remedy that increases the damping of the teeth.
pub fn more_damping(p: &Parameters) -> &'static str {
    match p.contact.damping_model {
        DampingModel::Step => "raise contact.damping",
        DampingModel::Restitution => "lower contact.restitution",
    }
}

/// Remedy for too many attempted steps.
pub fn fewer_steps(p: &Parameters) -> &'static str {
    if p.scene.gear_contact == GearContact::Tooth && !p.effects.teeth.corner_contact {
        return "set effects.corner_contact = true: without it, the force jumps when a loaded tooth enters contact, \
                and slow gears stall at this jump";
    }
    more_damping(p)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn damping_is_raised_by_the_parameter_in_use() {
        let mut p = Parameters::default();
        assert!(more_damping(&p).contains("contact.damping"));
        p.contact.damping_model = DampingModel::Restitution;
        assert!(more_damping(&p).contains("contact.restitution"));
        assert_eq!(fewer_steps(&p), more_damping(&p));
        p.effects.teeth.corner_contact = false;
        assert!(fewer_steps(&p).contains("effects.corner_contact = true"));
    }
}
