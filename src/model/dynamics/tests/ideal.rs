//! Tests of the equations of ideal gears with effects. Scenes in which only half-shafts act use separate equations,
//! which must give the same bits.

use super::{IdealEquations, State};
use crate::integrate::{Point, SecondOrder};
use crate::model::assembly::ideal_with_effects::{IDEAL_SIZE, IdealWithEffects};
use crate::model::assembly::{Gears, Given, Model};
use crate::model::scene::{CarrierDrive, GearContact, InputDerivatives, Inputs, PlanetSpin, SideDrive};
use crate::model::{Parameters, Simulation};

/// Scenes with half-shafts: driven by torques, with one end, and with imposed speeds of the carrier, the spin and a
/// side.
fn scenes() -> Vec<Parameters> {
    let mut parameters = Parameters::default();
    parameters.scene.gear_contact = GearContact::Ideal;
    parameters.scene.carrier_drive = CarrierDrive::Torque;
    parameters.effects.half_shaft = true;
    (parameters.inertia.left_end, parameters.inertia.right_end) = (1.0, 1.5);
    let mut scenes = vec![parameters; 5];
    scenes[1].inertia.right_end = 0.0;
    scenes[2].scene.carrier_drive = CarrierDrive::Speed;
    scenes[3].scene.planet_spin = PlanetSpin::Imposed;
    scenes[4].scene.left_drive = SideDrive::Speed;
    scenes
}

/// Calls `check` with constants, state, inputs and random points of each scene. All inputs have derivatives.
fn at_random_points(check: impl Fn(&IdealWithEffects, &State, &Inputs, &Point<IDEAL_SIZE>)) {
    let mut random = fastrand::Rng::with_seed(7);
    for parameters in scenes() {
        let inputs = Inputs { load_torque: [70.0, -20.0], ..Inputs::default() };
        let rate = Inputs { load_torque: [1e3, 2e3], carrier_speed: 10.0, planet_spin: -4.0, ..Inputs::ZERO };
        let simulation = Simulation::start(&parameters, &inputs, 0.0).unwrap();
        let mut state = *simulation.state();
        state.inputs.derivatives = Some(InputDerivatives { rates: [rate, rate] });
        let model = Model::new(&parameters, &Given::default()).unwrap();
        let Gears::Ideal(ideal) = &model.gears else { panic!("the gears are ideal") };
        for _ in 0..20 {
            let mut at = Point::<IDEAL_SIZE>::ZERO;
            let count = ideal.layout.count();
            at.q[..count].fill_with(|| random.f64() - 0.5);
            at.v[..count].fill_with(|| 100.0 * (random.f64() - 0.5));
            check(ideal, &state, &inputs, &at);
        }
    }
}

#[test]
fn equations_of_only_half_shafts_have_the_bits_of_the_equations_with_any_effects() {
    at_random_points(|ideal, state, inputs, at| {
        let any = IdealWithEffects { linear: None, ..ideal.clone() };
        assert!(ideal.linear.is_some());
        let [only_shafts, any] = [ideal, &any].map(|ideal| IdealEquations::<IDEAL_SIZE>::new(ideal, inputs, state));
        for time in [0.0, 0.02] {
            assert_eq!(only_shafts.evaluate_at(at, time), any.evaluate_at(at, time));
            assert_eq!(only_shafts.accelerate_at(at, time), any.evaluate_at(at, time).0);
            let [one, other] = [&only_shafts, &any].map(|equations| equations.linearise_at(at, time));
            assert_eq!((one.by_position, one.by_velocity), (other.by_position, other.by_velocity));
            assert_eq!((one.acceleration, one.ledger_rates), (other.acceleration, other.ledger_rates));
            assert_eq!(only_shafts.drift(at, time), any.drift(at, time));
        }
        assert_eq!(only_shafts.energy(at), any.energy(at));
    });
}

#[test]
fn derivatives_of_the_accelerations_equal_differences() {
    at_random_points(|ideal, state, inputs, at| {
        let equations = IdealEquations::<IDEAL_SIZE>::new(ideal, inputs, state);
        let lin = equations.linearise(at);
        // the equations are linear, so that differences are exact except for rounding
        for j in 0..ideal.layout.count() {
            let (mut turned, mut faster) = (*at, *at);
            turned.q[j] += 1.0;
            faster.v[j] += 1.0;
            let [a, by_position, by_velocity] = [at, &turned, &faster].map(|at| equations.evaluate(at).0);
            for i in 0..ideal.layout.count() {
                let size = 1e-11 * (1.0 + a[i].abs() + lin.by_position[i][j].abs());
                assert!((by_position[i] - a[i] - lin.by_position[i][j]).abs() < size, "{i} by position {j}");
                assert!((by_velocity[i] - a[i] - lin.by_velocity[i][j]).abs() < size, "{i} by velocity {j}");
            }
        }
    });
}
