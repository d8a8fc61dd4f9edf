//! The law of Benedict and Kelley, checked against hand calculations.

use bevel_differential::friction::benedict_kelley::*;
use bevel_differential::friction::{Conditions, ToothFrictionSpec};

fn spec() -> ToothFrictionSpec {
    ToothFrictionSpec { oil_viscosity: 0.010, roughness: 0.5e-6, ..ToothFrictionSpec::default() }
}

const AT: Conditions<f64> =
    Conditions { sliding: 2.0, sum_speed: 8.0, line_load: 400e3, radius: 0.01, modulus: 1.15e11 };

#[test]
fn value_equals_the_formula_by_hand() {
    // 29700 · 400/(10 · 2 · 64) = 9281.25, log10 = 3.967606475; 1.13/0.63 = 1.793650794; times 0.0127
    let by_hand = 0.0127 * 1.793650793650794 * 3.967606473;
    assert!((coefficient(&spec(), &AT) - by_hand).abs() < 1e-9, "{} {by_hand}", coefficient(&spec(), &AT));
}

#[test]
fn original_inch_units_give_the_same_within_their_rounding() {
    let (w, vs, vr): (f64, f64, f64) = (400.0 * 25.4 / 4.4482216, 2.0 / 0.0254, 8.0 / 0.0254);
    // ratio of rms to arithmetic mean roughness, as implied by the two forms of the factor
    let s: f64 = 0.5 / 0.0254 * (1.27 / 1.13);
    let original = 0.0127 * 50.0 / (50.0 - s) * (3.17e8 * w / (10.0 * vs * vr * vr)).log10();
    assert!((coefficient(&spec(), &AT) / original - 1.0).abs() < 3e-4);
}

#[test]
fn full_films_and_rough_flanks_are_reported() {
    assert_eq!(outside(&spec(), &AT), None);
    let fast = Conditions { sliding: 30.0, sum_speed: 60.0, line_load: 1e4, ..AT };
    assert_eq!(coefficient(&spec(), &fast), 0.0127 * (1.13 / (1.13 - 0.5)));
    assert!(outside(&spec(), &fast).is_some());
    let rough = ToothFrictionSpec { roughness: 0.8e-6, ..spec() };
    assert!(outside(&rough, &AT).unwrap().to_string().contains("R_a of 0.8000 µm is outside"));
}
