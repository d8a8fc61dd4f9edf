//! Rows of the parameters: all fixed but those that say tunable.

use super::row::{Access, Causality, Choice, EnumType, Range, RealParameter, Variability, Variable};
use super::units::{self, DisplayUnit, Unit};
use crate::contact::ContactLaw;
use crate::geometry::AddendumSystem;
use crate::model::{CarrierDrive, GearContact, Method, Parameters, PlanetSpin, Start};

fn row(name: &'static str, access: Access, description: &'static str) -> Variable {
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

fn real(
    name: &'static str,
    unit: Unit,
    display: Option<DisplayUnit>,
    (min, max): (f64, f64),
    at: RealParameter,
    description: &'static str,
) -> Variable {
    Variable { unit: Some(unit), display, range: Some(Range { min, max }), ..row(name, Access::Real(at), description) }
}

fn integer(
    name: &'static str,
    (min, max): (i32, i32),
    at: fn(&mut Parameters) -> &mut i32,
    description: &'static str,
) -> Variable {
    let range = Some(Range { min: f64::from(min), max: f64::from(max) });
    Variable { range, ..row(name, Access::Integer(at), description) }
}

fn switch(name: &'static str, at: fn(&mut Parameters) -> &mut bool, description: &'static str) -> Variable {
    row(name, Access::Boolean(at), description)
}

/// Declares an enumeration type and its row: the literals and their Rust counterparts stand side by side once.
macro_rules! choice {
    ($name:literal, $type:literal, $group:ident . $field:ident, $description:literal,
     $($value:path => $literal:literal $meaning:literal),+) => {{
        static TYPE: EnumType = EnumType {
            name: $type,
            choices: &[$(Choice { value: $value as i32, name: $literal, description: $meaning }),+],
        };
        fn set(p: &mut Parameters, value: i32) {
            $(if value == $value as i32 { p.$group.$field = $value; })+
        }
        row($name, Access::Enumeration(&TYPE, |p| p.$group.$field as i32, set), $description)
    }};
}

/// Rows of all parameters.
pub fn rows() -> Vec<Variable> {
    use units::{DEG, MM, MPA, N_PER_MM15, NS_PER_MM};
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
            "Wheel side of the left half-shaft, rigid on the side gear; 0 = none",
        ),
        real(
            "inertia.right_end",
            units::KG_M2,
            None,
            (0.0, 1e6),
            |p| &mut p.inertia.right_end,
            "Wheel side of the right half-shaft, rigid on the side gear; 0 = none",
        ),
        choice!("contact.law", "ContactLaw", contact.law, "Law of tooth contact",
            ContactLaw::Impact => "impact" "Adams IMPACT at the mean cone distance"),
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
    ];
    rows.extend([
        choice!("scene.carrier_drive", "CarrierDrive", scene.carrier_drive, "How the carrier is driven",
            CarrierDrive::Speed => "speed" "carrier.speed_command is imposed",
            CarrierDrive::Torque => "torque" "carrier.torque_command acts; carrier.speed_command is the initial speed"),
        choice!("scene.planet_spin", "PlanetSpin", scene.planet_spin, "Whether planets spin freely on their pins",
            PlanetSpin::Free => "free" "spin follows from the tooth forces",
            PlanetSpin::Imposed => "imposed" "planet.spin_command is imposed"),
        choice!("scene.gear_contact", "GearContact", scene.gear_contact, "Representation of tooth contact",
            GearContact::Ideal => "ideal" "no teeth: Willis' equation as a constraint",
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
    ]);
    rows
}
