//! Tests of the smallest energy that the balance of a step resolves.

use super::with_equations;
use crate::integrate::{POSITION_ROUNDING, Point, SecondOrder};
use crate::model::assembly::{Given, Model};
use crate::model::scene::{CarrierDrive, GearContact, Inputs, Start};
use crate::model::{Parameters, Simulation};

/// Factor on the rounding of positions, so that the change of the energy is far above the rounding of the energy
/// itself.
const MAGNIFIED: f64 = 1e6;

/// Wheels on half-shafts, held by brakes against 300 N·m on the carrier.
fn held(contact: GearContact) -> (Parameters, Inputs) {
    let (mut parameters, mut inputs) = (Parameters::default(), Inputs::default());
    parameters.scene.gear_contact = contact;
    parameters.scene.carrier_drive = CarrierDrive::Torque;
    parameters.scene.start = Start::Rest;
    parameters.effects.wheel_brake = true;
    parameters.effects.half_shaft = true;
    parameters.effects.pin_compliance = contact != GearContact::Ideal;
    (parameters.inertia.left_end, parameters.inertia.right_end) = (1.0, 1.0);
    inputs.carrier_torque = 300.0;
    inputs.load_torque = [0.0; 2];
    inputs.brake_torque = [200.0; 2];
    (parameters, inputs)
}

#[test]
fn the_floor_exceeds_the_energy_of_one_rounded_position_by_a_limited_factor() {
    for contact in [GearContact::Ideal, GearContact::Lumped, GearContact::Tooth] {
        let (parameters, inputs) = held(contact);
        let mut simulation = Simulation::start(&parameters, &inputs, 0.0).unwrap();
        simulation.advance(0.05).unwrap();
        let (model, state) = (Model::new(&parameters, &Given::default()).unwrap(), simulation.state());
        let [largest, floor] = with_equations!(&model, state, &inputs, |equations| {
            let at: Point<N> = state.point();
            let stored = |point: &Point<N>| equations.energy(point)[1];
            let mut largest = 0.0f64;
            for i in 0..equations.degrees_of_freedom() {
                for sign in [1.0, -1.0] {
                    let mut shifted = at;
                    shifted.q[i] += sign * MAGNIFIED * POSITION_ROUNDING * at.q[i];
                    largest = largest.max((stored(&shifted) - stored(&at)).abs() / MAGNIFIED);
                }
            }
            [largest, equations.energy_floor([&at, &at], 0.0, 0.0)]
        });
        println!("{contact:?}: shifts change {largest:e} J, floor {floor:e} J");
        assert!(largest > 1e-17 && largest <= floor, "{contact:?}: {largest:e} J, floor {floor:e} J");
        // the floor adds the contributions of all positions, and adds the rounding of the carrier's angle to the
        // roundings of side gears and pins
        assert!(floor < 1e3 * largest, "{contact:?}: {largest:e} J, floor {floor:e} J");
    }
}

#[test]
fn unresolved_speeds_count_only_near_rest() {
    let (parameters, inputs) = held(GearContact::Ideal);
    let mut simulation = Simulation::start(&parameters, &inputs, 0.0).unwrap();
    simulation.advance(0.05).unwrap();
    let (model, state) = (Model::new(&parameters, &Given::default()).unwrap(), simulation.state());
    with_equations!(&model, state, &inputs, |equations| {
        let moving_at = |speed: f64| -> Point<N> { Point { v: [speed; N], ..state.point() } };
        let floor =
            |speed: f64, tolerance: f64| equations.energy_floor([&moving_at(speed), &moving_at(speed)], tolerance, 0.0);
        let (tolerance, still) = (1e-6, floor(0.0, 0.0));
        // the error norm does not resolve speeds below 1e-6 rad/s, so the kinetic energy of all bodies at this speed
        // counts
        let [kinetic, _] = equations.energy(&moving_at(tolerance));
        assert!((floor(0.0, tolerance) - still - kinetic).abs() < 1e-6 * kinetic);
        assert_eq!(floor(5e-4, tolerance), floor(0.0, tolerance));
        // at 2 mrad/s, the tolerance times the kinetic energy exceeds the unresolved energy, so this no longer counts
        assert_eq!(floor(2e-3, tolerance), floor(2e-3, 0.0));
    });
}
