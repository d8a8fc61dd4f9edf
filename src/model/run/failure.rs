//! Why a step could not be completed.

use std::fmt;

/// Why a step could not be completed; the simulation stands at the last good time.
#[derive(Clone, Debug, PartialEq)]
pub struct StepFailure {
    /// Last good time [s].
    pub time: f64,
    /// What happened, where, and what may help.
    pub message: String,
}

impl StepFailure {
    /// A step that gave values which are not finite.
    pub fn not_finite(time: f64) -> Self {
        Self { time, message: "the step gave values that are not finite; look at the inputs".into() }
    }

    /// A step whose motion has come to `reached` [s] where it was to come to `until` [s].
    pub fn not_reached(reached: f64, until: f64) -> Self {
        let message =
            format!("the motion did not reach t = {until} s; this is an error of the program, please report it");
        Self { time: reached, message }
    }
}

impl fmt::Display for StepFailure {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "at t = {} s: {}", self.time, self.message)
    }
}
