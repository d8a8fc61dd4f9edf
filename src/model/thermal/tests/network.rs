//! Tests of the thermal network against closed forms and solutions of its linear system.

use nalgebra::{SMatrix, SVector};

use super::network::{Around, Conductance, Network};
use super::{CASE, CLUTCH, GEARS, NODES, OIL, Thermal, WASHERS};

const START: f64 = 300.0;
const AROUND: Around = Around { ambient: 280.0, sump: None };

fn network(conductances: [f64; NODES], to_ambient: f64) -> Network<2> {
    let mut shares = [[0.0; NODES]; 2];
    shares[0][CLUTCH] = 1.0;
    (shares[1][GEARS], shares[1][OIL]) = (0.7, 0.3);
    Network {
        capacity: [1800.0, 1500.0, 300.0, 60.0, 5000.0],
        to_oil: conductances.map(|at_rest| Conductance { at_rest, per_speed: 0.0 }),
        to_ambient: Conductance { at_rest: to_ambient, per_speed: 0.0 },
        around: AROUND,
        shares,
    }
}

/// Runs the network for `time` [s] in steps of `h` [s] with the heat rates `power` [W].
fn run(network: &Network<2>, power: [f64; 2], time: f64, h: f64) -> Thermal {
    let mut thermal = Thermal::uniform(START);
    for k in 1..=(time / h).round() as usize {
        let heat = power.map(|power| power * k as f64 * h);
        network.advance(&mut thermal, &heat, h, (0.0, [network.around; 2]));
    }
    thermal
}

#[test]
fn a_pack_without_a_path_for_heat_warms_by_heat_over_capacity() {
    let network = network([0.0; NODES], 0.0);
    for h in [1e-3, 0.1, 1.0] {
        let thermal = run(&network, [2000.0, 0.0], 20.0, h);
        let expected = START + 2000.0 * 20.0 / 300.0;
        assert!((thermal.temperatures()[CLUTCH] / expected - 1.0).abs() < 1e-10);
        assert!([OIL, GEARS, WASHERS, CASE].iter().all(|&i| thermal.temperatures()[i] == START));
    }
}

#[test]
fn a_long_run_ends_at_the_solution_of_the_linear_system() {
    let (to_oil, to_ambient, power) = ([0.0, 20.0, 10.0, 5.0, 30.0], 12.0, [150.0, 400.0]);
    let network = network(to_oil, to_ambient);
    let mut matrix = SMatrix::<f64, NODES, NODES>::zeros();
    let mut right = SVector::<f64, NODES>::zeros();
    for i in GEARS..=CASE {
        for (row, sign) in [(i, 1.0), (OIL, -1.0)] {
            matrix[(row, i)] += sign * to_oil[i];
            matrix[(row, OIL)] -= sign * to_oil[i];
        }
    }
    matrix[(CASE, CASE)] += to_ambient;
    (right[CASE], right[CLUTCH], right[GEARS], right[OIL]) =
        (to_ambient * 280.0, power[0], 0.7 * power[1], 0.3 * power[1]);
    let expected = matrix.lu().solve(&right).unwrap();
    let thermal = run(&network, power, 2e5, 1.0);
    for i in 0..NODES {
        assert!((thermal.temperatures()[i] / expected[i] - 1.0).abs() < 1e-9, "{i}: {:?}", thermal.temperatures());
    }
}

#[test]
fn no_heat_is_lost_whether_the_sump_is_free_or_given() {
    for sump in [None, Some(350.0)] {
        let network = Network { around: Around { sump, ..AROUND }, ..network([0.0, 20.0, 10.0, 5.0, 30.0], 12.0) };
        let thermal = run(&network, [150.0, 400.0], 500.0, 0.37);
        let entered = thermal.entered.iter().sum::<f64>();
        let off = entered - network.stored(&thermal) - thermal.given_off;
        assert!((off / entered).abs() < 1e-10, "{off} J of {entered} J");
    }
}

#[test]
fn a_node_cools_exponentially_if_the_sump_is_given() {
    let network =
        Network { around: Around { sump: Some(START), ..AROUND }, ..network([0.0, 0.0, 10.0, 0.0, 0.0], 0.0) };
    let mut thermal = Thermal::uniform(START);
    thermal.rises[CLUTCH] = 100.0;
    for _ in 0..600 {
        network.advance(&mut thermal, &[0.0; 2], 0.1, (0.0, [network.around; 2]));
    }
    // 60 s at a time constant of 30 s
    let expected = START + 100.0 * (-2.0_f64).exp();
    assert!((thermal.temperatures()[CLUTCH] - expected).abs() < 1e-3, "{}", thermal.temperatures()[CLUTCH]);
}

#[test]
fn steps_that_a_burst_of_heat_has_shortened_grow_again() {
    let network = network([0.0, 0.0, 10.0, 0.0, 0.0], 0.0);
    let mut thermal = Thermal::uniform(START);
    // a blow: 1 J within a microsecond; at this rate, half a kelvin takes 0.5 K · 300 J/K / 1 MW
    network.advance(&mut thermal, &[1.0, 0.0], 1e-6, (0.0, [AROUND; 2]));
    assert!(thermal.is_update_due());
    thermal.use_temperatures();
    assert!((thermal.longest / 150e-6 - 1.0).abs() < 1e-6, "{}", thermal.longest);
    // no heat after the blow
    network.advance(&mut thermal, &[1.0, 0.0], 1e-6, (0.0, [AROUND; 2]));
    assert!(!thermal.is_update_due(), "a short step says nothing about a long one");
    network.advance(&mut thermal, &[1.0, 0.0], 140e-6, (0.0, [AROUND; 2]));
    assert!(thermal.is_update_due());
    thermal.use_temperatures();
    assert!(thermal.longest > 100.0, "{}", thermal.longest);
}

#[test]
fn changing_outside_temperatures_are_followed_and_no_heat_is_lost() {
    // a sump that swings between two temperatures and an ambient that falls, with all nodes connected
    let network =
        Network { around: Around { sump: Some(320.0), ..AROUND }, ..network([0.0, 20.0, 10.0, 5.0, 30.0], 12.0) };
    let mut thermal = Thermal::uniform(START);
    for k in 1..=2000 {
        let time = 0.37 * f64::from(k);
        let around = network.around.changed([-0.01 * time, 30.0 * (0.05 * time).sin()]);
        network.advance(&mut thermal, &[150.0 * time, 400.0 * time], 0.37, (0.0, [around; 2]));
        assert!((thermal.temperatures()[OIL] - 320.0 - 30.0 * (0.05 * time).sin()).abs() < 1e-9);
    }
    let entered = thermal.entered.iter().sum::<f64>();
    let off = entered - network.stored(&thermal) - thermal.given_off;
    assert!((off / entered).abs() < 1e-10, "{off} J of {entered} J");
}

#[test]
fn a_case_follows_an_oscillating_ambient_with_delay_and_smaller_amplitude() {
    // C θ̇ = G (θ_a − θ): amplitude 1/√(1 + (ω C/G)²), here with ω C/G = 1
    let network = network([0.0; NODES], 10.0);
    let (rate, amplitude, h) = (10.0 / 5000.0, 20.0, 5.0);
    let mut thermal = Thermal::uniform(280.0);
    let mut largest = 0.0_f64;
    for k in 0..4000 {
        let around = network.around.changed([amplitude * (rate * h * (f64::from(k) + 0.5)).sin(), 0.0]);
        network.advance(&mut thermal, &[0.0; 2], h, (0.0, [around; 2]));
        if k > 2000 {
            largest = largest.max(thermal.temperatures()[CASE] - 280.0);
        }
    }
    assert!((largest / (amplitude / 2.0_f64.sqrt()) - 1.0).abs() < 1e-4, "{largest}");
}

#[test]
fn outside_temperatures_stay_within_the_range_of_the_friction_laws() {
    let around = Around { ambient: 280.0, sump: Some(400.0) };
    assert_eq!(around.changed([-500.0, 500.0]), Around { ambient: 213.15, sump: Some(673.15) });
    assert_eq!(around.changed([0.0, 0.0]), around);
}
