//! The angular momentum about the axle changes by the external torques, at each instant and over a run.

use bevel_differential::model::Simulation;

use super::scenes::{Case, driven, imposed};
use crate::angular_momentum::Differential;
use crate::angular_momentum::balance::Tally;

/// Of all terms of an instant: rounding of forces that follow from angles near a radian.
const INSTANT: f64 = 1e-9;

/// Runs a scene and asserts both balances; `look` sees each.
fn run(case: &Case, [begin, stop, step]: [f64; 3]) -> (Differential, Simulation, Tally) {
    let mut simulation = Simulation::start(&case.p, &case.inputs, 0.0).expect("a scene");
    simulation.advance(begin).expect("a step");
    let differential = Differential::of(&simulation);
    let tally = differential.over(&mut simulation, stop, step);
    println!("{}: at worst {:.1e} at an instant, {:.1e} in all", case.name, tally.worst, tally.error());
    assert!(tally.worst < INSTANT, "{}: {:e} at an instant", case.name, tally.worst);
    let allowed = 10.0 * case.p.solver.relative_tolerance;
    assert!(tally.error() < allowed, "{}: {:e} in all", case.name, tally.error());
    (differential, simulation, tally)
}

#[test]
fn momentum_changes_by_the_torques_of_drives_wheels_brakes_and_drag() {
    for case in driven() {
        let (differential, mut simulation, _) = run(&case, [0.0, 0.05, 2e-4]);
        let drive = differential.at(&simulation).drive;
        let reported = simulation.forces().carrier_torque;
        assert!((drive - reported).abs() < 1e-9 * drive.abs(), "{}: {drive} {reported}", case.name);
    }
}

#[test]
fn momentum_changes_by_the_torque_that_teeth_and_washers_demand_of_an_imposed_speed() {
    for case in imposed() {
        // until clutches that stick at first have broken loose
        let (differential, mut simulation, _) = run(&case, [2e-3, 0.05, 2e-4]);
        assert_eq!(simulation.ledger().held, [0.0; 3], "{}", case.name);
        // what the program reports is what its teeth demand
        let demanded = differential.at(&simulation).drive;
        let reported = simulation.forces().carrier_torque;
        assert!((demanded - reported).abs() < INSTANT * demanded.abs(), "{}: {demanded} {reported}", case.name);
    }
}
