//! Error of a call: the status to return and the message to log.

use super::Status;

/// Error of a call that was refused, failed, or was carried out only in part.
#[derive(Clone, Debug, PartialEq)]
pub struct CallError {
    /// Status that the call returns.
    pub status: Status,
    /// Message for the log.
    pub message: String,
}

/// Result of a call.
pub type CallResult<T = ()> = Result<T, CallError>;

impl CallError {
    /// Creates the error of a call that returns the status error.
    pub fn error(message: impl Into<String>) -> Self {
        Self { status: Status::Error, message: message.into() }
    }

    /// Creates the error of a call that returns the status discard.
    pub fn discard(message: impl Into<String>) -> Self {
        Self { status: Status::Discard, message: message.into() }
    }

    /// Creates the error of a call that was carried out in part and returns the status warning.
    pub fn warning(message: impl Into<String>) -> Self {
        Self { status: Status::Warning, message: message.into() }
    }
}
