//! The integrator's own time. It starts near the present, so that a double resolves steps as finely as they can get, and
//! moves with completed steps only, so that these do not depend on when the host looks.

use serde::{Deserialize, Serialize};

use crate::numeric::Finite;

/// Times on the integrator's clock [s].
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Clock {
    /// End of the last completed step.
    pub time: f64,
    /// The present, or the time to integrate to.
    pub now: f64,
    /// When the equations end: a tooth breaks, or inputs change.
    pub end: f64,
    /// When inputs are expected to change.
    pub expected: f64,
}

impl Clock {
    /// A clock that starts now.
    pub fn new(end: f64, expected: f64) -> Self {
        Self { time: 0.0, now: 0.0, end, expected }
    }

    /// Starts anew at the end of the last completed step. Returns by how much it is set back.
    pub fn set_back(&mut self) -> f64 {
        let by = self.time;
        *self = Self { time: 0.0, now: self.now - by, end: self.end - by, expected: self.expected - by };
        by
    }

    /// Whether no time is missing; the end and what is expected may never come.
    pub fn is_valid(&self) -> bool {
        let Self { time, now, end, expected } = *self;
        [time, now].is_finite() && now >= time && !(end + expected).is_nan()
    }
}
