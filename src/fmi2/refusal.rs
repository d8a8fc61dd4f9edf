//! Why a call was not carried out: the status to return and the message to log.

use super::types::Status;

/// A call that was not carried out, or not as asked.
#[derive(Clone, Debug, PartialEq)]
pub struct Refusal {
    /// What the host is told.
    pub status: Status,
    /// What the log is told.
    pub message: String,
}

/// Outcome of a call.
pub type Answer<T = ()> = Result<T, Refusal>;

impl Refusal {
    /// Refused with fmi2Error.
    pub fn error(message: impl Into<String>) -> Self {
        Self { status: Status::Error, message: message.into() }
    }

    /// Refused with fmi2Discard.
    pub fn discard(message: impl Into<String>) -> Self {
        Self { status: Status::Discard, message: message.into() }
    }

    /// Carried out in part: fmi2Warning.
    pub fn warning(message: impl Into<String>) -> Self {
        Self { status: Status::Warning, message: message.into() }
    }
}
