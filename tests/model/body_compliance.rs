//! Scenes with elastic gear bodies: energy, preloaded start, deflection, refusals.

use bevel_differential::contact::ContactLaw;
use bevel_differential::model::{GearContact, Inputs, Parameters, PlanetSpin, Simulation, Start};

/// Turn of the study with the line law and bores, changed by `change`.
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

/// Named scenes, with elastic gear bodies if `bodies`.
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
        ("no corners", turn(bodies, |p| p.effects.teeth.corner_contact = false)),
    ]
}

/// Energy that the loads convert in `time` [s].
fn turned_over(inputs: &Inputs, time: f64) -> f64 {
    let torque: f64 = inputs.load_torque.iter().map(|torque| torque.abs()).sum();
    torque * inputs.carrier_speed.abs() * time
}

#[test]
fn energy_balances_as_well_as_without_elastic_bodies() {
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
fn elastic_bodies_increase_deflection_only_under_load() {
    // without backlash, straight ahead, with and without load
    let error = |bodies: bool, load: f64| {
        let (mut p, mut inputs) = turn(bodies, |p| p.effects.teeth.backlash = false);
        p.scene.planet_spin = PlanetSpin::Free;
        inputs.load_torque = [load; 2];
        inputs.planet_spin = 0.0;
        let mut simulation = Simulation::start(&p, &inputs, 0.0).expect("a scene that can be built");
        simulation.forces().mesh[0][0].transmission_error
    };
    let [with, without] = [true, false].map(|bodies| error(bodies, 800.0));
    println!("{with:e} {without:e} {}", with / without);
    assert!(with / without > 1.05 && with / without < 1.6, "{with:e} {without:e}");
    // the law is linear: deflections are proportional to the load
    let [small, none] = [1e-3, 0.0].map(|load| error(true, load));
    assert!((small / with * 8e5 - 1.0).abs() < 1e-2 && none.abs() < 1e-12, "{with:e} {small:e} {none:e}");
}

#[test]
fn scenes_that_elastic_bodies_do_not_support_are_refused_by_name() {
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

#[test]
fn assumptions_about_bores_are_logged_only_with_the_effect() {
    let log = |bodies: bool, [planet, side]: [f64; 2]| -> Vec<String> {
        let (p, inputs) = turn(bodies, |p| (p.geometry.planet_bore, p.geometry.side_bore) = (planet, side));
        let simulation = Simulation::start(&p, &inputs, 0.0).expect("a scene that can be built");
        let of_bores = simulation.warnings().iter().filter(|problem| problem.message.contains("_bore"));
        of_bores.map(|problem| format!("{}: {}", problem.variable, problem.message)).collect()
    };
    // thin rims are reported with and without the effect
    let added = |bores: [f64; 2]| -> Vec<String> {
        let without = log(false, bores);
        log(true, bores).into_iter().filter(|message| !without.contains(message)).collect()
    };
    for bores in [[0.0, 0.0], [4e-3, 8e-3]] {
        let without = log(false, bores);
        assert!(without.is_empty(), "{without:?}");
    }
    assert!(added([16e-3, 30e-3]).is_empty());
    let [planet, side] = &added([0.0, 0.0])[..] else { panic!("two bores of 0") };
    assert!(
        planet.starts_with(
            "effects.body_compliance: geometry.planet_bore = 0 mm: the planet is taken as one piece with a pin"
        ),
        "{planet}"
    );
    assert!(
        side.starts_with(
            "effects.body_compliance: geometry.side_bore = 0 mm: the side gear is taken as one piece with a shaft"
        ),
        "{side}"
    );
    // the widest bore leaves a rim of a quarter of the module at the toe, where the root circle has 33.931 mm
    assert!(side.contains("about as stiff as on the widest bore, 32.743 mm"), "{side}");
    // pins transmit no torque, so the narrow bore of the planet causes no message
    let [side] = &added([4e-3, 8e-3])[..] else { panic!("one bore that takes torque") };
    assert!(
        side.starts_with(
            "effects.body_compliance: geometry.side_bore = 8.000 mm is less than half the root circle at the toe"
        ),
        "{side}"
    );
}

/// Transmission error [m] with the diameter `side_bore` [m], straight ahead and without backlash. Even a shaft of 0.5
/// mm can transmit the load of 20 N·m.
fn error_on(side_bore: f64) -> f64 {
    let (p, mut inputs) = turn(true, |p| {
        (p.effects.teeth.backlash, p.scene.planet_spin, p.geometry.side_bore) = (false, PlanetSpin::Free, side_bore);
    });
    (inputs.planet_spin, inputs.load_torque) = (0.0, [20.0; 2]);
    let mut simulation = Simulation::start(&p, &inputs, 0.0).expect("a scene that can be built");
    simulation.forces().mesh[0][0].transmission_error
}

#[test]
fn transmission_error_falls_with_the_bore_and_without_a_bore_is_close_to_that_of_the_widest() {
    let widest = 32.743e-3;
    let errors: Vec<f64> = (1..=40).map(|k| error_on(widest * f64::from(k) / 40.001)).collect();
    assert!(errors.is_sorted_by(|a, b| a > b), "{errors:?}");
    // for narrow bores, the rotation of the gear is proportional to 1/d²
    let narrow = [0.5e-3, 1e-3, 2e-3].map(error_on);
    for two in narrow.windows(2) {
        let ratio = two[0] / two[1];
        assert!(ratio > 3.5 && ratio < 4.0, "{narrow:?}");
    }
    let (none, widest) = (error_on(0.0), errors[39]);
    println!("{none:e} without a bore, {widest:e} on the widest");
    assert!((none / widest - 1.0).abs() < 0.1, "{none:e} {widest:e}");
}

/// Turn with the given numbers of teeth of planet and side gear, without bores. `load` is the tooth force divided by
/// face width, module and Young's modulus. `spin` is the imposed speed of the planets [rad/s].
fn many(teeth: [i32; 2], law: ContactLaw, load: f64, spin: f64) -> (Parameters, Inputs) {
    let (p, mut inputs) = turn(true, |p| {
        (p.geometry.planet_teeth, p.geometry.side_teeth, p.contact.law) = (teeth[0], teeth[1], law);
        (p.geometry.planet_bore, p.geometry.side_bore) = (0.0, 0.0);
    });
    let radius = 0.5 * p.geometry.module * f64::from(teeth[1]);
    let force = load * p.geometry.face_width * p.geometry.module * p.material.young_modulus;
    inputs.load_torque = [f64::from(p.geometry.planet_count) * force * radius; 2];
    inputs.planet_spin = spin;
    (p, inputs)
}

#[test]
fn many_small_teeth_carry_their_load_from_the_start() {
    for teeth in [[200, 40], [40, 200], [100, 160], [160, 160], [200, 200]] {
        for law in [ContactLaw::Line, ContactLaw::LineWeber] {
            // 1e-3 is 19 kN on each tooth with a face of 20 mm
            for load in [1e-4, 1e-3, 3e-3, 1e-2] {
                let still = many(teeth, law, load, 0.0);
                let mut simulation = Simulation::start(&still.0, &still.1, 0.0).expect("teeth that carry");
                let (inertia, acceleration) = (simulation.inertias().side, simulation.forces().side_acceleration);
                for s in 0..2 {
                    let left = (inertia[s] * acceleration[s] / still.1.load_torque[s]).abs();
                    assert!(left < 1e-6, "{teeth:?} {law:?} {load}: {left:e} of the load is not balanced");
                }
                // one pitch of rolling would take a hundred thousand steps if the tooth loads jumped
                let scene = many(teeth, law, load, 2.0);
                let pitch = std::f64::consts::TAU / f64::from(teeth[0]) / scene.1.planet_spin;
                let ledger = ran(&scene, pitch).ledger();
                assert!(ledger.steps < 5000.0, "{teeth:?} {law:?} {load}: {} steps", ledger.steps);
            }
        }
    }
}
