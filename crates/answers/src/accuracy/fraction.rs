//! Accuracies in the notation of users.

use crate::problem::{Problem, Problems};

/// Finest accuracy that users may request: references are computed ten thousand times finer.
const FINEST: f64 = 1e-6;

/// Parses a fraction: "1%", "1 %" or "0.01".
pub fn fraction(text: &str) -> Result<f64, Problems> {
    let problem = |what: &str| {
        Problems::from(Problem::of("within", text, format!("within {text}: {what}; write it as 1% or 0.01")))
    };
    let trimmed = text.trim();
    let (number, per) = match trimmed.strip_suffix('%') {
        Some(number) => (number.trim_end(), 100.0),
        None => (trimmed, 1.0),
    };
    let value = number.parse::<f64>().map_err(|_| problem("is not a number"))? / per;
    if !value.is_finite() {
        return Err(problem("is not a number"));
    }
    if value < FINEST {
        return Err(problem(if value > 0.0 {
            "must be 1e-6 or more: no model of gears is as accurate as that"
        } else {
            "must be above 0"
        }));
    }
    if value >= 1.0 {
        let meant = if per == 1.0 && value < 100.0 { format!(" (did you mean {number}%?)") } else { String::new() };
        return Err(problem(&format!("must be below 100 %{meant}")));
    }
    Ok(value)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn accuracies_are_percents_or_fractions_below_all_and_above_nothing() {
        for (text, wanted) in [("1%", 0.01), ("1 %", 0.01), (" 0.5%", 0.005), ("0.01", 0.01), ("1e-3", 0.001)] {
            assert_eq!(fraction(text).expect(text), wanted, "{text}");
        }
        for (text, wanted_text) in [
            ("", "not a number"),
            ("%", "not a number"),
            ("one", "not a number"),
            ("nan", "not a number"),
            ("inf%", "not a number"),
            ("1%%", "not a number"),
            ("0", "above 0"),
            ("-1%", "above 0"),
            ("1e-9", "or more"),
            ("100%", "below 100 %"),
            ("200%", "below 100 %"),
            ("1", "did you mean 1%?"),
            ("1e9", "below 100 %"),
        ] {
            let problem = fraction(text).expect_err(text).to_string();
            assert!(problem.contains(wanted_text) && problem.contains("1% or 0.01"), "{text}: {problem}");
        }
    }
}
