//! Validation errors: the offending variable, its allowed range, and a hint.

use std::fmt;

/// A validation error with a hint how to resolve it.
#[derive(Clone, Debug, PartialEq)]
pub struct Problem {
    /// Dotted name of the offending variable, for example `geometry.module`.
    pub variable: &'static str,
    /// Description of the error: value, unit, allowed range and, if the cause is known, a hint.
    pub message: String,
}

impl Problem {
    /// Creates a problem with `variable`, described by `message`.
    pub fn new(variable: &'static str, message: impl Into<String>) -> Self {
        Self { variable, message: message.into() }
    }
}

/// Creates a problem with a variable, described in the format of `format!`.
macro_rules! problem {
    ($variable:expr, $($message:tt)+) => { $crate::problem::Problem::new($variable, format!($($message)+)) };
}

impl fmt::Display for Problem {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}: {}", self.variable, self.message)
    }
}

/// Formats two numbers that a message compares, with at least `digits` decimals and enough to distinguish them.
pub fn distinct_texts(pair: [f64; 2], digits: usize) -> [String; 2] {
    let written = |digits: usize| pair.map(|x| format!("{x:.digits$}"));
    (digits..=MOST_DIGITS).map(written).find(|[a, b]| a != b).unwrap_or_else(|| written(digits))
}

/// Maximum number of decimals; doubles of ordinary magnitude contain no more.
const MOST_DIGITS: usize = 17;

/// Joins several problems into one text, one per line.
pub fn list(problems: &[Problem]) -> String {
    problems.iter().map(Problem::to_string).collect::<Vec<_>>().join("\n")
}
