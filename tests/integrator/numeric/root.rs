//! Tests of roots of rising functions.

use std::cell::Cell;

use bevel_differential::numeric::*;

/// Returns the root of `f` and the number of evaluations.
fn root(f: impl Fn(f64) -> [f64; 2], most: f64) -> (Option<f64>, usize) {
    let count = Cell::new(0);
    let counted = |x: f64| {
        count.set(count.get() + 1);
        f(x)
    };
    (rising_root(counted, most, 1e-11), count.get())
}

/// Function d^`n` − 1 of the distance d beyond an initial `play`, and its derivative.
fn after_play(x: f64, play: f64, n: i32) -> [f64; 2] {
    let d = (x - play).max(0.0);
    [d.powi(n) - 1.0, f64::from(n) * d.powi(n - 1)]
}

#[test]
fn roots_of_powers_after_play_are_found_to_rounding_in_few_evaluations() {
    for n in 1..=4 {
        for play in [0.0, 0.3, 50.0] {
            let (found, count) = root(|x| after_play(x, play, n), 100.0);
            let error = found.expect("a root") - (1.0 + play);
            assert!(error.abs() < 4.0 * f64::EPSILON * (1.0 + play), "{n} {play}: {error:e}");
            assert!(count <= if n == 1 { 3 } else { 30 }, "{n} {play}: {count}");
        }
    }
}

#[test]
fn roots_of_steps_and_misleading_slopes_are_bracketed() {
    // a staircase around a rising line, with slopes that differ from the slope of the line
    let staircase = |x: f64| {
        [
            libm::floor(8.0 * x) - 20.0 + 0.1 * bevel_differential::numeric::sin(9.0 * x),
            0.9 * bevel_differential::numeric::cos(9.0 * x),
        ]
    };
    let found = root(staircase, 10.0).0.expect("a root");
    assert!(staircase(found - 1e-9)[0] < 0.0 && staircase(found + 1e-9)[0] > 0.0, "{found}");
    // flat except for a jump
    let (found, _) = root(|x| [if x < 0.7 { -1.0 } else { 1.0 }, 0.0], 1.0);
    assert!((found.expect("a root") - 0.7).abs() < 1e-15);
}

#[test]
fn a_value_that_is_not_reached_has_no_root() {
    assert_eq!(root(|x| [x - 2.0, 1.0], 1.0), (None, 1));
    assert_eq!(root(|_| [f64::NAN; 2], 1.0), (None, 1));
    assert_eq!(root(|x| [x - 2.0, 1.0], 2.0), (Some(2.0), 1));
}
