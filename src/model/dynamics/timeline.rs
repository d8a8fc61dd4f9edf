//! Timeline of a simulation. It contains the present and finds the next stop. Something happens at these times:
//!
//! - the time requested by the host, such as a communication point or a point of a table,
//! - a change of the equations that the host does not cause: the onset of the tooth fault,
//! - the end of a long interval, at which the integrator's clock is reset,
//! - the expected next change of the inputs, after they have been constant for as long as before.
//!
//! A stop is the earliest of the first three. Steps are only fitted to the expected change; they may go beyond it.
//! Switches of friction and kinks of forces are within steps, where the integrator locates them (`integrate::driver`).

use serde::{Deserialize, Serialize};

use crate::numeric::{Finite, finite};

/// Longest interval before positions are wrapped and the integrator's clock is reset [s].
pub const LONGEST_INTERVAL: f64 = 1.0;
/// Relative allowance for rounding in the time for which inputs are expected to be constant. Hosts add up their steps.
const ROUNDING: f64 = 1e-6;
/// Number of rounded operations on times between two stops.
const ROUNDED_OPERATIONS: f64 = 8.0;

/// Times of a simulation.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Timeline {
    /// Present time [s].
    pub now: f64,
    /// Start of the present interval of constant inputs [s]: the communication point at which the integration last
    /// restarted or torques last changed. `None` before the first start.
    pub constant_since: Option<f64>,
    /// Length of the previous interval of constant inputs [s]; infinite if there was none.
    pub constant_before: f64,
    /// Last communication point, if the motion has paused since, or if a step has begun under the present inputs.
    pub pause: Option<CommunicationPoint>,
}

/// Communication point. The remaining interval counts from it, so a pause does not change rounding.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct CommunicationPoint {
    /// Time on the integrator's clock [s].
    pub clock: f64,
    /// Simulation time [s].
    pub time: f64,
}

finite!(CommunicationPoint { clock, time });

/// Times on the integrator's clock [s]. The clock starts near the present, so that a double resolves even the shortest
/// steps.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Clock {
    /// End of the last completed step.
    pub time: f64,
    /// Present time, or the target time of an integration.
    pub now: f64,
    /// Time up to which the present equations are valid, because a tooth breaks or inputs change then.
    pub end: f64,
    /// Time at which inputs are expected to change.
    pub expected: f64,
}

/// Stop of an integration.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Stop {
    /// Time of the stop [s].
    pub time: f64,
    /// True if the equations change at the stop.
    pub is_change: bool,
}

impl Timeline {
    /// Timeline that starts at `now` [s].
    pub fn new(now: f64) -> Self {
        Self { now, constant_since: None, constant_before: f64::INFINITY, pause: None }
    }

    /// True if `time` [s] has been reached, within the rounding of times.
    pub fn has_reached(&self, time: f64) -> bool {
        self.now + resolution(time) >= time
    }

    /// Next stop up to `until` [s]. `change` is the time of the next change of the equations [s], if there is one.
    pub fn next_stop(&self, change: Option<f64>, until: f64) -> Stop {
        let is_far = until - self.now > 1.5 * LONGEST_INTERVAL;
        let time = if is_far { self.now + LONGEST_INTERVAL } else { until };
        match change {
            // a communication point that differs from the change only by rounding counts as the change
            Some(change) if (change - time).abs() <= resolution(change) => Stop { time, is_change: true },
            Some(change) if change < time => Stop { time: change, is_change: true },
            _ => Stop { time, is_change: false },
        }
    }

    /// Ends the pause, if the motion has paused, and starts an interval of constant inputs at the present, because inputs
    /// or something else have changed. A further change at the same time does not start another interval. A change at a
    /// pause within a communication step does not either. The host may react to the end of each solver step, and a step
    /// that is fitted to the length of the last one never becomes longer.
    pub fn begin_constant_inputs(&mut self) {
        let is_within_step = self.pause.take().is_some();
        if !is_within_step && self.constant_since != Some(self.now) {
            self.constant_before = self.constant_since.map_or(f64::INFINITY, |since| self.now - since);
            self.constant_since = Some(self.now);
        }
    }

    /// Remaining time for which inputs are expected to be constant [s].
    pub fn expected(&self) -> f64 {
        let left = self.constant_before - self.constant_since.map_or(0.0, |since| self.now - since);
        left * (1.0 + ROUNDING)
    }

    /// Last communication point, given that `clock` shows the present.
    #[inline]
    pub fn last_communication_point(&self, clock: &Clock) -> CommunicationPoint {
        self.pause.unwrap_or(CommunicationPoint { clock: clock.now, time: self.now })
    }

    /// Moves the present to `until` [s] if `reached` [s] differs from it only by rounding, otherwise to `reached`.
    /// Returns true if the present is `until`.
    pub fn arrive(&mut self, until: f64, reached: f64) -> bool {
        let has_arrived = (until - reached).abs() <= resolution(until);
        self.now = if has_arrived { until } else { reached };
        has_arrived
    }

    /// True if all times are valid. The pause is not checked.
    pub fn is_valid(&self) -> bool {
        Finite::is_finite(&self.now) && self.constant_before >= 0.0 && Finite::is_finite(&self.constant_since)
    }
}

/// Smallest distinguishable difference of times near `time` [s].
pub fn resolution(time: f64) -> f64 {
    ROUNDED_OPERATIONS * f64::EPSILON * time.abs().max(LONGEST_INTERVAL)
}

impl Clock {
    /// Clock that starts now.
    pub fn new(end: f64, expected: f64) -> Self {
        Self { time: 0.0, now: 0.0, end, expected }
    }

    /// Resets the clock to zero at the end of the last completed step. Returns the shift [s].
    pub fn set_back(&mut self) -> f64 {
        let by = self.time;
        *self = Self { time: 0.0, now: self.now - by, end: self.end - by, expected: self.expected - by };
        by
    }

    /// True if all times are valid. The end and the expected change may be infinite.
    pub fn is_valid(&self) -> bool {
        let Self { time, now, end, expected } = *self;
        [time, now].is_finite() && now >= time && !(end + expected).is_nan()
    }
}
