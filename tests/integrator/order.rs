//! Tests of the orders of solution, error estimate and continuous extension, for problems that are not stiff and
//! problems that are.

use bevel_differential::integrate::Point;

use super::methods::{Known, fixed, step, with_every_method};
use super::problems::{Logarithmic, distance, forced, forced_exact};

with_every_method!(
    solution_has_its_theoretical_order
    error_estimate_has_its_theoretical_order
    continuous_extension_has_its_theoretical_order
    order_under_stiff_smooth_forcing_agrees_with_theory
);

/// Asserts that an order measured by halving steps is nearer to the expected order than to its neighbours.
fn assert_order(what: &str, expected: u32, coarse: f64, fine: f64) {
    let order = (coarse / fine).log2();
    println!("{what}: {coarse:e} {fine:e}: order {order:.2}, expected {expected}");
    assert!((order - f64::from(expected)).abs() < 0.5, "{what}: order {order} instead of {expected}");
}

fn solution_has_its_theoretical_order<M: Known>() {
    let error = |count| {
        let end = fixed::<M, 2, _>(&Logarithmic, Logarithmic::exact(0.0), 2.0, count);
        distance(&end, &Logarithmic::exact(2.0))
    };
    assert_order("solution", M::ORDER, error(32), error(64));
}

/// Size of a single step. Its error has an order one higher than the error of a whole integration.
const STEP: f64 = 0.0125;

fn error_estimate_has_its_theoretical_order<M: Known>() {
    let estimate = |h| distance(&step::<M, 2, _>(&Logarithmic, &Logarithmic::exact(0.0), h).error, &Point::ZERO);
    assert_order("estimate", M::METHOD.estimate_order() + 1, estimate(STEP), estimate(STEP / 2.0));
}

fn continuous_extension_has_its_theoretical_order<M: Known>() {
    for fraction in [0.1, 0.5, 0.8] {
        let error = |h| {
            let extension = step::<M, 2, _>(&Logarithmic, &Logarithmic::exact(0.0), h).extension;
            distance(&extension.at(fraction), &Logarithmic::exact(fraction * h))
        };
        assert_order(&format!("after {fraction}"), M::EXTENSION + 1, error(STEP), error(STEP / 2.0));
    }
}

fn order_under_stiff_smooth_forcing_agrees_with_theory<M: Known>() {
    // valid for λh ≫ 1; Radau IIA of s stages: h^s/λ (Hairer & Wanner II, section IV.15)
    let error = |lambda, count| {
        let end = fixed::<M, 2, _>(&forced(lambda), forced_exact(0.0), 1.0, count);
        (end.v[0] - forced_exact(1.0).v[0]).abs()
    };
    assert_order("forced", M::FORCED, error(1e5, 20), error(1e5, 40));
    let stiffer = error(1e5, 20) / error(1e6, 20);
    assert!((stiffer / 10.0 - 1.0).abs() < 0.05, "ten times as stiff, {stiffer} times as accurate");
}
