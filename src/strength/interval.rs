//! Values at the start, in the middle and at the end of an interval, and Simpson's parabola through them.

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
    (lean.abs() < 2.0 * difference.abs())
        .then(|| (middle - lean * lean / (8.0 * difference), 0.5 - lean / (4.0 * difference)))
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

/// Mean of a quantity by Simpson's rule, with each value weighted by the rate at which the interval is passed.
pub fn mean(values: Three, rates: Three) -> f64 {
    let weights = [rates[0].abs(), 4.0 * rates[1].abs(), rates[2].abs()];
    let passed = weights[0] + weights[1] + weights[2];
    let weights = if passed > 0.0 { weights.map(|weight| weight / passed) } else { [1.0 / 6.0, 4.0 / 6.0, 1.0 / 6.0] };
    weights[0] * values[0] + weights[1] * values[1] + weights[2] * values[2]
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
            for place in [0.01, 0.3, 0.5, 0.9] {
                let (value, at) = extremum(of(|t| sign * (2.0 - 3.0 * (t - place) * (t - place)))).unwrap();
                assert!((value - sign * 2.0).abs() < 1e-14 && (at - place).abs() < 1e-14, "{value} {at}");
            }
            for place in [-0.01, 1.01, 7.0] {
                assert_eq!(extremum(of(|t| sign * (t - place) * (t - place))), None);
            }
        }
        assert_eq!((extremum([4.0; 3]), extremum([1.0, 2.0, 3.0])), (None, None));
        assert!((at(of(|t| 2.0 - 3.0 * t * t), 0.3) - 1.73).abs() < 1e-15);
        assert_eq!(crest(of(|t| (t - 0.3) * (t - 0.3))), (0.7 * 0.7, 1.0));
        assert!((crest(of(|t| 1.0 - (t - 0.3) * (t - 0.3))).0 - 1.0).abs() < 1e-15);
    }

    #[test]
    fn a_mean_is_weighted_by_the_rate() {
        // ∫ t² (1 + t) dt / ∫ (1 + t) dt, exact for Simpson's rule
        let mean = mean(of(|t| t * t), of(|t| -1.0 - t));
        assert!((mean - (1.0 / 3.0 + 1.0 / 4.0) / 1.5).abs() < 1e-15);
        assert_eq!(super::mean([6.0, 0.0, 0.0], [0.0; 3]), 1.0);
    }
}
