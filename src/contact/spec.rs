//! User parameters of the contact law.

use crate::declaration::prelude::*;
use crate::drives::{GearContact, Scene};

choices! {
    /// Law of force against penetration.
    pub enum ContactLaw: "ContactLaw" {
        Impact = 1, "impact": "Adams IMPACT at the mean cone distance";
        Line = 2, "line": "linear tooth stiffness from geometry, over the face width";
        LineWeber = 3, "line_weber": "tooth stiffness from geometry, with a Hertz part that depends on the load";
    }
}

impl ContactLaw {
    /// True if the law has the stiffness of the teeth, valid at every cone distance. Other laws have one resultant for
    /// the whole face.
    pub const fn is_of_teeth(self) -> bool {
        matches!(self, Self::Line | Self::LineWeber)
    }
}

choices! {
    /// Damping of a tooth pair.
    pub enum DampingModel: "DampingModel" {
        Step = 1, "step": "contact.damping, built up over contact.penetration_depth as in Adams IMPACT";
        Restitution = 2, "restitution": "Hunt-Crossley, from contact.restitution at contact.impact_speed";
    }
}

parameters! {
    /// Contact law and its constants.
    ///
    /// The start values are the study's Adams settings.
    pub struct ContactSpec in "contact" {
        /// Contact law of tooth pairs
        law: ContactLaw = ContactLaw::Impact, when(is!(Scene.gear_contact, GearContact::Tooth));
        /// Stiffness by the study's Hertz formula 4/3 sqrt(Re) E* instead of contact.stiffness
        stiffness_from_hertz: bool = false,
            when(by_impact());
        // 5.77e5 N/mm^1.5 · (1000 mm/m)^1.5
        /// Contact stiffness K; in N/m^e if the exponent e is not 1.5
        stiffness: f64 = 5.77e5 * 1e3 * 1e3_f64.sqrt(), N_PER_M15 | N_PER_MM15, 1e3..=1e18,
            when(all([is!(Self.stiffness_from_hertz, false), by_impact()]));
        /// Exponent e of the contact force
        exponent: f64 = 1.5, ONE, 1.0..=3.0,
            when(by_impact());
        /// Contact damping C at contact.penetration_depth or more
        damping: f64 = 5e4, NS_PER_M | NS_PER_MM, 0.0..=1e9, TUNABLE,
            when(by_step());
        /// Penetration at which damping reaches contact.damping
        penetration_depth: f64 = 1e-4, METRE | MM, 1e-9..=0.01,
            when(by_step());
        /// Damping law of tooth pairs
        damping_model: DampingModel = DampingModel::Step, when(differs!(Scene.gear_contact, GearContact::Ideal));
        /// Coefficient of restitution, if contact.damping_model = restitution
        restitution: f64 = 0.8, ONE, 0.05..=1.0,
            when(by_restitution());
        /// Impact speed at which contact.restitution applies
        impact_speed: f64 = 0.1, M_PER_S, 1e-6..=1e3,
            when(by_restitution());
        /// Line load at the mean cone distance for the Hertz part of the tooth stiffness; for contact.law = line and
        /// lumped meshes
        reference_line_load: f64 = 4e5, N_PER_M | N_PER_MM, 1.0..=1e8,
            when(any([all([is!(Scene.gear_contact, GearContact::Tooth), is!(Self.law, ContactLaw::Line)]),
                all([is!(Scene.gear_contact, GearContact::Lumped), is!(Self.mesh_stiffness_from_geometry, true)])]));
        /// Stiffness of a lumped mesh from the tooth geometry; false: contact.mesh_stiffness
        mesh_stiffness_from_geometry: bool = true, when(is!(Scene.gear_contact, GearContact::Lumped));
        /// Stiffness of a lumped mesh per face width, if not from geometry
        mesh_stiffness: f64 = 1.8e10, N_PER_M2 | N_PER_MM_UM, 1e3..=1e15,
            when(all([is!(Scene.gear_contact, GearContact::Lumped), is!(Self.mesh_stiffness_from_geometry, false)]));
    }
}

/// Condition that pairs have the force of `contact.stiffness` and `contact.exponent`.
fn by_impact() -> Condition {
    any([
        all([is!(Scene.gear_contact, GearContact::Tooth), is!(ContactSpec.law, ContactLaw::Impact)]),
        is!(Scene.gear_contact, GearContact::Solid),
    ])
}

/// Condition that teeth have the damping by restitution.
fn by_restitution() -> Condition {
    all([differs!(Scene.gear_contact, GearContact::Ideal), is!(ContactSpec.damping_model, DampingModel::Restitution)])
}

/// Condition that teeth have the damping of Adams IMPACT.
fn by_step() -> Condition {
    all([differs!(Scene.gear_contact, GearContact::Ideal), is!(ContactSpec.damping_model, DampingModel::Step)])
}
