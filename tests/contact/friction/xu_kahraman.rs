//! The law of Xu and Kahraman, checked against hand calculations.

use bevel_differential::friction::xu_kahraman::*;
use bevel_differential::friction::{Conditions, ToothFrictionSpec};

#[test]
fn value_equals_the_formula_by_hand() {
    // w = π ρ P²/E* for P = 1 GPa, so that the power of the pressure is one; SR = 0.5, ν0 = 10 cP, S = 0.2 µm, R = 10
    // mm
    let modulus = 1.15e11;
    let at = Conditions {
        sliding: 5.0,
        sum_speed: 20.0,
        line_load: 1e18 * std::f64::consts::PI * 0.010 / modulus,
        radius: 0.010,
        modulus,
    };
    // R_q of both flanks is √(π/2)·R_a
    let roughness = 0.2e-6 / 1.253_314_137_315_5;
    let spec = ToothFrictionSpec { oil_viscosity: 0.010, roughness, ..ToothFrictionSpec::default() };
    assert!((at.pressure() / 1e9 - 1.0).abs() < 1e-14);
    // f = −8.916465 − 0.354068·0.5 + 2.812084·e^−0.5 + 0.620305·e^0.2, with e^−0.5 = 0.6065306597, e^0.2 = 1.2214027582
    let f = -8.916465 - 0.177034 + 2.812084 * 0.6065306597126334 + 0.620305 * 1.2214027581601699;
    // logarithms of the powers: ln 0.5 = −ln 2, ln 0.01 = −2 ln 10
    let powers = 1.036077 * -std::f64::consts::LN_2
        + (-0.100601 + 0.752755) * std::f64::consts::LN_10
        + 0.390958 * 2.0 * std::f64::consts::LN_10;
    let by_hand = (f + powers).exp();
    let value = coefficient(&spec, &at);
    assert!((value / by_hand - 1.0).abs() < 1e-12, "{value} {by_hand}");
    assert!((0.017..0.018).contains(&value), "{value}");
    assert_eq!(outside(&spec, &at), None);
    let slow = Conditions { sliding: 0.05, sum_speed: 0.4, ..at };
    assert_eq!(outside(&spec, &slow).unwrap().quantity, "entraining speed V_e");
    let light = Conditions { line_load: 1e4, ..at };
    assert_eq!(outside(&spec, &light).unwrap().quantity, "Hertzian pressure P");
}

#[test]
fn the_ranges_of_the_fit_match_the_thesis() {
    let spec = |rms: f64| ToothFrictionSpec { roughness: rms / 1.253_314_137_315_5, ..ToothFrictionSpec::default() };
    // entraining speed, slide-to-roll ratio, pressure in GPa, radius in mm, rms roughness in µm
    let quantity = |[speed, ratio, pressure, radius, rms]: [f64; 5]| {
        let (radius, modulus) = (radius * 1e-3, 1.15e11);
        let line_load = (pressure * 1e9).powi(2) * std::f64::consts::PI * radius / modulus;
        let at = Conditions { sliding: ratio * speed, sum_speed: 2.0 * speed, line_load, radius, modulus };
        outside(&spec(rms * 1e-6), &at).map(|outside| outside.quantity)
    };
    let usual = [10.0, 0.5, 1.0, 20.0, 0.3];
    assert_eq!(quantity(usual), None);
    for (i, [low, high]) in
        [[1.0, 20.0], [f64::NAN, 1.0], [0.5, 2.5], [5.0, 80.0], [f64::NAN, 0.6]].into_iter().enumerate()
    {
        for (limit, inward) in [(low, 1.01), (high, 0.99)] {
            let at = |value: f64| std::array::from_fn(|k| if k == i { value } else { usual[k] });
            if limit.is_finite() {
                assert_eq!(quantity(at(limit * inward)), None, "{i}: just within {limit}");
                assert!(quantity(at(limit / inward)).is_some(), "{i}: just outside {limit}");
            }
        }
    }
}
