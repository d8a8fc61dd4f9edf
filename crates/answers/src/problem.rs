//! Errors in a question as values, so that programs need not parse messages.

use std::fmt;

use bevel_differential::variables::Variable;
use serde::Serialize;

/// One error. The message is complete; the other fields repeat parts of it if they are known.
#[derive(Clone, Debug, Default, PartialEq, Serialize)]
pub struct Problem {
    /// Description of the error, as a sentence.
    pub message: String,
    /// Variable or option.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub variable: Option<String>,
    /// Value as written by the user.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub value: Option<String>,
    /// Unit of the variable and of the range.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub unit: Option<&'static str>,
    /// Minimum and maximum value of the variable.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub range: Option<[f64; 2]>,
    /// Probable intention.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub hint: Option<String>,
}

/// All errors in a question.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Problems(pub Vec<Problem>);

impl Problem {
    /// Creates an error of the variable or option `name` with the value `written`.
    pub fn of(name: &str, written: impl Into<String>, message: impl Into<String>) -> Self {
        let (variable, value) = (Some(name.to_owned()), Some(written.into()));
        Self { variable, value, ..Self::from(message.into()) }
    }

    /// Adds unit and range of `row`.
    pub fn about(mut self, row: &Variable) -> Self {
        self.variable.get_or_insert_with(|| row.name.to_owned());
        self.unit = row.unit.map(|unit| unit.name);
        self.range = row.range.map(|range| [range.min, range.max]);
        self
    }

    /// Puts `prefix` in front of the message.
    pub fn prefixed(mut self, prefix: &str) -> Self {
        self.message = format!("{prefix}{}", self.message);
        self
    }
}

impl From<String> for Problem {
    /// Extracts the hint after "did you mean" from the message.
    fn from(message: String) -> Self {
        let hint = message.split_once("did you mean ").map(|(_, meant)| meant.trim_end_matches([')', '?']).to_owned());
        Self { message, hint, ..Self::default() }
    }
}

impl From<&bevel_differential::problem::Problem> for Problem {
    fn from(found: &bevel_differential::problem::Problem) -> Self {
        let problem = Self { variable: Some(found.variable.to_owned()), ..Self::from(found.to_string()) };
        match bevel_differential::variables::named(found.variable) {
            Some(row) => problem.about(row),
            None => problem,
        }
    }
}

impl fmt::Display for Problem {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.message)
    }
}

impl fmt::Display for Problems {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let lines: Vec<&str> = self.0.iter().map(|problem| problem.message.as_str()).collect();
        f.write_str(&lines.join("\n"))
    }
}

impl std::error::Error for Problems {}

impl From<Problem> for Problems {
    fn from(problem: Problem) -> Self {
        Self(vec![problem])
    }
}

impl Problems {
    /// Adds a problem.
    pub fn push(&mut self, problem: impl Into<Problem>) {
        self.0.push(problem.into());
    }

    /// Adds several problems.
    pub fn extend<T: Into<Problem>>(&mut self, problems: impl IntoIterator<Item = T>) {
        self.0.extend(problems.into_iter().map(Into::into));
    }

    /// Returns `value` if there are no problems.
    pub fn or<T>(self, value: T) -> Result<T, Self> {
        if self.0.is_empty() { Ok(value) } else { Err(self) }
    }
}

/// Creates the error of a question that makes no sense; `what` is the sentence.
pub fn question_error(what: impl Into<String>) -> anyhow::Error {
    Problems::from(Problem::from(what.into())).into()
}
