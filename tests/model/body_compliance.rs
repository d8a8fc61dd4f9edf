//! Scenes with elastic bodies of the gears: energy, planets that move as one, restored states, deflection, refusals.

use bevel_differential::contact::ContactLaw;
use bevel_differential::model::{GearContact, Inputs, Parameters, PlanetSpin, Simulation, Start};

/// The study's turn with the law of the teeth and bores, changed by `change`.
fn turn(bodies: bool, change: impl Fn(&mut Parameters)) -> (Parameters, Inputs) {
    let (mut p, mut inputs) = (Parameters::default(), Inputs::default());
    p.scene.planet_spin = PlanetSpin::Imposed;
    (inputs.carrier_speed, inputs.planet_spin) = (954f64.to_radians(), 200f64.to_radians());
    (p.contact.law, p.effects.body_compliance) = (ContactLaw::Line, bodies);
    (p.geometry.planet_bore, p.geometry.side_bore) = (16e-3, 30e-3);
    change(&mut p);
    (p, inputs)
}

fn ran(scene: &(Parameters, Inputs), stop: f64) -> Simulation {
    let mut simulation = Simulation::start(&scene.0, &scene.1, 0.0).expect("a scene that can be built");
    simulation.advance(stop).expect("it runs");
    simulation
}

/// Scenes by name; the third says whether it has the effect.
fn scenes(bodies: bool) -> Vec<(&'static str, (Parameters, Inputs))> {
    vec![
        ("turn", turn(bodies, |_| {})),
        ("rolling", turn(bodies, |p| p.scene.start = Start::Rolling)),
        ("line_weber", turn(bodies, |p| p.contact.law = ContactLaw::LineWeber)),
        (
            "errors",
            turn(bodies, |p| {
                p.effects.tooth_errors = true;
                (p.specs.tooth_errors.accuracy_grade, p.specs.tooth_errors.crowning) = (6, 5e-6);
            }),
        ),
        (
            "pins and friction",
            turn(bodies, |p| {
                (p.effects.pin_compliance, p.effects.tooth_friction, p.effects.thrust_friction) = (true, true, true);
            }),
        ),
        ("friction", turn(bodies, |p| (p.effects.tooth_friction, p.effects.thrust_friction) = (true, true))),
        ("no corners", turn(bodies, |p| p.effects.corner_contact = false)),
    ]
}

/// Energy that the loads turn over in `time` [s].
fn turned_over(inputs: &Inputs, time: f64) -> f64 {
    let torque: f64 = inputs.load_torque.iter().map(|torque| torque.abs()).sum();
    torque * inputs.carrier_speed.abs() * time
}

#[test]
fn energy_balances_as_without_the_bodies() {
    const STOP: f64 = 0.1;
    for (with, without) in scenes(true).into_iter().zip(scenes(false)) {
        let residual = |scene: &(Parameters, Inputs), tolerance: f64| {
            let mut scene = *scene;
            scene.0.solver.relative_tolerance = tolerance;
            ran(&scene, STOP).ledger().energy_residual.abs() / turned_over(&scene.1, STOP)
        };
        let tight = residual(&with.1, 1e-9);
        let [on, off] = [&with.1, &without.1].map(|scene| residual(scene, 1e-6));
        println!("{}: {tight:.1e} at 1e-9; {on:.1e} at 1e-6, {off:.1e} without", with.0);
        assert!(tight < 1e-6, "{}: {tight:e}", with.0);
        assert!(on < 2.0 * off.max(1e-7), "{}: {on:e} instead of {off:e}", with.0);
    }
}

#[test]
fn a_preloaded_start_is_in_balance() {
    for (name, scene) in scenes(true) {
        if scene.0.scene.start == Start::Rolling || scene.0.effects.thrust_friction {
            continue;
        }
        let mut simulation = Simulation::start(&scene.0, &scene.1, 0.0).expect("a scene that can be built");
        let inertia = simulation.inertias().side;
        let acceleration = simulation.forces().side_acceleration;
        for s in 0..2 {
            let left = (inertia[s] * acceleration[s] / scene.1.load_torque[s]).abs();
            println!("{name}: {left:.1e}");
            assert!(left < 0.02, "{name}: {left:e} of the load is not balanced");
        }
    }
}

#[test]
fn planets_that_move_as_one_have_the_same_bits_as_each_alone() {
    for (name, scene) in scenes(true) {
        // planets with errors differ, and pins take other sums without bodies, too
        if scene.0.effects.tooth_errors || scene.0.effects.pin_compliance {
            continue;
        }
        let mut each = scene;
        each.0.solver.merge_planets = false;
        let [mut together, mut apart] = [&scene, &each].map(|scene| ran(scene, 0.03));
        assert_eq!(together.motion(), apart.motion(), "{name}");
        let [a, b] = [&mut together, &mut apart].map(|simulation| {
            let forces = simulation.forces();
            (forces.carrier_torque, forces.mesh)
        });
        assert_eq!(a, b, "{name}");
    }
}

/// Largest difference of two motions of the side gears, over the carrier's speed.
fn apart(a: [f64; 2], b: [f64; 2], scale: f64) -> f64 {
    a.iter().zip(b).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max) / scale
}

#[test]
fn mirrored_scenes_move_as_mirror_images() {
    for (name, scene) in scenes(true) {
        if scene.0.effects.tooth_errors {
            continue;
        }
        // everything the other way round, then left for right
        let (mut reversed, mut swapped) = (scene, scene);
        reversed.1.carrier_speed *= -1.0;
        for inputs in [&mut reversed.1, &mut swapped.1] {
            inputs.planet_spin *= -1.0;
        }
        reversed.1.load_torque = scene.1.load_torque.map(|torque| -torque);
        swapped.1.load_torque.swap(0, 1);
        let [here, reversed, swapped] = [&scene, &reversed, &swapped].map(|scene| {
            let mut simulation = ran(scene, 0.03);
            let (speed, mesh) = (simulation.motion().side_speed, simulation.forces().mesh[0]);
            (speed, mesh.map(|mesh| mesh.normal))
        });
        let scale = scene.1.carrier_speed;
        let turned = reversed.0.map(|speed| -speed);
        assert!(apart(here.0, turned, scale) < 1e-6, "{name}: {here:?} {reversed:?}");
        assert!(apart(here.0, [swapped.0[1], swapped.0[0]], scale) < 1e-6, "{name}: {here:?} {swapped:?}");
        assert!(apart(here.1, reversed.1, here.1[0]) < 1e-5, "{name}: {here:?} {reversed:?}");
        assert!(apart(here.1, [swapped.1[1], swapped.1[0]], here.1[0]) < 1e-5, "{name}: {here:?} {swapped:?}");
    }
}

#[test]
fn a_state_that_is_restored_goes_on_to_the_same_bits() {
    for (name, scene) in scenes(true) {
        let mut simulation = ran(&scene, 0.0123);
        let saved = simulation.clone();
        simulation.advance(0.02).expect("it runs");
        let mut again = saved;
        again.advance(0.02).expect("it runs");
        assert_eq!(simulation.state(), again.state(), "{name}");
    }
}

#[test]
fn gears_give_way_more_on_bodies_and_not_without_load() {
    // backlash aside, straight ahead under a load and without one
    let error = |bodies: bool, load: f64| {
        let (mut p, mut inputs) = turn(bodies, |p| p.effects.backlash = false);
        p.scene.planet_spin = PlanetSpin::Free;
        inputs.load_torque = [load; 2];
        inputs.planet_spin = 0.0;
        let mut simulation = Simulation::start(&p, &inputs, 0.0).expect("a scene that can be built");
        simulation.forces().mesh[0][0].transmission_error
    };
    let [with, without] = [true, false].map(|bodies| error(bodies, 800.0));
    println!("{with:e} {without:e} {}", with / without);
    assert!(with / without > 1.05 && with / without < 1.6, "{with:e} {without:e}");
    // a linear law: deflections fall with the load to none
    let [small, none] = [1e-3, 0.0].map(|load| error(true, load));
    assert!((small / with * 8e5 - 1.0).abs() < 1e-2 && none.abs() < 1e-12, "{with:e} {small:e} {none:e}");
}

#[test]
fn what_it_cannot_work_with_is_refused_by_name() {
    let refused = |change: &dyn Fn(&mut Parameters)| {
        let (p, inputs) = turn(true, change);
        Simulation::start(&p, &inputs, 0.0).map(|_| ()).expect_err("a scene that cannot be built").remove(0)
    };
    let impact = refused(&|p| p.contact.law = ContactLaw::Impact);
    assert_eq!(impact.variable, "effects.body_compliance");
    assert!(impact.message.contains("line or line_weber"), "{}", impact.message);
    for contact in [GearContact::Ideal, GearContact::Lumped, GearContact::Solid] {
        let problem = refused(&|p| p.scene.gear_contact = contact);
        assert!(["effects.body_compliance", "contact.law"].contains(&problem.variable), "{problem:?}");
    }
    for (name, change) in [
        ("geometry.planet_bore", &(|p: &mut Parameters| p.geometry.planet_bore = 19e-3) as &dyn Fn(&mut Parameters)),
        ("geometry.side_bore", &|p| p.geometry.side_bore = 33.5e-3),
    ] {
        let problem = refused(change);
        assert_eq!(problem.variable, name);
        assert!(problem.message.contains("leaves no body"), "{}", problem.message);
    }
}
