//! Tests of steady temperatures against closed forms and roots found by bisection.

use std::convert::Infallible;

use super::network::{Around, Conductance, Network};
use super::steady::{CycleMeans, Steady};
use super::{CASE, CLUTCH, GEARS, NODES, OIL, WASHERS};

const AMBIENT: f64 = 290.0;
/// Conductances to the oil, by node; 0 for the oil itself [W/K].
const TO_OIL: [f64; NODES] = [0.0, 20.0, 10.0, 5.0, 30.0];
/// Conductance of the case to ambient at 4 rad/s [W/K].
const TO_AMBIENT: f64 = 12.0;
const COLD: f64 = 290.0;
const HOT: f64 = 673.15;

fn network(sump: Option<f64>) -> Network<0> {
    Network {
        capacity: [1800.0, 1500.0, 300.0, 60.0, 5000.0],
        to_oil: TO_OIL.map(|at_rest| Conductance { at_rest, per_speed: 0.0 }),
        // grows to 12 W/K at 4 rad/s
        to_ambient: Conductance { at_rest: 8.0, per_speed: 1.0 },
        around: Around { ambient: AMBIENT, sump },
        shares: [],
    }
}

fn steady(
    network: &Network<0>,
    begin: f64,
    influential: &[usize],
    power: impl Fn(&[f64; NODES]) -> [f64; NODES],
) -> Steady {
    network
        .steady::<Infallible>(begin, influential, |at| Ok(CycleMeans { power: power(at), speed: 4.0 }))
        .unwrap_or(Steady::NotFound)
}

fn assert_near(found: Steady, expected: [f64; NODES], tolerance: f64) {
    let Steady::At(found) = found else { panic!("{found:?} for {expected:?}") };
    for (found, expected) in found.iter().zip(expected) {
        assert!((found - expected).abs() < tolerance, "{found} for {expected}");
    }
}

#[test]
fn given_heats_lead_to_the_sums_of_flows_over_conductances() {
    let power = [10.0, 200.0, 150.0, 8.0, 40.0];
    let case = AMBIENT + power.iter().sum::<f64>() / TO_AMBIENT;
    let oil = case + (power.iter().sum::<f64>() - power[CASE]) / TO_OIL[CASE];
    let above = |node: usize, oil: f64| oil + power[node] / TO_OIL[node];
    let expected = [oil, above(GEARS, oil), above(CLUTCH, oil), above(WASHERS, oil), case];
    for begin in [COLD, HOT] {
        assert_near(steady(&network(None), begin, &[], |_| power), expected, 1e-9);
    }
    // a given sump absorbs all heat that reaches it
    let sump = 350.0;
    let case = (power[CASE] + TO_OIL[CASE] * sump + TO_AMBIENT * AMBIENT) / (TO_OIL[CASE] + TO_AMBIENT);
    let expected = [sump, above(GEARS, sump), above(CLUTCH, sump), above(WASHERS, sump), case];
    assert_near(steady(&network(Some(sump)), COLD, &[], |_| power), expected, 1e-9);
}

/// Oil temperature within a range at which entering and leaving heat are equal, by bisection [K].
fn balance(power: impl Fn(f64) -> f64, [mut from, mut to]: [f64; 2]) -> f64 {
    let resistance = 1.0 / TO_OIL[CASE] + 1.0 / TO_AMBIENT;
    let residual = |oil: f64| power(oil) - (oil - AMBIENT) / resistance;
    let sign = residual(from).signum();
    for _ in 0..200 {
        let middle = 0.5 * (from + to);
        *(if residual(middle).signum() == sign { &mut from } else { &mut to }) = middle;
    }
    from
}

fn in_oil(power: f64) -> [f64; NODES] {
    let mut all = [0.0; NODES];
    all[OIL] = power;
    all
}

/// Checks that heat in the oil leads from `begin` to its balance within `range` [K].
fn assert_balances(begin: f64, range: [f64; 2], heat: impl Fn(f64) -> f64) {
    let oil = balance(&heat, range);
    let case = AMBIENT + heat(oil) / TO_AMBIENT;
    assert_near(steady(&network(None), begin, &[OIL], |at| in_oil(heat(at[OIL]))), [oil, oil, oil, oil, case], 1e-6);
}

#[test]
fn the_drag_of_a_thick_oil_has_one_steady_state() {
    for begin in [COLD, HOT] {
        assert_balances(begin, [AMBIENT, HOT], |oil| 4e3 * (-(oil - 273.0) / 12.0).exp() + 100.0);
    }
}

#[test]
fn friction_that_grows_with_temperature_has_a_cold_and_a_hot_steady_state() {
    for (begin, range) in [(COLD, [AMBIENT, 370.0]), (HOT, [390.0, 600.0])] {
        assert_balances(begin, range, |oil| 200.0 + 1200.0 / (1.0 + (-(oil - 380.0) / 5.0).exp()));
    }
}

#[test]
fn heat_without_a_path_ends_beyond_all_bounds_in_its_node() {
    let mut network = network(None);
    network.to_oil[CLUTCH].at_rest = 0.0;
    let mut power = [0.0; NODES];
    power[CLUTCH] = 50.0;
    assert!(matches!(steady(&network, COLD, &[], |_| power), Steady::Beyond(CLUTCH, _)));
    // without heat, the node keeps its temperature, and the others reach their balance
    assert_near(steady(&network, COLD, &[], |_| [0.0; NODES]), [AMBIENT; NODES], 1e-9);
}
