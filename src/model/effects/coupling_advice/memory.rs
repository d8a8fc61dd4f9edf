//! Time over which sums decay, from the oscillation of the host's values.
//!
//! A value changes side when it deviates from its mean by more than half its standard deviation, to the side opposite
//! to the last deviation. Two intervals between such changes are a period. A slow motion lasts until the next change.

use serde::{Deserialize, Serialize};

use crate::numeric::finite;

/// Ratio of the time over which sums decay to the period.
const PERIODS: f64 = 2.0;
/// Number of steps that sums remember at least.
pub const LEAST_STEPS: f64 = 50.0;
/// Square of the deviation, relative to the variance, at which a value changes side.
const SIDE: f64 = 0.25;

/// Oscillation of one value. Positive and negative deviations are treated identically.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Oscillation {
    /// Sum of the weights of all steps, mean of the value, and the sum of its squared deviations. They decay over the
    /// last two periods, so that the mean soon follows a jump.
    weight: f64,
    mean: f64,
    deviations: f64,
    /// Side on which the value deviated last: −1, 1, or 0 before the first deviation.
    side: f64,
    /// Time since the last change of sides, and the two intervals before it [s].
    since: f64,
    intervals: [f64; 2],
}

finite!(Oscillation { weight, mean, deviations, side, since, intervals });

impl Oscillation {
    /// Adds `value`, which acted for `h` [s]. Returns true if the value has changed sides.
    #[inline]
    pub fn add(&mut self, value: f64, h: f64) -> bool {
        let recent = (PERIODS * (self.intervals[0] + self.intervals[1])).max(LEAST_STEPS * h);
        let decay = recent / (recent + h);
        self.weight = decay * self.weight + 1.0;
        let share = 1.0 / self.weight;
        let deviation = value - self.mean;
        // a constant value
        if deviation == 0.0 && self.deviations == 0.0 {
            self.since += h;
            return false;
        }
        self.mean += share * deviation;
        self.deviations = decay * self.deviations + (1.0 - share) * deviation * deviation;
        self.since += h;
        let is_far = self.deviations > 0.0 && deviation * deviation > SIDE * share * self.deviations;
        if !is_far || deviation * self.side > 0.0 {
            return false;
        }
        let changes = self.side != 0.0;
        self.side = deviation.signum();
        if changes {
            self.intervals = [self.intervals[1], self.since];
            self.since = 0.0;
        }
        changes
    }

    /// True if a whole period is known.
    pub fn has_period(&self) -> bool {
        self.intervals[0] > 0.0
    }

    /// Time over which sums must decay to cover the oscillation [s]; 0 for a constant value.
    #[inline]
    pub fn memory(&self) -> f64 {
        if self.deviations > 0.0 { PERIODS * (self.intervals[0] + self.intervals[1]).max(self.since) } else { 0.0 }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Memory after 80 s of a sine with `period` [s] and steps of 10 ms, 60 s after a jump of its mean.
    fn memory_of(period: f64, sign: f64) -> f64 {
        let (mut oscillation, h) = (Oscillation::default(), 0.01);
        for step in 0..8000 {
            let mean = if step < 2000 { 3.0 } else { -1.0 };
            oscillation.add(sign * (mean + (core::f64::consts::TAU * f64::from(step) * h / period).sin()), h);
        }
        oscillation.memory()
    }

    #[test]
    fn the_memory_covers_the_period_of_an_oscillation_about_a_mean_that_jumps() {
        for period in [0.2, 1.0, 6.0] {
            let memory = memory_of(period, 1.0);
            assert!((memory / (2.0 * period) - 1.0).abs() < 0.1, "{period}: {memory}");
            assert_eq!(memory, memory_of(period, -1.0));
        }
    }

    #[test]
    fn a_constant_value_needs_no_memory() {
        let mut oscillation = Oscillation::default();
        for _ in 1..100 {
            assert!(!oscillation.add(7.0, 1e-3));
        }
        assert_eq!(oscillation.memory(), 0.0);
    }
}
