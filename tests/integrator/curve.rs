//! Curves of quantities within a step: extremes and crossings.

use bevel_differential::integrate::*;

fn curves() -> Vec<Curve> {
    let mut seed = 1u64;
    let mut draw = || {
        seed = seed.wrapping_mul(6364136223846793005).wrapping_add(1442695040888963407);
        (seed >> 11) as f64 / (1u64 << 52) as f64 - 1.0
    };
    let mut all: Vec<Curve> = (0..300)
        .map(|_| Curve { start: draw(), end: draw(), coefficients: [8.0 * draw(), 8.0 * draw(), 8.0 * draw()] })
        .collect();
    // of lower degrees too
    all.extend((0..300).map(|i| Curve {
        start: draw(),
        end: draw(),
        coefficients: [if i % 2 == 0 { draw() } else { 0.0 }, if i % 3 == 0 { draw() } else { 0.0 }, 0.0],
    }));
    all
}

#[test]
fn extremes_are_those_of_a_dense_recording() {
    for curve in curves() {
        for [from, to] in [[0.0, 1.0], [0.3, 0.7], [0.0, 1e-3]] {
            let (mut least, mut largest) = (f64::INFINITY, f64::NEG_INFINITY);
            curve.visit_extremes([from, to], |x| (least, largest) = (least.min(x), largest.max(x)));
            let dense = (0..=2000).map(|k| curve.at(from + (to - from) * f64::from(k) / 2000.0));
            let (low, high) = dense.fold((f64::INFINITY, f64::NEG_INFINITY), |(a, b), x| (a.min(x), b.max(x)));
            assert!(least <= low + 1e-15 && least > low - 2e-5, "{curve:?}: {least} {low}");
            assert!(largest >= high - 1e-15 && largest < high + 2e-5, "{curve:?}: {largest} {high}");
        }
    }
}

#[test]
fn a_crossing_is_where_the_curve_takes_the_value() {
    for curve in curves() {
        let middle = 0.5 * (curve.start + curve.end);
        let at = curve.crossing(middle, [0.0, 1.0]);
        assert!((curve.at(at) - middle).abs() < 1e-13, "{curve:?}");
    }
}

#[test]
fn negated_curves_have_negated_extremes_to_the_last_bit() {
    for curve in curves() {
        let negated = Curve { start: -curve.start, end: -curve.end, coefficients: curve.coefficients.map(|b| -b) };
        let [mut one, mut other] = [Vec::new(), Vec::new()];
        curve.visit_extremes([0.0, 1.0], |x| one.push(x));
        negated.visit_extremes([0.0, 1.0], |x| other.push(-x));
        assert_eq!(one, other);
    }
}
