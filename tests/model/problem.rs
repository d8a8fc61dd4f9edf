//! Tests of numbers in messages.

use bevel_differential::problem::*;

#[test]
fn different_numbers_are_written_with_enough_digits_to_differ() {
    let [a, b] = distinct_texts([11.1, 11.0999], 2);
    assert_eq!((a.as_str(), b.as_str()), ("11.1000", "11.0999"));
    assert_eq!(distinct_texts([20.0, 14.15], 2), ["20.00", "14.15"]);
    for bits in [1, 3, 1000] {
        let [a, b] = distinct_texts([11.1, f64::from_bits(11.1f64.to_bits() + bits)], 2);
        assert_ne!(a, b);
    }
}

#[test]
fn equal_numbers_and_numbers_that_are_not_finite_stay_short() {
    assert_eq!(distinct_texts([11.1, 11.1], 2), ["11.10", "11.10"]);
    assert_eq!(distinct_texts([f64::NAN, f64::NAN], 2), ["NaN", "NaN"]);
    assert_eq!(distinct_texts([f64::INFINITY, 1.0], 3), ["inf", "1.000"]);
}
