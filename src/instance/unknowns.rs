//! Unknowns of derivatives: outputs named by the host. Their derivatives must be finite.

use super::values::{finite, row, wrong_type};
use super::{CallError, CallResult};
use crate::variables::{Access, OutputSource, Variable};

/// Variables whose derivatives are requested.
pub struct Unknowns(pub Vec<(&'static Variable, OutputSource)>);

impl Unknowns {
    /// Returns the variables of `references`. Fails if one of them has no derivatives.
    pub fn of(references: impl Iterator<Item = u32>) -> CallResult<Self> {
        references
            .map(|reference| row(reference).and_then(|row| Ok((row, output_source(row)?))))
            .collect::<CallResult<_>>()
            .map(Self)
    }
}

/// Returns the derivative of a variable if it is finite.
pub fn finite_slope(row: &Variable, slope: f64) -> CallResult<f64> {
    finite(row, slope).map_err(|error| CallError { message: format!("the derivative of {}", error.message), ..error })
}

/// Returns the source of a variable that has derivatives.
pub fn output_source(row: &Variable) -> CallResult<OutputSource> {
    match row.access {
        Access::Output(OutputSource::Choice(..)) => Err(wrong_type(row)),
        Access::Output(source) => Ok(source),
        Access::Real(_) | Access::Input(_) => {
            Err(CallError::error(format!("{} is set by the host, so it has no derivative", row.name)))
        }
        _ => Err(wrong_type(row)),
    }
}
