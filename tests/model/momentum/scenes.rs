//! Scenes whose momentum is balanced: each drive, and each effect that acts on bodies.

use bevel_differential::contact::ContactLaw;
use bevel_differential::model::{CarrierDrive, GearContact, Inputs, Parameters, PlanetSpin, SideDrive, Start};

/// A scene with its name.
pub struct Case {
    pub name: &'static str,
    pub p: Parameters,
    pub inputs: Inputs,
}

fn case(name: &'static str, change: impl Fn(&mut Parameters, &mut Inputs)) -> Case {
    let (mut p, mut inputs) = (Parameters::default(), Inputs::default());
    let (drag, clutches) = (&mut p.specs.bearing_drag, &mut p.specs.limited_slip);
    (drag.carrier_torque, drag.carrier_viscous, drag.carrier_churning) = (0.5, 5e-3, 1e-4);
    (drag.side_torque, drag.side_viscous) = (0.2, 1e-3);
    (clutches.preload, clutches.torque_coefficient) = (50.0, 0.1);
    change(&mut p, &mut inputs);
    Case { name, p, inputs }
}

/// The study's turn, started in equilibrium.
fn turning(p: &mut Parameters, inputs: &mut Inputs) {
    p.scene.planet_spin = PlanetSpin::Imposed;
    (inputs.carrier_speed, inputs.planet_spin) = (16.0, 3.5);
}

/// A carrier driven by torque that speeds up, wheels with inertia on shafts that twist, unequally loaded.
fn launch(p: &mut Parameters, inputs: &mut Inputs) {
    p.scene.carrier_drive = CarrierDrive::Torque;
    (inputs.carrier_torque, inputs.load_torque) = (900.0, [300.0, 380.0]);
    inputs.carrier_speed = 12.0;
    (p.inertia.left_end, p.inertia.right_end) = (0.5, 0.8);
    p.effects.half_shaft = true;
}

/// Wheels of imposed speeds on shafts that twist.
fn between_speeds(p: &mut Parameters, inputs: &mut Inputs) {
    (p.scene.left_drive, p.scene.right_drive) = (SideDrive::Speed, SideDrive::Speed);
    p.scene.carrier_drive = CarrierDrive::Torque;
    (inputs.carrier_torque, inputs.side_speed, inputs.carrier_speed) = (700.0, [21.0, 19.0], 20.0);
}

/// Scenes in which a drive imposes the carrier's speed.
pub fn imposed() -> Vec<Case> {
    vec![
        case("turn", turning),
        case("turn backward under drag of the wheels", |p, inputs| {
            turning(p, inputs);
            (inputs.carrier_speed, inputs.planet_spin, inputs.load_torque) = (-16.0, 3.5, [-300.0; 2]);
            p.contact.law = ContactLaw::Line;
        }),
        case("turn, three planets, rough drive", |p, inputs| {
            turning(p, inputs);
            (p.geometry.planet_count, p.geometry.side_teeth) = (3, 18);
            p.effects.final_drive = true;
            p.contact.law = ContactLaw::LineWeber;
        }),
        case("turn with compliant pins under a rough drive and drag", |p, inputs| {
            turning(p, inputs);
            (p.effects.pin_compliance, p.effects.final_drive, p.effects.bearing_drag) = (true, true, true);
            p.contact.law = ContactLaw::Line;
        }),
        case("turn with washers and clutches", |p, inputs| {
            turning(p, inputs);
            (p.effects.thrust_friction, p.effects.limited_slip) = (true, true);
        }),
        case("turn, teeth with pitch errors", |p, inputs| {
            turning(p, inputs);
            p.effects.tooth_errors = true;
            p.contact.law = ContactLaw::Line;
        }),
        // the cogging of the teeth holds the planets
        case("free planets under unequal loads, rough drive", |p, inputs| {
            p.effects.final_drive = true;
            (inputs.carrier_speed, inputs.load_torque) = (16.0, [825.0, 845.0]);
        }),
    ]
}

/// Scenes in which the carrier is driven by torque: external torques are known without any tooth.
pub fn driven() -> Vec<Case> {
    vec![
        case("ideal gears", |p, inputs| {
            launch(p, inputs);
            p.scene.gear_contact = GearContact::Ideal;
        }),
        case("lumped teeth that strike", |p, inputs| {
            launch(p, inputs);
            p.scene.gear_contact = GearContact::Lumped;
            p.scene.start = Start::Rolling;
        }),
        case("teeth that strike, rigid shafts", |p, inputs| {
            launch(p, inputs);
            p.effects.half_shaft = false;
            p.scene.start = Start::Rolling;
        }),
        case("solid teeth", |p, inputs| {
            launch(p, inputs);
            p.scene.gear_contact = GearContact::Solid;
            p.solid.facets = 6;
        }),
        case("compliant pins", |p, inputs| {
            launch(p, inputs);
            p.effects.pin_compliance = true;
            p.contact.law = ContactLaw::Line;
        }),
        case("compliant pins of four planets with errors, given inertias", |p, inputs| {
            launch(p, inputs);
            (p.effects.pin_compliance, p.effects.tooth_errors) = (true, true);
            p.geometry.planet_count = 4;
            p.inertia.from_geometry = false;
            (p.inertia.side_gear, p.inertia.planet) = (3e-4, 9e-5);
        }),
        case("friction everywhere", |p, inputs| {
            launch(p, inputs);
            (p.effects.thrust_friction, p.effects.tooth_friction, p.effects.limited_slip) = (true, true, true);
            p.contact.law = ContactLaw::Line;
        }),
        case("locked", |p, inputs| {
            launch(p, inputs);
            inputs.lock = 1.0;
        }),
        case("a braked wheel, drag and a rough drive", |p, inputs| {
            launch(p, inputs);
            (p.effects.wheel_brake, p.effects.bearing_drag, p.effects.final_drive) = (true, true, true);
            inputs.brake_torque = [200.0, 0.0];
        }),
        case("wheels of imposed speeds", between_speeds),
        case("wheels of imposed speeds, compliant pins, friction", |p, inputs| {
            between_speeds(p, inputs);
            (p.effects.pin_compliance, p.effects.thrust_friction) = (true, true);
            p.contact.law = ContactLaw::Line;
        }),
    ]
}
