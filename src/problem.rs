//! Validation errors: the offending variable, its allowed range, and a hint.

use std::fmt;

/// A validation error with a hint what to change.
#[derive(Clone, Debug, PartialEq)]
pub struct Problem {
    /// Dotted name of the offending variable, e.g. `geometry.module`.
    pub variable: &'static str,
    /// The error: value, unit, allowed range and, where the cause is known, a hint.
    pub message: String,
}

impl Problem {
    /// A problem with `variable`, described by `message`.
    pub fn new(variable: &'static str, message: impl Into<String>) -> Self {
        Self { variable, message: message.into() }
    }
}

impl fmt::Display for Problem {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}: {}", self.variable, self.message)
    }
}

/// Two numbers that a message compares, with at least `digits` decimals and as many as it takes to tell them apart.
pub fn told_apart(pair: [f64; 2], digits: usize) -> [String; 2] {
    let written = |digits: usize| pair.map(|x| format!("{x:.digits$}"));
    (digits..=MOST_DIGITS).map(written).find(|[a, b]| a != b).unwrap_or_else(|| written(digits))
}

/// Decimals beyond which doubles of ordinary size hold no more.
const MOST_DIGITS: usize = 17;

/// Several problems in one text, a line each.
pub fn list(problems: &[Problem]) -> String {
    problems.iter().map(Problem::to_string).collect::<Vec<_>>().join("\n")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_that_differ_are_written_until_it_shows() {
        let [a, b] = told_apart([11.1, 11.0999], 2);
        assert_eq!((a.as_str(), b.as_str()), ("11.1000", "11.0999"));
        assert_eq!(told_apart([20.0, 14.15], 2), ["20.00", "14.15"]);
        for bits in [1, 3, 1000] {
            let [a, b] = told_apart([11.1, f64::from_bits(11.1f64.to_bits() + bits)], 2);
            assert_ne!(a, b);
        }
    }

    #[test]
    fn equal_numbers_and_those_that_are_none_stay_short() {
        assert_eq!(told_apart([11.1, 11.1], 2), ["11.10", "11.10"]);
        assert_eq!(told_apart([f64::NAN, f64::NAN], 2), ["NaN", "NaN"]);
        assert_eq!(told_apart([f64::INFINITY, 1.0], 3), ["inf", "1.000"]);
    }
}
