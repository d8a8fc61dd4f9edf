//! Rows of tooth contact.

use crate::declaration::units::{self, MM, N_PER_MM, N_PER_MM_UM, N_PER_MM15, NS_PER_MM};
use crate::declaration::{Parameter, Row, row};
use crate::model::Parameters;

/// Rows of `contact.…`.
pub fn rows() -> Vec<Row<Parameter<Parameters>>> {
    vec![
        row("contact.law", "Contact law of tooth pairs")
            .when("scene.gear_contact = tooth")
            .choice(|p| &mut p.contact.law),
        row(
            "contact.stiffness_from_hertz",
            "Stiffness by the study's Hertz formula 4/3 sqrt(Re) E* instead of contact.stiffness",
        )
        .when("scene.gear_contact = tooth and contact.law = impact or scene.gear_contact = solid")
        .switch(|p| &mut p.contact.stiffness_from_hertz),
        row("contact.stiffness", "Contact stiffness K; in N/m^e if the exponent e is not 1.5")
            .when(
                "contact.stiffness_from_hertz = false and (scene.gear_contact = tooth and contact.law = impact \
                 or scene.gear_contact = solid)",
            )
            .real((units::N_PER_M15, N_PER_MM15), (1e3, 1e18), |p| &mut p.contact.stiffness),
        row("contact.exponent", "Exponent e of the contact force")
            .when("scene.gear_contact = tooth and contact.law = impact or scene.gear_contact = solid")
            .real(units::ONE, (1.0, 3.0), |p| &mut p.contact.exponent),
        row("contact.damping", "Contact damping C at contact.penetration_depth or more")
            .tunable()
            .when("scene.gear_contact != ideal and contact.damping_model = step")
            .real((units::NS_PER_M, NS_PER_MM), (0.0, 1e9), |p| &mut p.contact.damping),
        row("contact.penetration_depth", "Penetration at which damping reaches contact.damping")
            .when("scene.gear_contact != ideal and contact.damping_model = step")
            .real((units::METRE, MM), (1e-9, 0.01), |p| &mut p.contact.penetration_depth),
        row("contact.damping_model", "Damping law of tooth pairs")
            .when("scene.gear_contact != ideal")
            .choice(|p| &mut p.contact.damping_model),
        row("contact.restitution", "Coefficient of restitution, if contact.damping_model = restitution")
            .when("scene.gear_contact != ideal and contact.damping_model = restitution")
            .real(units::ONE, (0.05, 1.0), |p| &mut p.contact.restitution),
        row("contact.impact_speed", "Impact speed at which contact.restitution applies")
            .when("scene.gear_contact != ideal and contact.damping_model = restitution")
            .real(units::M_PER_S, (1e-6, 1e3), |p| &mut p.contact.impact_speed),
        row(
            "contact.reference_line_load",
            "Line load at the mean cone distance for the Hertz part of the tooth stiffness; for contact.law = line \
             and lumped meshes",
        )
        .when(
            "scene.gear_contact = tooth and contact.law = line or scene.gear_contact = lumped and \
             contact.mesh_stiffness_from_geometry = true",
        )
        .real((units::N_PER_M, N_PER_MM), (1.0, 1e8), |p| &mut p.contact.line_load),
        row(
            "contact.mesh_stiffness_from_geometry",
            "Stiffness of a lumped mesh from the tooth geometry; false: contact.mesh_stiffness",
        )
        .when("scene.gear_contact = lumped")
        .switch(|p| &mut p.contact.mesh_stiffness_from_geometry),
        row("contact.mesh_stiffness", "Stiffness of a lumped mesh per face width, if not from geometry")
            .when("scene.gear_contact = lumped and contact.mesh_stiffness_from_geometry = false")
            .real((units::N_PER_M2, N_PER_MM_UM), (1e3, 1e15), |p| &mut p.contact.mesh_stiffness),
    ]
}
