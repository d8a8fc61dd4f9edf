//! Tests that wider vector instructions give the same bits as the vector instructions of every processor.

use std::process::Command;

use bevel_differential::contact::ContactLaw;
use bevel_differential::model::{GearContact, Inputs, Parameters, PlanetSpin, Simulation};
use bevel_differential::numeric::lanes;

/// Scenes that cover all sizes of the equations and all kinds of meshes.
fn scenes() -> Vec<(&'static str, Parameters)> {
    let changed = |name, change: fn(&mut Parameters)| {
        let mut p = Parameters::default();
        p.scene.planet_spin = PlanetSpin::Imposed;
        change(&mut p);
        (name, p)
    };
    vec![
        changed("plain", |_| {}),
        changed("planets one by one", |p| p.solver.merge_planets = false),
        changed("pins and half-shafts", |p| {
            (p.effects.pin_compliance, p.effects.half_shaft) = (true, true);
            (p.inertia.left_end, p.inertia.right_end) = (0.5, 0.8);
        }),
        changed("friction, errors, line law", |p| {
            (p.effects.tooth_friction, p.effects.thrust_friction, p.effects.tooth_errors) = (true, true, true);
            p.contact.law = ContactLaw::Line;
            p.specs.tooth_errors.accuracy_grade = 7;
        }),
        changed("solid", |p| p.scene.gear_contact = GearContact::Solid),
    ]
}

/// Runs every scene and prints the bits of its final state. The test below calls it in separate processes, because a
/// process selects its vector width only once.
#[test]
#[ignore = "prints for the other test"]
fn bits() {
    for (name, p) in scenes() {
        let inputs =
            Inputs { carrier_speed: 954f64.to_radians(), planet_spin: 200f64.to_radians(), ..Inputs::default() };
        let mut simulation = Simulation::start(&p, &inputs, 0.0).unwrap();
        for k in 1..=60 {
            simulation.advance(f64::from(k) * 1e-3).unwrap();
        }
        let (state, forces) = (*simulation.state(), *simulation.forces());
        let bits: Vec<u64> = state.q.iter().chain(&state.v).chain(&state.sums.heat).map(|x| x.to_bits()).collect();
        println!("bits of {name}: {bits:x?} {:x} {:?}", forces.carrier_torque.to_bits(), state.statistics);
    }
}

#[test]
fn wider_vectors_give_the_same_bits() {
    let [any, narrow] = ["", "narrow"].map(|vectors| {
        let run = Command::new(std::env::current_exe().unwrap())
            .args(["--exact", "bits", "--ignored", "--nocapture"])
            .env(lanes::VARIABLE, vectors)
            .output()
            .unwrap();
        let said = String::from_utf8(run.stdout).unwrap();
        assert!(run.status.success(), "{said}");
        said.lines().filter(|line| line.contains("bits of")).map(String::from).collect::<Vec<_>>()
    });
    assert_eq!(any.len(), scenes().len());
    assert_eq!(any, narrow);
}
