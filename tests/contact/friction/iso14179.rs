//! The law of ISO/TR 14179, checked against hand calculations.

use bevel_differential::friction::iso14179::*;
use bevel_differential::friction::{Conditions, ToothFrictionSpec};

const AT: Conditions<f64> =
    Conditions { sliding: 1.0, sum_speed: 4.0, line_load: 320e3, radius: 0.010, modulus: 1.15e11 };

#[test]
fn value_equals_the_formula_by_hand() {
    // 320/(4·10) = 8, 8^0.2 = 2^0.6 = 1.515716567; 16^−0.05 = 2^−0.2 = 0.870550563; 0.0625^0.25 = 0.5; X_L = 0.8
    let spec = ToothFrictionSpec {
        oil_viscosity: 0.016,
        roughness: 0.0625e-6,
        lubricant_factor: 0.8,
        ..ToothFrictionSpec::default()
    };
    let by_hand = 0.048 * 1.515716566510398 * 0.870550563296124 * 0.5 * 0.8;
    assert!((coefficient(&spec, &AT) / by_hand - 1.0).abs() < 1e-12);
}

#[test]
fn small_loads_count_as_150_newton_per_millimetre_and_are_reported() {
    let spec = ToothFrictionSpec::default();
    let at = |line_load| Conditions { line_load, ..AT };
    assert_eq!(coefficient(&spec, &at(1e4)), coefficient(&spec, &at(1.2e5)));
    assert_eq!((outside(&AT), outside(&at(1e4)).unwrap().quantity), (None, "line load w"));
    let fast = Conditions { sum_speed: 40.0, ..AT };
    assert_eq!(outside(&fast).unwrap().quantity, "sum speed v_Σ");
    assert_eq!(coefficient(&spec, &fast), coefficient(&spec, &Conditions { sum_speed: 90.0, ..AT }));
}

#[test]
fn the_minimum_load_matches_the_report() {
    // w ≥ 150 N/mm: one per cent inside and outside
    assert_eq!(outside(&Conditions { line_load: 151.5e3, ..AT }), None);
    assert!(outside(&Conditions { line_load: 148.5e3, ..AT }).is_some());
}
