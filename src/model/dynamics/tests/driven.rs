//! Tests of inputs that change with time: the parabola that they add equals the equations at the inputs of each time.

use super::shape::{Any, FEW_SIZE, MAX_SIZE, PLAIN_SIZE, PlainDriven, Shape, WithEffects, WithEnds, WithPinion};
use super::{Equations, FrictionEquations};
use crate::integrate::{Point, SecondOrder};
use crate::model::assembly::{Gears, Given, Model};
use crate::model::scene::{CarrierDrive, InputDerivatives, Inputs, PlanetSpin};
use crate::model::{Parameters, Simulation};

/// First and second derivatives of every torque and imposed speed.
fn derivatives() -> InputDerivatives {
    let rates = |scale: f64| Inputs {
        carrier_speed: 3.0 * scale,
        carrier_torque: -2e3 * scale,
        pinion_speed: 20.0 * scale,
        pinion_torque: -500.0 * scale,
        load_torque: [1e3 * scale, -4e3 * scale],
        planet_spin: 5.0 * scale,
        ..Inputs::ZERO
    };
    InputDerivatives { rates: [rates(1.0), rates(-7.0)] }
}

/// Largest relative difference of accelerations and input power between the parabola, in the shape `S`, and the
/// equations at the inputs of each time.
fn difference<const N: usize, S: Shape<N>>(parameters: &Parameters) -> f64 {
    let inputs = Inputs::default();
    let mut simulation = Simulation::start(parameters, &inputs, 0.0).unwrap();
    simulation.advance(0.002).unwrap();
    simulation.set_input_derivatives(Some(derivatives()));
    let model = Model::new(parameters, &Given::default()).unwrap();
    let Gears::Teeth(teeth) = &model.gears else { panic!("teeth") };
    let state = simulation.state();
    let equations = Equations::<S, N>::new(teeth, &inputs, state);
    assert!(equations.is_driven() && !equations.scales_by_inputs());
    let whole = Equations::<Any, MAX_SIZE>::new(teeth, &inputs, state);
    let mut largest = 0.0f64;
    for time in [0.0, 3e-4, 0.02] {
        let at: Point<N> = state.point();
        let (accelerations, rates) = equations.evaluate_at(&at, time);
        let (expected, expected_rates) = whole.later(time).evaluate(&state.point());
        let scale = expected.iter().fold(1.0f64, |scale, a| scale.max(a.abs()));
        for (a, b) in accelerations.iter().zip(&expected) {
            largest = largest.max((a - b).abs() / scale);
        }
        largest = largest.max((rates.input - expected_rates.input).abs() / expected_rates.input.abs());
        // the derivative with respect to time, by differences of the equations
        let step = 1e-6;
        let slope = equations.drift(&at, time);
        let ends = [time - step, time + step].map(|time| whole.later(time).evaluate(&state.point()).0);
        for i in 0..N {
            let by_difference = (ends[1][i] - ends[0][i]) / (2.0 * step);
            assert!(
                (slope[i] - by_difference).abs() <= 1e-5 * scale / step.sqrt(),
                "{i}: {} {by_difference}",
                slope[i]
            );
        }
    }
    largest
}

#[test]
fn a_parabola_of_time_equals_the_equations_at_the_inputs_of_each_time() {
    for (drive, spin) in [
        (CarrierDrive::Speed, PlanetSpin::Free),
        (CarrierDrive::Speed, PlanetSpin::Imposed),
        (CarrierDrive::Torque, PlanetSpin::Free),
        (CarrierDrive::Torque, PlanetSpin::Imposed),
    ] {
        let mut parameters = Parameters::default();
        (parameters.scene.carrier_drive, parameters.scene.planet_spin) = (drive, spin);
        let plain = difference::<PLAIN_SIZE, PlainDriven>(&parameters);
        assert!(plain < 1e-12, "plain teeth, {drive:?}, {spin:?}: {plain:e}");
        let any = difference::<MAX_SIZE, Any>(&parameters);
        assert!(any < 1e-12, "any shape, {drive:?}, {spin:?}: {any:e}");
        parameters.effects.tooth_friction = true;
        let effects = difference::<PLAIN_SIZE, WithEffects<1>>(&parameters);
        assert!(effects < 1e-12, "with friction, {drive:?}, {spin:?}: {effects:e}");
        parameters.effects.half_shaft = true;
        (parameters.inertia.left_end, parameters.inertia.right_end) = (0.3, 0.7);
        let ends = difference::<FEW_SIZE, WithEnds>(&parameters);
        assert!(ends < 1e-12, "with half-shafts, {drive:?}, {spin:?}: {ends:e}");
        (parameters.effects.half_shaft, parameters.effects.final_drive) = (false, true);
        (parameters.specs.final_drive.elastic_mesh, parameters.inertia.pinion) = (true, 0.003);
        for shaft in [false, true] {
            parameters.effects.propeller_shaft = shaft;
            let pinion = difference::<FEW_SIZE, WithPinion>(&parameters);
            assert!(pinion < 1e-12, "with a pinion, {drive:?}, {spin:?}, shaft {shaft}: {pinion:e}");
        }
    }
}
