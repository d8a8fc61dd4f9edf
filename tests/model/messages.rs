//! Messages of a run: errors name a remedy, and unusual results are reported once.

use bevel_differential::contact::ContactLaw;
use bevel_differential::model::{GearContact, Inputs, Parameters, PlanetSpin, Reported, Simulation};

/// A torque that no tooth carries [N·m].
const TOO_MUCH: f64 = 1e8;

/// Messages of a start and of a step under a load that bends teeth too far.
fn messages(p: &Parameters) -> [String; 2] {
    let inputs = Inputs { load_torque: [TOO_MUCH; 2], ..Inputs::default() };
    let refused = Simulation::start(p, &inputs, 0.0).unwrap_err();
    let mut simulation = Simulation::start(p, &Inputs::default(), 0.0).unwrap();
    simulation.set_inputs(&inputs);
    let failure = simulation.advance(0.02).unwrap_err();
    [refused[0].message.clone(), failure.message]
}

#[test]
fn errors_of_teeth_bent_too_far_name_a_remedy_for_the_law_in_use() {
    type Change = fn(&mut Parameters);
    let changes: [(&str, Change); 7] = [
        ("or raise contact.stiffness", |_| {}),
        ("contact.stiffness_from_hertz = false", |p| p.contact.stiffness_from_hertz = true),
        ("geometry.face_width", |p| p.contact.law = ContactLaw::Line),
        ("geometry.face_width", |p| p.contact.law = ContactLaw::LineWeber),
        ("geometry.face_width", |p| p.scene.gear_contact = GearContact::Lumped),
        ("raise contact.mesh_stiffness", |p| {
            p.scene.gear_contact = GearContact::Lumped;
            p.contact.mesh_stiffness_from_geometry = false;
        }),
        ("or raise contact.stiffness", |p| {
            p.scene.gear_contact = GearContact::Solid;
            p.solid.facets = 4;
        }),
    ];
    for (hint, change) in changes {
        let mut p = Parameters::default();
        change(&mut p);
        for message in messages(&p) {
            assert!(message.contains("tooth deflection exceeds half the base pitch"), "{message}");
            assert!(message.contains("reduce the load or") && message.contains(hint), "{hint}: {message}");
            assert_eq!(message.contains("raise contact.stiffness"), hint == "or raise contact.stiffness", "{message}");
        }
    }
}

#[test]
fn short_teeth_are_limited_by_their_working_depth() {
    let mut p = Parameters::default();
    p.geometry.addendum_system = bevel_differential::geometry::AddendumSystem::Explicit;
    (p.geometry.planet_addendum, p.geometry.side_addendum) = (0.7, 0.7);
    for message in messages(&p) {
        assert!(message.contains("tooth deflection exceeds the working depth"), "{message}");
    }
}

/// Scene with rated stresses, whose planets roll if `rolling`.
fn rated(rolling: bool) -> (Parameters, Inputs) {
    let (mut p, mut inputs) = (Parameters::default(), Inputs::default());
    p.effects.strength = true;
    if rolling {
        p.scene.planet_spin = PlanetSpin::Imposed;
        inputs.planet_spin = 20.0;
    }
    (p, inputs)
}

#[test]
fn stresses_within_the_strength_are_not_reported() {
    let (mut p, inputs) = rated(true);
    (p.specs.strength.bending_strength, p.specs.strength.contact_strength) = (1e11, 1e11);
    let mut simulation = Simulation::start(&p, &inputs, 0.0).unwrap();
    simulation.advance(0.05).unwrap();
    assert!(simulation.unreported(&mut Reported::default()).is_empty());
}

#[test]
fn each_stress_above_its_strength_is_reported_once_with_gear_values_and_time() {
    const BEGIN: f64 = 0.01;
    let (mut p, mut inputs) = rated(false);
    inputs.load_torque = [100.0, 100.0];
    let mut reported = Reported::default();
    // strengths between the stresses at 100 N·m and at 200 N·m; root stress is proportional to the torque, pressure to
    // its square root
    let stresses = |load: f64| {
        let mut inputs = inputs;
        inputs.load_torque = [load; 2];
        let mut simulation = Simulation::start(&p, &inputs, 0.0).unwrap();
        let at = |name: &str| bevel_differential::model::readings().position(|r| r.name == name).unwrap();
        let readings = simulation.forces().readings;
        (readings[at("stress.root_planet_max")], readings[at("stress.root_side_max")])
    };
    let (planet, side) = stresses(150.0);
    p.specs.strength.bending_strength = planet.max(side);
    p.specs.strength.contact_strength = 1e11;
    let mut simulation = Simulation::start(&p, &inputs, 0.0).unwrap();
    simulation.advance(BEGIN).unwrap();
    assert!(simulation.unreported(&mut reported).is_empty());
    inputs.load_torque[1] = 200.0 * planet.max(side) / planet.min(side);
    simulation.set_inputs(&inputs);
    simulation.advance(0.05).unwrap();
    // the unequal loads also accelerate the planets, which causes other reports
    let reports = simulation.unreported(&mut reported);
    let found: Vec<String> =
        reports.iter().filter(|one| one.variable.starts_with("strength")).map(ToString::to_string).collect();
    let strength = format!("exceeds the strength of {:.1} MPa", planet.max(side) * 1e-6);
    assert_eq!(found.len(), 2, "{found:?}");
    assert!(found[0].contains("strength.bending_strength: root stress of planet[1]"), "{found:?}");
    assert!(found[1].contains("root stress of the right side gear in mesh with planet[1]"), "{found:?}");
    for message in &found {
        assert!(message.contains(&strength), "{message}");
        let time: f64 = message.split("t = ").nth(1).unwrap().split(' ').next().unwrap().parse().unwrap();
        assert!(time > BEGIN && time < BEGIN + 5e-3, "{message}");
        let stress: f64 = message.split("of ").nth(2).unwrap().split(' ').next().unwrap().parse().unwrap();
        assert!(stress * 1e6 > planet.max(side) * (1.0 - 1e-3), "{message}");
    }
    simulation.advance(0.06).unwrap();
    assert!(simulation.unreported(&mut reported).is_empty());
}

#[test]
fn a_planet_that_rolls_is_rated_by_cycles_between_both_side_gears() {
    let (p, inputs) = rated(false);
    let mut simulation = Simulation::start(&p, &inputs, 0.0).unwrap();
    let at = bevel_differential::model::readings().position(|r| r.name == "stress.root_planet_max").unwrap();
    let stress = simulation.forces().readings[at];
    let reports = |rolling: bool| {
        let (mut p, inputs) = rated(rolling);
        p.specs.strength.contact_strength = 1e11;
        p.specs.strength.bending_strength = 1.2 * stress;
        let mut simulation = Simulation::start(&p, &inputs, 0.0).unwrap();
        simulation.advance(0.6).unwrap();
        simulation.unreported(&mut Reported::default())
    };
    assert!(reports(false).is_empty());
    let found = reports(true);
    let strength = format!("strength of {:.1} MPa", 1.2 * stress * 1e-6);
    assert!(found[0].message.contains("root stress of planet[1]") && found[0].message.contains(&strength), "{found:?}");
    // the planet turns once in 0.314 s; a cycle from one flank to the other and back needs about as long
    let time: f64 = found[0].message.split("t = ").nth(1).unwrap().split(' ').next().unwrap().parse().unwrap();
    assert!(time > 0.157 && time < 0.5, "{time}");
}
