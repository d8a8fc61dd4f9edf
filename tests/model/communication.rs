//! The integrator's steps continue beyond communication points. Neither steps nor results depend on these points, and
//! nothing that happens beyond a point affects the results at it.

use bevel_differential::contact::ContactLaw;
use bevel_differential::model::{
    CarrierDrive, Given, Inputs, Method, Parameters, PlanetSpin, Simulation, Start, State,
};

/// Named scene.
struct Scene {
    name: &'static str,
    parameters: Parameters,
    inputs: Inputs,
}

impl Scene {
    fn start(&self) -> Simulation {
        Simulation::start(&self.parameters, &self.inputs, 0.0).unwrap()
    }

    fn at_tolerance(&self, tolerance: f64) -> Simulation {
        let mut parameters = self.parameters;
        parameters.solver.relative_tolerance = tolerance;
        Simulation::start(&parameters, &self.inputs, 0.0).unwrap()
    }
}

/// Turn of the study, changed by `change`.
fn turn(name: &'static str, change: impl Fn(&mut Parameters)) -> Scene {
    let (mut parameters, mut inputs) = (Parameters::default(), Inputs::default());
    parameters.scene.planet_spin = PlanetSpin::Imposed;
    (inputs.carrier_speed, inputs.planet_spin) = (954f64.to_radians(), 200f64.to_radians());
    change(&mut parameters);
    Scene { name, parameters, inputs }
}

fn scenes() -> Vec<Scene> {
    let free = |p: &mut Parameters| {
        p.scene.carrier_drive = CarrierDrive::Torque;
        (p.inertia.left_end, p.inertia.right_end) = (0.5, 0.8);
    };
    vec![
        turn("turn", |_| {}),
        turn("rolling start", |p| p.scene.start = Start::Rolling),
        turn("line law", |p| p.contact.law = ContactLaw::Line),
        turn("tooth friction", |p| p.effects.tooth_friction = true),
        turn("bodies", |p| (p.contact.law, p.effects.body_compliance) = (ContactLaw::Line, true)),
        turn("washers that stick", |p| p.effects.thrust_friction = true),
        turn("driven by torque", free),
        turn("half-shafts", |p| {
            free(p);
            p.effects.half_shaft = true;
        }),
        Scene { name: "straight", parameters: Parameters::default(), inputs: Inputs::default() },
    ]
}

/// Sequences of communication points up to `stop` [s].
fn communication_points(stop: f64) -> Vec<Vec<f64>> {
    let even = |h: f64| {
        let count = (stop / h).round();
        (1..=count as u32).map(|k| stop * f64::from(k) / count).collect::<Vec<f64>>()
    };
    let (mut random, mut time, mut irregular) = (fastrand::Rng::with_seed(1), 0.0, Vec::new());
    while time < stop {
        time = f64::min(time + 10f64.powf(-5.0 + 3.5 * random.f64()), stop);
        irregular.push(time);
    }
    vec![even(1e-5), even(1e-3), even(7e-3), irregular]
}

/// Step-size control and statistics as text. They differ if steps differ.
fn steps_of(state: &State) -> String {
    format!("{:?} {:?}", state.control, state.statistics)
}

#[test]
fn steps_of_the_integrator_do_not_depend_on_communication_points() {
    const STOP: f64 = 0.05;
    for scene in scenes() {
        let mut whole = scene.start();
        whole.advance(STOP).unwrap();
        for points in communication_points(STOP) {
            let mut simulation = scene.start();
            for &point in &points {
                simulation.advance(point).unwrap();
            }
            assert_eq!(steps_of(simulation.state()), steps_of(whole.state()), "{}: {}", scene.name, points.len());
        }
    }
}

/// Speeds and their natural magnitude.
fn speeds(simulation: &Simulation) -> ([f64; 3], f64) {
    let motion = simulation.motion();
    let [left, right] = motion.side_speed;
    ([left, right, motion.spin_speed[0]], 1.0 + 2.0 * motion.carrier_speed.abs() + motion.spin_speed[0].abs())
}

#[test]
fn motion_and_forces_at_and_between_the_ends_of_steps_are_within_ten_tolerances() {
    for scene in scenes() {
        let (mut simulation, mut exact) = (scene.start(), scene.at_tolerance(1e-10));
        let tolerance = scene.parameters.solver.relative_tolerance;
        let (mut worst, mut wrong, mut largest) = (0.0f64, 0.0f64, 0.0f64);
        for k in 1..=4000 {
            let time = f64::from(k) * 1.25e-5;
            simulation.advance(time).unwrap();
            exact.advance(time).unwrap();
            let ((some, magnitude), (right, _)) = (speeds(&simulation), speeds(&exact));
            let off = (0..3).map(|i| (some[i] - right[i]).abs()).fold(0.0, f64::max);
            worst = worst.max(off / magnitude / tolerance);
            let [some, right] = [&mut simulation, &mut exact].map(|s| s.forces().side_normal);
            for i in 0..2 {
                wrong = wrong.max((some[i] - right[i]).abs());
                largest = largest.max(right[i]);
            }
        }
        let forces = wrong / largest / tolerance;
        println!("{}: speeds to {worst:.2} tolerances, forces to {forces:.2}", scene.name);
        assert!(worst.max(forces) < 10.0, "{}: {worst} tolerances, forces {forces}", scene.name);
    }
}

/// Change at a communication point after which the integration restarts.
type Change = fn(&mut Simulation, &Scene);

const CHANGES: [(&str, Change); 4] = [
    ("an input", |s, scene| {
        let load_torque = scene.inputs.load_torque.map(|torque| 1.1 * torque);
        s.set_inputs(&Inputs { load_torque, ..scene.inputs });
    }),
    ("derivatives of inputs", |s, _| s.set_input_derivatives(Some(bevel_differential::model::InputDerivatives::ZERO))),
    ("states", |s, _| {
        let mut states = s.states();
        states[0] += 1e-6;
        s.set_states(&states);
    }),
    ("a parameter", |s, scene| {
        let mut parameters = scene.parameters;
        parameters.contact.damping *= 1.5;
        s.tune(&parameters);
    }),
];

#[test]
fn the_integration_restarts_when_something_changes() {
    for scene in scenes() {
        for (what, change) in CHANGES {
            let mut fine = scene.start();
            for k in 1..=100 {
                fine.advance(f64::from(k) * 1e-4).unwrap();
            }
            assert_eq!(fine.state().timeline.constant_since, Some(0.0), "{}", scene.name);
            change(&mut fine, &scene);
            fine.advance(0.0101).unwrap();
            assert_eq!(fine.state().timeline.constant_since, Some(0.01), "{}: {what}", scene.name);
            let mut coarse = scene.start();
            coarse.advance(0.01).unwrap();
            change(&mut coarse, &scene);
            coarse.advance(0.0101).unwrap();
            let ((a, magnitude), (b, _)) = (speeds(&fine), speeds(&coarse));
            for i in 0..3 {
                assert!((a[i] - b[i]).abs() < 1e-8 * magnitude, "{}: {what}: {a:?} {b:?}", scene.name);
            }
        }
    }
}

#[test]
fn setting_the_same_inputs_again_changes_nothing() {
    let scene = turn("turn", |_| {});
    let [mut once, mut again] = [0; 2].map(|_| scene.start());
    for k in 1..=50 {
        let time = f64::from(k) * 1e-3;
        once.advance(time).unwrap();
        again.set_inputs(&Inputs { carrier_torque: 1.0, ..scene.inputs });
        again.set_inputs(&scene.inputs);
        again.advance(time).unwrap();
    }
    assert_eq!(once.state(), again.state());
}

#[test]
fn the_ledger_at_a_point_equals_that_of_a_run_that_ends_there() {
    for scene in scenes() {
        let mut parameters = scene.parameters;
        parameters.effects.strength = true;
        let scene = Scene { parameters, ..scene };
        for stop in [0.0103, 0.02171] {
            let (mut within, mut ends) = (scene.start(), scene.start());
            ends.set_input_derivatives(Some(bevel_differential::model::InputDerivatives::ZERO));
            ends.advance(stop).unwrap();
            within.advance(stop).unwrap();
            let (a, b) = (within.ledger(), ends.ledger());
            // ten tolerances of the energy converted so far
            let close = |x: f64, y: f64| (x - y).abs() < 1e-5 * (1.0 + b.heat.iter().sum::<f64>());
            let heats = a.heat.iter().zip(&b.heat).all(|(&x, &y)| close(x, y));
            // different steps evaluate the highest stress at different times
            let near = |x: f64, y: f64| close(x, y) || (x - y).abs() < 1e-4 * y.abs();
            let damages = a.readings.iter().zip(&b.readings).all(|(&x, &y)| near(x, y));
            assert!(heats && damages, "{} at {stop}: {a:?} {b:?}", scene.name);
            assert!(close(a.energy_residual, b.energy_residual), "{} at {stop}: {a:?} {b:?}", scene.name);
            // reading does not change the simulation
            let read = (*within.state(), within.memories().clone());
            within.ledger();
            within.forces();
            assert_eq!((*within.state(), within.memories().clone()), read);
        }
    }
}

#[test]
fn energy_balances_as_well_as_without_communication_points() {
    const STOP: f64 = 0.05;
    for scene in scenes() {
        let mut whole = scene.start();
        whole.advance(STOP).unwrap();
        let reference = whole.ledger().energy_residual;
        for points in communication_points(STOP) {
            let mut simulation = scene.start();
            points.iter().for_each(|&point| simulation.advance(point).unwrap());
            let residual = simulation.ledger().energy_residual;
            let close = (residual - reference).abs() <= 1e-9 * (1.0 + reference.abs());
            assert!(close, "{}: {residual:e} instead of {reference:e}", scene.name);
        }
    }
}

/// Scene with a load that bends the teeth beyond their limit some time after the start.
fn overload() -> Scene {
    let mut scene = turn("overload", |p| {
        (p.inertia.left_end, p.inertia.right_end) = (0.5, 0.5);
    });
    scene.inputs.load_torque = [1e6, 1e6];
    scene.parameters.scene.start = Start::Rolling;
    scene
}

#[test]
fn a_failure_beyond_a_communication_point_is_not_reported_at_it() {
    let scene = overload();
    let mut whole = scene.start();
    let failure = whole.advance(0.5).unwrap_err();
    assert!(failure.message.contains("tooth deflection exceeds"), "{failure}");
    assert!(failure.time > 1e-6 && whole.time() == failure.time);
    // small steps reach nearly the same time, because a failure of the pending step beyond the present is not reported
    let mut simulation = scene.start();
    let h = failure.time / 200.0;
    let mut reached = 0;
    let refused = loop {
        match simulation.advance(f64::from(reached + 1) * h) {
            Ok(()) => reached += 1,
            Err(refused) => break refused,
        }
        assert!(reached < 1000);
    };
    assert!(reached >= 200, "{reached}: {refused}");
    assert!(refused.time >= f64::from(reached) * h * (1.0 - 1e-12), "{refused}");
    // if the load is removed in time, the run continues
    let mut relieved = scene.start();
    relieved.advance(0.3 * failure.time).unwrap();
    relieved.set_inputs(&Inputs { load_torque: [0.0; 2], ..scene.inputs });
    relieved.advance(3.0 * failure.time).unwrap();
}

/// The step in which a tooth bends too far is not completed, so the last good state and the ledger belong together.
#[test]
fn after_a_failure_the_ledger_closes_at_the_last_good_time() {
    for method in [Method::Adaptive, Method::Radau, Method::FixedStep] {
        let mut scene = overload();
        (scene.parameters.solver.method, scene.parameters.solver.fixed_step) = (method, 1e-6);
        let mut simulation = scene.start();
        let failure = simulation.advance(0.5).unwrap_err();
        assert!(failure.message.contains("tooth deflection exceeds") && failure.time == simulation.time(), "{failure}");
        let (residual, work) = (simulation.ledger().energy_residual, simulation.state().sums.work);
        println!("{method:?}: {residual:e} J of {work:e} J");
        assert!(residual.abs() < 1e-3 * work.abs(), "{method:?}: {residual:e} J of {work:e} J");
    }
}

#[test]
fn a_copy_within_a_step_continues_with_the_same_bits() {
    for scene in scenes() {
        let mut simulation = scene.start();
        simulation.advance(0.0104).unwrap();
        assert!(simulation.state().pending_step.is_some(), "{}", scene.name);
        let state = (*simulation.state(), Some(simulation.memories().clone()));
        let copy = Simulation::resume_with(&scene.parameters, &scene.inputs, state, &Given::default()).unwrap();
        for mut other in [simulation.clone(), copy] {
            other.advance(0.02).unwrap();
            let mut same = simulation.clone();
            same.advance(0.02).unwrap();
            assert_eq!((same.state(), same.memories()), (other.state(), other.memories()), "{}", scene.name);
        }
    }
}
