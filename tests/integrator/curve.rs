//! Tests of extremes and crossings of quantities within a step.

use bevel_differential::integrate::*;

fn curves() -> Vec<Curve> {
    let mut random = fastrand::Rng::with_seed(1);
    let mut draw = || 2.0 * random.f64() - 1.0;
    let mut all: Vec<Curve> = (0..300)
        .map(|_| Curve { start: draw(), end: draw(), coefficients: [8.0 * draw(), 8.0 * draw(), 8.0 * draw()] })
        .collect();
    // also curves of lower degrees
    all.extend((0..300).map(|i| Curve {
        start: draw(),
        end: draw(),
        coefficients: [if i % 2 == 0 { draw() } else { 0.0 }, if i % 3 == 0 { draw() } else { 0.0 }, 0.0],
    }));
    all
}

fn extremes(curve: &Curve, span: [f64; 2]) -> [f64; 2] {
    let mut extremes = [f64::INFINITY, f64::NEG_INFINITY];
    curve.extend(&mut extremes, span);
    extremes
}

#[test]
fn extremes_agree_with_a_dense_sampling() {
    for curve in curves() {
        for [from, to] in [[0.0, 1.0], [0.3, 0.7], [0.0, 1e-3]] {
            let [least, largest] = extremes(&curve, [from, to]);
            let dense = (0..=2000).map(|k| curve.at(from + (to - from) * f64::from(k) / 2000.0));
            let (low, high) = dense.fold((f64::INFINITY, f64::NEG_INFINITY), |(a, b), x| (a.min(x), b.max(x)));
            assert!(least <= low + 1e-15 && least > low - 2e-5, "{curve:?}: {least} {low}");
            assert!(largest >= high - 1e-15 && largest < high + 2e-5, "{curve:?}: {largest} {high}");
        }
    }
}

#[test]
fn at_a_crossing_the_curve_has_the_value() {
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
        let [least, largest] = extremes(&curve, [0.0, 1.0]);
        assert_eq!(extremes(&negated, [0.0, 1.0]), [-largest, -least]);
    }
}

#[test]
fn earlier_extremes_are_extended_exactly_as_far_as_the_curve_exceeds_them() {
    for curve in curves() {
        let [least, largest] = extremes(&curve, [0.0, 1.0]);
        let range = largest - least;
        // just within an extreme, just beyond it, and far from both
        for inset in [-0.5, -1e-6, 0.0, 1e-6, 0.01, 0.2, 0.5] {
            for before in [[least + inset * range, largest], [least, largest - inset * range]] {
                let mut after = before;
                curve.extend(&mut after, [0.0, 1.0]);
                let expected = [before[0].min(least), before[1].max(largest)];
                assert!(
                    (0..2).all(|i| (after[i] - expected[i]).abs() < 1e-15),
                    "{curve:?}: {after:?}, not {expected:?}"
                );
            }
        }
    }
}
