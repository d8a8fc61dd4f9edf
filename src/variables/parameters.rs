//! Rows of the parameters: all fixed but those that say tunable.

use super::row::{Access, Causality, Range, RealParameter, Variability, Variable};
use super::units::{self, DisplayUnit, Unit};
use crate::contact::{ContactLaw, DampingModel};
use crate::geometry::AddendumSystem;
use crate::model::{CarrierDrive, GearContact, Method, Parameters, PlanetSpin, SideDrive, Start};

pub(super) fn row(name: &'static str, access: Access, description: &'static str) -> Variable {
    Variable {
        name,
        description,
        causality: Causality::Parameter,
        variability: Variability::Fixed,
        unit: None,
        display: None,
        range: None,
        access,
    }
}

pub(super) fn real(
    name: &'static str,
    unit: Unit,
    display: Option<DisplayUnit>,
    (min, max): (f64, f64),
    at: RealParameter,
    description: &'static str,
) -> Variable {
    Variable { unit: Some(unit), display, range: Some(Range { min, max }), ..row(name, Access::Real(at), description) }
}

pub(super) fn integer(
    name: &'static str,
    (min, max): (i32, i32),
    at: fn(&mut Parameters) -> &mut i32,
    description: &'static str,
) -> Variable {
    let range = Some(Range { min: f64::from(min), max: f64::from(max) });
    Variable { range, ..row(name, Access::Integer(at), description) }
}

pub(super) fn switch(name: &'static str, at: fn(&mut Parameters) -> &mut bool, description: &'static str) -> Variable {
    row(name, Access::Boolean(at), description)
}

/// Rows of all parameters.
pub fn rows() -> Vec<Variable> {
    use units::{DEG, MM, MPA, N_PER_MM, N_PER_MM_UM, N_PER_MM15, NS_PER_MM};
    let mut rows = vec![
        real(
            "geometry.module",
            units::METRE,
            Some(MM),
            (2e-4, 0.1),
            |p| &mut p.geometry.module,
            "Outer transverse module",
        ),
        integer("geometry.planet_teeth", (5, 200), |p| &mut p.geometry.planet_teeth, "Teeth of a planet"),
        integer("geometry.side_teeth", (5, 200), |p| &mut p.geometry.side_teeth, "Teeth of a side gear"),
        integer(
            "geometry.planet_count",
            (2, 4),
            |p| &mut p.geometry.planet_count,
            "Number of equally spaced planets; 2 side_teeth / planet_count must be an integer",
        ),
        real(
            "geometry.pressure_angle",
            units::RADIAN,
            Some(DEG),
            (0.17, 0.53),
            |p| &mut p.geometry.pressure_angle,
            "Pressure angle",
        ),
        real(
            "geometry.shaft_angle",
            units::RADIAN,
            Some(DEG),
            (0.17, 3.0),
            |p| &mut p.geometry.shaft_angle,
            "Angle between planet and side gear axes; a differential needs 90 deg",
        ),
        real("geometry.face_width", units::METRE, Some(MM), (1e-4, 1.0), |p| &mut p.geometry.face_width, "Face width"),
        choice!("geometry.addendum_system", "AddendumSystem", geometry.addendum_system,
            "Rule for addenda and dedenda",
            AddendumSystem::Standard => "standard" "addendum 1.0 m, dedendum 1.25 m on both gears",
            AddendumSystem::Gleason => "gleason" "Gleason long-and-short addenda",
            AddendumSystem::Iso23509 => "iso23509" "ISO 23509 mean addendum factor, clearance 0.25 m",
            AddendumSystem::Explicit => "explicit" "the four coefficients geometry.planet_addendum ... side_dedendum"),
        real(
            "geometry.planet_addendum",
            units::ONE,
            None,
            (0.05, 3.0),
            |p| &mut p.geometry.planet_addendum,
            "Planet addendum per module, with addendum_system explicit",
        ),
        real(
            "geometry.side_addendum",
            units::ONE,
            None,
            (0.05, 3.0),
            |p| &mut p.geometry.side_addendum,
            "Side gear addendum per module, with addendum_system explicit",
        ),
        real(
            "geometry.planet_dedendum",
            units::ONE,
            None,
            (0.05, 3.0),
            |p| &mut p.geometry.planet_dedendum,
            "Planet dedendum per module, with addendum_system explicit",
        ),
        real(
            "geometry.side_dedendum",
            units::ONE,
            None,
            (0.05, 3.0),
            |p| &mut p.geometry.side_dedendum,
            "Side gear dedendum per module, with addendum_system explicit",
        ),
        real(
            "geometry.backlash",
            units::METRE,
            Some(MM),
            (0.0, 0.05),
            |p| &mut p.geometry.backlash,
            "Circumferential backlash at the outer pitch circle",
        ),
        real(
            "geometry.root_fillet",
            units::ONE,
            None,
            (0.0, 1.0),
            |p| &mut p.geometry.root_fillet,
            "Fillet radius at the root of the teeth per module, for their stiffness",
        ),
        real(
            "geometry.planet_bore",
            units::METRE,
            Some(MM),
            (0.0, 10.0),
            |p| &mut p.geometry.planet_bore,
            "Bore diameter of a planet (its pin), for mass and rim; 0 = solid",
        ),
        real(
            "geometry.side_bore",
            units::METRE,
            Some(MM),
            (0.0, 10.0),
            |p| &mut p.geometry.side_bore,
            "Bore diameter of a side gear (its shaft), for mass and rim; 0 = solid",
        ),
        real(
            "material.young_modulus",
            units::PASCAL,
            Some(MPA),
            (1e8, 1e13),
            |p| &mut p.material.young_modulus,
            "Young's modulus of both gears",
        ),
        real(
            "material.poisson_ratio",
            units::ONE,
            None,
            (0.0, 0.499),
            |p| &mut p.material.poisson_ratio,
            "Poisson's ratio of both gears",
        ),
        real(
            "material.density",
            units::KG_PER_M3,
            None,
            (100.0, 3e4),
            |p| &mut p.material.density,
            "Density of the gears",
        ),
        switch(
            "inertia.from_geometry",
            |p| &mut p.inertia.from_geometry,
            "Side gear and planet inertia from their solids; false: as given",
        ),
        real(
            "inertia.carrier",
            units::KG_M2,
            None,
            (1e-9, 1e6),
            |p| &mut p.inertia.carrier,
            "Carrier with ring gear and cross-shaft about its axis, without planets",
        ),
        real(
            "inertia.side_gear",
            units::KG_M2,
            None,
            (1e-12, 1e6),
            |p| &mut p.inertia.side_gear,
            "Side gear about its axis, if not from geometry",
        ),
        real(
            "inertia.planet",
            units::KG_M2,
            None,
            (1e-12, 1e6),
            |p| &mut p.inertia.planet,
            "Planet about its own axis, if not from geometry",
        ),
        real(
            "inertia.left_end",
            units::KG_M2,
            None,
            (0.0, 1e6),
            |p| &mut p.inertia.left_end,
            "Wheel side of the left half-shaft; rigid on the side gear unless effects.half_shaft; 0 = none",
        ),
        real(
            "inertia.right_end",
            units::KG_M2,
            None,
            (0.0, 1e6),
            |p| &mut p.inertia.right_end,
            "Wheel side of the right half-shaft; rigid on the side gear unless effects.half_shaft; 0 = none",
        ),
        choice!("contact.law", "ContactLaw", contact.law, "Law of tooth contact",
            ContactLaw::Impact => "impact" "Adams IMPACT at the mean cone distance",
            ContactLaw::Line => "line" "tooth stiffness from geometry over the face width, linear",
            ContactLaw::LineWeber => "line_weber" "the same with the Hertz part as the load has it"),
        switch(
            "contact.stiffness_from_hertz",
            |p| &mut p.contact.stiffness_from_hertz,
            "Stiffness by the study's Hertz formula 4/3 sqrt(Re) E* instead of contact.stiffness",
        ),
        real(
            "contact.stiffness",
            units::N_PER_M15,
            Some(N_PER_MM15),
            (1e3, 1e18),
            |p| &mut p.contact.stiffness,
            "Contact stiffness K; N/m^e where the exponent is not 1.5",
        ),
        real("contact.exponent", units::ONE, None, (1.0, 3.0), |p| &mut p.contact.exponent, "Force exponent e"),
        Variable {
            variability: Variability::Tunable,
            ..real(
                "contact.damping",
                units::NS_PER_M,
                Some(NS_PER_MM),
                (0.0, 1e9),
                |p| &mut p.contact.damping,
                "Contact damping C at full penetration",
            )
        },
        real(
            "contact.penetration_depth",
            units::METRE,
            Some(MM),
            (1e-9, 0.01),
            |p| &mut p.contact.penetration_depth,
            "Penetration at which damping is full",
        ),
        choice!("contact.damping_model", "DampingModel", contact.damping_model, "Damping of a tooth pair",
            DampingModel::Step => "step" "contact.damping, built up over contact.penetration_depth as in Adams IMPACT",
            DampingModel::Restitution => "restitution" "Hunt-Crossley, from contact.restitution at contact.impact_speed"),
        real(
            "contact.restitution",
            units::ONE,
            None,
            (0.05, 1.0),
            |p| &mut p.contact.restitution,
            "Coefficient of restitution, with contact.damping_model restitution",
        ),
        real(
            "contact.impact_speed",
            units::M_PER_S,
            None,
            (1e-6, 1e3),
            |p| &mut p.contact.impact_speed,
            "Impact speed at which the restitution holds",
        ),
        real(
            "contact.reference_line_load",
            units::N_PER_M,
            Some(N_PER_MM),
            (1.0, 1e8),
            |p| &mut p.contact.line_load,
            "Line load at the mean cone distance for the Hertz part of contact.law line and of the lumped stiffness",
        ),
        switch(
            "contact.mesh_stiffness_from_geometry",
            |p| &mut p.contact.mesh_stiffness_from_geometry,
            "Stiffness of a lumped mesh from the geometry of its teeth; false: contact.mesh_stiffness",
        ),
        real(
            "contact.mesh_stiffness",
            units::N_PER_M2,
            Some(N_PER_MM_UM),
            (1e3, 1e15),
            |p| &mut p.contact.mesh_stiffness,
            "Stiffness of a lumped mesh per face width, if not from geometry",
        ),
    ];
    rows.extend([
        choice!("scene.carrier_drive", "CarrierDrive", scene.carrier_drive, "How the carrier is driven",
            CarrierDrive::Speed => "speed" "carrier.speed_command is imposed",
            CarrierDrive::Torque => "torque" "carrier.torque_command acts; carrier.speed_command is the initial speed"),
        choice!("scene.left_drive", "SideDrive", scene.left_drive, "How the left half-shaft is driven",
            SideDrive::Torque => "torque" "the load torque acts on its wheel side",
            SideDrive::Speed => "speed" "the speed command is imposed on its wheel side; the half-shaft twists"),
        choice!("scene.right_drive", "SideDrive", scene.right_drive, "How the right half-shaft is driven",
            SideDrive::Torque => "torque" "the load torque acts on its wheel side",
            SideDrive::Speed => "speed" "the speed command is imposed on its wheel side; the half-shaft twists"),
        choice!("scene.planet_spin", "PlanetSpin", scene.planet_spin, "Whether planets spin freely on their pins",
            PlanetSpin::Free => "free" "spin follows from the tooth forces",
            PlanetSpin::Imposed => "imposed" "planet.spin_command is imposed"),
        choice!("scene.gear_contact", "GearContact", scene.gear_contact, "Representation of tooth contact",
            GearContact::Ideal => "ideal" "no teeth: Willis' equation as a constraint",
            GearContact::Lumped => "lumped" "one spring per mesh",
            GearContact::Tooth => "tooth" "tooth pair by tooth pair along the path of contact"),
        choice!("scene.start", "Start", scene.start, "State at the start time",
            Start::Equilibrium => "equilibrium" "meshes preloaded by the loads at the start time",
            Start::Rolling => "rolling" "speeds by Willis' equation, teeth in mid-gap, unloaded",
            Start::Rest => "rest" "everything at rest that is not imposed"),
        switch(
            "effects.backlash",
            |p| &mut p.effects.backlash,
            "Backlash geometry.backlash; false: teeth without play",
        ),
        switch(
            "effects.corner_contact",
            |p| &mut p.effects.corner_contact,
            "Tip-corner contact outside the path of contact; false: pairs enter and leave abruptly",
        ),
        switch("effects.tooth_errors", |p| &mut p.effects.tooth_errors, "Deviations, modifications and misalignment"),
        switch(
            "effects.tooth_fault",
            |p| &mut p.effects.tooth_fault,
            "A tooth that breaks by fault.trigger or in time",
        ),
        switch("effects.tooth_friction", |p| &mut p.effects.tooth_friction, "Friction along the flanks"),
        switch("effects.thrust_friction", |p| &mut p.effects.thrust_friction, "Friction of thrust washers and pins"),
        switch("effects.limited_slip", |p| &mut p.effects.limited_slip, "Clutch packs between side gears and carrier"),
        switch("effects.half_shaft", |p| &mut p.effects.half_shaft, "Torsion of the half-shafts"),
        switch("effects.pin_compliance", |p| &mut p.effects.pin_compliance, "Pins and case that give way"),
        switch("effects.bearing_drag", |p| &mut p.effects.bearing_drag, "Drag of bearings and churned oil"),
        switch("effects.final_drive", |p| &mut p.effects.final_drive, "Excitation by the final drive's ring gear"),
        switch("effects.strength", |p| &mut p.effects.strength, "Stress and fatigue of the teeth"),
        choice!("solver.method", "SolverMethod", solver.method, "Integration method",
            Method::Adaptive => "adaptive" "adaptive L-stable Rosenbrock method of order 5"),
        real(
            "solver.relative_tolerance",
            units::ONE,
            None,
            (1e-11, 1e-1),
            |p| &mut p.solver.relative_tolerance,
            "Relative tolerance of the local error per step",
        ),
        switch(
            "solver.merge_planets",
            |p| &mut p.solver.merge_planets,
            "Planets that are identical and in phase are simulated once and counted; false: each by itself",
        ),
    ]);
    rows.extend(super::effects::rows());
    rows
}
