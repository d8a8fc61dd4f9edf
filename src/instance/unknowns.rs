//! Unknowns of derivatives: outputs named by the host. Their derivatives must be finite.

use super::values::{finite, row, wrong_type};
use super::{CallError, CallResult};
use crate::variables::{Access, OutputSource, Variable};

/// Variable whose derivatives are requested.
pub type Unknown = (&'static Variable, OutputSource);

/// Returns the variables of `references`. Fails if one of them has no derivatives.
pub fn unknowns(references: impl Iterator<Item = u32>) -> CallResult<Vec<Unknown>> {
    references.map(|reference| row(reference).and_then(|row| Ok((row, output_source(row)?)))).collect()
}

/// Returns the derivative of a variable if it is finite.
pub fn finite_slope(row: &Variable, slope: f64) -> CallResult<f64> {
    finite(row, slope).map_err(|error| CallError { message: format!("the derivative of {}", error.message), ..error })
}

/// Ends of the names of outputs that count or number something. They jump, so that their derivatives are 0.
const COUNTS: [&str; 3] = ["_pairs", ".tooth", "_phase"];

/// Returns the source of a variable that has derivatives.
pub fn output_source(row: &Variable) -> CallResult<OutputSource> {
    match row.access {
        Access::Output(_) if COUNTS.iter().any(|end| row.name.ends_with(end)) => {
            Ok(OutputSource::Constant(0, |_, _| 0.0))
        }
        Access::Output(OutputSource::Choice(..)) => Err(wrong_type(row)),
        Access::Output(source) => Ok(source),
        Access::Real(_) | Access::Input(_) => {
            Err(CallError::error(format!("{} is set by the host, so it has no derivative", row.name)))
        }
        _ => Err(wrong_type(row)),
    }
}
