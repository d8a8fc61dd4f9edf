//! Numbers for readers, and statistics of repeated measurements.

/// Numbers below this are shown with a power of ten.
const SMALL: f64 = 1e-3;
/// [`short`] shows numbers from here on with a power of ten.
const LARGE: f64 = 1e7;

/// Formats `value` with `digits` significant digits, or one digit less with a power of ten. Digits before the point are
/// never cut.
pub fn significant(value: f64, digits: u32) -> String {
    if !value.is_finite() {
        return "–".into();
    }
    if value == 0.0 {
        return "0".into();
    }
    if value.abs() < SMALL {
        return format!("{value:.*e}", digits.saturating_sub(2) as usize);
    }
    format!("{value:.*}", decimals(value, digits))
}

/// Formats `value` rounded to `digits` significant digits, without trailing zeros after the point. Digits before the
/// point are kept.
pub fn short(value: f64, digits: u32) -> String {
    if value == 0.0 || !value.is_finite() {
        return format!("{value}");
    }
    if !(SMALL..LARGE).contains(&value.abs()) {
        let text = format!("{value:.*e}", digits.saturating_sub(1) as usize);
        let (mantissa, exponent) = text.split_once('e').unwrap_or((&text, "0"));
        return format!("{}e{exponent}", trimmed(mantissa));
    }
    trimmed(&format!("{value:.*}", decimals(value, digits)))
}

/// Number of decimals for `digits` significant digits.
fn decimals(value: f64, digits: u32) -> usize {
    (f64::from(digits) - 1.0 - value.abs().log10().floor()).max(0.0) as usize
}

fn trimmed(number: &str) -> String {
    if number.contains('.') { number.trim_end_matches('0').trim_end_matches('.').to_owned() } else { number.to_owned() }
}

/// Median and quartiles.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Spread {
    /// Median.
    pub median: f64,
    /// Lower quartile.
    pub low: f64,
    /// Upper quartile.
    pub high: f64,
    /// Number of values.
    pub count: usize,
}

impl Spread {
    /// Spread of `values`; NaN if there are none.
    pub fn of(values: &[f64]) -> Self {
        let mut sorted = values.to_vec();
        sorted.sort_by(f64::total_cmp);
        let at = |part: f64| {
            let Some(last) = sorted.len().checked_sub(1) else { return f64::NAN };
            let place = part * last as f64;
            let (below, rest) = (place.floor() as usize, place.fract());
            sorted[below] + rest * (sorted[(below + 1).min(last)] - sorted[below])
        };
        Self { median: at(0.5), low: at(0.25), high: at(0.75), count: sorted.len() }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn significant_digits_are_kept_and_whole_numbers_are_not_cut() {
        assert_eq!(
            [123.4, 1.234, 0.01234, 1e-5, 0.0, f64::NAN].map(|v| significant(v, 3)),
            ["123", "1.23", "0.0123", "1.0e-5", "0", "–"]
        );
        assert_eq!([123.4, 1.26, 0.123].map(|v| significant(v, 2)), ["123", "1.3", "0.12"]);
    }

    #[test]
    fn short_numbers_have_no_zeros_at_the_end() {
        assert_eq!(
            [835.0, 0.1 + 0.2, -1.234_567_89e-7, 49.933_870_2].map(|v| short(v, 6)),
            ["835", "0.3", "-1.23457e-7", "49.9339"]
        );
        assert_eq!([9.740_282_517, 30.366_763_14, 90.0].map(|v| short(v, 4)), ["9.74", "30.37", "90"]);
    }

    #[test]
    fn quartiles_are_between_the_values_that_they_separate() {
        let spread = Spread::of(&[5.0, 1.0, 2.0, 4.0, 3.0]);
        assert_eq!(spread, Spread { median: 3.0, low: 2.0, high: 4.0, count: 5 });
        assert_eq!(Spread::of(&[1.0, 2.0]).median, 1.5);
        assert!(Spread::of(&[]).median.is_nan());
    }
}
