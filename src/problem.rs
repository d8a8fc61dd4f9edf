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

/// A problem with a variable, described as `format!` takes it.
macro_rules! problem {
    ($variable:expr, $($message:tt)+) => { $crate::problem::Problem::new($variable, format!($($message)+)) };
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
