//! Values at the start, in the middle and at the end of an interval, and the parabola through them.

use crate::numeric::{quotient, sqrt};

/// Values of one quantity at the start, in the middle and at the end of an interval.
pub type Three = [f64; 3];

/// Twice the amount by which the straight line exceeds the value in the middle.
pub fn second_difference([begin, middle, end]: Three) -> f64 {
    begin - 2.0 * middle + end
}

/// Value at the turning point of the parabola within the interval, and the fraction of the interval before it, or
/// `None`.
pub fn extremum(values: Three) -> Option<(f64, f64)> {
    let [begin, middle, end] = values;
    let (difference, lean) = (second_difference(values), end - begin);
    // compilers divide before they test, so the divisor must be valid in any case
    let divisor = difference.abs().max(0.5 * lean.abs()).max(f64::MIN_POSITIVE).copysign(difference);
    let top = (middle - lean * lean / (8.0 * divisor), 0.5 - lean / (4.0 * divisor));
    (lean.abs() < 2.0 * difference.abs()).then_some(top)
}

/// Largest value of the parabola, and the fraction of the interval before it.
pub fn crest(values: Three) -> (f64, f64) {
    let ends = if values[0] > values[2] { (values[0], 0.0) } else { (values[2], 1.0) };
    match extremum(values) {
        Some(top) if top.0 > ends.0 => top,
        _ => ends,
    }
}

/// Value of the parabola at the fraction `part` of the interval.
pub fn at([begin, middle, end]: Three, part: f64) -> f64 {
    let bend = 2.0 * second_difference([begin, middle, end]);
    begin + part * (end - begin - bend * (1.0 - part))
}

/// Fraction of the interval, within `span`, at which the parabola reaches `value`. It must be monotonic in the span,
/// and the value between those at both ends.
pub fn reaching(values: Three, value: f64, [from, to]: [f64; 2]) -> f64 {
    // bend t² + slope t + start = 0
    let bend = 2.0 * second_difference(values);
    let (slope, start) = (values[2] - values[0] - bend, values[0] - value);
    let q = -0.5 * (slope + sqrt((slope * slope - 4.0 * bend * start).max(0.0)).copysign(slope));
    let middle = 0.5 * (from + to);
    let nearest = |a: f64, b: f64| if (b - middle).abs() < (a - middle).abs() { b } else { a };
    let part = match [quotient(q, bend), quotient(start, q)] {
        [Some(a), Some(b)] => nearest(a, b),
        [Some(one), None] | [None, Some(one)] => one,
        [None, None] => middle,
    };
    part.clamp(from, to)
}

/// True if all values have the same sign. A load that is 0 or changes its flank has a kink, which no parabola
/// describes.
pub fn is_loaded_throughout(values: Three) -> bool {
    values.iter().all(|&value| value > 0.0) || values.iter().all(|&value| value < 0.0)
}

/// Load at the fraction `part` of the interval: on the parabola, or on straight lines if the load has a kink.
pub fn load_at(values: Three, part: f64) -> f64 {
    let [begin, middle, end] = values;
    if is_loaded_throughout(values) {
        at(values, part)
    } else if part < 0.5 {
        begin + 2.0 * part * (middle - begin)
    } else {
        middle + (2.0 * part - 1.0) * (end - middle)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn of(parabola: impl Fn(f64) -> f64) -> Three {
        [parabola(0.0), parabola(0.5), parabola(1.0)]
    }

    #[test]
    fn turning_points_of_a_parabola_are_found_only_within_the_interval() {
        for sign in [1.0, -1.0] {
            for turning in [0.01, 0.3, 0.5, 0.9] {
                let (value, at) = extremum(of(|t| sign * (2.0 - 3.0 * (t - turning) * (t - turning)))).unwrap();
                assert!((value - sign * 2.0).abs() < 1e-14 && (at - turning).abs() < 1e-14, "{value} {at}");
            }
            for turning in [-0.01, 1.01, 7.0] {
                assert_eq!(extremum(of(|t| sign * (t - turning) * (t - turning))), None);
            }
        }
        assert_eq!((extremum([4.0; 3]), extremum([1.0, 2.0, 3.0])), (None, None));
        assert!((at(of(|t| 2.0 - 3.0 * t * t), 0.3) - 1.73).abs() < 1e-15);
        assert_eq!(crest(of(|t| (t - 0.3) * (t - 0.3))), (0.7 * 0.7, 1.0));
        assert!((crest(of(|t| 1.0 - (t - 0.3) * (t - 0.3))).0 - 1.0).abs() < 1e-15);
    }

    #[test]
    fn a_value_is_reached_on_either_branch_of_a_parabola() {
        for turning in [0.2, 0.5, 0.7] {
            for sign in [1.0, -1.0] {
                let parabola = of(|t| sign * (t - turning) * (t - turning));
                for part in [0.05, 0.3, 0.6, 0.9] {
                    let span = if part < turning { [0.0, turning] } else { [turning, 1.0] };
                    let found = reaching(parabola, sign * (part - turning) * (part - turning), span);
                    assert!((found - part).abs() < 1e-12, "{turning} {part}: {found}");
                }
            }
        }
        for slope in [3.0, -2.0] {
            assert!((reaching(of(|t| 1.0 + slope * t), 1.0 + 0.25 * slope, [0.0, 1.0]) - 0.25).abs() < 1e-15);
        }
        assert_eq!(reaching([1.0; 3], 1.0, [0.0, 1.0]), 0.5);
    }

    #[test]
    fn a_load_with_a_kink_follows_straight_lines() {
        assert_eq!([0.25, 0.75].map(|part| load_at([0.0, 0.0, 8.0], part)), [0.0, 4.0]);
        assert_eq!([0.25, 0.75].map(|part| load_at([-2.0, 2.0, 4.0], part)), [0.0, 3.0]);
        assert!((load_at(of(|t| 1.0 + t * t), 0.25) - 1.0625).abs() < 1e-15);
    }
}
