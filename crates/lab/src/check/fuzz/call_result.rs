//! The result of a random call, and what is known about it.

use bevel_differential::fmi2::Status;

use super::arguments::Flaws;

/// The result of a call.
pub struct CallResult {
    /// Its status.
    pub status: Status,
    /// Numbers that it wrote; looked at only if it was carried out.
    pub numbers: Vec<f64>,
    /// Whether it had to be refused for its arguments.
    pub must_fail: bool,
    /// Bytes of the state that the instance is to be in now.
    pub restored: Option<Vec<u8>>,
    /// What is wrong, seen by the driver already.
    pub broken: Option<String>,
}

impl CallResult {
    /// With `status`, for arguments with `flaws`.
    pub fn of(status: Status, flaws: &Flaws) -> Self {
        Self { status, numbers: Vec::new(), must_fail: flaws.any, restored: None, broken: None }
    }

    /// With the numbers that the call wrote.
    pub fn with(self, numbers: &[f64]) -> Self {
        Self { numbers: numbers.to_vec(), ..self }
    }
}
