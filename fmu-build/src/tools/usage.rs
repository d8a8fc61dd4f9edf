//! Errors of use: what was asked for makes no sense. The program says so in one line and ends with exit status 2.

use std::fmt;

/// What is wrong with a question.
#[derive(Debug)]
pub struct UsageError(String);

impl fmt::Display for UsageError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.0)
    }
}

impl std::error::Error for UsageError {}

/// The error of use that `what` describes.
pub fn error(what: impl Into<String>) -> anyhow::Error {
    anyhow::Error::new(UsageError(what.into().replace('\n', "; ")))
}

/// `problem` with all its causes, as an error of use.
pub fn of(problem: anyhow::Error) -> anyhow::Error {
    anyhow::Error::new(UsageError(format!("{problem:#}")))
}
